"""Rows below the markers' plots: force, analog channels and model outputs, for context only.

They are read from the file, never detected on and never changed, and no marker is drawn in them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor

from markermend.arrays import FloatArray
from markermend.take import Take
from markermend_app.items.curve import Curve
from markermend_app.panels.plots.frame import PlotFrame
from markermend_app.panels.plots.range import value_range
from markermend_app.style import theme
from markermend_app.words import tr

_STYLES = (Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine, Qt.PenStyle.DotLine)
_LEAST_SHARE = 0.02


@dataclass(frozen=True, eq=False)
class Channel:
    """Something recorded beside the markers.

    Attributes
    ----------
    name, unit : for people
    kind : ``"analog"``, or of a point that is no marker its kind
    step : frames from one sample to the next
    values : (samples,) or (frames, 3) in the file's own units
    """

    name: str
    unit: str
    kind: str
    step: float
    values: FloatArray

    @property
    def group(self) -> tuple[str, str]:
        """Channels that share it share a row."""
        return self.kind, self.unit


def kind_name(kind: str) -> str:
    """What channels of a kind are called."""
    names = {
        "analog": tr("Analog"),
        "angle": tr("Angle"),
        "force": tr("Force"),
        "moment": tr("Moment"),
        "power": tr("Power"),
        "scalar": tr("Scalar"),
        "reaction": tr("Reaction"),
        "modelled": tr("Point of the model"),
    }
    return names.get(kind, kind.capitalize())


def analog_key(column: int) -> str:
    """How the document names an analog channel: labels may come twice."""
    return f"analog {column}"


def point_key(column: int) -> str:
    """How the document names a point that is no marker."""
    return f"point {column}"


def channel(take: Take, key: str) -> Channel | None:
    """Look a channel up; None when the take has none of that key."""
    what, _, number = key.partition(" ")
    column = int(number)
    if what == "analog" and take.analog is not None and column < len(take.analog.labels):
        analog = take.analog
        values = analog.values[:, column].astype(np.float64)
        unit = analog.units[column]
        return Channel(analog.labels[column], unit, what, take.rate / analog.rate, values)
    if what == "point" and take.points is not None and column < len(take.points.labels):
        points, kind = take.points, take.points.kinds[column]
        unit = points.units.get(kind, "")
        return Channel(points.labels[column], unit, kind, 1.0, points.values[:, column])
    return None


def grouped(channels: Iterable[Channel]) -> tuple[tuple[Channel, ...], ...]:
    """Channels that may share an axis, in the order first met."""
    groups: dict[tuple[str, str], list[Channel]] = {}
    for found in channels:
        groups.setdefault(found.group, []).append(found)
    return tuple(tuple(group) for group in groups.values())


class BesideRow(PlotFrame):
    """A row of channels of one unit."""

    def __init__(self, channels: Sequence[Channel]) -> None:
        super().__init__()
        self.channels = tuple(channels)
        self._curves: list[tuple[Curve, int, Qt.PenStyle]] = []
        self._lines: list[tuple[FloatArray, FloatArray]] = []
        for place, found in enumerate(self.channels):
            columns = found.values.reshape(len(found.values), -1).T
            for column, style in zip(columns, _STYLES, strict=False):
                x = np.arange(len(column), dtype=np.float64) * found.step
                curve = Curve(theme.marker_color(place), style=style)
                self.view.add_curve(curve)
                if np.isfinite(column).any():
                    curve.set_values(column, found.step)
                self._curves.append((curve, place, style))
                self._lines.append((x, column))
        self.restyle()

    def read_out(self, frame: int) -> str:
        """Every channel's value in a frame."""
        parts = []
        for found in self.channels[:4]:
            at = min(round(frame / found.step), len(found.values) - 1)
            values = np.atleast_1d(found.values[at])
            if np.isnan(values).all():
                parts.append(f"{found.name} {tr('missing')}")
                continue
            text = ", ".join("–" if np.isnan(v) else f"{v:.4g}" for v in values)
            parts.append(f"{found.name} {text} {found.unit}".rstrip())
        return " · ".join(parts)

    def set_view(self, start: float, stop: float) -> None:
        """Show these frames and, unless a hand moved them, the values that are there."""
        self.view.setRange(xRange=(start, stop), yRange=self._values(start, stop), padding=0)

    def _values(self, start: float, stop: float) -> tuple[float, float] | None:
        """Range of the values within these frames."""
        if not self.follows:
            return None
        seen = [y[slice(*np.searchsorted(x, (start, stop)))] for x, y in self._lines]
        whole = value_range([y for _, y in self._lines], least=1e-6)
        least = 1e-6 if whole is None else _LEAST_SHARE * (whole[1] - whole[0])
        return value_range(seen, least=least)

    def restyle(self) -> None:
        """Take over the theme's colours."""
        super().restyle()
        kind = kind_name(self.channels[0].kind) if self.channels else ""
        unit = self.channels[0].unit if self.channels else ""
        self.name_values(kind, unit, theme.current().muted)
        for curve, place, line in self._curves:
            curve.wear(theme.marker_color(place), style=line)

    def words(self) -> list[tuple[str, QColor]]:
        """Name the channels."""
        words = [(c.name, theme.marker_color(i)) for i, c in enumerate(self.channels)]
        if any(c.values.ndim == 2 for c in self.channels):
            words.append(("X —  Y – –  Z ···", theme.current().muted))
        return words
