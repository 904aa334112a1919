"""Many artifacts repaired, gaps filled: what is left, in which order, and what is said of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from gaps import gap, hide
from rigid import RATE, lonely, rigid_take

from markermend.artifact import Artifact, Kind, Status
from markermend.errors import Cancelled, MethodError
from markermend.patch import patched
from markermend.repairs import (
    fill,
    find_gaps,
    propose,
    repair,
    repair_all,
)
from markermend.take import Take


@pytest.fixture(scope="module")
def rigid() -> Take:
    return rigid_take()


@pytest.mark.parametrize("sure", [2.0, -0.1, float("nan")])
def test_a_confidence_that_is_none_is_refused(rigid: Take, sure: float) -> None:
    with pytest.raises(MethodError, match="from 0 to 1"):
        repair(rigid, [gap("M1", 10, 20)], min_confidence=sure)
    with pytest.raises(MethodError, match="0 or more"):
        fill(rigid, max_gap=-1)


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
