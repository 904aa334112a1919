"""What every row of the plots has: an area over time with cursor, crosshair, flags and sweep."""

from __future__ import annotations

from collections.abc import Sequence

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QFontMetricsF

from markermend.take import Event, Take
from markermend_app.items.caption import Caption
from markermend_app.items.flags import Flags
from markermend_app.items.outside import Outside
from markermend_app.items.plot import Plot
from markermend_app.items.time_axis import TimeAxis
from markermend_app.items.value_axis import ValueAxis
from markermend_app.panels.plots.view import PlotView
from markermend_app.style import theme

TIME_HEIGHT = 36
_VALUES_WIDTH = 80


class PlotFrame:
    """A plot without curves.

    Attributes
    ----------
    plot, view, time, values : the plot, its area and its two axes
    cursor : the line at the frame that is seen in space
    follows : whether the values shown follow what comes into view; until a hand moves them
    """

    def __init__(self) -> None:
        self.view = PlotView()
        self.time = TimeAxis()
        self.values = ValueAxis()
        self.plot = Plot(self.view, self.values, self.time)
        self.view.disableAutoRange()
        self.view.setDefaultPadding(0)
        self.values.setWidth(_VALUES_WIDTH)
        self.flags = Flags()
        self.outside = Outside()
        self.sweep = pg.LinearRegionItem(movable=False)
        self.cursor = pg.InfiniteLine(angle=90, movable=False)
        self.cursor.setZValue(30)
        self.across = pg.InfiniteLine(angle=90, movable=False)
        self.along = pg.InfiniteLine(angle=0, movable=False)
        self.caption = Caption(self.view)
        self._named: tuple[str, QColor] = ("", QColor())
        self.follows = True
        lines = (self.sweep, self.cursor, self.across, self.along)
        for item in (self.flags, self.outside, *lines):
            self.view.addItem(item, ignoreBounds=True)
        for item in (self.sweep, self.across, self.along):
            item.hide()
        self.view.values_moved.connect(self._let_go)
        self.view.sigResized.connect(self._place_name)

    def set_place(self, first: bool, last: bool) -> None:
        """Say whether this is the top row, which names the events, and the one with the time."""
        self.flags.set_named(first)
        self.time.setStyle(showValues=last)
        self.time.setHeight(TIME_HEIGHT if last else 0)

    def show_sweep(self, start: int, stop: int) -> None:
        """Draw a swept range; an empty one draws nothing."""
        self.sweep.setVisible(stop > start)
        if stop > start:
            self.sweep.setRegion((start - 0.5, stop - 0.5))

    def show_cross(self, frame: int | None, value: float | None) -> None:
        """Draw the crosshair: the line of a frame and, in the row under the mouse, of a value."""
        self.across.setVisible(frame is not None)
        self.along.setVisible(value is not None)
        if frame is not None:
            self.across.setValue(frame)
        if value is not None:
            self.along.setValue(value)

    def show_events(self, events: Sequence[tuple[float, str]]) -> None:
        """Draw events of the file: frame and name."""
        self.flags.show_events(events)

    def name_values(self, title: str, unit: str, color: QColor) -> None:
        """Write what is shown: beside the axis, or in the plot when that is too low for it."""
        self._named = (f"{title} ({unit})" if unit else title, color)
        self._place_name()

    def words(self) -> list[tuple[str, QColor]]:
        """What else is written in the plot's corner, each in its colour."""
        return []

    def restyle(self) -> None:
        """Take over the theme's colours."""
        look = theme.current()
        for axis in (self.values, self.time):
            axis.restyle()
        self.sweep.setBrush(pg.mkBrush(theme.faded(look.selection, 0.28)))
        for line in self.sweep.lines:
            line.setPen(pg.mkPen(look.selection, width=1, style=Qt.PenStyle.DashLine))
        self.cursor.setPen(pg.mkPen(theme.faded(look.text, 0.75), width=1))
        for line in (self.across, self.along):
            line.setPen(pg.mkPen(theme.faded(look.muted, 0.7), width=1, style=Qt.PenStyle.DotLine))
        self.flags.update()
        self.outside.update()

    def _place_name(self, *_: object) -> None:
        """Write the name where there is room for it."""
        text, color = self._named
        room = self.view.height() - 12
        fits = QFontMetricsF(self.values.label.font()).horizontalAdvance(text) < room
        size = f"{theme.SMALL_PT}pt"
        style = {"color": color.name(), "font-size": size}
        if fits:
            self.values.setLabel(text, **style)
        else:
            self.values.setLabel("", **style)
        self.values.showLabel(fits)
        # Else it stays where a name of another length, or none, had its middle.
        self.values.resizeEvent()
        self.caption.say([*([] if fits else [(text, color)]), *self.words()])

    def _let_go(self) -> None:
        """Leave the values as the operator put them."""
        self.follows = False


def events_of(take: Take) -> list[tuple[float, str]]:
    """Events of a take as flags say them: frame, and name with the side's letter before."""
    return [(take.frame_at(e), _name_of(e)) for e in take.events]


def _name_of(event: Event) -> str:
    side = event.context.strip()[:1].upper() if event.context.strip() in ("Left", "Right") else ""
    return f"{side} {event.label}".strip()
