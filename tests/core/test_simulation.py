from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import savgol_filter

from markermend.artifact import Artifact, Kind, damage_mask
from markermend.errors import Cancelled, DataError, MethodError
from markermend.mesh import infer_mesh
from markermend.repairs import repair
from markermend.simulation import Activity, Amounts, damage, simulate, simulate_clean
from markermend.simulation.damage import hann, rounded_triangle
from markermend.simulation.markers import MARKER_SET
from markermend.simulation.performer import perform
from markermend.simulation.skeleton import BALL, HEEL, PARENTS, Motion, joint_offset, turned
from markermend.take import Take

EVERYTHING = tuple(
    Activity(name, 4.0) for name in ("stand", "reach", "walk", "turn", "walk", "sit", "reach")
)


@lru_cache
def clean_take() -> Take:
    return simulate_clean(duration_s=40.0, seed=0)


@lru_cache
def motion(seed: int = 0) -> Motion:
    rng = np.random.default_rng(seed)
    return perform(duration_s=28.0, rate=100.0, height_mm=1750.0, activities=EVERYTHING, rng=rng)


def test_the_set_has_53_markers_and_is_symmetrical() -> None:
    assert len(MARKER_SET) == 53
    left = {label[1:] for label in MARKER_SET if label[0] == "L"}
    right = {label[1:] for label in MARKER_SET if label[0] == "R" and label != "RBAK"}
    assert left == right
    assert len(left) == 24


def test_bones_keep_their_length() -> None:
    body = motion()
    for segment, parent in PARENTS.items():
        if parent:
            span = np.linalg.norm(body.origins[segment] - body.origins[parent], axis=1)
            expected = np.linalg.norm(joint_offset(segment, body.height_mm))
            assert np.allclose(span, expected, atol=1e-9), segment
    for frame in body.rotations.values():
        assert np.allclose(frame @ frame.transpose(0, 2, 1), np.eye(3), atol=1e-9)


def test_markers_of_one_bone_are_rigid_without_soft_tissue() -> None:
    take = simulate_clean(
        duration_s=8, soft_tissue=False, noise=False, labels=["LTHI", "LTHF", "LKNE"], seed=4
    )
    for i, j in ((0, 1), (0, 2), (1, 2)):
        spans = np.linalg.norm(take.positions[:, i] - take.positions[:, j], axis=1)
        assert np.ptp(spans) < 1e-9
    soft = simulate_clean(duration_s=8, noise=False, labels=["LTHI", "LTHF", "LKNE"], seed=4)
    moved = np.linalg.norm(soft.positions - take.positions, axis=2)
    assert 1.0 < moved.max() < 25.0


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_it_moves_like_a_person(seed: int) -> None:
    body = motion(seed)
    for side in "LR":
        thigh, shank = body.rotations[side + "thigh"], body.rotations[side + "shank"]
        # The shank turns backwards about the knee, never forwards.
        bent = np.degrees(
            np.arctan2(
                np.einsum("fi,fi->f", thigh[:, :, 0], shank[:, :, 2]),
                np.einsum("fi,fi->f", thigh[:, :, 2], shank[:, :, 2]),
            )
        )
        assert 2 < bent.min() < 25
        assert 80 < bent.max() < 125
        foot, turn = body.origins[side + "foot"], body.rotations[side + "foot"]
        contacts = np.stack([foot + turned(turn, np.array(p) * 1750.0) for p in (BALL, HEEL)])
        assert contacts[..., 2].min() > -5.0
        planted = contacts[..., 2].max(axis=0) < 2.0
        slide = np.linalg.norm(np.diff(contacts[0, :, :2], axis=0), axis=1) * 100.0
        assert planted.mean() > 0.5
        assert np.quantile(slide[planted[1:] & planted[:-1]], 0.95) < 30.0
    pelvis = body.origins["pelvis"]
    assert 850 < pelvis[100, 2] < 940
    assert pelvis[:, 2].min() < 600
    hands = [body.origins[s + "hand"] for s in "LR"]
    assert np.linalg.norm(hands[0] - hands[1], axis=1).min() > 80


def test_nothing_jumps_and_noise_is_that_of_good_cameras() -> None:
    difference = np.diff(clean_take().positions, axis=0)
    lens = np.abs(difference - savgol_filter(difference, 13, 5, axis=0))
    assert 0.4 < np.quantile(lens, 0.9999) < 2.0
    silent = simulate_clean(duration_s=40.0, seed=0, noise=False).positions
    difference = np.diff(silent, axis=0)
    assert np.abs(difference - savgol_filter(difference, 13, 5, axis=0)).max() < 1.0


def test_its_mesh_is_the_one_a_person_would_draw() -> None:
    take = clean_take()
    mesh = infer_mesh(take)
    groups = [{take.labels[i] for i in group.markers} for group in mesh.groups]
    assert {"LFHD", "RFHD", "LBHD", "RBHD"} in groups
    assert {"LASI", "RASI", "LPSI", "RPSI"} in groups
    assert any({"LTHI", "LTHF"} <= g and not g & {"RTHI", "LTIB"} for g in groups)
    assert any({"RFRM", "RWRA", "RFIN"} <= g and "LWRA" not in g for g in groups)


def test_the_same_seed_gives_the_same_take() -> None:
    first, again = (simulate(duration_s=12, seed=5) for _ in range(2))
    other = simulate(duration_s=12, seed=6)
    assert np.array_equal(first[0].positions, again[0].positions, equal_nan=True)
    assert first[0].residuals is not None
    assert again[0].residuals is not None
    assert np.array_equal(first[0].residuals, again[0].residuals, equal_nan=True)
    assert first[1] == again[1]
    assert first[1] != other[1]


def test_rate_height_and_subset_are_heeded() -> None:
    take = simulate_clean(duration_s=5, rate=60, height_m=1.5, labels=["RFHD", "LTOE"], seed=1)
    assert (take.frames, take.labels, take.rate) == (300, ("RFHD", "LTOE"), 60.0)
    assert take.positions[0, 0, 2] == pytest.approx(1500 * 0.95, abs=40)
    assert take.residuals is not None
    assert take.residuals.dtype == np.float32
    whole = simulate_clean(duration_s=5, rate=60, height_m=1.5, noise=False, seed=1)
    part = simulate_clean(
        duration_s=5, rate=60, height_m=1.5, noise=False, labels=["RFHD", "LTOE"], seed=1
    )
    same = [whole.index(label) for label in part.labels]
    assert np.array_equal(part.positions, whole.positions[:, same])


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 2**31))
def test_damage_is_exactly_what_the_truth_says(seed: int) -> None:
    clean = clean_take()
    damaged, truth = damage(clean, seed=seed)
    same = (clean.positions == damaged.positions).astype(bool)
    assert np.array_equal(~same, damage_mask(clean, truth))
    gaps = np.zeros(clean.positions.shape[:2], dtype=bool)
    for a in truth:
        if a.kind is Kind.GAP:
            gaps[a.start : a.stop, clean.index(a.marker)] = True
    assert np.array_equal(~damaged.present, gaps)
    assert damaged.residuals is not None
    assert np.array_equal(np.isnan(damaged.residuals), gaps)
    assert {a.kind for a in truth} == set(Kind)
    assert 40 <= len(truth) <= 60


def test_swaps_name_each_other_and_swap_back() -> None:
    clean = clean_take()
    damaged, truth = damage(clean, amounts=only(swaps=4), seed=2)
    assert len(truth) == 8
    places = {(a.marker, a.counterpart, a.start, a.stop) for a in truth}
    for a in truth:
        assert (a.counterpart, a.marker, a.start, a.stop) in places
        assert a.counterpart is not None
        rows = slice(a.start, a.stop)
        there = damaged.positions[rows, clean.index(a.counterpart)]
        assert np.array_equal(there, clean.positions[rows, clean.index(a.marker)])


@pytest.mark.parametrize("kind", ["swaps_of_three", "brief_swaps", "swaps_with_gap"])
def test_rare_swaps_are_repaired_by_their_truth(kind: str) -> None:
    clean = clean_take()
    damaged, truth = damage(clean, amounts=only(**{kind: 4.0}), seed=6)
    swaps = [a for a in truth if a.counterpart]
    assert {len(a.markers) for a in swaps} == {3 if kind == "swaps_of_three" else 2}
    assert not np.array_equal(damaged.positions, clean.positions, equal_nan=True)
    repaired = repair(damaged, swaps)
    seen = repaired.present
    assert np.array_equal(repaired.positions[seen], clean.positions[seen])
    assert seen.all() == (kind != "swaps_with_gap")


def test_ghosts_frozen_stretches_and_falls_are_where_the_truth_says() -> None:
    clean = clean_take()
    amounts = only(ghosts=6, frozen=6, falls=3, peaks_on_drifts=6)
    damaged, truth = damage(clean, amounts=amounts, seed=4)
    changed = ~(damaged.positions == clean.positions)
    assert np.array_equal(changed, damage_mask(clean, truth))
    for a in truth:
        rows, column = slice(a.start, a.stop), clean.index(a.marker)
        if "frozen" in a.why:
            repeated = damaged.positions[a.start - 1 : a.stop, column]
            assert (repeated == repeated[0]).all()
        if "fell off" in a.why:
            assert a.stop == clean.frames
        if "ghost" in a.why and a.kind is Kind.STEP:
            assert not damaged.present[[a.start - 1, a.stop], column].any()
            delta = damaged.positions[rows, column] - clean.positions[rows, column]
            assert np.linalg.norm(delta, axis=1) == pytest.approx(a.amplitude_mm)
        if "peak on" in a.why:
            assert any(b.kind is Kind.SLOW and b.overlaps(a.start, a.stop) for b in truth)


def test_sizes_are_those_of_the_truth() -> None:
    clean = clean_take()
    damaged, truth = damage(clean, amounts=only(peaks=20, steps=10, drifts=9), seed=8)
    for a in truth:
        rows = slice(a.start, a.stop)
        column = clean.index(a.marker)
        delta = damaged.positions[rows, column] - clean.positions[rows, column]
        assert np.linalg.norm(delta, axis=1).max() == pytest.approx(a.amplitude_mm)
        assert np.array_equal(np.abs(delta).max(axis=0) > 0, [axis in a.axes for axis in "xyz"])


def only(**amounts: float) -> Amounts:
    nothing = dict.fromkeys(Amounts.__dataclass_fields__, 0.0)
    return Amounts(**(nothing | amounts))


@given(st.integers(10, 200))
def test_shapes_of_slow_changes_rise_to_one_and_are_nowhere_zero(length: int) -> None:
    for shape in (hann(length), rounded_triangle(length, 9)):
        assert len(shape) == length
        assert shape.max() == pytest.approx(1.0)
        assert shape.min() > 0
        assert np.allclose(shape, shape[::-1])


def test_undamaged_means_clean() -> None:
    take, truth = simulate(duration_s=12, seed=3, damaged=False)
    assert truth == ()
    assert take.present.all()
    assert np.array_equal(take.positions, simulate_clean(duration_s=12, seed=3).positions)


def test_nonsense_is_refused() -> None:
    with pytest.raises(MethodError, match="hour"):
        simulate_clean(duration_s=0)
    with pytest.raises(MethodError, match="fly"):
        simulate_clean(activities=[Activity("fly", 3.0)])
    with pytest.raises(MethodError, match="XYZ"):
        simulate_clean(duration_s=2, labels=["XYZ"])
    with pytest.raises(DataError, match="short"):
        simulate(duration_s=1.5)


def test_it_can_be_stopped() -> None:
    def stop(share: float, doing: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        simulate(duration_s=5, progress=stop)


def overlap(a: Artifact, b: Artifact) -> bool:
    return a.marker == b.marker and b.overlaps(a.start, a.stop)


def test_artifacts_of_one_marker_never_overlap() -> None:
    _, truth = damage(clean_take(), seed=1)
    assert not any(overlap(a, b) for i, a in enumerate(truth) for b in truth[:i])


def test_a_person_who_stands_does_not_jitter() -> None:
    stand = (Activity("stand", 8.0),)
    take = simulate_clean(duration_s=8.0, rate=120.0, seed=3, noise=False, activities=stand)
    hands = take.positions[12:-12, [take.index(name) for name in ("LWRA", "RWRA", "LFIN")]]
    # Fourth differences of the acceleration hold what changes from frame to frame, in mm/s².
    jitter = np.diff(hands, 6, axis=0) * take.rate**2 / np.sqrt(70.0)
    assert np.sqrt(np.mean(jitter**2)) < 0.5
