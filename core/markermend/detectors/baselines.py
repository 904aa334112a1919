"""Generic outlier detectors, each coordinate by itself: companions to measure others against.

Both flag samples without naming a class. skurowski2022, section 4.1, compares with them.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import median_filter, uniform_filter1d

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import MethodError
from markermend.predictors.bridging import bridge

# Median absolute deviation of a normal distribution over its standard deviation.
MAD_OF_NORMAL = 0.6745
SIGMAS = 3.0


def moving_three_sigma(positions: FloatArray, window: int) -> BoolArray:
    """Flag samples more than three moving standard deviations from the moving mean.

    Parameters
    ----------
    positions : (frames, markers, 3) float64, mm; NaN = missing
    window : odd number of frames

    Returns
    -------
    (frames, markers, 3) bool; false where missing

    Raises
    ------
    MethodError
        when the window is even or shorter than 3
    """
    signal, seen = _prepared(positions, window)
    # The mean is taken out first: far from the origin the difference of squares loses digits.
    signal = signal - signal.mean(axis=0)
    mean = uniform_filter1d(signal, window, axis=0)
    variance = uniform_filter1d(signal**2, window, axis=0) - mean**2
    flags = np.abs(signal - mean) > SIGMAS * np.sqrt(np.maximum(variance, 0.0))
    return np.asarray((flags & seen).reshape(positions.shape))


def hampel(positions: FloatArray, window: int) -> BoolArray:
    """Flag samples more than three scaled median absolute deviations from the moving median.

    Parameters
    ----------
    positions : (frames, markers, 3) float64, mm; NaN = missing
    window : odd number of frames

    Returns
    -------
    (frames, markers, 3) bool; false where missing. The deviations' median is taken over their
    distances to each sample's own moving median, the usual fast form of the filter.

    Raises
    ------
    MethodError
        when the window is even or shorter than 3
    """
    signal, seen = _prepared(positions, window)
    away = np.abs(signal - _moving_median(signal, window))
    spread = _moving_median(away, window) / MAD_OF_NORMAL
    # A marker at rest has no spread; the least bit of rounding would be an outlier.
    flags = away > SIGMAS * np.maximum(spread, 1e-6)
    return np.asarray((flags & seen).reshape(positions.shape))


def _prepared(positions: FloatArray, window: int) -> tuple[FloatArray, BoolArray]:
    """Coordinates side by side, bridged, and where they are seen."""
    if window < 3 or window % 2 == 0:
        raise MethodError(f"The window must be an odd number of at least 3 frames, not {window}.")
    signal = positions.reshape(len(positions), -1)
    seen = ~np.isnan(signal)
    return bridge(signal, seen), seen


def _moving_median(signal: FloatArray, window: int) -> FloatArray:
    """Moving median of each column."""
    out = np.empty_like(signal)
    for channel in range(signal.shape[1]):
        out[:, channel] = median_filter(
            np.ascontiguousarray(signal[:, channel]), window, mode="nearest"
        )
    return out
