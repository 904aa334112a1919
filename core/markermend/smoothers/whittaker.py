"""Whittaker–Henderson smoothing whose weight is found by maximum likelihood."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.smoothers.penalised import LOWEST, likeliest_cutoff, solve, weight_of
from markermend.smoothers.registry import Signals, register


@dataclass(frozen=True)
class WhittakerParams:
    """Order of the difference, and how strongly it is penalised."""

    order: int = field(
        default=3, metadata={"min": 1, "max": 4, "help": "Order of the penalised difference"}
    )
    cutoff_hz: float = field(
        default=0.0,
        metadata={
            "unit": "Hz",
            "min": 0.0,
            "max": 1e5,
            "help": "Frequency that is halved; 0 for the likeliest of each coordinate",
        },
    )


@register(
    "whittaker",
    label="Whittaker–Henderson",
    summary="Penalises the third difference; one likeliest weight for each coordinate.",
    params=WhittakerParams,
    source="Whittaker 1923; Henderson 1924; Eilers 2003",
)
def smooth_whittaker(signals: Signals, params: Any) -> FloatArray:
    """Smooth each coordinate of each stretch with one weight."""
    return signals.each_stretch(
        lambda values: fit_whittaker(values, signals.rate, params.order, params.cutoff_hz),
        2 * params.order + 2,
    )


def fit_whittaker(
    values: FloatArray, rate: float, order: int = 3, cutoff_hz: float = 0.0
) -> FloatArray:
    """Smooth by penalised differences.

    Parameters
    ----------
    values : (n, channels) float64, without NaN, n > 2 · order
    rate : frames per second
    order : of the difference
    cutoff_hz : frequency that is halved; 0 for the likeliest of each channel

    Returns
    -------
    (n, channels) float64
    """
    if cutoff_hz:
        cutoffs = np.full(values.shape[1], cutoff_hz)
    else:
        cutoffs, _ = likeliest_cutoff(values, rate, order)
    shares = np.clip(cutoffs / rate, LOWEST, 0.5)
    noise = np.ones(len(values))
    columns = [
        solve(signal, noise, np.full(len(values) - order, 1.0 / weight), order)
        for signal, weight in zip(values.T, weight_of(shares, order), strict=True)
    ]
    return np.stack(columns, axis=1)
