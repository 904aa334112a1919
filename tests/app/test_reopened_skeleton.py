"""Skeleton recordings whose review is taken up again: the body stands at once, repairs follow."""

from __future__ import annotations

import time

import pytest
from driving import key
from PySide6.QtCore import Qt

import markermend as mm
from markermend.artifact import Artifact, Kind, Status
from markermend.review.file import open_session

WAIT = 20_000


def until_cancelled(take, progress=None):
    """Work that goes on as long as it is wanted."""
    while True:
        progress(0.5, "")
        time.sleep(0.01)


@pytest.fixture
def begun(broken):
    """A recording in whose review something was marked."""
    kept = open_session(mm.read(broken), folder=broken.parent)
    kept.session.mark(Artifact("head", "xyz", 60, 66, Kind.STEP, 0.9, why="marked by hand"))
    kept.save()
    kept.close()
    return broken


def taken_up(window, path, qtbot):
    """Open it, and wait until its artifact is looked at."""
    window.commands.open_path(path)
    qtbot.waitUntil(lambda: window.document.current is not None, timeout=WAIT)
    qtbot.waitUntil(lambda: window.lane.busy, timeout=WAIT)
    return window.document


def test_the_tree_stands_while_the_recording_is_restored(window, begun, qtbot, monkeypatch):
    monkeypatch.setattr("markermend.repairs.skeleton.get_ready", until_cancelled)
    document = taken_up(window, begun, qtbot)
    qtbot.waitUntil(lambda: window.tree.view.model().rowCount() == 1, timeout=WAIT)
    assert window.lane.busy
    assert not document.proposals.lane.busy
    # Who does not want to wait has each repair made when it is looked at.
    window.lane.cancel()
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)


def test_f_looks_at_the_body_where_that_was_cancelled(window, begun, qtbot, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr("markermend.mesh.infer_mesh", until_cancelled)
        document = taken_up(window, begun, qtbot)
        window.lane.cancel()
        qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)
    assert document.mesh is None
    key(qtbot, window, Qt.Key.Key_F)
    [artifact] = document.session.artifacts
    qtbot.waitUntil(
        lambda: document.session.artifact(artifact.id).status is Status.REPAIRED, timeout=WAIT
    )
