"""Proposals made in the background: only those still wanted, never of samples that moved."""

from __future__ import annotations

import threading
from dataclasses import replace

import pytest

from markermend.mesh import infer_mesh
from markermend.repairs.registry import Repair
from markermend.review.session import Session
from markermend_app.background.proposals import Proposals

WAIT = 10_000


@pytest.fixture
def slow(qapp, damaged, monkeypatch):
    """Proposals whose making waits, with what was begun."""
    take, truth = damaged
    session, mesh = Session(take), infer_mesh(take)
    session.add_detected(truth, "truth")
    begun, entered, go_on = [], threading.Event(), threading.Event()

    def propose(take, artifact, artifacts, *, method, mesh, references, progress):
        begun.append(artifact.marker)
        entered.set()
        assert go_on.wait(10)
        return Repair(method, (), reason="none")

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
    assert entered.wait(5)
    for artifact in artifacts[1:]:
        ask(artifact)
    go_on.set()
    last = artifacts[-1]
    qtbot.waitUntil(lambda: proposals.get(last, "auto") is not None, timeout=WAIT)
    assert begun == [artifacts[0].marker, last.marker]


def test_a_proposal_under_way_while_samples_move_is_not_used(slow, qtbot):
    proposals, ask, artifacts, begun, entered, go_on = slow
    first = artifacts[0]
    ask(first)
    assert entered.wait(5)
    proposals.invalidate([artifacts[1].marker])
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
