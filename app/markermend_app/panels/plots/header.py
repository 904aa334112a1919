"""The line above the plots: which markers are shown, and what lies under mouse or cursor."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QToolButton, QWidget

from markermend.artifact import Artifact
from markermend_app.panels.markers.badge import kind_icon
from markermend_app.panels.markers.naming import short_names
from markermend_app.sight import Sight
from markermend_app.style import theme
from markermend_app.words import literal

_MOST, _GAP = 6, 4
_MARGIN, _SPACING = 8, 6
_NAME_LEAST, _NAME_MOST = 90, 150
"""Pixels that the foremost marker's name has before the readout says all it could."""
_NARROW = 460


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
        self._said = ""
        self._sight: Sight | None = None
        self._lost: Artifact | None = None
        self.legend = Legend()
        self.legend.chosen.connect(self.chosen)
        self.readout = QLabel()
        self.readout.setTextFormat(Qt.TextFormat.PlainText)
        self.readout.setObjectName("readout")
        self.readout.setAccessibleName(self.tr("Readout"))
        # Else the longest readout would be the least width of the window.
        self.readout.setMinimumWidth(60)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(_MARGIN, 4, _MARGIN, 4)
        layout.setSpacing(_SPACING)
        self.plots = QToolButton()
        self.plots.setText(self.tr("Plots"))
        self.plots.setIconSize(QSize(14, 14))
        self.plots.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.plots.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.plots.setToolTip(self.tr("Choose what the plots show"))
        layout.addWidget(self.plots)
        self.back = QToolButton()
        self.back.setObjectName("back")
        self.back.setAccessibleName(self.tr("Back to the artifact under review"))
        self.back.setIconSize(QSize(16, 16))
        self.back.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.back.hide()
        layout.addWidget(self.back)
        # The name of the foremost marker goes before the readout's last figures.
        self.legend.setMinimumWidth(_NAME_LEAST)
        layout.addWidget(self.legend, 1)
        layout.addWidget(self.readout)
        theme.watcher.changed.connect(self._restyle)
        self._restyle()

    def read_out(self, text: str) -> None:
        """Say what lies under mouse or cursor."""
        if text != self._said:
            self._said = text
            self._fit_readout()
        self.readout.show()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Say as much as has room now."""
        super().resizeEvent(event)
        style = Qt.ToolButtonStyle
        narrow = self.width() < _NARROW
        self.plots.setToolButtonStyle(
            style.ToolButtonIconOnly if narrow else style.ToolButtonTextBesideIcon
        )
        self._fit_readout()

    def _fit_readout(self) -> None:
        """Leave out the time, the frame, and the name, before the last values."""
        taken = [self.plots, self.back] if self.back.isVisible() else [self.plots]
        name = min(max(self.legend.foremost_width, _NAME_LEAST), _NAME_MOST)
        room = self.width() - name - 2 * _MARGIN
        room -= sum(button.sizeHint().width() + _SPACING for button in taken) + _SPACING
        frame, _, rest = self._said.partition(" · ")
        values = rest.partition(" · ")[2]
        bare = values if " · " in values else values.partition(" ")[2]
        for text in (self._said, f"{frame} · {values}", values, bare) if values else (self._said,):
            self.readout.setText(text)
            over = self.readout.sizeHint().width() - room
            if over <= 0:
                break
        else:
            # A figure cut off would be another figure: dots say that there is more.
            metrics = self.readout.fontMetrics()
            width = max(metrics.horizontalAdvance(text) - over, 0)
            self.readout.setText(metrics.elidedText(text, Qt.TextElideMode.ElideRight, width))
        self.readout.setToolTip(self._said)

    def clear(self) -> None:
        """Read nothing out."""
        self.readout.hide()

    def follow(self, sight: Sight) -> None:
        """Offer the way back to the artifact under review while it is out of sight."""
        self._sight = sight
        self.back.clicked.connect(sight.look_back)
        sight.changed.connect(self._offer_back)

    def _offer_back(self, *, anew: bool = False) -> None:
        lost = None if self._sight is None else self._sight.lost
        if not anew and lost == self._lost:
            return
        self._lost = lost
        self.back.setVisible(lost is not None)
        self._fit_readout()
        if lost is not None:
            kind = theme.kind_name(lost.kind, within=True)
            self.back.setIcon(kind_icon(lost.kind))
            self.back.setText(
                self.tr("Back to {0}").format(short_names([lost.marker])[lost.marker])
            )
            text = self.tr("Under review, but out of sight: {0} on {1}").format(kind, lost.marker)
            self.back.setToolTip(text)

    def show_markers(self, markers: Sequence[str]) -> None:
        """List these markers, each in its colour, the foremost first."""
        self._markers = tuple(markers)
        self.legend.show_markers(self._markers)
        self._fit_readout()

    def _restyle(self) -> None:
        """Take over the theme's colours."""
        self.plots.setIcon(theme.icon("curves"))
        self._offer_back(anew=True)
        self.show_markers(self._markers)


class Legend(QWidget):
    """Names of markers in the colours of their curves; as many as have room.

    Signals
    -------
    chosen(str) : a marker was clicked
    """

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        # Its names must not make the window wider.
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._markers: tuple[str, ...] = ()
        # Made once: a button that is made, or shown, has its window painted a second time.
        self._made: list[QToolButton] = []
        self._first = ""
        self.more = QLabel(self)
        self.more.setProperty("role", "small")

    def show_markers(self, markers: Sequence[str]) -> None:
        """Name these markers."""
        self._markers = tuple(markers)
        short = short_names(self._markers)
        for i in range(len(self._made), len(self.named)):
            self._made.append(self._chip(i))
        for chip in self._made[len(self.named) :]:
            chip.hide()
        for i, (chip, name) in enumerate(zip(self.chips, self.named, strict=True)):
            chip.setText(literal(short[name]))
            chip.setIcon(_swatch(theme.marker_color(i)))
            chip.setToolTip(self.tr("Bring {marker} to the front").format(marker=name))
        self._first = short[self._markers[0]] if self._markers else ""
        self._arrange()

    @property
    def named(self) -> tuple[str, ...]:
        """The markers that have a button."""
        return self._markers[:_MOST]

    @property
    def chips(self) -> list[QToolButton]:
        """Their buttons, of which those without room are hidden."""
        return self._made[: len(self.named)]

    @property
    def foremost_width(self) -> int:
        """Pixels that the whole name of the foremost marker takes, and how many others there are.

        Without a marker these are none.
        """
        if not self.chips:
            return 0
        chip = self.chips[0]
        cut = chip.fontMetrics().horizontalAdvance(chip.text())
        whole = chip.fontMetrics().horizontalAdvance(literal(self._first))
        rest = self.more.sizeHint().width() if len(self._markers) > 1 else 0
        return chip.sizeHint().width() + whole - cut + _GAP + rest

    def sizeHint(self) -> QSize:
        """As high as a button."""
        return QSize(0, 26)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Name as many as have room now."""
        super().resizeEvent(event)
        self._arrange()

    def _chip(self, index: int) -> QToolButton:
        """The button of the marker in this place."""
        chip = QToolButton(self)
        chip.setIconSize(QSize(12, 12))
        chip.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        chip.clicked.connect(lambda: self.chosen.emit(self._markers[index]))
        return chip

    def _arrange(self) -> None:
        """Put the names beside one another, and count those without room."""
        if not self.chips:
            self._count(0)
            return
        self.chips[0].setText(literal(self._first))
        widths = [chip.sizeHint().width() + _GAP for chip in self.chips]
        for fitting in range(len(self.chips), 0, -1):
            self._count(len(self._markers) - fitting)
            over = sum(widths[:fitting]) - self.width()
            over += 0 if self.more.isHidden() else self.more.sizeHint().width()
            if over <= 0:
                break
        else:
            # Not even the foremost name has room: its middle goes.
            metrics = self.chips[0].fontMetrics()
            room = metrics.horizontalAdvance(self._first) - over
            elided = metrics.elidedText(self._first, Qt.TextElideMode.ElideMiddle, max(room, 0))
            self.chips[0].setText(literal(elided))
            widths[0] -= over
        x = 0
        for i, (chip, width) in enumerate(zip(self.chips, widths, strict=True)):
            chip.setVisible(i < fitting)
            chip.setGeometry(x, 0, width - _GAP, self.height())
            x += width if i < fitting else 0
        self.more.setGeometry(x, 0, self.more.sizeHint().width(), self.height())

    def _count(self, rest: int) -> None:
        """Say how many are not named."""
        self.more.setText(f"+{rest}")
        self.more.setToolTip(", ".join(self._markers[len(self._markers) - rest :]))
        self.more.setVisible(rest > 0)


def _swatch(color: QColor) -> QIcon:
    """A stroke in a colour, as the curve has it."""
    pixmap = QPixmap(24, 24)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.fillRect(0, 8, 24, 8, color)
    painter.end()
    return QIcon(pixmap)
