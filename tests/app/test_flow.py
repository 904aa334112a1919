"""A review that flows: a hundred artifacts with the keyboard alone, one key each."""

from __future__ import annotations

import numpy as np
import pytest
from driving import settled
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from markermend.artifact import Artifact, Kind, Status
from markermend.take import Take
from markermend_app.looking import Selection

WAIT = 20_000
CTRL = Qt.KeyboardModifier.ControlModifier
MOST_KEYS_EACH = 1.2


@pytest.fixture
def hundred(review, damaged):
    """The window on a take with a hundred peaks."""
    take = damaged[0]
    positions = np.nan_to_num(take.positions, nan=0.0).copy()
    positions[60:90, 0] = take.positions[59, 0]
    found = []
    for i in range(100):
        marker, at = take.labels[i % 8], 5 + 30 * (i // 8) + i % 8
        size = 15.0 + i % 11
        positions[at, i % 8, i % 3] += size
        found.append(Artifact(marker, "xyz"[i % 3], at, at + 1, Kind.PEAK, 0.9, size))
    return review(Take(positions, take.labels, take.rate), found)


def test_a_hundred_artifacts_take_one_key_each_and_no_mouse(hundred, qtbot):
    document = hundred.document
    sizes, keys = [], 0
    before = document.session.positions.copy()
    while document.session.with_status(Status.PENDING):
        current = document.current
        assert current.status is Status.PENDING
        low, high = hundred.trajectories.rows[0].view.viewRange()[0]
        assert low < current.start < current.stop < high
        sizes.append(current.amplitude_mm)
        # A hand decides as it sees fit; most are repaired.
        key = (Qt.Key.Key_R, Qt.Key.Key_A, *[Qt.Key.Key_F] * 8)[keys % 10]
        qtbot.keyClick(hundred, key)
        keys += 1
        # F is remembered until the repair is there, and then it moves on by itself.
        qtbot.waitUntil(
            lambda had=current.id: document.session.artifact(had).status is not Status.PENDING,
            timeout=WAIT,
        )
        assert keys <= 100 * MOST_KEYS_EACH
    assert keys == 100
    assert sizes == sorted(sizes, reverse=True)
    assert len(document.session.with_status(Status.REPAIRED)) == 80
    assert len(document.session.history) == 101
    for _ in range(100):
        qtbot.keyClick(hundred, Qt.Key.Key_Z, CTRL)
    assert np.array_equal(document.session.positions, before)
    assert len(document.session.with_status(Status.PENDING)) == 100


class Paints(QObject):
    """Counts how often most of a widget is painted."""

    def __init__(self, widget):
        super().__init__(widget)
        self.widget, self.count = widget, 0
        widget.installEventFilter(self)

    def eventFilter(self, watched, event):
        if event.type() == QEvent.Type.Paint:
            self.count += event.region().boundingRect().width() > 0.5 * self.widget.width()
        return False


def test_a_decision_is_told_and_painted_once(hundred, qtbot):
    document = hundred.document
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    qtbot.waitUntil(lambda: not document.proposals.lane.busy, timeout=WAIT)
    settled(qtbot)
    paints = Paints(hundred.trajectories.canvas.viewport())
    told = []
    document.current_changed.connect(lambda: told.append(document.current))
    following = document.queue[1]
    qtbot.keyClick(hundred, Qt.Key.Key_R)
    assert [a.id for a in told] == [following]
    QApplication.processEvents()
    assert paints.count == 1


def test_undo_held_down_shows_only_now_and_then_what_it_reaches(hundred, qtbot):
    document = hundred.document
    decided = []
    for _ in range(12):
        decided.append(document.current.id)
        qtbot.keyClick(hundred, Qt.Key.Key_R)
    told = []
    document.current_changed.connect(lambda: told.append(document._current))
    for had in reversed(decided):
        qtbot.keyClick(hundred, Qt.Key.Key_Z, CTRL)
        # Whatever is shown, keys mean what the last step was about.
        assert document.current.id == had
    assert told[0] == decided[-1]
    assert len(told) < 12
    qtbot.waitUntil(lambda: told[-1] == decided[0], timeout=WAIT)
    low, high = hundred.trajectories.rows[0].view.viewRange()[0]
    assert low < document.current.start < high


def test_a_decision_after_fast_undos_is_about_what_the_last_one_reached(hundred, qtbot):
    document = hundred.document
    first, second = document.queue[:2]
    for _ in range(2):
        qtbot.keyClick(hundred, Qt.Key.Key_R)
    for _ in range(2):
        qtbot.keyClick(hundred, Qt.Key.Key_Z, CTRL)
    qtbot.keyClick(hundred, Qt.Key.Key_A)
    assert [document.session.artifact(i).status for i in (first, second)] == [
        Status.ACCEPTED,
        Status.PENDING,
    ]
    assert document.current.id == second
    told = []
    document.current_changed.connect(lambda: told.append(document.current))
    qtbot.wait(200)
    assert not told, "what was moved on from must not come back"


@pytest.fixture
def hopeless(review, damaged):
    """The window on a take in which a marker is never seen, so that nothing can repair it."""
    take = damaged[0]
    positions = take.positions.copy()
    positions[:, 3] = np.nan
    found = [
        Artifact(take.labels[3], "xyz", 20, 60, Kind.GAP, 1.0),
        Artifact(take.labels[5], "y", 150, 151, Kind.PEAK, 0.95, 25.0),
    ]
    window = review(Take(positions, take.labels, take.rate), found)
    gap = next(a for a in window.document.session.artifacts if a.kind is Kind.GAP)
    window.document.select(gap.id)
    return window, gap.id


def test_the_repair_key_accepts_what_cannot_be_repaired_and_goes_on(hopeless, qtbot):
    window, gap = hopeless
    document = window.document
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    assert not document.proposal.patches
    why, before = document.proposal.reason, document.session.positions.copy()
    assert "F accepts the flag" in window.inspector.artifact.methods.outcome.text()
    qtbot.keyClick(window, Qt.Key.Key_F)
    assert document.session.artifact(gap).status is Status.ACCEPTED
    assert document.current.id != gap
    assert why
    assert why in window.status._said.whole
    assert np.array_equal(document.session.positions, before, equal_nan=True)
    qtbot.keyClick(window, Qt.Key.Key_Z, CTRL)
    assert document.session.artifact(gap).status is Status.PENDING


def test_buttons_for_repair_do_what_the_key_does(hopeless, qtbot):
    window, gap = hopeless
    document, action = window.document, window.actions_by_name["repair"]
    buttons = (window.inspector.decisions.repair, window.trajectories.buttons.repair)
    for button in buttons:
        document.select(gap)
        qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
        assert not document.proposal.patches
        qtbot.waitUntil(button.isVisible)
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
        assert document.session.artifact(gap).status is Status.ACCEPTED
        assert document.current.id != gap
        qtbot.keyClick(window, Qt.Key.Key_Z, CTRL)
        assert document.session.artifact(gap).status is Status.PENDING
    document.select(next(i for i in document.queue if i != gap))
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    peak = document.current.id
    qtbot.keyClick(window, Qt.Key.Key_F)
    document.select(peak)
    assert document.current.status is Status.REPAIRED
    assert not any(one.isEnabled() for one in (action, *buttons)), "repaired already"
    document.sweep(Selection("C7", 10, 30))
    assert action.isEnabled(), "now it is about the swept range"


def test_a_method_chosen_by_hand_that_has_no_repair_decides_nothing(hopeless, qtbot):
    window, gap = hopeless
    document = window.document
    document.choose_method("spline")
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    assert not document.proposal.patches
    qtbot.keyClick(window, Qt.Key.Key_F)
    assert document.session.artifact(gap).status is Status.PENDING
    assert "cannot be repaired" in window.status._said.whole


def test_the_first_is_framed_closely_with_its_repair_and_band(hundred, qtbot):
    document, rows = hundred.document, hundred.trajectories.rows
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    low, high = rows[0].view.viewRange()[0]
    assert high - low < 0.6 * document.session.original.rate
    row = rows["xyz".index(document.current.axes)]
    assert row.proposed


def test_a_held_key_that_repeats_itself_keeps_the_comparison_open(hundred, qtbot):
    comparison = hundred.comparison
    QTest.keyPress(hundred, Qt.Key.Key_C)
    for kind in (QEvent.Type.KeyRelease, QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress) * 3:
        none = Qt.KeyboardModifier.NoModifier
        event = QKeyEvent(kind, Qt.Key.Key_C, none, "c", True)
        QApplication.sendEvent(hundred, event)
        assert comparison.shown
    QTest.keyRelease(hundred, Qt.Key.Key_C)
    qtbot.waitUntil(lambda: not comparison.shown)


def test_a_repeat_that_looks_like_letting_go_keeps_it_open_too(hundred, qtbot):
    # A busy desktop hands the release and the press of a repeat over one by one, unmarked.
    comparison = hundred.comparison
    hidden = []
    comparison.changed.connect(lambda: hidden.append(not comparison.shown))
    QTest.keyPress(hundred, Qt.Key.Key_C)
    for _ in range(3):
        QTest.keyRelease(hundred, Qt.Key.Key_C)
        QTest.keyPress(hundred, Qt.Key.Key_C)
        qtbot.wait(100)
    assert comparison.shown
    assert not any(hidden)
    QTest.keyRelease(hundred, Qt.Key.Key_C)
    qtbot.waitUntil(lambda: not comparison.shown)
