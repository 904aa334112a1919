"""A review: decisions, undo and redo bit for bit."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from reviews import FRAMES, artifact, drive, make_take, proposal, state_of, verbs

from markermend.artifact import Kind, Status
from markermend.errors import DataError
from markermend.patch import Patch
from markermend.repairs.registry import Repair
from markermend.review.session import Session
from markermend.take import Origin, Take


def test_repair_replaces_only_interval_and_named_axes():
    session = Session(make_take())
    a = artifact(axes="xz")
    session.add_detected([a], "paper")
    session.repair([(a.id, proposal(a))])
    differs = session.positions != session.original.positions
    differs &= ~np.isnan(session.original.positions)
    expected = np.zeros_like(differs)
    expected[30:40, 0, [0, 2]] = True
    assert (differs == expected).all()
    assert (session.origin[30:40, 0] == Origin.EDITED).all()
    assert session.artifact(a.id).status is Status.REPAIRED
    assert session.notes[a.id].method == "spline"


def test_filling_a_gap_marks_samples_filled():
    session = Session(make_take())
    a = artifact("B", start=10, stop=20, kind=Kind.GAP)
    session.add_detected([a], "paper")
    session.repair([(a.id, proposal(a))])
    assert (session.origin[10:20, 1] == Origin.FILLED).all()
    session.undo()
    assert (session.origin[10:20, 1] == Origin.MISSING).all()
    assert np.isnan(session.positions[10:20, 1]).all()


def test_proposal_outside_its_artifact_is_refused():
    session = Session(make_take())
    a = artifact(axes="x")
    session.add_detected([a], "paper")
    wide = Repair("spline", (Patch("A", "xy", 30, 40, np.zeros((10, 2))),))
    before = state_of(session)
    with pytest.raises(DataError, match="outside the artifact"):
        session.repair([(a.id, wide)])
    assert state_of(session) == before


def test_half_missing_sample_is_refused_and_nothing_changes():
    session = Session(make_take())
    fine = artifact("A")
    gap = artifact("B", axes="x", start=10, stop=20, kind=Kind.GAP)
    session.add_detected([fine, gap], "paper")
    before = state_of(session)
    with pytest.raises(DataError, match="half missing"):
        session.repair([(fine.id, proposal(fine)), (gap.id, proposal(gap))])
    assert state_of(session) == before


def test_rejecting_a_repaired_artifact_restores_its_source():
    session = Session(make_take())
    a = artifact()
    session.add_detected([a], "paper")
    session.repair([(a.id, proposal(a))])
    session.set_status([a.id], Status.REJECTED)
    assert session.positions.tobytes() == session.original.positions.tobytes()
    assert session.origin.tobytes() == session.original.origin.tobytes()
    assert a.id not in session.notes


def test_a_decision_made_already_is_no_second_step():
    session = Session(make_take())
    a, b = artifact(), artifact("C")
    session.add_detected([a, b], "paper")
    session.set_status([a.id], Status.REJECTED)
    steps, revision = session.history, session.revision
    session.set_status([a.id], Status.REJECTED)
    assert (session.history, session.revision) == (steps, revision)
    session.set_status([a.id, b.id], Status.REJECTED)
    assert session.history[-1] == f"Reject {b.kind} on {b.marker}"


def test_reopening_leaves_an_overlapping_repair_alone():
    session = Session(make_take())
    a, b = artifact(start=30, stop=40), artifact(start=36, stop=50, kind=Kind.STEP)
    session.add_detected([a, b], "paper")
    session.repair([(a.id, proposal(a, 1.0))])
    session.repair([(b.id, proposal(b, 2.0))])
    session.set_status([a.id], Status.PENDING)
    assert (session.positions[36:50, 0] == 2.0).all()
    assert (session.positions[30:36, 0] == session.original.positions[30:36, 0]).all()


def test_detecting_again_keeps_decisions():
    session = Session(make_take())
    a, b = artifact(), artifact("C")
    session.add_detected([a, b], "paper")
    session.set_status([a.id], Status.REJECTED)
    again = artifact(start=31, stop=41)
    other = artifact("C", start=2, stop=9)
    session.add_detected([again, other], "paper")
    assert [(x.marker, x.start, x.status) for x in session.artifacts] == [
        ("C", 2, Status.PENDING),
        ("A", 30, Status.REJECTED),
    ]


def test_exported_asks_only_when_something_was_decided():
    session = Session(make_take())
    a = artifact()
    session.add_detected([a], "paper")
    assert session.exported
    session.set_status([a.id], Status.ACCEPTED)
    assert not session.exported
    session.mark_exported()
    assert session.exported
    session.undo()
    assert session.exported
    session.redo()
    session.set_status([a.id], Status.REJECTED)
    assert not session.exported


@settings(max_examples=60, deadline=None)
@given(verbs)
def test_undo_and_redo_restore_every_state_bit_for_bit(script):
    session = Session(make_take())
    states = [state_of(session)]
    for step in script:
        before = len(session.history)
        drive(session, *step)
        if len(session.history) > before:
            states.append(state_of(session))
    for state in reversed(states[:-1]):
        session.undo()
        assert state_of(session) == state
    for state in states[1:]:
        session.redo()
        assert state_of(session) == state
    session.travel(0)
    assert state_of(session) == states[0]
    session.travel(len(states) - 1)
    assert state_of(session) == states[-1]


@settings(max_examples=30, deadline=None)
@given(verbs)
def test_samples_held_on_to_are_those_that_stood_then(script):
    session = Session(make_take())
    held = []
    for step in script:
        drive(session, *step)
        take = session.take
        held.append((session.state.held(), take.positions.copy(), take.origin.copy()))
    for make, positions, origin in held:
        made = make()
        np.testing.assert_array_equal(made.positions, positions)
        np.testing.assert_array_equal(made.origin, origin)


def test_detecting_again_keeps_what_was_marked_by_hand_or_given_other_edges():
    session = Session(make_take())
    found = [artifact("A"), artifact("C")]
    session.add_detected(found, "paper")
    session.mark(artifact("B", start=45, stop=50))
    session.change(found[0].id, stop=44)
    session.add_detected([artifact("C", start=2, stop=6)], "paper")
    assert [(a.marker, a.start, a.stop) for a in session.artifacts] == [
        ("C", 2, 6),
        ("A", 30, 44),
        ("B", 45, 50),
    ]


def test_repairing_repaired_ones_anew_starts_from_the_source():
    session = Session(make_take())
    a, b = artifact(start=30, stop=40), artifact(start=35, stop=45)
    session.add_detected([a, b], "paper")
    session.repair([(a.id, proposal(a)), (b.id, proposal(b))])
    session.repair([(a.id, proposal(a, 2.0)), (b.id, proposal(b, 3.0))])
    assert (session.positions[30:35, 0] == 2.0).all()
    assert (session.positions[35:45, 0] == 3.0).all()
    session.set_status([a.id, b.id], Status.PENDING)
    assert session.positions.tobytes() == session.original.positions.tobytes()


def test_looking_at_the_working_samples_checks_nothing_again(monkeypatch):
    session = Session(make_take())
    session.mark(artifact())
    monkeypatch.setattr(Take, "__post_init__", lambda self: pytest.fail("checked again"))
    assert session.take.positions.shape == (FRAMES, 3, 3)
