"""Takes with other labels, frames or points than the one they come from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from numbers import Integral

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import DataError
from markermend.take import Origin, Points, Take


def relabel(take: Take, names: Mapping[str, str]) -> Take:
    """Give markers other names.

    Parameters
    ----------
    take : the recording
    names : new name for each old one; two may change places

    Raises
    ------
    DataError
        when a marker does not exist, or two would have the same name
    """
    for label in names:
        take.index(label)
    return replace(take, labels=tuple(names.get(label, label) for label in take.labels))


def crop(take: Take, start: int, stop: int) -> Take:
    """Keep the frames of an interval.

    Parameters
    ----------
    take : the recording
    start, stop : half-open interval of 0-based frame indices

    Returns
    -------
    Take
        frames keep their numbers, and events their times, those outside the interval too

    Raises
    ------
    DataError
        when the interval is empty or reaches beyond the take
    """
    whole = isinstance(start, Integral) and isinstance(stop, Integral)
    if not (whole and 0 <= start < stop <= take.frames):
        raise DataError(f"Frames {start} to {stop} are not a part of the take's {take.frames}.")
    rows = slice(start, stop)
    analog, points, source = take.analog, take.points, take.source
    if source is not None and take.skeleton:
        # Slow to load, and needed for nothing else.
        from markermend.files.pose import crop_pose
        from markermend.poses.take import pose_of

        source = replace(source, layout=crop_pose(pose_of(take), start, stop))
    if analog is not None:
        each = len(analog.values) // take.frames
        analog = replace(analog, values=analog.values[start * each : stop * each])
    if points is not None:
        points = replace(points, values=points.values[rows])
    return replace(
        take,
        positions=take.positions[rows],
        origin=take.origin[rows],
        residuals=None if take.residuals is None else take.residuals[rows],
        cameras=None if take.cameras is None else take.cameras[rows],
        analog=analog,
        points=points,
        first_frame=take.first_frame + start,
        source=source,
    )


def drop(take: Take, labels: Sequence[str]) -> Take:
    """Leave out markers or other points.

    Parameters
    ----------
    take : the recording
    labels : markers, or labels of points that are not markers

    Raises
    ------
    DataError
        when there is none of that name
    """
    gone = set(labels)
    points = take.points
    others = points.labels if points is not None else ()
    unknown = gone - set(take.labels) - set(others)
    if unknown:
        raise DataError(f"The take has no point called “{sorted(unknown)[0]}”.")
    if points is not None and gone & set(others):
        stay = [i for i, label in enumerate(others) if label not in gone]
        points = (
            Points(
                values=points.values[:, stay],
                labels=tuple(others[i] for i in stay),
                kinds=tuple(points.kinds[i] for i in stay),
                columns=tuple(points.columns[i] for i in stay),
                units=points.units,
            )
            if stay
            else None
        )
    keep = [i for i, label in enumerate(take.labels) if label not in gone]
    return replace(_columns_taken(take, keep), points=points)


def add(take: Take, label: str, positions: FloatArray) -> Take:
    """Add a marker at the end.

    Parameters
    ----------
    take : the recording
    label : a name that is free
    positions : (frames, 3) float64, mm; NaN where missing

    Raises
    ------
    DataError
        when the name is taken, or the frames are not the take's
    """
    if positions.shape != (take.frames, 3):
        raise DataError(f"A marker of this take has {(take.frames, 3)}, not {positions.shape}.")
    missing = np.isnan(positions[:, :1])
    origin = np.where(missing, Origin.MISSING, Origin.FILLED).astype(np.uint8)
    residuals, cameras = take.residuals, take.cameras
    if residuals is not None:
        column = np.where(missing, np.nan, 0.0).astype(np.float32)
        residuals = np.concatenate([residuals, column], axis=1)
    if cameras is not None:
        cameras = np.concatenate([cameras, np.zeros((take.frames, 1), np.uint8)], axis=1)
    source = take.source
    if source is not None and source.format == "c3d":
        source = replace(source, columns=(*source.columns, -1))
    return replace(
        take,
        positions=np.concatenate([take.positions, positions[:, None]], axis=1),
        labels=(*take.labels, label),
        origin=np.concatenate([take.origin, origin], axis=1),
        residuals=residuals,
        cameras=cameras,
        source=source,
    )


def _columns_taken(take: Take, keep: list[int]) -> Take:
    """Return the take with some of its markers."""
    source = take.source
    if source is not None and source.format == "c3d":
        source = replace(source, columns=tuple(source.columns[i] for i in keep))
    return replace(
        take,
        positions=take.positions[:, keep],
        labels=tuple(take.labels[i] for i in keep),
        origin=take.origin[:, keep],
        residuals=None if take.residuals is None else take.residuals[:, keep],
        cameras=None if take.cameras is None else take.cameras[:, keep],
        source=source,
    )
