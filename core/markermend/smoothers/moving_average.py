"""Moving average, symmetric or over the past, as ardestani2022 compares it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import MethodError
from markermend.smoothers.registry import Signals, register


@dataclass(frozen=True)
class MovingAverageParams:
    """Length and side of the window."""

    window: int = field(
        default=5, metadata={"unit": "frames", "min": 1, "max": 1001, "help": "Length"}
    )
    symmetric: bool = field(
        default=True,
        metadata={"help": "As much future as past (odd lengths); else the past, which lags"},
    )


@register(
    "moving_average",
    label="Moving average",
    summary="Mean of the neighbouring frames; leaves much noise in the derivatives.",
    params=MovingAverageParams,
    source="ardestani2022, 2.1",
)
def smooth_moving_average(signals: Signals, params: Any) -> FloatArray:
    """Average each stretch; at its ends the window shrinks."""
    if params.symmetric and params.window % 2 == 0:
        raise MethodError(f"A symmetric window has an odd length, not {params.window} frames.")
    average = symmetric_average if params.symmetric else recursive_average
    return signals.each_stretch(lambda values: average(values, params.window), 2)


def symmetric_average(values: FloatArray, window: int) -> FloatArray:
    """Mean over as many frames before as after; near the ends over as many as both sides have.

    Parameters
    ----------
    values : (n, channels) float64, without NaN
    window : odd number of frames
    """
    n = len(values)
    frames = np.arange(n)
    half = np.minimum(np.minimum(frames, n - 1 - frames), window // 2)
    total = np.concatenate([np.zeros_like(values[:1]), np.cumsum(values - values[0], axis=0)])
    mean = (total[frames + half + 1] - total[frames - half]) / (2 * half + 1)[:, None]
    return np.asarray(mean + values[0])


def recursive_average(values: FloatArray, window: int) -> FloatArray:
    """Mean of the current frame and of those already smoothed: y_t = (x_t + y_{t-1} + …) / n.

    Parameters
    ----------
    values : (n, channels) float64, without NaN
    window : number of frames n

    Notes
    -----
    The text of ardestani2022 (2.1) leaves open what is averaged; over the already smoothed past
    its tables come out.
    """
    from scipy.signal import lfilter

    past = np.full(window, -1.0 / window)
    past[0] = 1.0
    # Started as if the first value had stood before the beginning.
    start = values[0]
    filtered = lfilter([1.0 / window], past, values - start, axis=0)
    return np.asarray(filtered + start, dtype=np.float64)
