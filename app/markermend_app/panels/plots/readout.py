"""What the line above the plots says about a frame."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from markermend.take import Origin, Take
from markermend_app import units
from markermend_app.panels.markers.naming import short_names
from markermend_app.panels.plots.beside import BesideRow
from markermend_app.panels.plots.frame import PlotFrame
from markermend_app.panels.plots.row import PlotRow
from markermend_app.words import tr as _tr

_MOST, _LONG = 3, 24


def read_out(take: Take, shown: Sequence[str], frame: int, row: PlotFrame | None) -> str:
    """Frame, time, and values there.

    Parameters
    ----------
    take : the recording as it stands
    shown : markers, the foremost first
    frame : index, clipped to the take
    row : the one under the mouse, whose values of the first markers are told; else None, for the
        position of the foremost
    """
    frame = max(0, min(frame, take.frames - 1))
    time = f"{frame / take.rate:.3f}"
    where = _tr("Frame {0} · {1} s").format(take.frame_number(frame), time)
    if isinstance(row, BesideRow):
        return f"{where} · {row.read_out(frame)}"
    if isinstance(row, PlotRow):
        short = short_names(shown)
        parts = [f"{_named(short[s])} {_value(take, row, s, frame)}" for s in shown[:_MOST]]
        title = "" if row.column is not None else f"{row.title}: "
        return f"{where} · {title}{' · '.join(parts)}"
    position = take.positions[frame, take.index(shown[0])]
    name = _named(short_names(shown)[shown[0]])
    if np.isnan(position[0]):
        value = _tr("missing")
        return f"{where} · {name} {value}"
    value = ", ".join(units.number(v) for v in position)
    origin = take.origin[frame, take.index(shown[0])]
    return f"{where} · {name} {value} {units.unit()}{_how(origin)}"


def _named(name: str) -> str:
    """A name that leaves room for what is told of it; blanks in it end no name."""
    ends = _LONG // 2
    shown = name if len(name) <= _LONG else f"{name[:ends]}…{name[-ends:]}"
    return shown.replace(" ", "\u00a0")


def _value(take: Take, row: PlotRow, name: str, frame: int) -> str:
    """A marker's value in a row."""
    value = row.value_at(name, frame)
    if value is None:
        return "–"
    if math.isnan(value):
        missing = take.origin[frame, take.index(name)] == Origin.MISSING
        return _tr("missing") if missing else "–"
    unit, factor, more = units.scaled(row.quantity.unit)
    number = f"{value * factor:.{row.quantity.places + more}f} {unit}".rstrip()
    axis = "" if row.column is None else f"{row.title} "
    return f"{axis}{number}{_how(row.origin_at(name, frame))}"


def _how(origin: int) -> str:
    """Say so where a sample was not measured."""
    if origin == Origin.FILLED:
        how = _tr("filled")
    elif origin == Origin.EDITED:
        how = _tr("edited")
    else:
        return ""
    return f" ({how})"
