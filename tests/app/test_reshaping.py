"""Artifacts reshaped in the real window: edges nudged, split, joined, called another class."""

from __future__ import annotations

import pytest
from driving import settled, state, undo
from PySide6.QtCore import Qt

from markermend.artifact import Artifact, Kind

CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def window(at_gap):
    return at_gap


def test_keys_nudge_split_join_and_reclass(window, qtbot):
    document, before = window.document, state(window)
    artifact = document.current
    document.show([artifact.marker])
    for key in (Qt.Key.Key_BracketLeft, Qt.Key.Key_BracketRight, Qt.Key.Key_BracketRight):
        qtbot.keyClick(window, key)
    assert (document.current.start, document.current.stop) == (59, 92)
    qtbot.keyClick(window, Qt.Key.Key_BraceLeft)
    assert document.current.start == 60
    document.go_to(75)
    qtbot.keyClick(window, Qt.Key.Key_Slash)
    assert [(a.start, a.stop) for a in document.session.artifacts[:2]] == [(60, 75), (75, 92)]
    qtbot.keyClick(window, Qt.Key.Key_J)
    assert (document.current.start, document.current.stop) == (60, 92)
    qtbot.keyClick(window, Qt.Key.Key_3, CTRL)
    assert document.current.kind is Kind.NOISE
    for _ in range(6):
        undo(window, qtbot)
    assert state(window) == before
    assert document.session.artifact(artifact.id) == artifact


def test_a_key_does_not_join_what_is_far_apart(window, qtbot):
    document = window.document
    current = document.current
    away = Artifact(current.marker, "xyz", current.stop + 150, current.stop + 160, Kind.NOISE)
    document.do(lambda session: session.mark(away))
    document.select(current.id)
    steps = len(document.session.history)
    qtbot.keyClick(window, Qt.Key.Key_J)
    assert len(document.session.history) == steps
    assert "150 frames later" in window.status._said.whole


def test_nudges_of_one_edge_are_one_step_that_tells_where_it_ended(window, qtbot):
    document, before = window.document, state(window)
    artifact, steps = document.current, len(document.session.history)
    first = document.session.original.first_frame
    document.show([artifact.marker])

    def told_last():
        settled(qtbot)
        return window.history.model.index(len(document.session.history)).data()

    for _ in range(3):
        qtbot.keyClick(window, Qt.Key.Key_BraceLeft)
    assert (document.current.start, document.current.stop) == (63, 90)
    assert len(document.session.history) == steps + 1
    assert told_last().endswith(f", {63 + first}–{89 + first}")
    qtbot.keyClick(window, Qt.Key.Key_BracketRight)
    qtbot.keyClick(window, Qt.Key.Key_BracketRight)
    assert len(document.session.history) == steps + 2, "the other edge is a step of its own"
    assert told_last().endswith(f", {63 + first}–{91 + first}")
    undo(window, qtbot)
    assert (document.current.start, document.current.stop) == (63, 90)
    undo(window, qtbot)
    assert document.session.artifact(artifact.id) == artifact
    assert state(window) == before


def test_the_menu_of_the_queue_joins_artifacts_of_one_marker(window, qtbot):
    document, queue = window.document, window.queue
    gap = document.current
    document.show([gap.marker])
    document.go_to(75)
    qtbot.keyClick(window, Qt.Key.Key_Slash)

    def click(row, held=CTRL):
        place = queue.view.visualRect(queue.model.index(row, 2)).center()
        qtbot.mouseClick(queue.view.viewport(), Qt.MouseButton.LeftButton, held, place)

    first, second = (i for i, a in enumerate(queue.model.rows) if a.marker == gap.marker)
    click(first, Qt.KeyboardModifier.NoModifier)
    click(second)
    halves = [(a.marker, a.start, a.stop) for a in queue.model.rows if a.id in queue.selected()]
    join = next(a for a in queue.menu().actions() if a.objectName() == "join_artifacts")
    join.trigger()
    assert halves == [(gap.marker, 60, 75), (gap.marker, 75, 90)]
    assert (document.current.start, document.current.stop) == (60, 90)
    click(next(i for i, a in enumerate(queue.model.rows) if a.marker != gap.marker))
    assert len(queue.selected()) == 2
    assert not [a for a in queue.menu().actions() if a.objectName() == "join_artifacts"]
