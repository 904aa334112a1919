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
        metadata={"min": 0.0, "max": 1e15, "help": "Weight in frames³; 0 for cross-validation"},
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
    from scipy.interpolate import make_smoothing_spline

    def fit(values: FloatArray) -> FloatArray:
        frames = np.arange(len(values), dtype=np.float64)
        result = np.empty_like(values)
        for channel, signal in enumerate(values.T):
            # A signal that does not move leaves nothing to validate.
            if np.ptp(signal) == 0:
                result[:, channel] = signal
                continue
            curve = make_smoothing_spline(frames, signal, lam=params.penalty or None)
            result[:, channel] = curve(frames)
        return result

    return signals.each_stretch(fit, 5)
