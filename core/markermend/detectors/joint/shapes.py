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
from numpy.lib.stride_tricks import sliding_window_view

from markermend.arrays import FloatArray, IntArray

ORDER = 5
"""Order of the polynomial that stands for motion within a window."""


@dataclass(frozen=True, eq=False)
class Fit:
    """Least squares of one shape and a polynomial in one window.

    Attributes
    ----------
    basis : (window, terms) orthonormal columns that span what is fitted; the last one is what of
        the shape no polynomial follows
    size_of_last : the shape's size for a last part of 1
    """

    basis: FloatArray
    size_of_last: float

    @property
    def size(self) -> FloatArray:
        """(window,) weights that give the shape's size."""
        return np.asarray(self.basis[:, -1] * self.size_of_last)

    @property
    def error(self) -> float:
        """Standard error of the size for noise of standard deviation 1."""
        return abs(self.size_of_last)


# At 250 Hz a search takes some hundred: blocks of all lengths, and places beside gaps.
@lru_cache(maxsize=4096)
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
    basis, triangle = np.linalg.qr(design)
    return Fit(basis, 1.0 / float(triangle[-1, -1]))


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
    signal : (frames, channels) mm, without NaN; best where a channel lies in one piece
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
    side = LEAST_SIDE if length <= reach else LONG_SIDE
    fits = (start + window <= stop) & (offset >= side)
    fits &= offset + length <= window - side
    size, error, unit = (np.full(len(frame), value) for value in (0.0, np.inf, np.inf))
    if not fits.any():
        return Judged(size, error, unit)
    windows = sliding_window_view(signal, window, axis=0)
    for one in np.flatnonzero(np.bincount(offset[fits])):
        at = np.flatnonzero(fits & (offset == one))
        fit = fit_of(window, int(one), int(one) + length if length else window)
        values = windows[start[at], channel[at]]
        # Far from the origin a difference of large numbers would lose digits.
        values = values - values[:, :1]
        parts = values @ fit.basis
        left = np.einsum("nk,nk->n", values, values) - np.einsum("nk,nk->n", parts, parts)
        free = window - parts.shape[1]
        size[at] = parts[:, -1] * fit.size_of_last
        error[at] = fit.error * np.sqrt(np.maximum(left, 0.0) / free)
        unit[at] = fit.error
    return Judged(size, error, unit)


LEAST_SIDE, LONG_SIDE = 1, 3
"""Frames of the undamaged trajectory needed on each side of a shape: with less, a jump is none. A
block longer than the reach bends with the motion; with fewer beside it nothing tells them apart."""
