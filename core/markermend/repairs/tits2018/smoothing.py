"""The authors' filter: sliding median, then sliding mean, that shrink towards holes and ends."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray

WINDOW_S = 0.07


def smooth(signal: FloatArray, window: int) -> FloatArray:
    """Filter columns with a symmetric sliding median and then a mean.

    Near a hole and at the ends the window shrinks so far that it stays symmetric and whole; where
    less than two samples are left on either side, the sample is kept.

    Parameters
    ----------
    signal : (frames, columns); a frame with NaN in any column is a hole
    window : length of the window in frames; made odd

    Returns
    -------
    (frames, columns), NaN in the holes
    """
    if window < 2:
        return signal.copy()
    hole: BoolArray = np.any(np.isnan(signal), axis=1)
    reach = np.minimum(_room(hole), window // 2)
    signal = np.where(hole[:, None], np.nan, signal)
    for average in (_median, _mean):
        signal = _slide(signal, reach, average)
    return signal


def _room(hole: BoolArray) -> IntArray:
    """Frames on either side of each frame until the nearest hole or end."""
    frames = np.arange(len(hole))
    walls = np.concatenate([[-1], np.flatnonzero(hole), [len(hole)]])
    after = np.searchsorted(walls, frames)
    nearest = np.minimum(frames - walls[np.maximum(after - 1, 0)], walls[after] - frames)
    return np.asarray(np.maximum(nearest - 1, 0), dtype=np.int64)


def _median(windows: FloatArray) -> FloatArray:
    """Middle of an odd number of samples, without looking for NaN."""
    middle = windows.shape[-1] // 2
    return np.asarray(np.partition(windows, middle, axis=-1)[..., middle])


def _mean(windows: FloatArray) -> FloatArray:
    return np.asarray(windows.mean(axis=-1))


def _slide(
    signal: FloatArray, reach: IntArray, average: Callable[[FloatArray], FloatArray]
) -> FloatArray:
    """Apply an average over each frame's own reach; frames with a reach under two are kept."""
    result = signal.copy()
    for half in range(2, int(reach.max(initial=0)) + 1):
        centres = np.flatnonzero(reach == half)
        windows = np.lib.stride_tricks.sliding_window_view(signal, 2 * half + 1, axis=0)
        result[centres] = average(windows[centres - half])
    return result
