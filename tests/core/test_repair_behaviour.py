"""What `auto` does where much is missing, and that its repairs join and keep the body's lengths."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind
from markermend.bench.gaps import BAND_90
from markermend.patch import Patch, patched
from markermend.repairs import Repair, find_gaps, repair_all
from markermend.repairs.automatic import if_worth_it
from markermend.repairs.body_frame import rank_references
from markermend.simulation import simulate_clean
from markermend.take import Take

Hole = tuple[str, int, int]
FRAMES = 1200
RIGHT_ARM = ("RUPA", "RELB", "RELM", "RFRM", "RWRA", "RWRB", "RFIN", "RTHM")
# Nothing of it is left to hold its markers together: they are put back one by one.
ARM = "a whole arm"
HEAD = ("LFHD", "RFHD", "LBHD", "RBHD")


@pytest.fixture(scope="module")
def walk() -> Take:
    return simulate_clean(duration_s=FRAMES / 100.0, seed=5)


@pytest.fixture(scope="module")
def head(walk: Take) -> Take:
    """A take of four markers."""
    return Take(walk.positions[:, [walk.index(m) for m in HEAD]], HEAD, walk.rate)


def filled(truth: Take, holes: list[Hole]) -> tuple[Take, list[tuple[Artifact, Repair]]]:
    """Hide some samples and let `auto` fill them."""
    positions = truth.positions.copy()
    for marker, start, stop in holes:
        positions[start:stop, truth.index(marker)] = np.nan
    take = Take(positions, truth.labels, truth.rate)
    pairs = list(repair_all(take, find_gaps(take)))
    return patched(take, (p for _, r in pairs for p in r.patches)), pairs


def error(truth: Take, take: Take, holes: list[Hole]) -> float:
    """Mean distance from the truth over all that was hidden, mm; NaN where some was left."""
    apart = np.linalg.norm(take.positions - truth.positions, axis=2)
    return float(np.mean([apart[a:b, truth.index(m)].mean() for m, a, b in holes]))


CASES: dict[str, tuple[list[Hole], float]] = {
    "one": ([("LSHO", 400, 460)], 1.0),
    "beginning": ([("LSHO", 0, 80)], 2.0),
    "end": ([("LSHO", FRAMES - 80, FRAMES)], 2.0),
    "longer than half the take": ([("LTIB", 100, 800)], 3.0),
    "several at once": (
        [(m, 400, 500) for m in ("LFHD", "C7", "LELB", "LASI", "RKNE", "RTOE")],
        2.0,
    ),
    ARM: ([(m, 700, 800) for m in RIGHT_ARM], 15.0),
    "overlapping in turn": ([("LWRA", 400, 470), ("LWRB", 440, 520), ("LFRM", 500, 560)], 3.0),
}


@pytest.mark.parametrize("name", CASES)
def test_it_is_filled_and_near(walk: Take, name: str) -> None:
    holes, most_mm = CASES[name]
    take, pairs = filled(walk, holes)
    assert error(walk, take, holes) < most_mm
    assert all(r.error_mm is not None for _, r in pairs)
    assert not any(r.leaves for _, r in pairs)


@pytest.mark.parametrize("name", CASES)
def test_value_and_velocity_go_on_at_both_borders(walk: Take, name: str) -> None:
    holes, _ = CASES[name]
    take, _ = filled(walk, holes)
    for marker, start, stop in holes:
        column = walk.index(marker)
        for edge in (start, stop):
            if not 3 <= edge <= FRAMES - 3:
                continue
            # A jump of either is a second difference of its own size.
            around = slice(edge - 3, edge + 3)
            bend = np.abs(np.diff(take.positions[around, column], n=2, axis=0)).max()
            near = slice(max(0, edge - 50), edge + 50)
            usual = np.abs(np.diff(walk.positions[near, column], n=2, axis=0)).max()
            assert bend < 1.25 * usual + (0.3 if name != ARM else 1.0)


@pytest.mark.parametrize("name", CASES)
def test_segments_keep_the_lengths_they_have_elsewhere(walk: Take, name: str) -> None:
    holes, _ = CASES[name]
    take, _ = filled(walk, holes)
    for marker, start, stop in holes:
        column, inside = walk.index(marker), slice(start, stop)
        outside = np.ones(FRAMES, dtype=bool)
        outside[inside] = False
        nearest, _ = rank_references(walk, walk.present, column, slice(0, FRAMES))
        for other in nearest[:3]:
            length = np.linalg.norm(take.positions[:, column] - take.positions[:, other], axis=1)
            middle = np.median(length[outside])
            usual = np.abs(length[outside] - middle).max()
            slack = 0.5 if name != ARM else 5.0
            assert np.abs(length[inside] - middle).max() < 1.25 * usual + slack


def test_a_short_blackout_is_bridged_by_curves(walk: Take) -> None:
    holes = [(m, 400, 410) for m in walk.labels]
    take, pairs = filled(walk, holes)
    assert error(walk, take, holes) < 2.0
    assert all("three are needed" in r.reason for _, r in pairs)


def test_a_long_blackout_is_left_with_the_reason(walk: Take) -> None:
    take, pairs = filled(walk, [(m, 400, 600) for m in walk.labels])
    assert len(pairs) == len(walk.labels)
    assert np.isnan(take.positions[400:600]).all()
    assert all(not r.patches and "three are needed" in r.reason for _, r in pairs)


@pytest.mark.parametrize("length", [50, 800])
def test_a_take_of_four_markers_is_enough(head: Take, length: int) -> None:
    holes = [("RFHD", 150, 150 + length)]
    take, pairs = filled(head, holes)
    assert error(head, take, holes) < 2.0
    assert pairs[0][1].method == "local_regression"


def test_of_four_markers_two_gone_at_once_get_curves_or_the_reason(head: Take) -> None:
    short = [("RFHD", 400, 410), ("LBHD", 400, 410)]
    take, pairs = filled(head, short)
    assert error(head, take, short) < 2.0
    assert all("three are needed" in r.reason for _, r in pairs)
    long = [("RFHD", 400, 600), ("LBHD", 400, 600)]
    take, pairs = filled(head, long)
    assert all("three are needed" in r.reason for _, r in pairs)
    assert {r.method for _, r in pairs} == {"pattern"}
    # Beside the pattern's own expected error, it must be plain whose reason that is.
    assert all(r.reason.startswith("Local regression is not used: ") for _, r in pairs)
    # Usual distances pin them down, which each one's expected error does not count on.
    told = np.mean([r.error_mm for _, r in pairs])
    assert error(head, take, long) < 5.0 < told


def test_a_whole_arm_is_no_surer_than_what_it_follows(walk: Take) -> None:
    holes = [(m, 400, 600) for m in RIGHT_ARM]
    take, pairs = filled(walk, holes)
    for artifact, repair in pairs:
        if not repair.patches:
            assert "too far to be used" in repair.reason
            continue
        column, inside = walk.index(artifact.marker), slice(artifact.start, artifact.stop)
        apart = np.linalg.norm(
            take.positions[inside, column] - walk.positions[inside, column], axis=1
        )
        assert repair.error_mm is not None
        assert repair.error_mm > 0.3 * apart.mean()


def test_the_band_holds_where_the_take_begins_or_ends(walk: Take) -> None:
    inside = []
    for marker in walk.labels[::3]:
        for start in (0, FRAMES - 100):
            take, ((_, repair),) = filled(walk, [(marker, start, start + 100)])
            rows, column = slice(start, start + 100), walk.index(marker)
            apart = np.linalg.norm(
                take.positions[rows, column] - walk.positions[rows, column], axis=1
            )
            assert repair.band_mm is not None
            inside.append(np.mean(apart <= BAND_90 * repair.band_mm))
    assert 0.8 < np.mean(inside) < 0.97


def test_the_band_holds_in_short_gaps_where_most_of_the_error_is_noise(walk: Take) -> None:
    inside = []
    for n, marker in enumerate(walk.labels[::2]):
        start, length = 60 + 26 * n, 8 + n % 20
        take, ((_, repair),) = filled(walk, [(marker, start, start + length)])
        rows, column = slice(start, start + length), walk.index(marker)
        apart = np.linalg.norm(take.positions[rows, column] - walk.positions[rows, column], axis=1)
        assert repair.band_mm is not None
        inside.append(np.mean(apart <= BAND_90 * repair.band_mm))
    assert 0.8 < np.mean(inside) < 0.97


def test_the_band_holds_where_most_of_the_take_is_missing_and_one_side_is_short(walk: Take) -> None:
    rows, inside = slice(10, 730), []
    for marker in walk.labels[::3]:
        take, ((_, repair),) = filled(walk, [(marker, rows.start, rows.stop)])
        column = walk.index(marker)
        apart = np.linalg.norm(take.positions[rows, column] - walk.positions[rows, column], axis=1)
        assert repair.band_mm is not None
        inside.append(np.mean(apart <= BAND_90 * repair.band_mm))
    assert 0.85 < np.mean(inside) < 0.97


def test_own_movement_is_taken_where_the_rest_of_the_body_tells_far_less(walk: Take) -> None:
    _, pairs = filled(walk, CASES[ARM][0])
    instead = [r for _, r in pairs if r.reason.startswith("Local regression may be about")]
    assert instead
    assert all(r.method == "kalman" and r.error_mm is not None and r.error_mm < 20 for r in instead)


SPIKE = Artifact("LSHO", "x", 400, 403, Kind.PEAK, 0.9, 3.0)


@pytest.mark.parametrize(
    ("error_mm", "left", "refused"),
    [
        (2.9, (), ""),
        (3.1, (), "may be 3.1 mm off, more than the 3.0 mm"),
        (0.2, ((400, 401, 9.0),), "more damage than it mends: a peak of 9.0 mm"),
        (0.2, ((400, 401, 2.0),), ""),
        # What reaches beyond the interval was there before.
        (0.2, ((402, 405, 9.0),), ""),
    ],
)
def test_a_repair_that_is_worse_than_the_damage_is_not_made(error_mm, left, refused) -> None:
    leaves = tuple(Artifact("LSHO", "x", a, b, Kind.PEAK, 0.9, mm) for a, b, mm in left)
    patch = Patch("LSHO", "x", 400, 403, np.zeros((3, 1)))
    told = if_worth_it(SPIKE, Repair("kalman", (patch,), error_mm=error_mm, leaves=leaves))
    assert bool(told.patches) is not bool(refused)
    assert refused in told.reason
    noise = replace(SPIKE, kind=Kind.NOISE, amplitude_mm=1.6)
    told = if_worth_it(noise, Repair("kalman", (patch,), error_mm=error_mm))
    assert told.patches
    gap = Artifact("LSHO", "xyz", 400, 403, Kind.GAP, 1.0)
    assert if_worth_it(gap, Repair("kalman", (patch,), error_mm=error_mm, leaves=leaves)).patches
