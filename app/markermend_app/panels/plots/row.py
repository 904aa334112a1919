"""One of the stacked plots: a quantity of the shown markers, their artifacts and a proposal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from operator import is_

import numpy as np
from PySide6.QtCore import QPointF

from markermend.arrays import ByteArray, FloatArray
from markermend.artifact import Artifact
from markermend.patch import Patch
from markermend.take import AXES, Origin
from markermend_app import units
from markermend_app.items.band import Band
from markermend_app.items.curve import Curve
from markermend_app.items.edges import Edges
from markermend_app.items.intervals import Intervals
from markermend_app.items.points import lone_samples
from markermend_app.later import OneByOne
from markermend_app.panels.plots.drawn import Shown
from markermend_app.panels.plots.frame import PlotFrame
from markermend_app.panels.plots.quantity import Quantity
from markermend_app.panels.plots.range import value_range
from markermend_app.panels.plots.trace import Trace
from markermend_app.style import theme
from markermend_app.words import tr

_SPARE = 2
"""Markers whose empty curves are kept for the next ones: making curves takes long."""
_AT_ONCE, _FEWEST = 60_000, 28_000
"""Samples drawn at a time, where a marker counts for as many at least: curves take time to make."""

Banded = tuple[Patch, FloatArray]
"""Values, and (frames,) mm how far off them the marker may be in each frame."""


def same_objects(these: Sequence[object], those: Sequence[object]) -> bool:
    """Whether two sequences hold the very same objects: then what was drawn of them still holds."""
    return len(these) == len(those) and all(map(is_, these, those))


@dataclass(frozen=True, eq=False)
class _Source:
    """What a quantity was in the file, and how its samples came about: there, and as they stand."""

    values: FloatArray
    origin_before: ByteArray
    origin: ByteArray


class PlotRow(PlotFrame):
    """Everything that is drawn of one quantity.

    Parameters
    ----------
    quantity : what is shown
    turns : in which all rows draw what takes long

    Attributes
    ----------
    title : what the quantity is called
    intervals : the artifacts
    edges : those of the current artifact, to be dragged
    values_of : (frames,) values by marker, as far as they are known
    """

    def __init__(self, quantity: Quantity, turns: OneByOne) -> None:
        super().__init__()
        self.quantity = quantity
        self.title = tr(quantity.title)
        self.column = AXES.index(quantity.name) if quantity.name in AXES else None
        self.intervals = Intervals()
        self.band = Band()
        self._proposals: list[Curve] = []
        self.proposed: list[Curve] = []
        self._pool: list[Trace] = []
        self.traces: dict[str, Trace] = {}
        self.values_of: dict[str, FloatArray] = {}
        self._source_of: dict[str, _Source] = {}
        self._shown: dict[str, Shown] = {}
        self._asked: Sequence[object] = ()
        self._offered: tuple[Sequence[Patch], Banded | None] = ((), None)
        self._waiting: dict[str, Shown] = {}
        self._seen: tuple[float, float, Artifact | None] = (0.0, 1.0, None)
        self._turns = turns
        self._before = False
        for item in (self.intervals, self.band):
            self.view.addItem(item, ignoreBounds=True)
        self.edges = Edges(self.view)
        self.edges.show(False, False)
        self.restyle()

    # Curves

    def show_markers(self, shown: Mapping[str, Shown], soon: bool = False) -> None:
        """Draw these markers and no others: the foremost now, or all of them soon."""
        if len(self._pool) > max(len(shown), _SPARE):
            self._turns.ask(self._trim)
        for i in range(len(self._pool), len(shown)):
            self._pool.append(Trace(self.view, i, self._before))
        for trace in self._pool[len(shown) :]:
            trace.clear_all()
        same = {a for a, b in zip(self.traces, shown, strict=False) if a == b}
        self.traces = dict(zip(shown, self._pool, strict=False))
        values, self.values_of = self.values_of, {}
        sources, self._source_of = self._source_of, {}
        before, self._shown = self._shown, {}
        self._waiting.clear()
        for name, marker in shown.items():
            if name in same and before.get(name) is marker:
                # What is in its curves already need not be worked out again.
                self._shown[name] = marker
                if name in values:
                    self.values_of[name] = values[name]
                    self._source_of[name] = sources[name]
            else:
                self._waiting[name] = marker
        # What the operator looks at is there at once, what is shown beside it may follow.
        self._draw_waiting(soon, int(next(iter(shown), None) in self._waiting))
        for name in self._waiting:
            self.traces[name].clear_all()

    def _trim(self) -> None:
        """Take the curves of one marker that is no longer shown out of the plot."""
        if len(self._pool) > max(len(self.traces), _SPARE):
            self._pool.pop().remove()
            self._turns.ask(self._trim)

    def renew(self, changed: Mapping[str, Shown], soon: bool = False) -> None:
        """Draw markers anew whose samples changed: the foremost now, or all of them soon."""
        waiting = {**self._waiting, **changed}
        self._waiting = {name: waiting[name] for name in self.traces if name in waiting}
        self._draw_waiting(soon, int(next(iter(self.traces), None) in changed))

    def _draw_waiting(self, soon: bool, least: int) -> None:
        """Draw at least so many of the markers that wait, and more where that does not take long.

        The rest is drawn when the window and the other rows had their turns, or all if ``soon``.
        """
        if soon:
            if self._waiting:
                self._turns.ask(self._draw_later)
            return
        samples = 0
        for drawn, (name, marker) in enumerate(list(self._waiting.items())):
            samples += max(marker.frames, _FEWEST)
            if drawn >= least and samples > _AT_ONCE:
                self._turns.ask(self._draw_later)
                break
            self.refresh(name, marker)

    def _draw_later(self) -> None:
        """Draw more of those that wait, what a repair would make of them, and make room for it."""
        self._draw_waiting(False, 1)
        self.show_proposal(*self._offered)
        self.set_view(*self._seen)

    def refresh(self, name: str, shown: Shown) -> None:
        """Draw the samples of one marker as they stand now."""
        trace = self.traces[name]
        self._shown[name] = shown
        self._waiting.pop(name, None)
        values = self.quantity.of(shown.now)
        source = values if shown.before is shown.now else self.quantity.of(shown.before)
        if values is None or source is None:
            self.values_of.pop(name, None)
            self._source_of.pop(name, None)
            trace.clear_all()
            return
        origin, same = shown.origin, None
        if source is not values:
            same = (values == source) | (np.isnan(values) & np.isnan(source))
            # Of a sample one axis may have been edited and not the others.
            kept = same & (origin == Origin.EDITED)
            origin = np.where(kept, shown.origin_before, origin) if kept.any() else origin
        self.values_of[name] = values
        self._source_of[name] = _Source(source, shown.origin_before, origin)
        filled, edited = origin == Origin.FILLED, origin == Origin.EDITED
        mended = filled | edited
        measured = np.where(mended, np.nan, values) if mended.any() else values
        trace.fill_whole("measured", measured)
        trace.fill_pieces("filled", values, filled)
        trace.fill_pieces("edited", values, edited)
        trace.fill_pieces("lone", values, lone_samples(values), join=0)
        if same is None:
            trace.clear("original")
        else:
            trace.fill_pieces("original", source, ~same)

    def show_prediction(self, predicted: Mapping[str, FloatArray]) -> None:
        """Draw predicted positions, (frames, 3) by marker; others get none."""
        for name, trace in self.traces.items():
            if name in predicted and self.column is not None:
                trace.fill_whole("predicted", predicted[name][:, self.column])
            else:
                trace.clear("predicted")

    def set_before(self, before: bool) -> None:
        """Bring the source's samples forward and let the repairs step back, or not."""
        self._before = before
        for trace in self._pool:
            trace.style(self._before)
        if before:
            # Back again the view stays: who looks at both by turns wants nothing else to change.
            self.set_view(*self._seen)

    def set_title(self, title: str) -> None:
        """Call what is shown something else."""
        if title != self.title:
            self.title = title
            self.restyle()

    def value_at(self, name: str, frame: int) -> float | None:
        """Value of a shown marker in a frame, of the version in front.

        NaN where missing, None where nothing is known.
        """
        values = self._in_front(name)
        return None if values is None or not len(values) else float(values[frame])

    def _in_front(self, name: str) -> FloatArray | None:
        """(frames,) values of a marker, of the version in front."""
        source = self._source_of.get(name)
        if self._before and source is not None:
            return source.values
        return self.values_of.get(name)

    def origin_at(self, name: str, frame: int) -> Origin:
        """How that value came about."""
        source = self._source_of.get(name)
        if source is None:
            return Origin.MEASURED
        return Origin(int((source.origin_before if self._before else source.origin)[frame]))

    def nearest(self, at: QPointF, names: Sequence[str], reach: float) -> str | None:
        """The marker whose curve passes nearest to a point, None where none is in reach.

        Parameters
        ----------
        at : in the scene
        names : markers looked at; of equals the first
        reach : pixels
        """
        here, (wide, high) = self.view.mapSceneToView(at), self.view.viewPixelSize()
        first = max(0, int(here.x() - reach * wide))
        frames = np.arange(first, int(here.x() + reach * wide) + 2)
        found: str | None = None
        for name in names if len(frames) else ():
            values = self._in_front(name)
            if values is None:
                continue
            curve = values[first : frames[-1] + 1]
            across = (frames[: len(curve)] - here.x()) / wide
            apart = np.hypot(across, (curve - here.y()) / high)
            least = float(np.nanmin(apart, initial=np.inf))
            if least < reach:
                found, reach = name, least
        return found

    # Artifacts and the proposal

    def show_artifacts(self, artifacts: Sequence[Artifact], markers: Sequence[str]) -> None:
        """Draw the artifacts that name an axis of this row."""
        self.intervals.show([a for a in artifacts if self.concerns(a)], markers)

    def concerns(self, artifact: Artifact) -> bool:
        """Whether an artifact names an axis that this row depends on."""
        return not set(artifact.axes).isdisjoint(self.quantity.axes)

    def show_current(self, artifact: Artifact | None, editable: bool) -> None:
        """Mark the artifact under review and, where it may be changed, offer its edges."""
        self.intervals.set_current(None if artifact is None else artifact.id)
        offered = artifact is not None and self.concerns(artifact)
        self.edges.show(offered, offered and editable)
        if artifact is not None and offered:
            self.edges.place(artifact.start, artifact.stop)

    def show_proposal(self, patches: Sequence[Patch], banded: Banded | None) -> None:
        """Draw what a repair would put here, and how far off it, or what it did put, may be."""
        self._offered = patches, banded
        markers = [p.marker for p in (*patches, *(banded or ())[:1])]
        asked = (*patches, *(banded or ()), *map(self._shown.get, markers))
        if same_objects(asked, self._asked):
            return
        self._asked = asked
        self._show_band(banded)
        self.proposed = []
        for patch in patches:
            joined = self.joined(patch)
            if joined is None:
                continue
            if len(self.proposed) == len(self._proposals):
                curve = Curve(theme.current().accent, width=2)
                curve.setZValue(15)
                self.view.add_curve(curve)
                self._proposals.append(curve)
            curve = self._proposals[len(self.proposed)]
            curve.set_points(*joined)
            self.proposed.append(curve)
        for curve in self._proposals[len(self.proposed) :]:
            curve.clear()

    def _show_band(self, banded: Banded | None) -> None:
        """Draw the range around the values of a patch that is shown here, or none."""
        self.band.clear()
        if banded is None:
            return
        patch, band_mm = banded
        concerned = patch.marker in self._shown and self.quantity.name in patch.axes
        if concerned and len(band_mm) == len(patch.values):
            values = patch.values[:, patch.axes.index(self.quantity.name)]
            inner = np.arange(patch.start, patch.stop, dtype=np.float64)
            self.band.set_data(inner, values, band_mm)

    def joined(self, patch: Patch) -> tuple[FloatArray, FloatArray] | None:
        """What a patch would make of the values, with one known value on either side."""
        shown, reach = self._shown.get(patch.marker), self.quantity.reach
        if shown is None or reach < 0 or set(patch.axes).isdisjoint(self.quantity.axes):
            return None
        near, first = shown.now.patched(patch, 2 * reach + 1)
        values = self.quantity.of(near)
        if values is None:
            return None
        low = max(0, patch.start - reach - 1)
        part = values[low - first : patch.stop + reach + 1 - first]
        return low + np.arange(len(part), dtype=np.float64), part

    # The view

    def set_view(self, start: float, stop: float, current: Artifact | None) -> None:
        """Show these frames and, unless a hand moved them, the values that matter there."""
        self._seen = (start, stop, current)
        values = self._values_within(start, stop, current) if self.follows else None
        # Plots never choose their range by themselves, and need not be told to leave that.
        self.view.setRange(xRange=(start, stop), yRange=values, padding=0, disableAutoRange=False)

    def _values_within(
        self, start: float, stop: float, current: Artifact | None
    ) -> tuple[float, float] | None:
        """Values that matter within these frames, or None where nothing is."""
        low, high = max(0, int(start)), max(0, int(np.ceil(stop)) + 1)
        trusted, special = [], []
        for name, whole in self.values_of.items():
            values = whole[low:high]
            if current is not None and name in current.markers and self.concerns(current):
                a, b = max(0, current.start - low), max(0, current.stop - low)
                special.append(values[a:b])
                trusted += [values[:a], values[b:]]
            else:
                trusted.append(values)
            source = self._source_of.get(name)
            if self._before and source is not None and source.values is not whole:
                special.append(source.values[low:high])
        for curve in self.proposed:
            if curve.frames is not None and curve.values is not None:
                within = slice(*np.searchsorted(curve.frames, (low, high)))
                special.append(curve.values[within])
        height = max(1.0, self.view.height())
        bottom = min(0.3, self.intervals.strip_height / height)
        top = min(0.3, self.flags.height / height)
        q = self.quantity
        return value_range(
            trusted, special, bottom, top, least=q.least, least_at=q.least_at, whole=q.whole
        )

    def restyle(self) -> None:
        """Take over the theme's colours."""
        super().restyle()
        look, q = theme.current(), self.quantity
        unit, factor, _ = units.scaled(q.unit)
        self.values.setScale(factor)
        self.name_values(self.title, unit, look.axes.get(q.name, look.muted))
        accent = look.accent
        self.edges.set_color(accent)
        self.band.set_color(theme.faded(accent, 0.22))
        for curve in self._proposals:
            curve.wear(accent, width=2)
        for trace in self._pool:
            trace.style(self._before)
        self.intervals.update()
