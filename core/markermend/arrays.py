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


def median_of_seen(values: FloatArray) -> FloatArray:
    """Median along the first axis of what is not NaN; NaN where there is nothing.

    Several times faster than ``np.nanmedian``, which goes through the columns one by one.

    Parameters
    ----------
    values : (n, ...), n at least 1
    """
    ordered = np.sort(values, axis=0)
    count = len(values) - np.isnan(values).sum(axis=0)
    low, high = np.maximum(count - 1, 0) // 2, np.minimum(count // 2, len(values) - 1)
    middle = [np.take_along_axis(ordered, at[None], axis=0)[0] for at in (low, high)]
    return np.asarray(0.5 * (middle[0] + middle[1]))
