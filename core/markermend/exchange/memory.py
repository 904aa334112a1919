"""Takes out of what other libraries hold in memory."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from markermend.errors import DataError
from markermend.exchange.xarrays import rate_of, scale_of
from markermend.files.c3d_points import kinds_of, units_of
from markermend.files.labels import unique_labels
from markermend.take import Event, Points, Take


def from_ezc3d(c3d: Mapping[str, Any]) -> Take:
    """Make a take of what ``ezc3d.c3d(path)`` returns.

    Parameters
    ----------
    c3d : ezc3d's mapping with ``header``, ``parameters`` and ``data``

    Returns
    -------
    Take without a source: written out it becomes a new file. To keep a file's own bytes, use
    :func:`markermend.read`. Missing are samples that are NaN, or zero on all three axes. Angles,
    forces and other outputs are kept apart, as in files.

    Raises
    ------
    DataError
        when the mapping is not ezc3d's, or its unit of length is unknown
    """
    try:
        point, header = c3d["parameters"]["POINT"], c3d["header"]["points"]
        stored = np.asarray(c3d["data"]["points"], dtype=np.float64)[:3].transpose(2, 1, 0)
        rate = float(point["RATE"]["value"][0])
    except (KeyError, IndexError, TypeError) as error:
        raise DataError(f"This is not what ezc3d.c3d(path) returns: {error} is missing.") from error

    def texts(name: str) -> list[str]:
        return [str(v) for v in point[name]["value"]] if name in point else []

    stated = [s for key in _numbered(point, "LABELS") for s in texts(key)]
    labels, _ = unique_labels(stated, stored.shape[1])
    kinds = kinds_of(texts, labels)
    mine = [i for i, kind in enumerate(kinds) if not kind]
    others = [i for i, kind in enumerate(kinds) if kind]
    positions = np.ascontiguousarray(stored[:, mine])
    positions[np.isnan(positions).any(axis=2) | (positions == 0).all(axis=2)] = np.nan
    unit = next(iter(texts("UNITS")), "") or "mm"
    return Take(
        positions * scale_of(unit),
        tuple(labels[i] for i in mine),
        rate,
        # ezc3d counts from zero what the file counts from one.
        int(header["first_frame"]) + 1,
        points=Points(
            np.ascontiguousarray(stored[:, others]),
            tuple(labels[i] for i in others),
            tuple(kinds[i] for i in others),
            tuple(others),
            units_of(texts, kinds),
        )
        if others
        else None,
    )


def from_kineticstoolkit(series: Any) -> Take:
    """Make a take of a Kinetics Toolkit ``TimeSeries`` of points.

    Parameters
    ----------
    series : each key of its ``data`` that holds (n, 4) or (n, 3) values is a marker; the length is
        in the unit its ``info`` states, metres without one

    Returns
    -------
    Take without a source; its events keep their names, and a sample with a NaN is missing

    Raises
    ------
    DataError
        when no key holds points, or the times are not evenly spaced
    """
    info = getattr(series, "info", None) or getattr(series, "data_info", {})
    columns, labels = [], []
    for label, values in series.data.items():
        array = np.asarray(values, dtype=np.float64)
        if array.ndim == 2 and array.shape[1] in (3, 4):
            unit = str(info.get(label, {}).get("Unit", "m"))
            columns.append(array[:, :3] * scale_of(unit))
            labels.append(str(label))
    if not columns:
        raise DataError("This TimeSeries holds no points; give that called “Points”.")
    positions = np.stack(columns, axis=1)
    positions[np.isnan(positions).any(axis=2)] = np.nan
    time = np.asarray(series.time, dtype=np.float64)
    rate = rate_of(time)
    first = 1 + round(float(time[0]) * rate)
    events = tuple(Event(str(e.name), float(e.time)) for e in getattr(series, "events", ()))
    return Take(positions, tuple(labels), rate, first, events=events)


def _numbered(group: Mapping[str, Any], name: str) -> list[str]:
    """``LABELS``, ``LABELS2``… as far as there are any."""
    found = [name] if name in group else []
    while (following := f"{name}{len(found) + 1}") in group:
        found.append(following)
    return found
