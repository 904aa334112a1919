"""Markers gone together come back at their usual distances."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind, Status
from markermend.patch import Patch, patched
from markermend.repairs import Repair, evidence_for, find_gaps, propose, repair, repair_all
from markermend.repairs.lengths import at_usual_distances
from markermend.simulation import simulate_clean
from markermend.take import Take

LOST, LENGTH = slice(300, 360), 60
ARM = ("LSHO", "LUPA", "LELB", "LFRM", "LWRA", "LWRB", "LFIN")


@pytest.fixture(scope="module")
def plate() -> Take:
    """Four markers of one plate, which drifts and turns, 100 mm apart; all seen."""
    seconds = np.arange(800) / 100.0
    turn = np.stack([np.cos(seconds), np.sin(seconds), 0 * seconds], axis=1)
    across = np.stack([-np.sin(seconds), np.cos(seconds), 0 * seconds], axis=1)
    middle = np.stack([200 * seconds, 0 * seconds, 1000 + 0 * seconds], axis=1)
    corners = [middle + 50 * (a * turn + b * across) for a in (-1, 1) for b in (-1, 1)]
    return Take(np.stack(corners, axis=1), ("A", "B", "C", "D"), 100.0)


@pytest.fixture(scope="module")
def person() -> Take:
    """Twenty seconds of a performer, all seen."""
    return simulate_clean(duration_s=20.0, rate=100.0, seed=811)


def put_off(take: Take, marker: str, away: np.ndarray, deviation: float) -> tuple[Artifact, Repair]:
    """A repair that puts a marker off its place."""
    artifact = Artifact(marker, "xyz", LOST.start, LOST.stop, Kind.GAP)
    values = take.positions[LOST, take.index(marker)] + away
    patch = Patch(marker, "xyz", LOST.start, LOST.stop, values)
    return artifact, Repair("pattern", (patch,), error_mm=5.0, band_mm=np.full(LENGTH, deviation))


def settled(take: Take, pairs: list[tuple[Artifact, Repair]]) -> list[tuple[Artifact, Repair]]:
    """Repairs that stand in the take, drawn to distances that are usual outside of them."""
    return at_usual_distances(evidence_for(take, [a for a, _ in pairs]), pairs)


def put_off_repair(take: Take, *pairs: tuple[Artifact, Repair]) -> Take:
    return patched(take, (p for _, r in pairs for p in r.patches))


def test_both_give_way_the_less_sure_one_more(plate: Take) -> None:
    sure = put_off(plate, "A", np.array([0.0, 0.0, 8.0]), 1.0)
    unsure = put_off(plate, "B", np.array([0.0, 0.0, -30.0]), 20.0)
    after = put_off_repair(plate, sure, unsure)
    (_, first), (_, second) = settled(after, [sure, unsure])
    moved = [
        np.linalg.norm(now.patches[0].values - was.patches[0].values, axis=1)
        for now, was in ((first, sure[1]), (second, unsure[1]))
    ]
    assert (moved[0] < 0.2 * moved[1]).all()
    now = put_off_repair(after, (sure[0], first), (unsure[0], second)).positions[LOST]
    apart = np.linalg.norm(now[:, 0] - now[:, 1], axis=1)
    assert np.abs(apart - 100.0)[10:-10].max() < 1.0
    assert np.linalg.norm(now[:, 1] - plate.positions[LOST, 1], axis=1).max() < 20.0


def test_distances_that_are_usual_are_left_alone(plate: Take) -> None:
    pairs = [put_off(plate, m, np.zeros(3), 5.0) for m in ("A", "B")]
    after = settled(put_off_repair(plate, *pairs), pairs)
    for (_, now), (_, was) in zip(after, pairs, strict=True):
        assert np.abs(now.patches[0].values - was.patches[0].values).max() < 1e-3


def test_one_that_was_gone_alone_is_held_to_what_is_seen(plate: Take) -> None:
    alone = put_off(plate, "A", np.array([30.0, 0.0, 20.0]), 20.0)
    ((_, now),) = settled(put_off_repair(plate, alone), [alone])
    apart = now.patches[0].values[:, None] - plate.positions[LOST, 1:]
    usual = plate.positions[LOST, 0, None] - plate.positions[LOST, 1:]
    off = np.linalg.norm(apart, axis=2) - np.linalg.norm(usual, axis=2)
    assert np.abs(off)[10:-10].max() < 1.0


def test_strangers_hold_nobody(plate: Take) -> None:
    names = ("me:A", "you:B", "you:C", "*D")
    other = Take(plate.positions, names, plate.rate)
    alone = put_off(other, "me:A", np.array([30.0, 0.0, 20.0]), 20.0)
    assert settled(put_off_repair(other, alone), [alone]) == [alone]


def test_what_stays_missing_holds_nobody(plate: Take) -> None:
    positions = plate.positions.copy()
    positions[LOST, 2:] = np.nan
    holed = Take(positions, plate.labels, plate.rate)
    left = Artifact("C", "xyz", LOST.start, LOST.stop, Kind.GAP), Repair("pattern", reason="no")
    moved = put_off(holed, "A", np.array([0.0, 0.0, 40.0]), 10.0)
    after = put_off_repair(holed, moved)
    (_, now), same = settled(after, [moved, left])
    assert same == left
    assert np.isfinite(now.patches[0].values).all()
    apart = np.linalg.norm(now.patches[0].values - plate.positions[LOST, 1], axis=1)
    assert np.abs(apart - 100.0)[10:-10].max() < 1.0


def by_turns(holed: Take) -> Take:
    """The gaps of a take repaired one at a time, as in a review."""
    take, known = holed, list(find_gaps(holed))
    errors: dict[str, float] = {}
    for n, gap in enumerate(known):
        done = propose(take, gap, known, errors=errors)
        take = patched(take, done.patches)
        known[n] = gap.with_status(Status.REPAIRED)
        errors[gap.id] = done.error_mm or 0.0
    return take


def test_repairs_of_the_same_moment_do_not_lean_on_each_other(plate: Take) -> None:
    positions = plate.positions.copy()
    positions[300:308, :2] = np.nan
    holed = Take(positions, plate.labels, plate.rate)
    first, second = find_gaps(holed)
    one = propose(holed, first, [first, second])
    after = patched(holed, one.patches)
    alone = propose(holed, second, [first, second])
    then = propose(after, second, [first.with_status(Status.REPAIRED), second])
    assert np.array_equal(alone.patches[0].values, then.patches[0].values)
    assert alone.error_mm == then.error_mm


def test_a_repair_that_follows_others_is_no_surer_than_they_are(person: Take) -> None:
    few = [person.index(n) for n in ("LELB", "LUPA", "LSHO", "LFRM")]
    positions = person.positions[:, few].copy()
    positions[600:720, :2] = np.nan
    holed = Take(positions, tuple(person.labels[c] for c in few), person.rate)
    first, second = find_gaps(holed)
    one = propose(holed, first, [first, second])
    known, after = [first.with_status(Status.REPAIRED), second], patched(holed, one.patches)
    exact, doubted = (propose(after, second, known, errors={first.id: e}) for e in (0.0, 30.0))
    assert exact.error_mm is not None
    assert doubted.error_mm == pytest.approx(np.hypot(exact.error_mm, 30.0))


def without_arm(person: Take) -> Take:
    """Its arm not seen for two seconds."""
    positions = person.positions.copy()
    positions[600:800, [person.index(n) for n in ARM]] = np.nan
    return Take(positions, person.labels, person.rate)


def beyond(person: Take, after: Take) -> float:
    """By how much distances along the arm, frame by frame, are beyond what they ever are, mm."""
    off = 0.0
    for i, j in pairwise(person.index(n) for n in ARM):
        usual = np.linalg.norm(person.positions[:, i] - person.positions[:, j], axis=1)
        now = np.linalg.norm(after.positions[:, i] - after.positions[:, j], axis=1)
        off += float(np.abs(now - np.clip(now, usual.min(), usual.max())).sum())
    return off


def test_a_take_is_repaired_so_and_its_patches_give_it(
    person: Take, monkeypatch: pytest.MonkeyPatch
) -> None:
    holed = without_arm(person)
    together = repair(holed, find_gaps(holed))
    pairs = repair_all(holed, find_gaps(holed))
    assert np.array_equal(put_off_repair(holed, *pairs).positions, together.positions)
    monkeypatch.setattr("markermend.repairs.run.at_usual_distances", lambda _, pairs: list(pairs))
    assert beyond(person, together) < 0.7 * beyond(person, repair(holed, find_gaps(holed)))


def test_one_at_a_time_as_well(person: Take, monkeypatch: pytest.MonkeyPatch) -> None:
    holed = without_arm(person)
    held = by_turns(holed)
    monkeypatch.setattr(
        "markermend.repairs.proposing.at_usual_distances", lambda _, pairs: list(pairs)
    )
    assert beyond(person, held) < 0.7 * beyond(person, by_turns(holed))
