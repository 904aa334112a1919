"""Markers gone together come back at their usual distances."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind
from markermend.patch import Patch, patched
from markermend.repairs import Repair, find_gaps, repair, repair_all
from markermend.repairs.lengths import at_usual_distances
from markermend.simulation import simulate_clean
from markermend.take import Take

LOST, LENGTH = slice(300, 360), 60


@pytest.fixture(scope="module")
def plate() -> Take:
    """Four markers of one plate, which drifts and turns, 100 mm apart; all seen."""
    seconds = np.arange(800) / 100.0
    turn = np.stack([np.cos(seconds), np.sin(seconds), 0 * seconds], axis=1)
    across = np.stack([-np.sin(seconds), np.cos(seconds), 0 * seconds], axis=1)
    middle = np.stack([200 * seconds, 0 * seconds, 1000 + 0 * seconds], axis=1)
    corners = [middle + 50 * (a * turn + b * across) for a in (-1, 1) for b in (-1, 1)]
    return Take(np.stack(corners, axis=1), ("A", "B", "C", "D"), 100.0)


def put_off(take: Take, marker: str, away: np.ndarray, deviation: float) -> tuple[Artifact, Repair]:
    """A repair that puts a marker off its place."""
    artifact = Artifact(marker, "xyz", LOST.start, LOST.stop, Kind.GAP)
    values = take.positions[LOST, take.index(marker)] + away
    patch = Patch(marker, "xyz", LOST.start, LOST.stop, values)
    return artifact, Repair("pattern", (patch,), error_mm=5.0, band_mm=np.full(LENGTH, deviation))


def put_off_repair(take: Take, *pairs: tuple[Artifact, Repair]) -> Take:
    return patched(take, (p for _, r in pairs for p in r.patches))


def test_both_give_way_the_less_sure_one_more(plate: Take) -> None:
    sure = put_off(plate, "A", np.array([0.0, 0.0, 8.0]), 1.0)
    unsure = put_off(plate, "B", np.array([0.0, 0.0, -30.0]), 20.0)
    after = put_off_repair(plate, sure, unsure)
    (_, first), (_, second) = at_usual_distances(after, [sure, unsure])
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
    settled = at_usual_distances(put_off_repair(plate, *pairs), pairs)
    for (_, now), (_, was) in zip(settled, pairs, strict=True):
        assert np.abs(now.patches[0].values - was.patches[0].values).max() < 1e-3


def test_one_that_was_gone_alone_is_not_moved(plate: Take) -> None:
    alone = put_off(plate, "A", np.array([0.0, 0.0, 8.0]), 1.0)
    assert at_usual_distances(put_off_repair(plate, alone), [alone]) == [alone]


def test_what_stays_missing_holds_nobody(plate: Take) -> None:
    positions = plate.positions.copy()
    positions[LOST, 2:] = np.nan
    holed = Take(positions, plate.labels, plate.rate)
    left = Artifact("C", "xyz", LOST.start, LOST.stop, Kind.GAP), Repair("pattern", reason="no")
    moved = put_off(holed, "A", np.array([0.0, 0.0, 40.0]), 10.0)
    after = put_off_repair(holed, moved)
    (_, now), same = at_usual_distances(after, [moved, left])
    assert same == left
    assert np.isfinite(now.patches[0].values).all()
    apart = np.linalg.norm(now.patches[0].values - plate.positions[LOST, 1], axis=1)
    assert np.abs(apart - 100.0)[10:-10].max() < 1.0


def test_a_take_is_repaired_so_and_its_patches_give_it(monkeypatch: pytest.MonkeyPatch) -> None:
    clean = simulate_clean(duration_s=20.0, rate=100.0, seed=811)
    columns = [clean.index(n) for n in ("LSHO", "LUPA", "LELB", "LFRM", "LWRA", "LWRB", "LFIN")]
    positions = clean.positions.copy()
    positions[600:800, columns] = np.nan
    holed = Take(positions, clean.labels, clean.rate)

    def beyond() -> float:
        pairs = repair_all(holed, find_gaps(holed))
        after = put_off_repair(holed, *pairs)
        assert np.array_equal(after.positions, repair(holed, find_gaps(holed)).positions)
        off = 0.0
        for i, j in pairwise(columns):
            usual = np.linalg.norm(clean.positions[:, i] - clean.positions[:, j], axis=1)
            now = np.linalg.norm(after.positions[:, i] - after.positions[:, j], axis=1)
            off += float(np.abs(now - np.clip(now, usual.min(), usual.max())).sum())
        return off

    together = beyond()
    monkeypatch.setattr("markermend.repairs.run.at_usual_distances", lambda _, pairs: list(pairs))
    assert together < 0.7 * beyond()
