"""Savitzky–Golay: a polynomial fitted around each frame."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import MethodError
from markermend.smoothers.registry import Signals, register


@dataclass(frozen=True)
class SavgolSmootherParams:
    """Window and degree; the window is for 100 Hz and scaled by the rate."""

    window: int = field(
        default=13,
        metadata={"unit": "frames at 100 Hz", "min": 3, "max": 1001, "help": "Length"},
    )
    order: int = field(default=5, metadata={"min": 0, "max": 15, "help": "Degree"})


@register(
    "savgol",
    label="Savitzky–Golay",
    summary="Local polynomial; keeps peaks, smooths little.",
    params=SavgolSmootherParams,
    source="Savitzky and Golay 1964",
)
def smooth_savgol(signals: Signals, params: Any) -> FloatArray:
    """Fit around each frame; at a stretch's ends the last window's polynomial is used."""
    from scipy.signal import savgol_filter

    window = round(params.window * signals.rate / 100) // 2 * 2 + 1
    if window <= params.order:
        raise MethodError(
            f"At {signals.rate:g} frames per second the window holds {window} frames; "
            f"degree {params.order} needs more."
        )

    def fit(values: FloatArray) -> FloatArray:
        return np.asarray(savgol_filter(values, window, params.order, axis=0), dtype=np.float64)

    return signals.each_stretch(fit, window)
