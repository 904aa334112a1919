"""The rows of the plots, one above the other: which there are, their order and their heights."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pyqtgraph as pg
from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt

from markermend_app.later import OneByOne
from markermend_app.panels.plots.beside import BesideRow, Channel
from markermend_app.panels.plots.frame import TIME_HEIGHT, PlotFrame
from markermend_app.panels.plots.quantity import QUANTITIES
from markermend_app.panels.plots.row import PlotRow

_SPACING = 6
_MARGIN = 4


class _Ready(QObject):
    """Brings a scene's views and the window's layouts up to date before the scene is painted.

    A scene that changed has its whole window painted at once, ahead of layouts that wait, and its
    views take a new range over only then; all that either moves would be painted a second time.
    """

    def __init__(self, scene: pg.GraphicsScene) -> None:
        super().__init__(scene)
        self._scene = scene
        scene.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Go before the scene's own turn."""
        if event.type() == QEvent.Type.MetaCall:
            QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
            self._scene.prepareForPaint()
        return False


class PlotStack(pg.GraphicsLayoutWidget):
    """Plots that share one time axis, below the last one.

    Parameters
    ----------
    made : called with each new row, to connect its gestures

    Attributes
    ----------
    rows : of the markers, from the top
    beside : of channels that are no markers, below them
    """

    def __init__(self, made: Callable[[PlotFrame], None]) -> None:
        super().__init__()
        self._made = made
        self._kept: dict[str, PlotRow] = {}
        self._turns = OneByOne(self)
        self.rows: tuple[PlotRow, ...] = ()
        self.beside: tuple[BesideRow, ...] = ()
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        _Ready(self.scene())
        self.ci.layout.setSpacing(_SPACING)
        self.ci.layout.setContentsMargins(0, _MARGIN, 12, _MARGIN)
        self.sigDeviceRangeChanged.connect(self.share_height)

    @property
    def frames(self) -> tuple[PlotFrame, ...]:
        """Every row, from the top."""
        return (*self.rows, *self.beside)

    def row(self, name: str) -> PlotRow | None:
        """The row of a quantity, or None when it is not shown."""
        return next((r for r in self.rows if r.quantity.name == name), None)

    def set_rows(self, names: Sequence[str]) -> None:
        """Show these quantities, in this order."""
        for name in names:
            if name not in self._kept:
                self._kept[name] = PlotRow(QUANTITIES[name], self._turns)
                self._made(self._kept[name])
        self._replace(tuple(self._kept[name] for name in names), self.beside)

    def set_beside(self, groups: Sequence[Sequence[Channel]]) -> None:
        """Show these channels below, one row a group."""
        rows = tuple(BesideRow(group) for group in groups)
        for row in rows:
            self._made(row)
        self._replace(self.rows, rows)

    def _replace(self, rows: tuple[PlotRow, ...], beside: tuple[BesideRow, ...]) -> None:
        """Lay other rows out; those that stay where they are are left alone, which takes long."""
        before, now = self.frames, (*rows, *beside)
        if now == before:
            return
        stay = next(
            (i for i, (a, b) in enumerate(zip(before, now, strict=False)) if a is not b),
            min(len(before), len(now)),
        )
        for frame in before[stay:]:
            self.ci.removeItem(frame.plot)
        self.rows, self.beside = rows, beside
        for i, frame in enumerate(now):
            if i >= stay:
                self.ci.addItem(frame.plot, row=i, col=0)
            frame.set_place(i == 0, i == len(now) - 1)
        self.share_height()
        # Where rows stay, the scene would else lay them out only when it is painted next.
        self.ci.layout.activate()

    def share_height(self, *_: object) -> None:
        """Give all plots the same height, whoever carries the time axis."""
        count = len(self.frames)
        if not count:
            return
        free = self.height() - 2 * _MARGIN - (count - 1) * _SPACING - TIME_HEIGHT
        height = max(20.0, free / count)
        layout = self.ci.layout
        for i in range(layout.rowCount()):
            extra = TIME_HEIGHT if i == count - 1 else 0
            layout.setRowFixedHeight(i, height + extra if i < count else 0)
            layout.setRowSpacing(i, _SPACING if i < count - 1 else 0)
