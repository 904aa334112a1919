"""Which axis of a take points up."""

from __future__ import annotations

import warnings
from weakref import WeakKeyDictionary

import numpy as np

from markermend.arrays import FloatArray
from markermend.files.axes import vertical_of
from markermend.take import AXES, Take

SAMPLED = 200
# A guess takes milliseconds, and every repair of a take asks for it.
_guessed: WeakKeyDictionary[Take, int] = WeakKeyDictionary()


def up_axis(take: Take) -> int:
    """The axis that points up, as the file tells it, or guessed from the body where it does not."""
    told = vertical_of(take)
    if told:
        return AXES.index(told)
    if take not in _guessed:
        _guessed[take] = vertical_axis(take.positions)
    return _guessed[take]


def vertical_axis(positions: FloatArray) -> int:
    """Guess which axis points up.

    A standing body is longest along it, moves about least along it, and rarely gets below zero.
    X is hardly ever vertical in practice, so it must win clearly.

    Parameters
    ----------
    positions : (frames, markers, 3) mm, NaN = missing
    """
    points = positions[:: max(1, len(positions) // SAMPLED)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        extent = np.nanpercentile(np.nanmax(points, axis=1) - np.nanmin(points, axis=1), 50, axis=0)
        # Many times faster than a percentile, which goes through the frames one by one.
        centre = np.nanmedian(points, axis=1)
        travel = np.nanpercentile(centre, 95, axis=0) - np.nanpercentile(centre, 5, axis=0)
        lowest = np.nanpercentile(points.reshape(-1, 3), 1, axis=0)
    if not np.isfinite(extent).all():
        return 2
    score = extent - 0.5 * travel + np.where(lowest > -0.1 * extent, 0.3 * extent, 0.0)
    score[0] -= 0.3 * abs(score[0])
    # Ties go to Z, the axis most systems use.
    return int(2 - np.argmax(score[::-1]))
