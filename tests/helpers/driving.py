"""Small steps of tests that drive the window."""

from __future__ import annotations

from PySide6.QtCore import Qt

WAIT = 20_000


def key(qtbot, window, what, modifier=Qt.KeyboardModifier.NoModifier):
    """Press a key in the window."""
    qtbot.keyClick(window, what, modifier)


def proposed(qtbot, window):
    """Wait for the previewed repair."""
    qtbot.waitUntil(lambda: window.document.proposal is not None, timeout=WAIT)
