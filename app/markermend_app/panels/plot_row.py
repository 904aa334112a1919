"""One of the stacked plots: an axis of the shown markers, their artifacts and a proposal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact
from markermend.patch import Patch
from markermend.take import AXES, Origin, Take
from markermend_app import theme
from markermend_app.items.band import Band
from markermend_app.items.curve import curve, dots, lone_samples, pieces, prepare_plot
from markermend_app.items.edges import Edges
from markermend_app.items.intervals import Intervals
from markermend_app.items.time_axis import TimeAxis
from markermend_app.panels.plot_range import value_range
from markermend_app.panels.plot_view import PlotView

TIME_HEIGHT = 36
_VALUES_WIDTH = 80
_SPARE = 2
"""Markers whose empty curves are kept for the next ones: making curves takes long."""
_NONE: FloatArray = np.zeros(0)


@dataclass(frozen=True, eq=False)
class Trace:
    """The curves of one marker on one axis.

    Attributes
    ----------
    measured : samples as recorded
    changed : samples that were filled or edited, drawn apart
    original : samples of the source where the working ones differ
    lone : samples without neighbours
    predicted : where the rest of the body says the marker is
    """

    measured: pg.PlotDataItem
    changed: pg.PlotDataItem
    original: pg.PlotDataItem
    lone: pg.PlotDataItem
    predicted: pg.PlotDataItem

    def items(self) -> tuple[pg.PlotDataItem, ...]:
        """All of them."""
        return (self.original, self.measured, self.changed, self.lone, self.predicted)


class PlotRow:
    """Everything that is drawn for one axis.

    Attributes
    ----------
    axis, column : ``"x"``, ``"y"`` or ``"z"``, and its column in positions
    plot, view : the plot and its area
    intervals : the artifacts
    edges : those of the current artifact, to be dragged
    follows : whether the values shown follow what comes into view; until a hand moves them
    """

    def __init__(self, axis: str, last: bool) -> None:
        self.axis, self.column = axis, AXES.index(axis)
        self.view = PlotView()
        self.time = TimeAxis()
        self.plot = pg.PlotItem(viewBox=self.view, axisItems={"bottom": self.time})
        self.plot.hideButtons()
        self.plot.setMenuEnabled(False)
        prepare_plot(self.plot)
        self.view.setDefaultPadding(0)
        self.values = self.plot.getAxis("left")
        self.values.setWidth(_VALUES_WIDTH)
        self.plot.showGrid(x=True, y=True, alpha=1.0)
        for side in (self.values, self.time):
            # Else the grid lies over the curves, and minor lines outnumber what is drawn.
            side.setZValue(-1000)
            side.enableAutoSIPrefix(False)
            side.setStyle(maxTickLevel=0)
        self.time.setStyle(showValues=last)
        self.time.setHeight(TIME_HEIGHT if last else 0)
        self.intervals = Intervals()
        self.band = Band()
        self.sweep = pg.LinearRegionItem(movable=False)
        self.cursor = pg.InfiniteLine(angle=90, movable=False)
        self.cursor.setZValue(30)
        self._proposals: list[pg.PlotDataItem] = []
        self.proposed: list[pg.PlotDataItem] = []
        self._pool: list[Trace] = []
        self.traces: dict[str, Trace] = {}
        self._take: Take | None = None
        self._before = False
        self.follows = True
        for item in (self.intervals, self.band, self.sweep, self.cursor):
            self.plot.addItem(item, ignoreBounds=True)
        self.edges = Edges(self.plot)
        self.edges.show(False, False)
        self.sweep.hide()
        self.view.sigResized.connect(self._resized)
        self.view.values_moved.connect(self._let_go)
        self.restyle()

    # Curves

    def show_markers(self, take: Take, original: Take, markers: Sequence[str]) -> None:
        """Draw these markers and no others."""
        for trace in self._pool[max(len(markers), _SPARE) :]:
            for item in trace.items():
                self.plot.removeItem(item)
        del self._pool[max(len(markers), _SPARE) :]
        for i in range(len(self._pool), len(markers)):
            self._pool.append(self._new_trace(i))
        for trace in self._pool[len(markers) :]:
            for item in trace.items():
                _fill(item)
        self.traces = dict(zip(markers, self._pool, strict=False))
        self._take = take
        for name in markers:
            self.refresh(take, original, name)

    def refresh(self, take: Take, original: Take, name: str) -> None:
        """Draw the samples of one marker as they stand now."""
        self._take = take
        trace, column = self.traces[name], take.index(name)
        values = np.ascontiguousarray(take.positions[:, column, self.column])
        source = np.ascontiguousarray(original.positions[:, column, self.column])
        origin = take.origin[:, column]
        mended = (origin == Origin.FILLED) | (origin == Origin.EDITED)
        _fill_whole(trace.measured, np.where(mended, np.nan, values))
        _fill_pieces(trace.changed, values, mended)
        _fill_pieces(trace.lone, values, lone_samples(values), join=0)
        same = (values == source) | (np.isnan(values) & np.isnan(source))
        _fill_pieces(trace.original, source, ~same)

    def show_prediction(self, predicted: Mapping[str, FloatArray]) -> None:
        """Draw predicted positions, (frames, 3) by marker; others get none."""
        for name, trace in self.traces.items():
            if name in predicted:
                _fill_whole(trace.predicted, predicted[name][:, self.column])
            else:
                _fill(trace.predicted)

    def set_before(self, before: bool) -> None:
        """Bring the source's samples forward and let the repairs step back, or not."""
        self._before = before
        for i, trace in enumerate(self._pool):
            self._style(trace, i)

    # Artifacts and the proposal

    def show_artifacts(self, artifacts: Sequence[Artifact], markers: Sequence[str]) -> None:
        """Draw the artifacts that name this axis."""
        self.intervals.show([a for a in artifacts if self.axis in a.axes], markers)

    def show_current(self, artifact: Artifact | None, editable: bool) -> None:
        """Mark the artifact under review and, where it may be changed, offer its edges."""
        self.intervals.set_current(None if artifact is None else artifact.id)
        offered = artifact is not None and self.axis in artifact.axes
        self.edges.show(offered, offered and editable)
        if artifact is not None and offered:
            self.edges.place(artifact.start, artifact.stop)

    def show_sweep(self, start: int, stop: int) -> None:
        """Draw a swept range; an empty one draws nothing."""
        self.sweep.setVisible(stop > start)
        if stop > start:
            self.sweep.setRegion((start - 0.5, stop - 0.5))

    def show_proposal(self, patches: Sequence[Patch], band_mm: FloatArray | None) -> None:
        """Draw what a repair would put here; the band goes with the first patch."""
        self.proposed = []
        self.band.clear()
        for i, patch in enumerate(patches):
            if self.axis not in patch.axes or patch.marker not in self.traces:
                continue
            x, y = self._joined(patch)
            if len(self.proposed) == len(self._proposals):
                item = curve(theme.current().accent, width=2)
                item.setZValue(15)
                self.plot.addItem(item)
                self._proposals.append(item)
            item = self._proposals[len(self.proposed)]
            _fill(item, x, y)
            self.proposed.append(item)
            if i == 0 and band_mm is not None and len(band_mm) == patch.stop - patch.start:
                inner = np.arange(patch.start, patch.stop, dtype=np.float64)
                values = patch.values[:, patch.axes.index(self.axis)]
                self.band.set_data(inner, values, band_mm)
        for item in self._proposals[len(self.proposed) :]:
            _fill(item)

    def _joined(self, patch: Patch) -> tuple[FloatArray, FloatArray]:
        """A patch's values on this axis with the samples on either side."""
        values = patch.values[:, patch.axes.index(self.axis)]
        x = np.arange(patch.start, patch.stop, dtype=np.float64)
        if self._take is None:
            return x, values
        known = self._take.positions[:, self._take.index(patch.marker), self.column]
        before = slice(max(0, patch.start - 1), patch.start)
        after = slice(patch.stop, min(len(known), patch.stop + 1))
        start = patch.start - len(known[before])
        joined = np.concatenate((known[before], values, known[after]))
        return start + np.arange(len(joined), dtype=np.float64), joined

    # The view

    def set_view(self, start: float, stop: float, current: Artifact | None) -> None:
        """Show these frames and, unless a hand moved them, the values that matter there."""
        values = self._values_within(start, stop, current) if self.follows else None
        self.view.setRange(xRange=(start, stop), yRange=values, padding=0)

    def _values_within(
        self, start: float, stop: float, current: Artifact | None
    ) -> tuple[float, float] | None:
        """Values that matter within these frames, or None where nothing is."""
        take = self._take
        if take is None or not self.traces:
            return None
        low, high = max(0, int(start)), max(0, int(np.ceil(stop)) + 1)
        columns = [take.index(name) for name in self.traces]
        trusted, special = [], []
        for name, column in zip(self.traces, columns, strict=True):
            values = take.positions[low:high, column, self.column]
            if current is not None and name == current.marker and self.axis in current.axes:
                mine: BoolArray = np.zeros(len(values), dtype=bool)
                mine[max(0, current.start - low) : max(0, current.stop - low)] = True
                special.append(values[mine])
                values = values[~mine]
            trusted.append(values)
        special += [item.yData for item in self.proposed if item.yData is not None]
        height = max(1.0, self.view.height())
        bottom = min(0.3, self.intervals.strip_height / height)
        return value_range(trusted, special, bottom)

    def restyle(self) -> None:
        """Take over the theme's colours."""
        look = theme.current()
        for axis in (self.values, self.time):
            axis.setPen(pg.mkPen(look.border))
            axis.setTickPen(pg.mkPen(look.grid))
            axis.setTextPen(pg.mkPen(look.muted))
            font = axis.font()
            font.setPointSize(theme.SMALL_PT)
            axis.setTickFont(font)
        name = look.axes[self.axis].name()
        self.values.setLabel(
            f"{self.axis.upper()} (mm)", **{"color": name, "font-size": f"{theme.SMALL_PT}pt"}
        )
        accent = look.accent
        self.edges.set_color(accent)
        self.sweep.setBrush(pg.mkBrush(theme.faded(look.selection, 0.28)))
        for line in self.sweep.lines:
            line.setPen(pg.mkPen(look.selection, width=1, style=Qt.PenStyle.DashLine))
        self.cursor.setPen(pg.mkPen(theme.faded(look.text, 0.75), width=1))
        self.band.set_color(theme.faded(accent, 0.22))
        for item in self._proposals:
            item.setPen(pg.mkPen(accent, width=2, cosmetic=True))
        for i, trace in enumerate(self._pool):
            self._style(trace, i)
        self.intervals.update()

    def _new_trace(self, index: int) -> Trace:
        """Empty curves for a marker."""
        color = theme.marker_color(index)
        trace = Trace(curve(color), curve(color), curve(color), dots(color), curve(color))
        for depth, item in enumerate(trace.items()):
            item.setZValue(10 - index * 0.1 + depth * 0.01)
            self.plot.addItem(item)
        self._style(trace, index)
        return trace

    def _style(self, trace: Trace, index: int) -> None:
        """Give a marker's curves their pens."""
        look, color = theme.current(), theme.marker_color(index)
        mended = theme.blend(color, look.accent, 0.55)
        original = color if self._before else look.original
        trace.measured.setPen(pg.mkPen(color, width=1))
        trace.original.setPen(pg.mkPen(original, width=1))
        style = Qt.PenStyle.DotLine if self._before else Qt.PenStyle.DashLine
        trace.changed.setPen(
            pg.mkPen(look.original if self._before else mended, width=1, style=style)
        )
        trace.lone.setSymbolBrush(color)
        trace.predicted.setPen(
            pg.mkPen(theme.blend(look.accent, color, 0.3), width=1, style=Qt.PenStyle.DotLine)
        )

    def _let_go(self) -> None:
        """Leave the values as the operator put them."""
        self.follows = False

    def _resized(self, *_: object) -> None:
        """Work out anew how many samples a pixel stands for."""
        for trace in self.traces.values():
            for item in trace.items():
                item.viewRangeChanged()


def _fill_whole(item: pg.PlotDataItem, values: FloatArray) -> None:
    """Give a curve one value a frame; a curve without any is emptied."""
    if np.isnan(values).all():
        _fill(item)
    else:
        _fill(item, np.arange(len(values), dtype=np.float64), values)


def _fill_pieces(item: pg.PlotDataItem, values: FloatArray, mask: BoolArray, join: int = 1) -> None:
    """Give a curve the masked stretches of some values."""
    if mask.any():
        _fill(item, *pieces(values, mask, join))
    else:
        _fill(item)


def _fill(item: pg.PlotDataItem, x: FloatArray = _NONE, y: FloatArray = _NONE) -> None:
    """Give a curve its points; one that is empty already is left alone, which most are."""
    if len(x) or item.xData is not None:
        item.setData(x, y)
