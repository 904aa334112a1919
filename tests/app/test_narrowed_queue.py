"""Once the queue is narrowed down, keys decide about what is listed, and about nothing else."""

from __future__ import annotations

import pytest
from driving import WAIT, key, settled
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from markermend.artifact import Kind, Status
from markermend_app.panels.queue.filters import OPEN
from markermend_app.panels.queue.keeping import REST_MS
from markermend_app.panels.queue.model import MARKER

NOTHING = "No artifact is listed, so that none is under review."
DECIDED = 2


@pytest.fixture
def window(review, damaged, qtbot):
    """The window on the damaged take; listed are a gap, a step, a peak and noise."""
    made = review(*damaged)
    settled(qtbot)
    assert [a.kind.value for a in made.queue.model.rows] == ["gap", "step", "peak", "noise"]
    return made


def press(qtbot, window, kind):
    """Click the button of a class above the queue."""
    qtbot.mouseClick(window.queue.filters.kinds[kind], Qt.MouseButton.LeftButton)
    settled(qtbot)


def under_review(window):
    """Which class is under review, or None."""
    current = window.document.current
    return None if current is None else current.kind.value


def said(window):
    return window.status._said.whole


def statuses(window):
    return {a.kind.value: a.status.value for a in window.document.session.artifacts}


def test_keys_decide_about_what_a_class_leaves_listed(window, qtbot):
    press(qtbot, window, Kind.PEAK)
    assert under_review(window) == "peak"
    assert window.queue.view.currentIndex().row() == 0
    assert window.inspector.artifact.title.text() == "LELB"
    assert window.document.shown == ("LELB",)
    assert window.sight.lost is None
    key(qtbot, window, Qt.Key.Key_R)
    assert statuses(window)["peak"] == "rejected"
    assert statuses(window)["gap"] == "pending"


def test_what_follows_in_the_queue_comes_under_review_else_the_first(window, qtbot):
    window.document.select(window.document.queue[2])
    press(qtbot, window, Kind.NOISE)
    assert under_review(window) == "noise"
    press(qtbot, window, Kind.STEP)
    press(qtbot, window, Kind.GAP)
    press(qtbot, window, Kind.NOISE)
    assert under_review(window) == "gap"


def test_what_is_listed_still_stays_with_its_view(window, qtbot):
    window.document.select(window.document.queue[1])
    window.document.frame_requested.emit(0, 400)
    view, frame = window.sight._view, window.document.frame
    press(qtbot, window, Kind.STEP)
    assert under_review(window) == "step"
    assert (window.sight._view, window.document.frame) == (view, frame)


def test_where_nothing_is_listed_keys_do_nothing_and_it_is_said_why(window, qtbot):
    press(qtbot, window, Kind.SLOW)
    assert under_review(window) is None
    assert said(window) == NOTHING
    before = window.document.session.artifacts
    for what in (Qt.Key.Key_A, Qt.Key.Key_R, Qt.Key.Key_F, Qt.Key.Key_U, Qt.Key.Key_Delete):
        key(qtbot, window, what)
    assert window.document.session.artifacts == before
    assert said(window) == NOTHING
    press(qtbot, window, Kind.SLOW)
    assert under_review(window) == "gap"
    assert said(window) == ""


def test_letters_are_followed_where_typing_rests_or_the_line_is_left(window, qtbot):
    line = window.queue.filters.marker
    line.setFocus()
    qtbot.waitUntil(line.hasFocus)
    QTest.keyClicks(line, "lw")
    assert [a.marker for a in window.queue.model.rows] == ["LWRA"]
    assert under_review(window) == "gap", "more letters may follow"
    qtbot.waitUntil(lambda: under_review(window) == "step", timeout=REST_MS + WAIT)
    line.clear()
    QTest.keyClicks(line, "elb")
    qtbot.keyClick(line, Qt.Key.Key_Return)
    assert under_review(window) == "peak"
    qtbot.waitUntil(window.queue.view.hasFocus)
    key(qtbot, window.queue.view, Qt.Key.Key_A)
    assert statuses(window) == {
        "gap": "pending", "peak": "accepted", "noise": "pending", "step": "pending"
    }  # fmt: skip


def test_a_slip_of_the_pen_is_undone_by_taking_it_back(window, qtbot):
    window.document.select(window.document.queue[1])
    line = window.queue.filters.marker
    line.setFocus()
    qtbot.waitUntil(line.hasFocus)
    QTest.keyClicks(line, "lwrx")
    qtbot.waitUntil(lambda: said(window) == NOTHING, timeout=REST_MS + WAIT)
    qtbot.keyClick(line, Qt.Key.Key_Backspace)
    qtbot.waitUntil(lambda: under_review(window) == "step", timeout=REST_MS + WAIT)
    assert said(window) == ""


def test_after_a_look_at_what_is_decided_the_review_goes_on_where_it_was(window, qtbot):
    key(qtbot, window, Qt.Key.Key_A)
    key(qtbot, window, Qt.Key.Key_N)
    assert under_review(window) == "peak"
    window.queue.filters.status.setCurrentIndex(DECIDED)
    settled(qtbot)
    assert under_review(window) == "gap"
    window.queue.filters.status.setCurrentIndex(0)
    settled(qtbot)
    assert window.queue.filters.statuses == OPEN
    assert under_review(window) == "peak"


def test_who_went_on_elsewhere_is_not_called_back(window, qtbot):
    window.document.select(window.document.queue[1])
    press(qtbot, window, Kind.NOISE)
    assert under_review(window) == "noise"
    press(qtbot, window, Kind.NOISE)
    assert under_review(window) == "noise"
    window.queue.filters.marker.setText("l")
    settled(qtbot)
    assert under_review(window) == "gap", "not the step, which was left long ago"


def test_what_is_chosen_elsewhere_needs_not_be_listed(window, qtbot):
    key(qtbot, window, Qt.Key.Key_A)
    gap = window.document.session.with_status(Status.ACCEPTED)[0]
    window.document.select(gap.id)
    line = window.queue.filters.marker
    line.setFocus()
    qtbot.waitUntil(line.hasFocus)
    qtbot.keyClick(line, Qt.Key.Key_Escape)
    settled(qtbot)
    assert under_review(window) == "gap", "no filter was changed"
    assert not window.queue.view.currentIndex().siblingAtColumn(MARKER).isValid()
