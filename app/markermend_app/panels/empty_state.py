"""What a panel shows while it has nothing to show."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from markermend_app.style import theme

_ICON_PX = 48


class EmptyState(QWidget):
    """An icon, a heading and one sentence that says what to do."""

    def __init__(self, icon: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._icon = icon
        self._picture, self._heading, self._text = QLabel(), QLabel(), QLabel()
        self._heading.setProperty("role", "heading")
        self._text.setProperty("role", "muted")
        self._text.setWordWrap(True)
        layout = QVBoxLayout(self)
        layout.setSpacing(8)
        layout.addStretch()
        for label in (self._picture, self._heading, self._text):
            label.setAlignment(Qt.AlignmentFlag.AlignCenter)
            layout.addWidget(label)
        layout.addStretch()
        theme.watcher.changed.connect(self._restyle)
        self._restyle()

    def say(self, heading: str, text: str) -> None:
        """Show these words."""
        self._heading.setText(heading)
        self._text.setText(text)
        self.setAccessibleName(heading)

    def _restyle(self) -> None:
        """Draw the icon in the theme's colour."""
        self._picture.setPixmap(theme.icon(self._icon).pixmap(_ICON_PX, _ICON_PX))
