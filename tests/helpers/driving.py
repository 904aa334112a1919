"""Small steps of tests that drive the window."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QApplication, QLineEdit

from markermend_app.later import _queue

WAIT = 20_000


def key(qtbot, window, what, modifier=Qt.KeyboardModifier.NoModifier):
    """Press a key in the window."""
    qtbot.keyClick(window, what, modifier)


def settled(qtbot):
    """Let everything that waits for a turn of its own have it."""
    qtbot.waitUntil(lambda: not _queue()._waiting, timeout=WAIT)


def proposed(qtbot, window):
    """Wait for the previewed repair."""
    qtbot.waitUntil(lambda: window.document.proposal is not None, timeout=WAIT)


def answer_with(qtbot, word):
    """Type a word into the dialog that the next key opens, and press Return."""

    def write():
        line = QApplication.activeModalWidget().findChild(QLineEdit)
        line.selectAll()
        qtbot.keyClicks(line, word)
        qtbot.keyClick(line, Qt.Key.Key_Return)

    QTimer.singleShot(200, write)


def state(window):
    """What undo has to bring back."""
    session = window.document.session
    return session.positions.tobytes(), session.artifacts, session.take.labels


def undo(window, qtbot):
    """Take the last step back by key."""
    qtbot.keyClick(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
