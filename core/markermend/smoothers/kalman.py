"""The scalar Kalman filter of ardestani2022."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.smoothers.registry import Signals, register


@dataclass(frozen=True)
class KalmanParams:
    """Errors the filter works with, in the signal's unit."""

    measurement_error: float = field(
        default=0.01,
        metadata={"min": 1e-9, "max": 1e6, "help": "E_mea; the larger, the smoother and later"},
    )
    process: float = field(
        default=0.01,
        metadata={"min": 0.0, "max": 1e6, "help": "Share of each change added to the error"},
    )


@register(
    "kalman",
    label="Kalman filter",
    summary="Runs along the signal once, so that it lags; as published, for comparison.",
    params=KalmanParams,
    source="ardestani2022, eq. 6 to 8",
)
def smooth_kalman(signals: Signals, params: Any) -> FloatArray:
    """Filter each stretch from its first sample."""
    return signals.each_stretch(
        lambda values: filter_kalman(values, params.measurement_error, params.process), 2
    )


def filter_kalman(
    values: FloatArray, measurement_error: float, process: float = 0.01
) -> FloatArray:
    """Follow a signal with a gain from estimated and measurement error.

    Parameters
    ----------
    values : (n, channels) float64, without NaN
    measurement_error : E_mea
    process : share of |EST_t − EST_{t−1}| that is added to the estimated error

    Returns
    -------
    (n, channels) float64

    Notes
    -----
    ardestani2022, eq. 6 to 8. By (8) alone the error only shrinks and the filter would stop
    following; feeding it with the estimate's change brings the published tables.
    """
    result = np.empty_like(values)
    estimate = values[0].copy()
    error = np.full_like(estimate, measurement_error)
    result[0] = estimate
    for t in range(1, len(values)):
        gain = error / (error + measurement_error)
        step = gain * (values[t] - estimate)
        estimate = estimate + step
        error = (1.0 - gain) * error + process * np.abs(step)
        result[t] = estimate
    return result
