"""Every repair method: only its interval and axes, pure, deterministic; and exactness where due."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from gaps import gap, hide
from hypothesis import given, settings
from hypothesis import strategies as st
from rigid import RATE, lonely, rigid_take

from markermend.artifact import Artifact, Kind, Status, axis_columns
from markermend.errors import DataError, MethodError
from markermend.patch import patched
from markermend.repairs import (
    REPAIRS,
    choose,
    evidence_for,
    fill,
    propose,
    propose_from,
    repair,
)
from markermend.repairs.interpolation import too_few
from markermend.repairs.result import without_own
from markermend.take import Origin, Take


@pytest.fixture(scope="module")
def rigid() -> Take:
    return rigid_take()


@pytest.mark.parametrize("name", list(REPAIRS))
@pytest.mark.parametrize("axes", ["y", "xz", "xyz"])
def test_method_touches_only_its_interval_and_axes(rigid: Take, name: str, axes: str) -> None:
    artifact = Artifact("M1", axes, 250, 275, Kind.STEP, counterpart="M2")
    before = rigid.positions.copy()
    # Measured elsewhere once only, where that takes longer than the repair.
    first, again = (
        propose(rigid, artifact, method=name)
        if axes == "xyz" and not n
        else propose_from(evidence_for(rigid, [artifact]), artifact, method=name)
        for n in range(2)
    )
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
