"""Smoothing without a knob: as much as each moment of each trajectory bears."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.smoothers.levels import ORDER, Levels, find_levels
from markermend.smoothers.penalised import LOWEST, solve, weight_of
from markermend.smoothers.registry import Signals, register

LEAST = ORDER + 2
"""Shorter stretches, in frames, are left as they are."""


@dataclass(frozen=True)
class AutoParams:
    """There is nothing to set."""


@register(
    "auto",
    label="Adaptive",
    summary="Estimates noise and liveliness at each moment; a kick keeps its peak, standing still "
    "loses its jitter.",
    params=AutoParams,
    source="penalised fourth differences, weighted along the take by a hidden Markov chain",
)
def smooth_auto(signals: Signals, params: Any) -> FloatArray:
    """Smooth each stretch with the levels found along it."""
    return smooth_with(signals, find_levels(signals))


def smooth_with(signals: Signals, levels: Levels) -> FloatArray:
    """Penalise fourth differences as cut-off and noise say.

    Parameters
    ----------
    signals : trajectories
    levels : cut-off and noise at each of their samples

    Returns
    -------
    (frames, markers, 3) float64, mm; NaN where the input is
    """
    result = signals.values.copy()
    variance = levels.noise_mm**2
    shares = np.clip(levels.cutoff_hz / signals.rate, LOWEST, 0.5)
    for frames, markers in signals.stretches():
        n = frames.stop - frames.start
        if n < LEAST:
            continue
        # A difference belongs to the middle of the samples it is made of.
        middle = slice(frames.start + ORDER // 2, frames.stop - ORDER // 2)
        motion = variance[middle, markers] / weight_of(shares[middle, markers], ORDER)
        for i, marker in enumerate(markers):
            for axis in range(3):
                result[frames, marker, axis] = solve(
                    signals.values[frames, marker, axis],
                    variance[frames, marker, axis],
                    motion[:, i, axis],
                    ORDER,
                )
    return result
