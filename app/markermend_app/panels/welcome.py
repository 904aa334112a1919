"""What the window shows while nothing is open: how to begin."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from markermend_app import settings
from markermend_app.actions.shortcuts import KeyTip
from markermend_app.style import theme

SHOWN_RECENT = 5


class Welcome(QWidget):
    """An invitation to open a take.

    Signals
    -------
    open_requested(), demo_requested() : the buttons
    path_requested(Path) : a recent take was chosen
    """

    open_requested = Signal()
    demo_requested = Signal()
    path_requested = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._picture = QLabel()
        title = QLabel(self.tr("Open a take to mend"))
        title.setProperty("role", "heading")
        hint = QLabel(
            self.tr("Drop a C3D, TRC, CSV, AMC or BVH file here, or begin with the demo take.")
        )
        hint.setProperty("role", "muted")
        hint.setWordWrap(True)
        self.first = QPushButton(self.tr("Open take…"))
        KeyTip(self.first, self.tr("Open a take"), "open")
        self.first.setDefault(True)
        self.first.clicked.connect(self.open_requested)
        self.demo = QPushButton(self.tr("Open the demo take"))
        self.demo.clicked.connect(self.demo_requested)
        buttons = QHBoxLayout()
        buttons.setSpacing(8)
        buttons.addStretch(1)
        buttons.addWidget(self.first)
        buttons.addWidget(self.demo)
        buttons.addStretch(1)
        self._recent = QVBoxLayout()
        self._recent.setSpacing(4)
        box = QVBoxLayout(self)
        box.addStretch(2)
        for widget in (self._picture, title, hint):
            widget.setAlignment(Qt.AlignmentFlag.AlignCenter)
            box.addWidget(widget)
            box.addSpacing(8)
        box.addLayout(buttons)
        box.addSpacing(24)
        box.addLayout(self._recent)
        box.addStretch(3)
        theme.watcher.changed.connect(self._recolour)
        self._recolour()

    def showEvent(self, event: QShowEvent) -> None:
        """List the recent takes afresh."""
        while self._recent.count():
            item = self._recent.takeAt(0)
            widget = item.widget() if item is not None else None
            if widget is not None:
                widget.deleteLater()
        paths = settings.recent()[:SHOWN_RECENT]
        links = [self._link(path, paths) for path in paths]
        for link in links:
            link.setMinimumWidth(max(other.sizeHint().width() for other in links))
            self._recent.addWidget(link, 0, Qt.AlignmentFlag.AlignHCenter)
        super().showEvent(event)

    def _link(self, path: Path, among: list[Path]) -> QPushButton:
        """Make a flat button that opens a recent take; its folder tells it from a namesake."""
        alike = sum(other.name == path.name for other in among) > 1
        button = QPushButton(f"{path.parent.name}/{path.name}" if alike else path.name)
        button.setFlat(True)
        button.setToolTip(str(path))
        button.clicked.connect(lambda: self.path_requested.emit(path))
        return button

    def _recolour(self) -> None:
        self._picture.setPixmap(theme.app_icon().pixmap(96, 96))
