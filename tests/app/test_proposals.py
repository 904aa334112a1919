"""Proposals made in the background: only those still wanted, never of samples that moved."""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.errors import Cancelled
from markermend.mesh import infer_mesh
from markermend.patch import Patch
from markermend.progress import heed
from markermend.repairs.registry import Repair
from markermend.review.edits import Change
from markermend.review.session import Session
from markermend_app.background.proposals import REACH_S, Proposals, _Request

WAIT = 10_000


def proposed(artifact):
    """A repair of nothing but zeros."""
    values = np.zeros((artifact.length, len(artifact.axes)))
    patch = Patch(artifact.marker, artifact.axes, artifact.start, artifact.stop, values)
    return Repair("pattern", (patch,))


@pytest.fixture
def slow(qapp, damaged, monkeypatch):
    """Proposals whose making waits, with what was begun."""
    take, truth = damaged
    session, mesh = Session(take), infer_mesh(take)
    session.add_detected(truth, "truth")
    begun, entered, go_on = [], threading.Event(), threading.Event()

    def propose(take, artifact, artifacts, *, method, mesh, references, errors, progress):
        begun.append(artifact.marker)
        entered.set()
        assert go_on.wait(10)
        return proposed(artifact)

    monkeypatch.setattr("markermend.repairs.propose", propose)
    proposals = Proposals()

    def ask(*artifacts):
        proposals.want(session, mesh, [(a, "auto", ()) for a in artifacts])

    yield proposals, ask, session.artifacts, begun, entered, go_on
    go_on.set()
    proposals.close()


def test_artifacts_passed_by_are_not_worked_on(slow, qtbot):
    proposals, ask, artifacts, begun, entered, go_on = slow
    ask(artifacts[0])
    qtbot.waitUntil(entered.is_set)
    for artifact in artifacts[1:]:
        ask(artifact)
    go_on.set()
    last = artifacts[-1]
    qtbot.waitUntil(lambda: proposals.get(last, "auto") is not None, timeout=WAIT)
    assert begun == [artifacts[0].marker, last.marker]


def test_one_under_way_that_nobody_wants_any_more_is_stopped(slow, qtbot, monkeypatch):
    proposals, ask, artifacts, _, entered, _ = slow
    stopped = []

    def propose(take, artifact, *_, **__):
        entered.set()
        try:
            for _ in range(1000):
                heed()
                threading.Event().wait(0.01)
        except Cancelled:
            stopped.append(artifact)
            raise
        return proposed(artifact)

    monkeypatch.setattr("markermend.repairs.propose", propose)
    ask(artifacts[0])
    qtbot.waitUntil(entered.is_set)
    assert stopped == []
    ask(artifacts[1])
    qtbot.waitUntil(lambda: stopped == [artifacts[0]], timeout=2000)
    proposals.forget()


def test_a_proposal_under_way_while_samples_move_is_not_used(slow, qtbot):
    proposals, ask, artifacts, begun, entered, go_on = slow
    first = artifacts[0]
    ask(first)
    qtbot.waitUntil(entered.is_set)
    proposals.invalidate(Change((artifacts[1].marker,), 0, 10), 100.0)
    ask(first)
    go_on.set()
    qtbot.waitUntil(lambda: proposals.get(first, "auto") is not None, timeout=WAIT)
    assert begun == [first.marker, first.marker]


def test_a_note_spoils_no_proposal(slow, qtbot):
    proposals, ask, artifacts, begun, _, go_on = slow
    go_on.set()
    ask(artifacts[0])
    qtbot.waitUntil(lambda: proposals.get(artifacts[0], "auto") is not None, timeout=WAIT)
    noted = replace(artifacts[0], note="wand in the way")
    assert proposals.get(noted, "auto") is proposals.get(artifacts[0], "auto")
    ask(noted)
    qtbot.wait(60)
    assert begun == [artifacts[0].marker]


def test_a_proposal_under_way_goes_on_while_damage_it_knows_of_is_repaired(slow, qtbot):
    proposals, ask, artifacts, begun, entered, go_on = slow
    first, other = artifacts[:2]
    ask(first)
    qtbot.waitUntil(entered.is_set)
    proposals.invalidate(Change((other.marker,), other.start, other.stop, artifacts=True), 100.0)
    ask(first)
    go_on.set()
    qtbot.waitUntil(lambda: proposals.get(first, "auto") is not None, timeout=WAIT)
    assert begun == [first.marker]


def test_samples_of_both_markers_of_a_mix_up_are_disbelieved():
    swap = Artifact("CLAV", "xyz", 250, 280, Kind.STEP, counterpart="STRN")
    request = _Request((swap,), {})
    assert request.disbelieves(Change(swap.markers, 250, 280, artifacts=True))
    assert not request.disbelieves(Change(("C7",), 250, 280, artifacts=True))


def test_a_proposal_is_made_anew_only_where_its_own_marker_moved_nearby(slow, qtbot):
    proposals, ask, artifacts, _, _, go_on = slow
    gap, rate = artifacts[0], 10.0
    go_on.set()
    ask(gap)
    qtbot.waitUntil(lambda: proposals.get(gap, "auto") is not None, timeout=WAIT)
    reach = round(REACH_S * rate)
    far = Change((gap.marker,), gap.stop + reach, gap.stop + reach + 5)
    proposals.invalidate(far, rate)
    proposals.invalidate(Change((gap.marker,), 0, gap.start - reach), rate)
    proposals.invalidate(Change((artifacts[1].marker,), gap.start, gap.stop), rate)
    assert proposals.get(gap, "auto") is not None
    proposals.invalidate(Change((gap.marker,), far.start - 1, far.stop), rate)
    assert proposals.get(gap, "auto") is None


def test_a_proposal_that_follows_markers_chosen_by_hand_rests_on_all_of_them(slow):
    proposals, _, artifacts, *_ = slow
    key = artifacts[0], "auto", ("STRN",)
    proposals.keep({key: proposed(artifacts[0])})
    proposals.invalidate(Change(("STRN",), 390, 400), 1.0)
    assert proposals.get(*key) is None


def test_what_was_refused_is_tried_again_once_another_of_the_same_moment_is_repaired(slow):
    proposals, _, artifacts, *_ = slow
    refused, good = (artifacts[0], "auto", ()), (artifacts[0], "pattern", ())
    proposals.keep({refused: Repair("pattern", reason="none"), good: proposed(artifacts[0])})
    rate, there = 10.0, (artifacts[0].start, artifacts[0].stop)
    later = artifacts[0].stop + round(REACH_S * rate)
    proposals.invalidate(Change((artifacts[1].marker,), later, later + 5), rate)
    assert proposals.get(*refused) is not None
    proposals.invalidate(Change((artifacts[1].marker,), *there), rate)
    assert proposals.get(*refused) is None
    assert proposals.get(*good) is not None


def test_joints_marked_since_at_the_same_time_spoil_what_was_proposed(qtbot, walk_session):
    session, mesh, artifact, other, later = walk_session
    proposals = Proposals()

    def ask():
        proposals.want(session, mesh, [(artifact, "skeleton", ())])
        qtbot.waitUntil(lambda: proposals.get(artifact, "skeleton") is not None, timeout=WAIT)
        return proposals.get(artifact, "skeleton")

    session.add_detected([artifact], "truth")
    before = ask()
    assert ask() is before
    session.add_detected([artifact, later], "truth")
    assert ask() is before
    session.add_detected([artifact, later, other], "truth")
    after = ask()
    assert after is not before
    assert after.error_mm > before.error_mm
    # What is made elsewhere is made of what is there.
    session.add_detected([artifact, later], "truth")
    proposals.keep({(artifact, "skeleton", ()): before})
    assert ask() is before
    proposals.close()


@pytest.fixture
def walk_session(shared_data):
    """A review of joints, an elbow, the wrist on it at the same time, and one later."""
    take = mm.read(shared_data / "poses" / "02_01.amc")
    elbow, wrist, knee = (
        Artifact(joint, "xyz", start, start + 20, Kind.NOISE)
        for joint, start in (("lradius", 100), ("lwrist", 105), ("rtibia", 200))
    )
    return Session(take), infer_mesh(take), elbow, wrist, knee
