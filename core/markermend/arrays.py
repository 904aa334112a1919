"""Array types used in signatures, and the few operations on boolean runs everyone needs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]
ByteArray = NDArray[np.uint8]


def runs(mask: NDArray[Any]) -> IntArray:
    """Half-open intervals where a one-dimensional mask is true.

    Parameters
    ----------
    mask : (n,) bool

    Returns
    -------
    (k, 2) int64: ``[start, stop)`` of each run, in order.
    """
    padded = np.zeros(len(mask) + 2, dtype=np.int8)
    padded[1:-1] = mask
    edges = np.flatnonzero(np.diff(padded))
    return edges.reshape(-1, 2).astype(np.int64)


def samples_of(positions: FloatArray, frames: IntArray, columns: IntArray) -> FloatArray:
    """(frames, columns, 3) samples of some markers in some frames.

    Several times as fast as indexing by frames and columns at once.

    Parameters
    ----------
    positions : (frames, markers, 3), in C order as a take's are
    frames, columns : which, (n,) and (k,)
    """
    markers = positions.shape[1]
    return np.asarray(positions.reshape(-1, 3).take(frames[:, None] * markers + columns, axis=0))


def median_of_seen(values: FloatArray) -> FloatArray:
    """Median along the first axis of what is not NaN; NaN where there is nothing.

    Several times faster than ``np.nanmedian``, which goes through the columns one by one.

    Parameters
    ----------
    values : (n, ...), n at least 1
    """
    return _middle(np.sort(values, axis=0), 0)


def quantile_of_seen(values: FloatArray, share: float) -> FloatArray:
    """Quantile along the first axis of what is not NaN; NaN where there is nothing.

    As ``np.nanquantile``, which takes twenty times as long.

    Parameters
    ----------
    values : (n, ...), n at least 1
    share : 0 to 1
    """
    ordered = np.sort(values, axis=0)
    last = np.maximum(len(values) - 1 - np.isnan(ordered).sum(axis=0, keepdims=True), 0)
    place = share * last
    low = place.astype(np.int64)
    below = np.take_along_axis(ordered, low, 0)
    above = np.take_along_axis(ordered, np.minimum(low + 1, last), 0)
    return np.asarray((below + (above - below) * (place - low))[0])


def deviation_of_seen(values: FloatArray) -> FloatArray:
    """Median absolute deviation along the last axis of what is not NaN; NaN where there is nothing.

    Parameters
    ----------
    values : (..., n), n at least 1
    """
    ordered = np.sort(values, axis=-1)
    ordered -= _middle(ordered, -1)[..., None]
    np.abs(ordered, out=ordered)
    # Falling and then rising, they need only be merged, which takes a tenth of the time.
    ordered.sort(axis=-1, kind="stable")
    return _middle(ordered, -1)


def _middle(ordered: FloatArray, axis: int) -> FloatArray:
    """Median along an axis of what is in order, with NaN last."""
    size = ordered.shape[axis]
    if not np.isnan(ordered.take(-1, axis)).any():
        return np.asarray(
            0.5 * (ordered.take((size - 1) // 2, axis) + ordered.take(size // 2, axis))
        )
    count = size - np.isnan(ordered).sum(axis=axis, keepdims=True)
    low, high = np.maximum(count - 1, 0) // 2, np.minimum(count // 2, size - 1)
    middle = (np.take_along_axis(ordered, at, axis) for at in (low, high))
    return np.asarray(0.5 * np.squeeze(sum(middle), axis))


def free_starts(free: BoolArray, length: int, beside: int) -> IntArray:
    """Starts of all stretches of a length that are free.

    Parameters
    ----------
    free : (frames,) bool
    length : frames
    beside : frames on either side that are to be free, too

    Returns
    -------
    (n,) int64, rising; none where there is no room
    """
    taken = np.concatenate([[0], np.cumsum(~free)])
    starts = np.arange(beside, len(free) - length - beside + 1)
    return np.asarray(starts[taken[starts + length + beside] == taken[starts - beside]])
