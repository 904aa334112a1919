"""Real mouse events on the 3D view."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication


def place(scene, document, label):
    """Pixel of a marker."""
    scene.grab()
    x, y = scene._at[document.session.original.index(label)]
    return QPoint(round(x), round(y))


def drag(qtbot, scene, by, button=Qt.MouseButton.LeftButton, held=Qt.KeyboardModifier.NoModifier):
    """Drag from a place where no marker is."""
    start = QPoint(120, 320)
    qtbot.mousePress(scene, button, held, start)
    for share in (0.5, 1.0):
        at = QPointF(start + by * share)
        move(scene, at, button, held)
    qtbot.mouseRelease(scene, button, held, start + by)


def move(scene, at, button, held):
    """Move with a button held: what QTest.mouseMove cannot."""
    event = QMouseEvent(
        QEvent.Type.MouseMove, at, scene.mapToGlobal(at), Qt.MouseButton.NoButton, button, held
    )
    QApplication.sendEvent(scene, event)
