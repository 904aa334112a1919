"""Natural cubic smoothing spline by generalised cross-validation."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.smoothers.registry import Signals, register


@dataclass(frozen=True)
class WoltringParams:
    """How strongly the curve is smoothed."""

    penalty: float = field(
        default=0.0,
        metadata={"min": 0.0, "max": 1e12, "help": "Weight in frames³; 0 for cross-validation"},
    )


@register(
    "woltring",
    label="Cross-validated spline",
    summary="Smoothing spline that chooses its own weight for each coordinate and stretch.",
    params=WoltringParams,
    source="Woltring 1986; Craven and Wahba 1979",
)
def smooth_woltring(signals: Signals, params: Any) -> FloatArray:
    """Fit a cubic smoothing spline to each coordinate of each stretch."""

    def fit(values: FloatArray) -> FloatArray:
        if params.penalty:
            return fit_spline(values, params.penalty)
        penalties = cross_validate(values)
        columns = [
            fit_spline(values[:, [i]], float(penalty)) for i, penalty in enumerate(penalties)
        ]
        return np.concatenate(columns, axis=1)

    return signals.each_stretch(fit, 6)


def fit_spline(values: FloatArray, penalty: float) -> FloatArray:
    """Natural cubic smoothing spline, read at its samples.

    Parameters
    ----------
    values : (n, channels) float64, without NaN, n > 4
    penalty : λ of Σ (y − f)² + λ ∫ f″², time in frames

    Returns
    -------
    (n, channels) float64

    Notes
    -----
    Reinsch (1967): f = y − λ Q u with (R + λ QᵀQ) u = Qᵀy, where Qᵀ takes second differences and R
    has 2/3 on and 1/6 beside its diagonal.
    """
    from scipy.linalg import solveh_banded

    band = np.empty((3, len(values) - 2))
    band[0], band[1], band[2] = penalty, 1.0 / 6.0 - 4.0 * penalty, 2.0 / 3.0 + 6.0 * penalty
    u = solveh_banded(band, np.diff(values, 2, axis=0), check_finite=False)
    result = values.copy()
    result[:-2] -= penalty * u
    result[1:-1] += 2.0 * penalty * u
    result[2:] -= penalty * u
    return result


def cross_validate(values: FloatArray) -> FloatArray:
    """Penalty of least generalised cross-validation for each channel.

    Parameters
    ----------
    values : (n, channels) float64, without NaN, n > 4

    Returns
    -------
    (channels,) float64

    Notes
    -----
    n·Σ (y − f)² / (n − trace)² (Craven and Wahba 1979). With evenly spaced samples the influence
    matrix is a filter but for its ends, so that its trace is the sum of the filter's gains, plus
    two for the straight line that no penalty touches. The minimum is refined by a parabola.
    """
    n = len(values)
    grid = np.geomspace(1e-4, 1e9, 66)
    omega = np.pi * np.arange(2, n) / n
    stiff = (2.0 * np.sin(omega / 2.0)) ** 4 * 3.0 / (2.0 + np.cos(omega))
    score = np.empty((len(grid), values.shape[1]))
    for k, penalty in enumerate(grid):
        trace = 2.0 + np.sum(1.0 / (1.0 + penalty * stiff))
        taken = np.sum((values - fit_spline(values, float(penalty))) ** 2, axis=0)
        score[k] = np.log(np.maximum(taken, 1e-30)) - 2.0 * np.log(n - trace)
    best = np.clip(score.argmin(axis=0), 1, len(grid) - 2)
    channel = np.arange(values.shape[1])
    left, low, right = (score[best + shift, channel] for shift in (-1, 0, 1))
    bend = left - 2.0 * low + right
    shift = np.clip(0.5 * (left - right) / np.where(bend > 0, bend, 1.0), -1.0, 1.0)
    return np.asarray(grid[best] * (grid[1] / grid[0]) ** shift)
