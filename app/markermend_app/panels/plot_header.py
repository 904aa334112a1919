"""The line above the plots: which markers are shown, and what lies under mouse or cursor."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap
from PySide6.QtWidgets import QHBoxLayout, QLabel, QToolButton, QWidget

from markermend_app import theme

_MOST = 6


class PlotHeader(QWidget):
    """Menu of plots and legend on the left, readout on the right.

    Signals
    -------
    chosen(str) : a marker of the legend was clicked
    """

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._markers: tuple[str, ...] = ()
        self._legend = QHBoxLayout()
        self._legend.setSpacing(4)
        self.readout = QLabel()
        self.readout.setObjectName("readout")
        self.readout.setAccessibleName(self.tr("Readout"))
        # Else the longest readout would be the least width of the window.
        self.readout.setMinimumWidth(60)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(8, 4, 8, 4)
        self.plots = QToolButton()
        self.plots.setText(self.tr("Plots"))
        self.plots.setIconSize(QSize(14, 14))
        self.plots.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.plots.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.plots.setToolTip(self.tr("Choose what the plots show"))
        layout.addWidget(self.plots)
        layout.addLayout(self._legend)
        layout.addStretch()
        layout.addWidget(self.readout)
        theme.watcher.changed.connect(self._restyle)
        self._restyle()

    def read_out(self, text: str) -> None:
        """Say what lies under mouse or cursor."""
        self.readout.setText(text)
        self.readout.show()

    def clear(self) -> None:
        """Read nothing out."""
        self.readout.hide()

    def show_markers(self, markers: Sequence[str]) -> None:
        """List these markers, each in its colour, the foremost first."""
        self._markers = tuple(markers)
        while (item := self._legend.takeAt(0)) is not None:
            widget = item.widget()
            if widget is not None:
                widget.hide()
                widget.deleteLater()
        for i, name in enumerate(self._markers[:_MOST]):
            button = QToolButton()
            button.setText(name)
            button.setIcon(_swatch(theme.marker_color(i)))
            button.setIconSize(QSize(12, 12))
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
            button.setToolTip(self.tr("Bring {marker} to the front").format(marker=name))
            button.clicked.connect(lambda _=False, name=name: self.chosen.emit(name))
            self._legend.addWidget(button)
        rest = len(self._markers) - _MOST
        if rest > 0:
            label = QLabel(self.tr("and {count} more").format(count=rest))
            label.setProperty("role", "small")
            label.setToolTip(", ".join(self._markers[_MOST:]))
            self._legend.addWidget(label)

    def _restyle(self) -> None:
        """Take over the theme's colours."""
        self.plots.setIcon(theme.icon("curves"))
        self.show_markers(self._markers)


def _swatch(color: QColor) -> QIcon:
    """A stroke in a colour, as the curve has it."""
    pixmap = QPixmap(24, 24)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.fillRect(0, 8, 24, 8, color)
    painter.end()
    return QIcon(pixmap)
