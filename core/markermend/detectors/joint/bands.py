"""Innovations split into bands of frequency, each with a loudness of its own at every moment.

Cameras hiss at all frequencies and all the time; skin swings slowly, and only while the body moves;
a file that was low-pass filtered is silent above. One standard deviation cannot say all that. Split
into bands, noise is judged where and when it is loud, and the kinks of a drift where it is not.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from markermend.arrays import FloatArray
from markermend.detectors.joint.loudness import loudness

CUTS = (1 / 12, 1 / 4, 1 / 2)
"""Borders of the bands in shares of half the rate: 5, 15 and 30 Hz at 120."""
WIDTHS = tuple(float(b) for b in np.diff((0.0, *CUTS, 1.0)))
BANDS = len(WIDTHS)
TAPS = 41
HALF = TAPS // 2
WINDOWS = (161, 101, 33, 33)
"""Frames over which the loudness of each band is taken: slow bands must outlast a drift."""
CLIPS = (8.0, 6.0, 3.5, 3.5)
"""Standard deviations up to which an innovation counts; above, it does not tell more."""
DUST_MM = 0.0005


@lru_cache(maxsize=1)
def filters() -> FloatArray:
    """(bands, taps) linear-phase filters that add up to 1."""
    lows = [np.zeros(TAPS), *(_low_pass(cut) for cut in CUTS), np.zeros(TAPS)]
    lows[-1][HALF] = 1.0
    return np.diff(np.stack(lows), axis=0)


def _low_pass(cut: float) -> FloatArray:
    """(taps,) Hamming's window times a sinc: ``scipy.signal.firwin``, which takes 0.4 s to load."""
    taps = np.sinc(cut * (np.arange(TAPS) - HALF)) * np.hamming(TAPS)
    return np.asarray(taps / taps.sum())


@lru_cache(maxsize=4)
def filter_matrix(width: int) -> FloatArray:
    """(width, bands × width) the filters as a matrix that multiplies rows from the right."""
    away = np.arange(width)[:, None] - np.arange(width)[None, :]
    inside = np.abs(away) <= HALF
    taps = np.where(inside, filters()[:, np.clip(away + HALF, 0, TAPS - 1)], 0.0)
    return np.ascontiguousarray(taps.transpose(1, 0, 2).reshape(width, -1))


def split(error: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Split innovations into bands.

    Parameters
    ----------
    error : (frames,) mm

    Returns
    -------
    parts : (bands, frames) mm
    weight : (bands, frames) 1/mm², inverse noise power of a band, were it as wide as all together
    """
    parts = np.stack([np.convolve(error, taps, "same") for taps in filters()])
    weight = np.empty_like(parts)
    for b in range(BANDS):
        weight[b] = WIDTHS[b] / (loudness(parts[b], WINDOWS[b]) + DUST_MM) ** 2
    return parts, weight


def clipped(parts: FloatArray, weight: FloatArray) -> FloatArray:
    """Innovations no larger than is believed of them, (bands, frames) as from :func:`split`."""
    most = np.array(CLIPS)[:, None] * np.sqrt(np.array(WIDTHS)[:, None] / weight)
    return np.clip(parts, -most, most)
