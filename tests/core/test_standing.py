"""How a review stands, counted by hand."""

from __future__ import annotations

import numpy as np

from markermend.artifact import Artifact, Kind, Status
from markermend.patch import Patch
from markermend.repairs import Repair
from markermend.review.session import Session
from markermend.review.standing import standings, still_doubted
from markermend.take import Take


def review() -> Session:
    """Two markers and an unlabelled one; a gap repaired, a peak rejected, a step open."""
    positions = np.zeros((100, 3, 3))
    positions[10:30, 0] = np.nan
    positions[:, 2] = np.nan
    session = Session(Take(positions, ("A", "B", "*3"), 100.0))
    found = (
        Artifact("A", "xyz", 10, 20, Kind.GAP, 1.0),
        Artifact("A", "xyz", 20, 30, Kind.GAP, 1.0),
        Artifact("B", "x", 50, 51, Kind.PEAK, 0.9),
        Artifact("B", "x", 60, 70, Kind.STEP, 0.9),
    )
    session.add_detected(found, "test")
    patch = Patch("A", "xyz", 10, 20, np.ones((10, 3)))
    session.repair([(found[0].id, Repair("linear", (patch,), error_mm=2.5))])
    session.set_status([found[2].id], Status.REJECTED)
    return session


def test_everything_is_counted() -> None:
    s = review()
    whole, a, b, other = standings(s.original, s.take, s.artifacts, s.notes)
    assert (whole.marker, a.marker, b.marker, other.marker) == ("", "A", "B", "*3")
    assert (a.gap_before, a.gap_now, a.mended) == (0.2, 0.1, 0.1)
    assert (whole.gap_before, whole.gap_now, whole.mended) == (0.1, 0.05, 0.05)
    assert other.gap_now == 1.0
    assert (dict(a.open), dict(a.decided)) == ({Kind.GAP: 1}, {Kind.GAP: 1})
    assert (dict(b.open), dict(b.decided)) == ({Kind.STEP: 1}, {Kind.PEAK: 1})
    assert sum(whole.open.values()) == 2
    assert (a.mean_mm, a.worst_mm, b.mean_mm) == (2.5, 2.5, None)


def test_undo_takes_it_back() -> None:
    s = review()
    s.travel(1)
    a = standings(s.original, s.take, s.artifacts, s.notes)[1]
    assert (a.gap_now, a.mended, a.mean_mm) == (0.2, 0.0, None)


def test_a_take_of_unlabelled_markers_only() -> None:
    s = Session(Take(np.full((5, 1, 3), np.nan), ("*1",), 100.0))
    whole, only = standings(s.original, s.take, (), {})
    assert (whole.gap_now, only.gap_now) == (0.0, 1.0)


def test_a_swap_which_invents_nothing_has_no_error_and_thins_out_no_mean() -> None:
    s = review()
    step = next(a for a in s.artifacts if a.kind is Kind.STEP)
    swapped = Patch("B", "x", 60, 70, np.zeros((10, 1)))
    s.repair([(step.id, Repair("swap", (swapped,), error_mm=0.0))])
    whole, _, b, _ = standings(s.original, s.take, s.artifacts, s.notes)
    assert (whole.mean_mm, whole.worst_mm) == (2.5, 2.5)
    assert (b.mean_mm, b.worst_mm) == (None, None)


def test_a_mix_up_counts_for_each_of_its_markers_and_once_for_the_take() -> None:
    s = review()
    swap = Artifact("A", "xyz", 80, 90, Kind.STEP, counterpart="B")
    s.mark(swap)
    whole, a, b, _ = standings(s.original, s.take, s.artifacts, s.notes)
    assert (a.open[Kind.STEP], b.open[Kind.STEP], whole.open[Kind.STEP]) == (1, 2, 2)
    patch = Patch("A", "xyz", 80, 90, np.ones((10, 3)))
    s.repair([(swap.id, Repair("linear", (patch,), error_mm=7.0))])
    _, a, b, _ = standings(s.original, s.take, s.artifacts, s.notes)
    # Repaired on one alone, it is of that one.
    assert (a.decided[Kind.STEP], b.decided[Kind.STEP], b.worst_mm) == (1, 0, None)


def test_what_was_exchanged_back_is_believed_and_what_was_filled_is_not() -> None:
    random = np.random.default_rng(0)
    session = Session(Take(random.normal(size=(100, 3, 3)), ("A", "B", "C"), 100.0))
    found = tuple(
        Artifact("A", "xyz", at, at + 10, Kind.STEP, 1.0, counterpart="B") for at in (10, 40, 70)
    )
    session.add_detected(found, "test")
    assert still_doubted(session.artifacts, session.notes) == session.artifacts
    both, alone, _ = (a.id for a in session.artifacts)
    sides = [Patch(name, "xyz", 10, 20, np.ones((10, 3))) for name in "AB"]
    session.repair([(both, Repair("swap", tuple(sides)))])
    # The other side is an artifact of its own then.
    session.repair([(alone, Repair("linear", (Patch("A", "xyz", 40, 50, np.ones((10, 3))),)))])
    doubted = still_doubted(session.artifacts, session.notes)
    assert [(a.marker, a.start) for a in doubted] == [("A", 40), ("B", 40), ("A", 70)]
    session.set_status([both], Status.PENDING)
    assert len(still_doubted(session.artifacts, session.notes)) == 4
