"""Sudden shapes fitted where they stand: a jump, or a block that leaves and comes back.

A short window of a clean trajectory is a polynomial and a little noise. A shape is fitted
together with that polynomial, and its size is judged by what the fit leaves over in the very
same window. So a kick, which no polynomial follows, raises its own threshold, while a jump on a
resting or smoothly moving marker stands out by tens of standard errors, and nothing rings: what
a fit sees ends with its window.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import null_space

from markermend.arrays import FloatArray, IntArray

ORDER = 5
"""Order of the polynomial that stands for motion within a window."""


@dataclass(frozen=True, eq=False)
class Fit:
    """Least squares of one shape and a polynomial in one window.

    Attributes
    ----------
    size : (window,) weights that give the shape's size
    rest : (window, free) orthonormal weights that give what the fit leaves over
    error : standard error of the size for noise of standard deviation 1
    """

    size: FloatArray
    rest: FloatArray
    error: float


@lru_cache(maxsize=512)
def fit_of(window: int, first: int, last: int) -> Fit:
    """Make the fit of a shape that is 1 on ``[first, last)`` of a window and 0 elsewhere.

    Parameters
    ----------
    window : frames; at least 3 more than the polynomial has terms
    first, last : half-open interval; a jump has ``last == window``
    """
    place = (np.arange(window) - (window - 1) / 2) / (window / 2)
    shape = np.zeros(window)
    shape[first:last] = 1.0
    design = np.column_stack([np.vander(place, ORDER + 1), shape])
    size = np.linalg.pinv(design)[-1]
    return Fit(size, null_space(design.T), float(np.linalg.norm(size)))


@dataclass(frozen=True, eq=False)
class Judged:
    """Sizes of one shape at many places.

    Attributes
    ----------
    size : (n,) mm
    error : (n,) standard error from what the fit leaves over, mm per unit of noise included
    unit : (n,) standard error for noise of standard deviation 1
    """

    size: FloatArray
    error: FloatArray
    unit: FloatArray


def judge(
    signal: FloatArray,
    channel: IntArray,
    frame: IntArray,
    length: int,
    reach: int,
    first: IntArray,
    stop: IntArray,
) -> Judged:
    """Fit one shape at many places.

    Parameters
    ----------
    signal : (frames, channels) mm, without NaN
    channel, frame : (n,) where the shape begins
    length : frames of the block; 0 for a jump that does not come back in the window
    reach : frames looked at on either side of the shape
    first, stop : (n,) half-open interval in which the marker is seen without a break. Near its
        ends the window is moved inwards; what does not fit in at all has infinite errors

    Returns
    -------
    Judged, in the order given
    """
    window = 2 * reach + length
    # Not by clip, whose call takes longer than the work.
    start = np.maximum(np.minimum(frame - reach, stop - window), first)
    offset = frame - start
    fits = (start + window <= stop) & (offset >= LEAST_SIDE)
    fits &= (offset + length <= window - LEAST_SIDE) if length else (offset <= window - LEAST_SIDE)
    size, error, unit = (np.full(len(frame), value) for value in (0.0, np.inf, np.inf))
    for one in np.flatnonzero(np.bincount(offset[fits])):
        at = np.flatnonzero(fits & (offset == one))
        fit = fit_of(window, int(one), int(one) + length if length else window)
        values = signal[start[at][:, None] + np.arange(window), channel[at][:, None]]
        # Far from the origin a difference of large numbers would lose digits.
        values = values - values[:, :1]
        rest = values @ fit.rest
        size[at] = values @ fit.size
        error[at] = fit.error * np.sqrt(np.einsum("nk,nk->n", rest, rest) / rest.shape[1])
        unit[at] = fit.error
    return Judged(size, error, unit)


LEAST_SIDE = 1
"""Frames of the undamaged trajectory needed on each side of a shape: with less, a jump is none."""
