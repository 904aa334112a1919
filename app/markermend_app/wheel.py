"""The wheel over a field scrolls the page around it; it must not change what nobody looks at."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QAbstractSlider, QAbstractSpinBox, QComboBox, QScrollBar, QWidget


class _Guard(QObject):
    """Hands the wheel on to what is around a field without the keyboard."""

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep the wheel from the field."""
        held = isinstance(watched, QWidget) and watched.hasFocus()
        if held or event.type() != QEvent.Type.Wheel:
            return False
        event.ignore()
        return True


def leave_wheel(page: QWidget) -> None:
    """Let the fields on a page, or a field, take the wheel only while they have the keyboard."""
    guard = _Guard(page)
    kinds = (QComboBox, QAbstractSpinBox, QAbstractSlider)
    within = [field for kind in kinds for field in page.findChildren(kind)]
    for field in [*within, page] if isinstance(page, kinds) else within:
        if not isinstance(field, QScrollBar):
            # By itself the wheel would give them the keyboard.
            field.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            field.installEventFilter(guard)
