"""Zero-lag Butterworth filter as biomechanics uses it, and Winter's residual analysis."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import MethodError
from markermend.smoothers.registry import Signals, register


@dataclass(frozen=True)
class ButterworthParams:
    """Where the filter cuts, and how steeply."""

    cutoff_hz: float = field(
        default=6.0,
        metadata={"unit": "Hz", "min": 0.01, "max": 1e5, "help": "Half power after both passes"},
    )
    order: int = field(
        default=2, metadata={"min": 1, "max": 8, "help": "Order of one pass; two are made"}
    )


@register(
    "butterworth",
    label="Butterworth",
    summary="Low pass run forwards and backwards; one cut-off for calm and fast alike.",
    params=ButterworthParams,
    source="Winter 2009, section 3.4.4",
)
def smooth_butterworth(signals: Signals, params: Any) -> FloatArray:
    """Filter each stretch; its ends are continued by reflection."""
    return signals.each_stretch(
        lambda values: filter_butterworth(values, signals.rate, params.cutoff_hz, params.order), 4
    )


def filter_butterworth(
    values: FloatArray, rate: float, cutoff_hz: float, order: int = 2
) -> FloatArray:
    """Low pass without lag.

    Parameters
    ----------
    values : (n, channels) float64, without NaN
    rate : frames per second
    cutoff_hz : where both passes together leave half the power
    order : of one pass

    Returns
    -------
    (n, channels) float64

    Raises
    ------
    MethodError
        when the cut-off is too high for the rate

    Notes
    -----
    Two passes halve the power where one leaves 1/√2 of it: the single pass is designed for a
    tangent tan(π·f/rate) raised by (√2 − 1)^(−1/(2·order)), 1/0.802 for the second order (Winter
    2009, section 3.4.4.2). Before filtering, each end is continued by its point reflection over one
    second, or as far as the stretch reaches.
    """
    from scipy.signal import butter, sosfiltfilt

    if cutoff_hz >= rate / 2:
        raise MethodError(
            f"A cut-off of {cutoff_hz:g} Hz is too high for {rate:g} frames per second; "
            f"it must stay below {rate / 2:g} Hz."
        )
    correction = (np.sqrt(2.0) - 1.0) ** (1.0 / (2 * order))
    raised = rate / np.pi * np.arctan(np.tan(np.pi * cutoff_hz / rate) / correction)
    sections = butter(order, raised, fs=rate, output="sos")
    padding = min(len(values) - 1, round(rate))
    filtered = sosfiltfilt(sections, values, axis=0, padtype="odd", padlen=padding)
    return np.asarray(filtered, dtype=np.float64)


@dataclass(frozen=True, eq=False)
class ResidualAnalysis:
    """What a Butterworth filter takes away at each cut-off.

    Attributes
    ----------
    cutoffs_hz : (k,) cut-offs tried
    residual_mm : (k, channels) root mean square of what is taken away
    noise_mm : (channels,) the noise, where the straight line of high cut-offs meets 0 Hz
    chosen_hz : (channels,) the cut-off that takes away as much as the noise
    """

    cutoffs_hz: FloatArray
    residual_mm: FloatArray
    noise_mm: FloatArray
    chosen_hz: FloatArray


def analyse_residuals(values: FloatArray, rate: float, order: int = 2) -> ResidualAnalysis:
    """Choose a cut-off by how much is taken away.

    Parameters
    ----------
    values : (n, channels) float64, mm, without NaN
    rate : frames per second
    order : of one pass

    Notes
    -----
    Winter 2009, section 3.4.4.3: for white noise the residual falls in a straight line towards
    high cut-offs. The line is fitted to the upper half of those tried.
    """
    highest = 0.35 * rate
    cutoffs = np.linspace(highest / 40, highest, 40)
    residual = np.stack(
        [
            np.sqrt(np.mean((values - filter_butterworth(values, rate, float(f), order)) ** 2, 0))
            for f in cutoffs
        ]
    )
    upper = slice(len(cutoffs) // 2, None)
    noise = np.maximum(np.polyfit(cutoffs[upper], residual[upper], 1)[1], 0.0)
    # The residual falls with the cut-off: the first that takes away no more than the noise.
    below = residual <= noise
    first = np.where(below.any(axis=0), below.argmax(axis=0), len(cutoffs) - 1)
    before = np.maximum(first - 1, 0)
    channel = np.arange(values.shape[1])
    high, low = residual[before, channel], residual[first, channel]
    fall = np.where(high > low, high - low, 1.0)
    share = np.clip((high - noise) / fall, 0.0, 1.0)
    chosen = cutoffs[before] + share * (cutoffs[first] - cutoffs[before])
    return ResidualAnalysis(cutoffs, residual, noise, chosen)
