"""The line above the plots: which markers are shown, and what lies under mouse or cursor."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap
from PySide6.QtWidgets import QHBoxLayout, QLabel, QToolButton, QWidget

from markermend.take import AXES, Take
from markermend_app import theme

_MOST = 6


class PlotHeader(QWidget):
    """Legend on the left, readout on the right.

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
        layout = QHBoxLayout(self)
        layout.setContentsMargins(8, 4, 8, 4)
        layout.addLayout(self._legend)
        layout.addStretch()
        layout.addWidget(self.readout)
        theme.watcher.changed.connect(self._restyle)

    def read_out(self, take: Take, marker: str, frame: int, axis: str = "") -> None:
        """Say frame, time and a marker's value: on one axis, or on all of them."""
        frame = max(0, min(frame, take.frames - 1))
        position = take.positions[frame, take.index(marker)]
        if np.isnan(position[0]):
            value = self.tr("missing")
        elif axis:
            value = f"{axis.upper()} {position[AXES.index(axis)]:.1f} mm"
        else:
            value = ", ".join(f"{v:.1f}" for v in position) + " mm"
        self.readout.setText(
            self.tr("Frame {frame} · {time:.3f} s · {marker} {value}").format(
                frame=take.frame_number(frame), time=frame / take.rate, marker=marker, value=value
            )
        )
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
        self.show_markers(self._markers)


def _swatch(color: QColor) -> QIcon:
    """A stroke in a colour, as the curve has it."""
    pixmap = QPixmap(24, 24)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.fillRect(0, 8, 24, 8, color)
    painter.end()
    return QIcon(pixmap)
