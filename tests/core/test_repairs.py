"""Every repair method: only its interval and axes, pure, deterministic; and exactness where due."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from gaps import gap, hide
from hypothesis import given, settings
from hypothesis import strategies as st

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind, Status, axis_columns
from markermend.errors import Cancelled, DataError, MethodError
from markermend.patch import patched
from markermend.repairs import (
    REPAIRS,
    choose,
    evidence_for,
    fill,
    find_gaps,
    propose,
    propose_from,
    repair,
    repair_all,
)
from markermend.repairs.interpolation import too_few
from markermend.repairs.result import without_own
from markermend.take import Origin, Take

RATE = 100.0
BODY = np.array(
    [
        [0, 0, 0],
        [200, 0, 0],
        [0, 300, 0],
        [0, 0, 150],
        [120, 80, 60],
        [-90, 40, 110],
        [60, -70, 90],
        [30, 210, -40],
    ],
    dtype=float,
)


def rotations(angles: FloatArray) -> FloatArray:
    """(frames, 3, 3) rotations about z, then x."""
    c, s = np.cos(angles), np.sin(angles)
    zero, one = np.zeros((len(angles), 1))[:, 0], np.ones(len(angles[:, 0]))
    about_z = np.stack([c[:, 0], -s[:, 0], zero, s[:, 0], c[:, 0], zero, zero, zero, one], 1)
    about_x = np.stack([one, zero, zero, zero, c[:, 1], -s[:, 1], zero, s[:, 1], c[:, 1]], 1)
    return about_z.reshape(-1, 3, 3) @ about_x.reshape(-1, 3, 3)


def rigid_take(frames: int = 600, seed: int = 0) -> Take:
    """One rigid body turning and walking, with nothing missing."""
    rng = np.random.default_rng(seed)
    t = np.arange(frames) / RATE
    phase, speed = rng.uniform(0, 6, 5), rng.uniform(0.3, 1.2, 5) * 2 * np.pi
    waves = np.sin(speed * t[:, None] + phase)
    turned = np.einsum("fij,mj->fmi", rotations(waves[:, :2]), BODY)
    positions = turned + 300 * waves[:, None, 2:] + np.array([0.0, 0.0, 900.0])
    return Take(positions, tuple(f"M{i}" for i in range(len(BODY))), RATE)


def lonely(values: FloatArray) -> Take:
    """A take of one marker only."""
    return Take(values[:, None], ("M0",), RATE)


@pytest.fixture(scope="module")
def rigid() -> Take:
    return rigid_take()


@pytest.mark.parametrize("name", list(REPAIRS))
@pytest.mark.parametrize("axes", ["y", "xz", "xyz"])
def test_method_touches_only_its_interval_and_axes(rigid: Take, name: str, axes: str) -> None:
    artifact = Artifact("M1", axes, 250, 275, Kind.STEP, counterpart="M2")
    before = rigid.positions.copy()
    first = propose(rigid, artifact, method=name)
    # Not measured elsewhere a second time, where that takes longer than the repair.
    again = propose_from(evidence_for(rigid, [artifact]), artifact, method=name)
    assert np.array_equal(rigid.positions, before)
    assert len(first.patches) == len(again.patches)
    for one, two in zip(first.patches, again.patches, strict=True):
        assert np.array_equal(one.values, two.values, equal_nan=True)
    if not first.patches:
        assert first.reason.endswith(".")
        return
    after = patched(rigid, first.patches)
    assert after.positions.shape == before.shape
    assert after.positions.dtype == np.float64
    allowed = np.zeros(before.shape, dtype=bool)
    for label in ("M1", "M2") if name == "swap" else ("M1",):
        for axis in axis_columns(axes):
            allowed[250:275, rigid.index(label), axis] = True
    changed = before.view(np.int64) != after.positions.view(np.int64)
    assert not (changed & ~allowed).any()
    assert (changed & allowed).any()


@pytest.mark.parametrize("name", list(REPAIRS))
def test_method_fills_a_gap_or_says_why(rigid: Take, name: str) -> None:
    take = hide(rigid, "M1", 250, 262)
    done = propose(take, gap("M1", 250, 262), method=name)
    assert done.method == name
    if done.patches:
        (patch,) = done.patches
        assert patch.axes == "xyz"
        assert np.isfinite(patch.values).all()
        after = patched(take, done.patches)
        assert (after.origin[250:262, 1] == Origin.FILLED).all()
        assert (np.delete(after.origin, 1, axis=1) == Origin.MEASURED).all()
    else:
        assert done.reason.endswith(".")


@pytest.mark.parametrize("name", list(REPAIRS))
def test_method_survives_a_take_where_little_is_known(name: str) -> None:
    positions = np.full((40, 2, 3), np.nan)
    positions[5:8, 0] = 1.0
    positions[:, 1] = 2.0
    take = Take(positions, ("A", "B"), RATE)
    for start, stop in ((0, 5), (8, 40)):
        done = propose(take, gap("A", start, stop), method=name)
        assert bool(done.patches) != bool(done.reason)


@given(
    start=st.integers(3, 60),
    length=st.integers(1, 30),
    slope=st.floats(-50, 50),
    name=st.sampled_from(["linear", "spline", "pchip", "makima"]),
)
@settings(max_examples=40, deadline=None)
def test_curves_reproduce_a_straight_line(start: int, length: int, slope: float, name: str) -> None:
    t = np.arange(100.0)
    truth = np.stack([slope * t, 7.0 - slope * t, np.full(100, 3.0)], axis=1)
    take = hide(lonely(truth), "M0", start, start + length)
    done = propose(take, gap("M0", start, start + length), method=name)
    assert np.allclose(done.patches[0].values, truth[start : start + length], atol=1e-6)


def test_spline_reproduces_a_cubic() -> None:
    t = np.linspace(-1, 1, 120)
    truth = np.stack([100 * t**3 - 40 * t, 30 * t**2, 5 * t**3 + t**2], axis=1)
    take = hide(lonely(truth), "M0", 50, 70)
    done = propose(take, gap("M0", 50, 70), method="spline")
    assert np.allclose(done.patches[0].values, truth[50:70], atol=1e-8)


def test_savgol_reproduces_a_polynomial_of_its_order_up_to_the_ends() -> None:
    t = np.linspace(-1, 1, 200)
    truth = np.stack([100 * t**13, 50 * t**7 - t, 10 * t**2], axis=1)
    take = lonely(truth)
    for start, stop in ((0, 12), (90, 110), (195, 200)):
        artifact = Artifact("M0", "xyz", start, stop, Kind.NOISE)
        done = propose(take, artifact, method="savgol")
        assert np.allclose(done.patches[0].values, truth[start:stop], atol=1e-7)


@pytest.mark.parametrize("name", ["linear", "spline", "pchip", "makima"])
@pytest.mark.parametrize(("start", "stop", "word"), [(0, 20, "beginning"), (580, 600, "end")])
def test_curves_do_not_extrapolate(
    rigid: Take, name: str, start: int, stop: int, word: str
) -> None:
    done = propose(hide(rigid, "M1", start, stop), gap("M1", start, stop), method=name)
    assert not done.patches
    assert word in done.reason


def test_too_few_samples_are_told_as_an_operator_would(rigid: Take) -> None:
    gone = propose(hide(rigid, "M1", 0, 300), gap("M1", 300, 310), method="kalman")
    assert gone.reason == "M1 has no trusted samples near the interval's beginning; needed: 4."
    assert "only one trusted sample near the interval's end" in too_few("M1", 9, 1, 2)
    assert "only 3 trusted samples near the interval's end" in too_few("M1", 9, 3, 4)


@pytest.mark.parametrize("sure", [2.0, -0.1, float("nan")])
def test_a_confidence_that_is_none_is_refused(rigid: Take, sure: float) -> None:
    with pytest.raises(MethodError, match="from 0 to 1"):
        repair(rigid, [gap("M1", 10, 20)], min_confidence=sure)
    with pytest.raises(MethodError, match="0 or more"):
        fill(rigid, max_gap=-1)


def test_why_chosen_references_do_not_do_names_them(rigid: Take) -> None:
    take = hide(hide(rigid, "M1", 100, 200), "M2", 150, 160)
    chosen = ("M2", "M3", "M4")
    done = propose(take, gap("M1", 100, 200), references=chosen)
    assert not done.patches
    assert done.reason.startswith("With only M2, M3, M4 to follow: Only two others of the body")


def test_curves_do_not_look_at_flagged_samples(rigid: Take) -> None:
    damaged = rigid.positions.copy()
    damaged[240:250, 1] += 500.0
    take = Take(damaged, rigid.labels, RATE)
    other = Artifact("M1", "xyz", 240, 250, Kind.STEP)
    one = propose(take, Artifact("M1", "xyz", 250, 253, Kind.PEAK), [other], method="linear")
    edges = rigid.positions[[239, 253], 1]
    expected = edges[0] + (np.arange(250, 253)[:, None] - 239) / 14 * (edges[1] - edges[0])
    assert np.allclose(one.patches[0].values, expected)


def test_swap_restores_the_truth_bit_for_bit(rigid: Take) -> None:
    mixed = rigid.positions.copy()
    mixed[100:180, [1, 2]] = mixed[100:180, [2, 1]]
    take = Take(mixed, rigid.labels, RATE)
    one = Artifact("M1", "xyz", 100, 180, Kind.STEP, counterpart="M2")
    other = Artifact("M2", "xyz", 100, 180, Kind.STEP, counterpart="M1")
    clean = repair(take, [one, other])
    assert np.array_equal(clean.positions, rigid.positions)
    assert (clean.origin[100:180, 1:3] == Origin.EDITED).all()
    second = propose(clean, other, [one.with_status(Status.REPAIRED)])
    assert not second.patches
    assert "Already exchanged" in second.reason


def test_swap_of_three_restores_the_truth_whoever_tells_it(rigid: Take) -> None:
    mixed = rigid.positions.copy()
    mixed[100:180, [1, 2, 3]] = mixed[100:180, [3, 1, 2]]
    take = Take(mixed, rigid.labels, RATE)
    names = ("M1", "M2", "M3")
    told = [
        Artifact(
            names[i], "xyz", 100, 180, Kind.STEP,
            counterpart=names[i - 2], further_counterparts=(names[i - 1],),
        )
        for i in range(3)
    ]  # fmt: skip
    for artifacts in (told, told[2:], told[:1]):
        assert np.array_equal(repair(take, artifacts).positions, rigid.positions)


def test_swap_refuses_the_same_name_twice(rigid: Take) -> None:
    same = Artifact("M1", "xyz", 10, 20, Kind.STEP, counterpart="M2", further_counterparts=("M1",))
    done = propose(rigid, same, method="swap")
    assert not done.patches
    assert "M2 and M1" in done.reason


def test_swap_exchanges_a_gap_too(rigid: Take) -> None:
    truth = hide(rigid, "M1", 120, 140).positions
    mixed = truth.copy()
    mixed[100:180, [1, 2]] = mixed[100:180, [2, 1]]
    take = Take(mixed, rigid.labels, RATE)
    artifact = Artifact("M1", "x", 100, 180, Kind.STEP, counterpart="M2")
    clean = repair(take, [artifact])
    assert np.array_equal(clean.positions, truth, equal_nan=True)
    assert (clean.origin[120:140, 1] == Origin.MISSING).all()
    assert (clean.origin[120:140, 2] == Origin.EDITED).all()


def test_leave_empty_makes_a_gap_and_refuses_half_samples(rigid: Take) -> None:
    done = propose(rigid, Artifact("M1", "xyz", 10, 20, Kind.NOISE), method="leave_empty")
    after = patched(rigid, done.patches)
    assert not after.present[10:20, 1].any()
    assert after.present.sum() == rigid.present.sum() - 10
    half = propose(rigid, Artifact("M1", "x", 10, 20, Kind.NOISE), method="leave_empty")
    assert not half.patches


@pytest.mark.parametrize(("start", "stop"), [(0, 60), (200, 215), (250, 400), (540, 600)])
def test_local_regression_reproduces_a_rigid_body(rigid: Take, start: int, stop: int) -> None:
    take = hide(rigid, "M4", start, stop)
    done = propose(take, gap("M4", start, stop), method="local_regression")
    error = np.linalg.norm(done.patches[0].values - rigid.positions[start:stop, 4], axis=1)
    assert error.max() < 1e-3
    assert done.band_mm is not None
    assert done.band_mm.shape == (stop - start,)


def test_local_regression_works_with_a_missing_reference(rigid: Take) -> None:
    take = hide(hide(rigid, "M4", 200, 300), "M5", 250, 320)
    clean = fill(take)
    assert np.abs(clean.positions - rigid.positions).max() < 1e-3


def test_damage_in_a_reference_is_not_believed(rigid: Take) -> None:
    damaged = hide(rigid, "M4", 200, 260).positions.copy()
    damaged[190:270, 5] += 80.0
    take = Take(damaged, rigid.labels, RATE)
    step = Artifact("M5", "xyz", 190, 270, Kind.STEP)
    done = propose(take, gap("M4", 200, 260), [step])
    assert np.abs(done.patches[0].values - rigid.positions[200:260, 4]).max() < 1e-3


def test_choice_by_kind() -> None:
    assert choose(Artifact("M", "x", 1, 2, Kind.PEAK)) == "kalman"
    assert choose(Artifact("M", "x", 1, 9, Kind.STEP, counterpart="N")) == "swap"
    for kind in (Kind.STEP, Kind.GAP, Kind.NOISE, Kind.SLOW):
        assert choose(Artifact("M", "x", 1, 9, kind)) == "local_regression"


def test_auto_falls_back_and_says_why() -> None:
    t = np.arange(200) / RATE
    wave = np.stack([np.sin(t), np.cos(t), t], axis=1) * 100
    take = hide(lonely(wave), "M0", 80, 90)
    done = propose(take, gap("M0", 80, 90))
    assert done.method == "kalman"
    assert done.patches
    assert done.reason
    long = propose(hide(lonely(wave), "M0", 40, 160), gap("M0", 40, 160))
    assert not long.patches
    assert long.reason


def test_repair_leaves_what_is_rejected_doubtful_or_done(rigid: Take) -> None:
    flags = [
        replace(Artifact("M1", "xyz", 50, 60, Kind.NOISE), status=Status.REJECTED),
        Artifact("M2", "xyz", 50, 60, Kind.NOISE, confidence=0.49),
        replace(Artifact("M3", "xyz", 50, 60, Kind.NOISE), status=Status.REPAIRED),
    ]
    assert repair_all(rigid, flags) == ()
    assert np.array_equal(repair(rigid, flags).positions, rigid.positions)


def test_patches_of_repair_all_give_what_repair_gives(rigid: Take) -> None:
    damaged = hide(rigid, "M4", 200, 260).positions.copy()
    damaged[100, 4, 0] += 30.0
    damaged[300:340, 6] += 20.0
    take = Take(damaged, rigid.labels, RATE)
    flags = [
        gap("M4", 200, 260),
        Artifact("M4", "x", 100, 101, Kind.PEAK),
        Artifact("M6", "xyz", 300, 340, Kind.STEP),
    ]
    shares: list[float] = []
    clean = repair(take, flags, progress=lambda share, _: shares.append(share))
    pairs = repair_all(take, flags)
    assert [r.method for _, r in pairs] == ["kalman", "local_regression", "local_regression"]
    replayed = patched(take, [p for _, r in pairs for p in r.patches])
    assert np.array_equal(replayed.positions, clean.positions)
    assert np.abs(clean.positions - rigid.positions).max() < 0.05
    assert shares == sorted(shares)
    assert shares[-1] == 1.0


def test_repair_can_be_cancelled(rigid: Take) -> None:
    def stop(share: float, doing: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        repair(rigid, [Artifact("M1", "x", 5, 6, Kind.PEAK)], progress=stop)


def test_fill_takes_gaps_up_to_the_longest_named(rigid: Take) -> None:
    take = hide(hide(rigid, "M1", 50, 55), "M2", 100, 150)
    assert [(g.marker, g.length) for g in find_gaps(take)] == [("M1", 5), ("M2", 50)]
    with pytest.raises(MethodError, match="whole number"):
        fill(take, max_gap=0.2)
    with pytest.raises(MethodError, match="no parameter “windw”"):
        fill(take, method="savgol", windw=3)
    with pytest.raises(MethodError, match="“auto” has no parameters"):
        fill(take, context=3)
    short = fill(take, max_gap=20)
    assert short.present[:, 1].all()
    assert not short.present[100:150, 2].any()
    assert fill(take, method="linear").present.all()
    near, far = (fill(take, method="spline", context=n).positions for n in (4, 200))
    assert np.abs(near - far)[100:150, 2].max() > 0.01


def test_unlabelled_and_never_seen_markers_are_no_gaps() -> None:
    positions = np.zeros((30, 3, 3)) + 1.0
    positions[10:20, 0] = np.nan
    positions[:, 1] = np.nan
    take = Take(positions, ("*12", "GONE", "HERE"), RATE)
    assert find_gaps(take) == ()


def test_wrong_requests_are_errors(rigid: Take) -> None:
    artifact = Artifact("M1", "x", 5, 6, Kind.PEAK)
    with pytest.raises(MethodError, match="spline"):
        propose(rigid, artifact, method="no such")
    with pytest.raises(MethodError, match="context"):
        propose(rigid, artifact, method="spline", params={"context": 1})
    with pytest.raises(MethodError, match="width"):
        propose(rigid, artifact, method="spline", params={"width": 1})
    with pytest.raises(DataError, match="600"):
        propose(rigid, Artifact("M1", "x", 590, 601, Kind.PEAK))


def test_evidence_excludes_missing_and_flagged(rigid: Take) -> None:
    take = hide(rigid, "M1", 10, 20)
    flags = [
        Artifact("M2", "y", 30, 60, Kind.NOISE),
        replace(Artifact("M3", "x", 30, 31, Kind.PEAK), status=Status.REPAIRED),
        replace(Artifact("M4", "x", 30, 60, Kind.NOISE), status=Status.REJECTED),
    ]
    evidence = evidence_for(take, flags)
    expected = np.ones(take.positions.shape, dtype=bool)
    expected[10:20, 1] = False
    expected[30:60, 2, 1] = False
    assert np.array_equal(evidence.trusted, expected)
    assert np.array_equal(evidence.seen, expected.all(axis=2))
    own = without_own(evidence, Artifact("M5", "x", 40, 50, Kind.NOISE))
    assert not own.trusted[38:52, 5, 0].any()
    assert np.array_equal(own.seen, own.trusted.all(axis=2))
    for axis in range(3):
        expected[70 + axis, 5, axis] = False
    assert np.array_equal(replace(evidence, trusted=expected).seen, expected.all(axis=2))


def test_number_keys_pick_methods_in_order() -> None:
    keyed = [(m.key, name) for name, m in REPAIRS.items() if m.key is not None]
    assert keyed == sorted(keyed)
    assert keyed[0] == (1, "local_regression")


def test_a_missing_limb_is_worked_out_from_repairs_and_says_so(rigid: Take) -> None:
    positions = rigid.positions.copy()
    for column, start, stop in ((1, 100, 220), (2, 200, 380), (3, 360, 540), (4, 100, 540)):
        positions[start:stop, column] = np.nan
    take = Take(positions[:, :6], rigid.labels[:6], RATE)
    pairs = {a.marker: r for a, r in repair_all(take, find_gaps(take))}
    late = {m for m, r in pairs.items() if r.patches and "other repairs" in r.reason}
    assert late == {"M2", "M4"}
    assert np.abs(fill(take).positions - rigid.positions[:, :6]).max() < 0.01


def test_what_would_be_far_off_is_left_with_its_expected_error() -> None:
    rng = np.random.default_rng(0)
    steps = rng.normal(size=(400, 5, 3)).cumsum(axis=0) * 40
    take = hide(Take(steps, tuple("ABCDE"), RATE), "A", 100, 190)
    done = propose(take, gap("A", 100, 190))
    assert not done.patches
    assert "mm off" in done.reason
    assert propose(take, gap("A", 100, 190), method="linear").patches


def test_what_is_named_is_not_left_for_being_far_off_and_says_how_far() -> None:
    rng = np.random.default_rng(0)
    positions = rng.normal(size=(640, 6, 3)).cumsum(axis=0) * 40
    for column, start, stop in ((1, 100, 220), (2, 200, 380), (3, 360, 540), (4, 100, 540)):
        positions[start:stop, column] = np.nan
    take = Take(positions, tuple("ABCDEF"), RATE)
    pairs = repair_all(take, find_gaps(take), method="local_regression")
    late = [r for _, r in pairs if "other repairs" in r.reason]
    assert late
    assert all(r.patches and r.error_mm is not None and r.error_mm > 50.0 for r in late)


def test_a_repaired_take_is_the_same_whether_a_model_is_measured_or_not(rigid: Take) -> None:
    take = hide(rigid, "M4", 250, 350)
    ((_, told),) = repair_all(take, find_gaps(take), method="lpr")
    assert told.error_mm is not None
    named = repair(take, find_gaps(take), method="lpr")
    np.testing.assert_array_equal(named.positions, patched(take, told.patches).positions)


@pytest.mark.parametrize("noise_mm", [0.1, 1.0])
def test_local_regression_does_not_follow_noise(rigid: Take, noise_mm: float) -> None:
    rng = np.random.default_rng(4)
    noisy = rigid.positions + rng.normal(0, noise_mm, rigid.positions.shape)
    take = hide(Take(noisy, rigid.labels, RATE), "M4", 250, 350)
    done = propose(take, gap("M4", 250, 350))
    error = np.linalg.norm(done.patches[0].values - rigid.positions[250:350, 4], axis=1).mean()
    assert error < 1.5 * noise_mm


def test_edges_flagged_a_frame_too_narrow_do_not_drag_the_repair(rigid: Take) -> None:
    damaged = rigid.positions.copy()
    damaged[300:340, 4] += [12.0, 9.0, 0.0]
    take = Take(damaged, rigid.labels, RATE)
    done = propose(take, Artifact("M4", "xyz", 302, 338, Kind.STEP))
    assert done.patches[0].start == 302
    assert np.abs(done.patches[0].values - rigid.positions[302:338, 4]).max() < 1e-3
