"""How smooth a signal is, as ardestani2022 measures it."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray

TOO_MUCH = 30.0
"""A %SM1 above this should be looked at (ardestani2022, section 2.4)."""


def sm1(signal: FloatArray) -> FloatArray:
    """Length of the way a signal goes up and down.

    Parameters
    ----------
    signal : (frames, ...) float64; steps into or out of NaN do not count

    Returns
    -------
    (...) float64, in the signal's unit

    Notes
    -----
    ardestani2022, eq. 9.
    """
    return np.asarray(np.nansum(np.abs(np.diff(signal, axis=0)), axis=0), dtype=np.float64)


def sm2(signal: FloatArray) -> FloatArray:
    """Energy of a signal's second difference.

    Parameters
    ----------
    signal : (frames, ...) float64; differences that touch NaN do not count

    Returns
    -------
    (...) float64, in the signal's unit squared

    Notes
    -----
    ardestani2022, eq. 11.
    """
    return np.asarray(np.nansum(np.diff(signal, 2, axis=0) ** 2, axis=0), dtype=np.float64)


def percent_less(before: FloatArray, after: FloatArray) -> FloatArray:
    """How much smaller a metric became: %SM1 or %SM2.

    Parameters
    ----------
    before, after : (...) float64, the metric of the signal and of the smoothed one

    Returns
    -------
    (...) float64, percent of `before`; 0 where it was 0 already

    Notes
    -----
    ardestani2022, eq. 10 and 12.
    """
    safe = np.where(before > 0, before, 1.0)
    return np.asarray(np.where(before > 0, 100.0 * (before - after) / safe, 0.0), dtype=np.float64)
