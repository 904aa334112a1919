"""Rauch–Tung–Striebel: the Kalman filter run both ways, for a body whose jerk is white."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.smoothers.penalised import likeliest_cutoff, weight_of
from markermend.smoothers.registry import Signals, register

_ORDER = 3


@dataclass(frozen=True)
class RtsParams:
    """Noise and liveliness of the motion."""

    noise_mm: float = field(
        default=0.0,
        metadata={"unit": "mm", "min": 0.0, "max": 1e4, "help": "Of a sample; 0 to estimate it"},
    )
    jerk: float = field(
        default=0.0,
        metadata={
            "unit": "mm/s²·√Hz",
            "min": 0.0,
            "max": 1e12,
            "help": "Root of the white jerk's spectral density; 0 to estimate it",
        },
    )


@register(
    "rts",
    label="Rauch–Tung–Striebel",
    summary="Kalman filter of position, velocity and acceleration, run forwards and backwards.",
    params=RtsParams,
    source="Rauch, Tung and Striebel 1965",
)
def smooth_rts(signals: Signals, params: Any) -> FloatArray:
    """Smooth each stretch; what is not given is estimated by maximum likelihood."""

    def fit(values: FloatArray) -> FloatArray:
        cutoffs, found = likeliest_cutoff(values, signals.rate, _ORDER)
        noise = np.full_like(found, params.noise_mm) if params.noise_mm else found
        density = found / np.sqrt(weight_of(cutoffs / signals.rate, _ORDER))
        jerk = density * signals.rate**2.5
        if params.jerk:
            jerk = np.full_like(found, params.jerk)
        return run_rts(values, signals.rate, np.maximum(noise, 1e-6), jerk)[0]

    return signals.each_stretch(fit, 2 * _ORDER + 2)


def run_rts(
    values: FloatArray, rate: float, noise_mm: FloatArray, jerk: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Estimate position, velocity and acceleration from the whole stretch.

    Parameters
    ----------
    values : (n, channels) float64, mm, without NaN
    rate : frames per second
    noise_mm : (channels,) standard deviation of a sample, above 0
    jerk : (channels,) root of the jerk's spectral density, mm/s²·√Hz

    Returns
    -------
    positions (mm), velocities (mm/s), accelerations (mm/s²), each (n, channels) float64

    Notes
    -----
    Rauch, Tung and Striebel (1965); the motion's noise is that of white jerk integrated over a
    frame. All channels are carried along together.
    """
    n, channels = values.shape
    dt = 1.0 / rate
    step = np.array([[1.0, dt, dt * dt / 2], [0.0, 1.0, dt], [0.0, 0.0, 1.0]])
    powers = np.array([[dt**5 / 20, dt**4 / 8, dt**3 / 6], [dt**4 / 8, dt**3 / 3, dt**2 / 2]])
    shape = np.vstack([powers, [dt**3 / 6, dt**2 / 2, dt]])
    drive = shape * (jerk**2)[:, None, None]
    variance = noise_mm**2
    # So wide that the first samples decide.
    start = np.diag([1e6, 1e6 * rate**2, 1e6 * rate**4]) * variance[:, None, None]
    state, spread = np.zeros((channels, 3)), start
    state[:, 0] = values[0]
    filtered = np.empty((n, channels, 3))
    spreads = np.empty((n, channels, 3, 3))
    for t in range(n):
        if t:
            state = state @ step.T
            spread = step @ spread @ step.T + drive
        gain = spread[:, :, 0] / (spread[:, 0, 0] + variance)[:, None]
        state = state + gain * (values[t] - state[:, 0])[:, None]
        # Joseph's form keeps the covariance positive.
        keep = np.broadcast_to(np.eye(3), spread.shape).copy()
        keep[:, :, 0] -= gain
        outer = gain[:, :, None] * gain[:, None, :] * variance[:, None, None]
        spread = keep @ spread @ keep.transpose(0, 2, 1) + outer
        filtered[t], spreads[t] = state, spread
    smoothed = filtered.copy()
    for t in range(n - 2, -1, -1):
        ahead = step @ spreads[t] @ step.T + drive
        back = np.linalg.solve(ahead, step @ spreads[t]).transpose(0, 2, 1)
        gap = smoothed[t + 1] - filtered[t] @ step.T
        smoothed[t] += np.einsum("cij,cj->ci", back, gap)
    return smoothed[:, :, 0], smoothed[:, :, 1], smoothed[:, :, 2]
