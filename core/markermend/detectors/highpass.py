"""What is left of a trajectory when its legitimate motion is taken away.

The high passes of skurowski2022: signal minus moving median (eq. 18), signal minus
Savitzky–Golay (eq. 7, where ``c(i)`` means ``x(i)``), and the differential (eq. 12). Windows
are given in frames at 100 Hz, as the paper gives them, and scaled to the take's rate.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import median_filter

from markermend.arrays import FloatArray


def scaled(frames: float, rate: float) -> int:
    """Return a number of frames at 100 Hz as frames at ``rate``, at least 1."""
    return max(1, round(frames * rate / 100))


def scaled_odd(frames: float, rate: float, *, least: int = 3) -> int:
    """Scale a window to the take's rate.

    Parameters
    ----------
    frames : its length at 100 Hz
    rate : of the take, Hz
    least : shortest window

    Returns
    -------
    An odd number of frames, at least ``least``
    """
    window = 2 * int(frames * rate / 200) + 1
    return max(window, least + 1 - least % 2)


def differential(signal: FloatArray) -> FloatArray:
    """Change since the frame before (skurowski2022, eq. 12); 0 in the first frame.

    Parameters
    ----------
    signal : (frames, channels) without NaN

    Returns
    -------
    (frames, channels)
    """
    return np.diff(signal, axis=0, prepend=signal[:1])


def median_high_pass(signal: FloatArray, window: int) -> FloatArray:
    """Signal minus its moving median (skurowski2022, eq. 18).

    Parameters
    ----------
    signal : (frames, channels) without NaN
    window : odd number of frames

    Returns
    -------
    (frames, channels)
    """
    smooth = np.empty_like(signal)
    for channel in range(signal.shape[1]):
        # SciPy's one-dimensional filter is several times faster than its n-dimensional one.
        smooth[:, channel] = median_filter(
            np.ascontiguousarray(signal[:, channel]), window, mode="nearest"
        )
    return signal - smooth


def savgol_low_pass(signal: FloatArray, order: int, window: int) -> FloatArray:
    """Smooth by local polynomials (skurowski2022, eq. 6).

    Parameters
    ----------
    signal : (frames, …) float64 without NaN
    order : of the polynomials
    window : odd number of frames, above ``order``

    Returns
    -------
    As large as ``signal``, which comes back as it is where it is shorter than the window
    """
    from scipy.signal import savgol_filter

    if len(signal) < window:
        return signal.copy()
    return np.asarray(savgol_filter(signal, window, order, axis=0), dtype=np.float64)


def savgol_high_pass(signal: FloatArray, order: int, window: int) -> FloatArray:
    """Signal minus its local polynomial (skurowski2022, eq. 7).

    Parameters and result are those of :func:`savgol_low_pass`; a signal shorter than the window
    becomes zero.
    """
    return signal - savgol_low_pass(signal, order, window)
