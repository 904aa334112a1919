"""The detector looks again at every repair: what it leaves or makes is told, and avoided."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind
from markermend.outcome import cleaned_document, outcomes
from markermend.patch import Patch
from markermend.repairs import propose, repair_all
from markermend.repairs.look_again import in_words, looked_at
from markermend.repairs.registry import Repair
from markermend.review.session import Session
from markermend.simulation import simulate_clean
from markermend.take import Take

START, STOP = 400, 440


@pytest.fixture(scope="module")
def walk() -> Take:
    return simulate_clean(duration_s=8.0, seed=3)


def put(take: Take, column: int, offset: float, axes: str = "xyz") -> Repair:
    """The truth, moved by an offset, as a repair."""
    columns = ["xyz".index(a) for a in axes]
    values = take.positions[START:STOP, column][:, columns] + offset
    return Repair("test", (Patch(take.labels[column], axes, START, STOP, values),))


def test_truth_leaves_nothing_on_any_marker(walk: Take) -> None:
    assert not any(looked_at(walk, put(walk, c, 0.0)).leaves for c in range(len(walk.labels)))


def test_repair_that_jumps_at_its_borders_says_so(walk: Take) -> None:
    left = looked_at(walk, put(walk, 5, 15.0, "y")).leaves
    assert left is not None
    assert {a.kind for a in left} == {Kind.STEP}
    assert all("y" in a.axes and a.marker == walk.labels[5] for a in left)
    assert left[0].amplitude_mm == pytest.approx(15.0, abs=2.0)
    assert (left[0].start, left[0].stop) == (START, STOP)
    assert in_words(left).startswith("The detector still finds damage there: a step of 1")


def test_damage_elsewhere_is_not_the_repairs(walk: Take) -> None:
    positions = walk.positions.copy()
    positions[STOP + 60 : STOP + 90, 5] += 20.0
    assert looked_at(walk.with_positions(positions, walk.origin), put(walk, 5, 0.0)).leaves == ()


def test_repair_without_patches_is_not_looked_at(walk: Take) -> None:
    assert looked_at(walk, Repair("test", reason="none")).leaves is None


def shaken(take: Take) -> tuple[Take, Artifact]:
    """Gap of a marker whose references all jump in the middle of it."""
    positions = take.positions.copy()
    column = 5
    others = [i for i in range(len(take.labels)) if i != column]
    positions[START + 4 : START + 6, others] += [0.0, 2000.0, 0.0]
    positions[START : START + 30, column] = np.nan
    gap = Artifact(take.labels[column], "xyz", START, START + 30, Kind.GAP)
    return take.with_positions(positions, take.origin), gap


def test_auto_prefers_a_method_that_leaves_nothing(walk: Take) -> None:
    take, gap = shaken(walk)
    named = propose(take, gap, method="local_regression")
    assert named.leaves
    chosen = propose(take, gap)
    assert chosen.leaves == ()
    assert chosen.method != "local_regression"
    assert "would leave damage" in chosen.reason


def test_what_is_left_reaches_json_words_and_review(walk: Take) -> None:
    take, gap = shaken(walk)
    pairs = repair_all(take, [gap], method="local_regression")
    done = outcomes([gap], pairs)
    assert "still finds damage" in done[0].note
    values = cleaned_document(take, done, "test", "0", name="t")
    left = values["artifacts"][0]["repair"]["leaves"]
    assert left
    assert left[0]["marker"] == gap.marker
    session = Session(take)
    session.add_detected([gap], "test")
    session.repair([(gap.id, pairs[0][1])])
    assert "still finds damage" in session.notes[gap.id].leaves
    session.undo()
    assert gap.id not in session.notes


def test_a_clean_repair_says_nothing(walk: Take) -> None:
    gap = Artifact(walk.labels[5], "xyz", START, STOP, Kind.GAP)
    done = outcomes([gap], repair_all(walk, [gap]))
    assert done[0].leaves == ()
    assert done[0].note == ""
