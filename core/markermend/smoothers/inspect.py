"""What smoothing did to a marker: how much of its way went, and which frequencies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray, runs
from markermend.smoothers.butterworth import ResidualAnalysis, analyse_residuals
from markermend.smoothers.metrics import percent_less, sm1

SHORTEST = 16
"""A shorter stretch, in frames, has no spectrum worth a look."""


@dataclass(frozen=True, eq=False)
class Inspection:
    """The longest stretch without a gap, before and after.

    Attributes
    ----------
    frequencies_hz : (k,)
    before, after : (k, 3) power spectral density, mm²/Hz
    residuals : what a Butterworth filter would take from the samples before
    """

    frequencies_hz: FloatArray
    before: FloatArray
    after: FloatArray
    residuals: ResidualAnalysis


def inspect(before: FloatArray, after: FloatArray, rate: float) -> Inspection | None:
    """Spectra of a marker before and after smoothing, and Winter's residual analysis.

    Parameters
    ----------
    before, after : (n, 3) float64, mm; NaN where the marker was not seen
    rate : frames per second

    Returns
    -------
    Inspection or None
        None when no stretch has :data:`SHORTEST` frames without a gap

    Notes
    -----
    Welch's estimate over windows of two seconds, without the linear trend of each.
    """
    from scipy.signal import detrend, welch

    stretches = runs(~np.isnan(before[:, 0]))
    if not len(stretches):
        return None
    start, stop = stretches[(stretches[:, 1] - stretches[:, 0]).argmax()]
    if stop - start < SHORTEST:
        return None
    window = min(int(stop - start), max(SHORTEST, round(2 * rate)))
    frequencies, power = welch(
        np.stack([before[start:stop], after[start:stop]]),
        rate,
        nperseg=window,
        detrend=detrend,
        axis=1,
    )
    return Inspection(frequencies, power[0], power[1], analyse_residuals(before[start:stop], rate))


def percent_sm1(before: FloatArray, after: FloatArray) -> FloatArray:
    """%SM1: how much shorter the way became.

    Parameters
    ----------
    before, after : (frames, ...) float64, NaN where missing

    Returns
    -------
    (...) float64, percent

    Notes
    -----
    ardestani2022, eq. 10.
    """
    return percent_less(sm1(before), sm1(after))
