"""What of a take stands still in the 3D view: which way is up, floor, and a view of it all."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.files.axes import vertical_of
from markermend.take import AXES, Take
from markermend.vertical import vertical_axis
from markermend_app.panels.scene.camera import FOV, Camera

_SAMPLED = 200
# Frames on either side that say where a body is.
_AROUND, _AWAY = 5, 2000
LEAST_RADIUS_MM, LONE_RADIUS_MM = 10.0, 300.0


@dataclass(frozen=True, eq=False)
class Stage:
    """The room a take was recorded in.

    Attributes
    ----------
    up : axis that points up
    floor : mm along it where the floor is drawn
    middle : (3,) mm, what the camera looks at first
    radius : mm around it that hold the take
    size : mm, extent of the body in a frame
    unit : mm, side of a square of the floor
    low, high : (3,) mm, extent of the floor, whole units
    """

    up: int
    floor: float
    middle: FloatArray
    radius: float
    size: float
    unit: float
    low: FloatArray
    high: FloatArray

    def camera(self, last: Camera | None = None) -> Camera:
        """A camera that has the body in view, turned as the last one."""
        x, y, z = self.middle.tolist()
        distance = 1.25 * self.radius / math.tan(FOV / 2)
        base = last if last is not None else Camera()
        return replace(base, target=(x, y, z), distance=distance, up=self.up)


def set_stage(take: Take, up: int | None = None) -> Stage:
    """Work out the room of a take.

    Parameters
    ----------
    take : its samples as opened
    up : axis that points up; None takes what the file says, and guesses when it says nothing
    """
    points = _sample(take.positions)
    points = points[:, take.named] if take.named else points
    if not points.size:
        points = np.full((1, 1, 3), np.nan)
    if up is None:
        told = vertical_of(take)
        up = AXES.index(told) if told else vertical_axis(points)
    flat = points.reshape(-1, 3)
    flat = flat[~np.isnan(flat[:, 0])]
    if not len(flat):
        flat = np.array([[-1000.0] * 3, [1000.0] * 3])
    low, high = np.percentile(flat, 0.5, axis=0), np.percentile(flat, 99.5, axis=0)
    middle = (low + high) / 2
    size = _extent(points)
    # One marker that stands still has no extent, but is to be seen from somewhere.
    radius = max(min(float(np.linalg.norm(high - low)) / 2, 2.2 * size), LEAST_RADIUS_MM)
    # A floor at zero is where systems put it, if the body stands near it.
    floor = 0.0 if abs(low[up]) < 0.2 * size else float(low[up])
    reach = np.maximum(high - low, size)
    reach[up] = 0.0
    unit = _round_unit(float(reach.max()) / 12)
    edge = 0.15 * size
    return Stage(
        up,
        floor,
        middle,
        radius,
        size,
        unit,
        np.floor((middle - reach / 2 - edge) / unit) * unit,
        np.ceil((middle + reach / 2 + edge) / unit) * unit,
    )


@lru_cache(maxsize=4)
def floor_lines(stage: Stage) -> tuple[FloatArray, FloatArray]:
    """Starts and ends, (n, 3) each, of the lines of the floor."""
    a, b = (stage.up + 1) % 3, (stage.up + 2) % 3
    starts: list[FloatArray] = []
    stops: list[FloatArray] = []
    for along, across in ((a, b), (b, a)):
        n = round((stage.high[across] - stage.low[across]) / stage.unit)
        for at in stage.low[across] + stage.unit * np.arange(n + 1):
            for side, where in ((starts, stage.low[along]), (stops, stage.high[along])):
                point = np.zeros(3)
                point[stage.up], point[across], point[along] = stage.floor, at, where
                side.append(point)
    return np.array(starts), np.array(stops)


def reach_of(take: Take, body: Sequence[int]) -> float:
    """How far some markers are from their :func:`centre_at`, mm; at least what is to be seen.

    One marker by itself, or one of which alone anything is seen, has no extent, but goes somewhere.
    """
    points = _sample(take.positions)[:, body]
    seen = ~np.isnan(points[..., 0])
    if seen.sum(axis=1).max(initial=0) == 1:
        way = _extent(points[seen][None])
        return min(max(way / 2, LEAST_RADIUS_MM), LONE_RADIUS_MM)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        centres = np.nanmedian(points, axis=1, keepdims=True)
        away = np.nanmax(np.linalg.norm(points - centres, axis=2), axis=1, initial=-np.inf)
    away = away[np.isfinite(away)]
    return max(float(np.percentile(away, 90)), LEAST_RADIUS_MM) if len(away) else 1000.0


def centre_at(
    positions: FloatArray, frame: int, body: Sequence[int], lost: BoolArray
) -> FloatArray:
    """Middle of what is seen of some markers around a frame.

    Amid frames without any it goes evenly from where they are seen last to where they are next.

    Parameters
    ----------
    positions : (frames, markers, 3) mm
    frame : the one that is looked at
    body : columns of the markers
    lost : (frames,) bool, frames that count as if none of them was seen

    Returns
    -------
    (3,) mm, NaN when they are seen long before or after only
    """
    reach = _AROUND
    while True:
        start, seen = _seen(positions, frame, body, lost, reach)
        found = start + np.flatnonzero(seen.any(axis=1))
        last, following = found[found <= frame][-1:], found[found >= frame][:1]
        if (last.size and following.size) or len(seen) == len(positions) or 4 * reach > _AWAY:
            break
        reach *= 4
    if not found.size:
        return np.full(3, np.nan)
    ends = np.array([*last, *following])
    places = np.array([_middle(positions, int(end), body, lost) for end in ends])
    return np.array([np.interp(frame, ends, places[:, axis]) for axis in range(3)])


def _middle(positions: FloatArray, frame: int, body: Sequence[int], lost: BoolArray) -> FloatArray:
    """(3,) mm, middle of some markers that are seen in a frame and in those around it."""
    start, seen = _seen(positions, frame, body, lost, _AROUND)
    return np.asarray(np.median(positions[start : start + len(seen), body][seen], axis=0))


def _seen(
    positions: FloatArray, frame: int, body: Sequence[int], lost: BoolArray, reach: int
) -> tuple[int, BoolArray]:
    """First of the frames as near as that, and (n, markers) bool which are seen in these."""
    start = max(0, frame - reach)
    near = slice(start, frame + reach + 1)
    return start, ~np.isnan(positions[near, body, 0]) & ~lost[near, None]


def _extent(points: FloatArray) -> float:
    """Extent of (frames, n, 3) points in a frame, mm; a metre where it cannot be told."""
    if not points.size:
        return 1000.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        spans = np.nanmax(points, axis=1) - np.nanmin(points, axis=1)
        size = float(np.nanpercentile(spans.max(axis=1), 50))
    return size if math.isfinite(size) and size > 0 else 1000.0


def _sample(positions: FloatArray) -> FloatArray:
    """Frames evenly from the whole take."""
    step = max(1, len(positions) // _SAMPLED)
    return positions[::step]


def _round_unit(mm: float) -> float:
    """The nearest of 1, 2, 5 times a power of ten, from above."""
    power = 10.0 ** math.floor(math.log10(max(mm, 1.0)))
    return next(f * power for f in (1, 2, 5, 10) if f * power >= mm)
