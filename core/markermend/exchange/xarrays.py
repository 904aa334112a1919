"""Takes as labelled arrays, laid out as ``movement`` or as ``pyomeca`` does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from markermend.arrays import ByteArray, FloatArray
from markermend.errors import DataError, MethodError
from markermend.exchange.need import need
from markermend.files.units import unit_mm
from markermend.take import AXES, Take

if TYPE_CHECKING:
    import xarray

Layout = Literal["movement", "pyomeca"]
NOBODY = "individual_0"
"""What ``movement`` calls the individual of a recording that names none."""
_MOVEMENT = ("time", "space", "keypoints", "individuals")
_PYOMECA = ("axis", "channel", "time")


def to_xarray(take: Take, layout: Layout = "movement") -> xarray.Dataset | xarray.DataArray:
    """Lay a take out as a labelled array.

    Parameters
    ----------
    take : the recording
    layout : ``"movement"``: a Dataset with ``position`` (time, space, keypoints, individuals),
        ``confidence`` (all NaN: cameras state none) and ``origin`` (see
        :class:`markermend.take.Origin`). Subjects are the individuals; keypoints that an individual
        has not are NaN. ``"pyomeca"``: a DataArray (axis, channel, time) whose axis is x, y, z and
        ones

    Returns
    -------
    positions in mm, NaN where missing; time in seconds from the first frame; ``units``, ``rate``
    or ``fps``, and ``first_frame`` among the attributes

    Raises
    ------
    MethodError
        when xarray is not installed, or there is no such layout
    """
    need("xarray")
    match layout:
        case "movement":
            return _to_movement(take)
        case "pyomeca":
            return _to_pyomeca(take)
    raise MethodError(f"There is no layout “{layout}”; choose one of movement, pyomeca.")


def _to_movement(take: Take) -> xarray.Dataset:
    """Lay out as ``movement`` does."""
    import xarray as xr

    people = [take.subject(s) or NOBODY for s in take.labels]
    names = [s.rpartition(":")[2] for s in take.labels]
    individuals, keypoints = list(dict.fromkeys(people)), list(dict.fromkeys(names))
    position = np.full((take.frames, 3, len(keypoints), len(individuals)), np.nan)
    origin = np.zeros((take.frames, len(keypoints), len(individuals)), dtype=np.uint8)
    for marker, (person, name) in enumerate(zip(people, names, strict=True)):
        at = keypoints.index(name), individuals.index(person)
        position[:, :, *at] = take.positions[:, marker]
        origin[:, *at] = take.origin[:, marker]
    seen = ("time", "keypoints", "individuals")
    return xr.Dataset(
        {
            "position": (_MOVEMENT, position),
            "confidence": (seen, np.full(origin.shape, np.nan)),
            "origin": (seen, origin),
        },
        coords={
            "time": _seconds(take),
            "space": list(AXES),
            "keypoints": keypoints,
            "individuals": individuals,
        },
        attrs={
            "source_software": "Markermend",
            "ds_type": "poses",
            "fps": take.rate,
            "time_unit": "seconds",
            "units": "mm",
            "first_frame": take.first_frame,
        },
    )


def _to_pyomeca(take: Take) -> xarray.DataArray:
    """Lay out as ``pyomeca`` does."""
    import xarray as xr

    ones = np.ones((1, take.markers, take.frames))
    return xr.DataArray(
        np.concatenate([take.positions.transpose(2, 1, 0), ones]),
        dims=_PYOMECA,
        coords={"axis": [*AXES, "ones"], "channel": list(take.labels), "time": _seconds(take)},
        name="markers",
        attrs={"rate": take.rate, "units": "mm", "first_frame": take.first_frame},
    )


def _seconds(take: Take) -> FloatArray:
    """(frames,) seconds from the first frame."""
    return np.asarray(np.arange(take.frames) / take.rate)


def from_xarray(data: xarray.Dataset | xarray.DataArray) -> Take:
    """Make a take of a labelled array in one of the layouts of :func:`to_xarray`.

    Parameters
    ----------
    data : a ``movement`` Dataset of poses in three dimensions, or a ``pyomeca`` DataArray of
        markers; lengths in the unit that the attribute ``units`` names, mm without one

    Returns
    -------
    Take. A sample with a NaN coordinate is missing. Where there are several individuals, keypoints
    that one of them never has are left out of its markers.

    Raises
    ------
    DataError
        when dimensions are missing, the space is not x, y, z, the time is not evenly spaced or the
        unit is unknown
    """
    dims = {str(d) for d in data.dims}
    if dims >= set(_MOVEMENT):
        return _from_movement(data)
    if dims == set(_PYOMECA):
        return _from_pyomeca(data)
    raise DataError(
        f"An array with the dimensions {', '.join(sorted(dims))} is not known; give one with "
        f"{', '.join(_MOVEMENT)} (movement) or {', '.join(_PYOMECA)} (pyomeca)."
    )


def _from_movement(data: Any) -> Take:
    """Read the layout of ``movement``."""
    array = data.get("position")
    if array is None:
        raise DataError(
            "This dataset has no “position”; give one of poses as movement lays it out."
        )
    values = array.transpose("time", "individuals", "keypoints", "space").values
    if values.shape[3] != len(AXES):
        raise DataError("A take needs positions in three dimensions; this array has other ones.")
    frames = len(values)
    # Not -1, which numpy cannot work out where there is no frame.
    markers = values.shape[1] * values.shape[2]
    flat = values.reshape(frames, markers, len(AXES)).astype(np.float64)
    people = [str(v) for v in data["individuals"].values]
    alone = people == [NOBODY] or people == ["id_0"]
    labels = [
        str(k) if alone or person in (NOBODY, "id_0") else f"{person}:{k}"
        for person in people
        for k in data["keypoints"].values
    ]
    origin = None
    if "origin" in data:
        origins = data["origin"].transpose("time", "individuals", "keypoints").values
        origin = origins.reshape(frames, markers)
    if len(people) > 1 and frames:
        seen = ~np.isnan(flat).all(axis=(0, 2))
        flat, labels = flat[:, seen], [s for s, ok in zip(labels, seen, strict=True) if ok]
        origin = None if origin is None else origin[:, seen]
    rate = data.attrs.get("fps") or rate_of(data["time"].values)
    return _take(flat, labels, float(rate), data.attrs | array.attrs, origin)


def _from_pyomeca(data: Any) -> Take:
    """Read the layout of ``pyomeca``."""
    values = data.transpose("time", "channel", "axis").sel(axis=list(AXES)).values
    labels = [str(v) for v in data["channel"].values]
    rate = data.attrs.get("rate") or rate_of(data["time"].values)
    return _take(values.astype(np.float64), labels, float(rate), data.attrs, None)


def _take(
    positions: FloatArray,
    labels: Sequence[str],
    rate: float,
    attributes: dict[str, Any],
    origin: ByteArray | None,
) -> Take:
    """Make a take, lengths in mm and missing samples missing on every axis."""
    positions = positions * scale_of(str(attributes.get("units", "mm")))
    missing = np.isnan(positions).any(axis=2)
    positions[missing] = np.nan
    known = np.asarray(~missing if origin is None else origin, dtype=np.uint8)
    first = int(attributes.get("first_frame", 1))
    return Take(positions, tuple(labels), rate, first, origin=known)


def scale_of(unit: str) -> float:
    """Millimetres of a unit by its name.

    Raises
    ------
    DataError
        when the unit is unknown
    """
    scale = unit_mm(unit)
    if scale is None:
        raise DataError(f"“{unit}” is no unit of length that is known; use mm, cm or m.")
    return scale


def rate_of(time: FloatArray) -> float:
    """Frames per second of evenly spaced times in seconds.

    Raises
    ------
    DataError
        when there are fewer than two, or they are not evenly spaced
    """
    steps = np.diff(np.asarray(time, dtype=np.float64))
    if not len(steps) or not steps.min() > 0 or np.ptp(steps) > 0.01 * steps.mean():
        raise DataError("The rate cannot be told, since the times are not evenly spaced.")
    # Rounded, since times in floats give 119.99999999 for 120.
    return round(float(1 / steps.mean()), 6)
