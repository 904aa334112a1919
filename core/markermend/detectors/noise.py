"""Heavy noise: many peaks next to each other.

Section 3.4.3 of skurowski2022, equations 26 to 30.
"""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.artifact import Kind
from markermend.detectors.channels import judged, spread
from markermend.detectors.finding import Finding
from markermend.detectors.highpass import differential, savgol_high_pass, scaled, scaled_odd
from markermend.detectors.morphology import closing
from markermend.detectors.params import PaperParams


def high_passed_differential(
    signal: FloatArray, valid: BoolArray, rate: float, params: PaperParams
) -> FloatArray:
    """Differential minus its Savitzky–Golay course (skurowski2022, eq. 26 and 27).

    Parameters
    ----------
    signal : (frames, channels) mm, without NaN
    valid : (frames, channels) bool; elsewhere the result is 0
    rate : frames per second
    params : ``savgol_*``

    Returns
    -------
    (frames, channels) mm per frame
    """
    order = params.savgol_order
    window = scaled_odd(params.savgol_window, rate, least=order + 2)
    return np.where(valid, savgol_high_pass(differential(signal), order, window), 0.0)


def find_noise(
    signal: FloatArray, seen: BoolArray, rate: float, params: PaperParams
) -> list[Finding]:
    """Find heavy noise on each channel.

    Parameters
    ----------
    signal : (frames, channels) mm, without NaN, clear of single peaks
    seen : (frames, channels) bool; heavy noise never reaches into a gap
    rate : frames per second
    params : ``noise_*``, ``savgol_*`` and ``least_mm``

    Returns
    -------
    Findings whose ratio is the median of the closed magnitude over the threshold and whose
    amplitude is the largest distance from the smoothed course.
    """
    shortest = scaled(params.noise_length, rate)
    element = 2 * shortest - 1
    valid = judged(seen)
    change = high_passed_differential(signal, valid, rate, params)
    threshold = np.maximum(params.noise_k * spread(change, valid), params.least_mm)
    magnitude = closing(np.abs(change), element)
    noisy = closing(magnitude > threshold, element) & seen
    window = scaled_odd(params.savgol_window, rate, least=params.savgol_order + 2)

    found = []
    for channel in np.flatnonzero(noisy.any(axis=0)):
        deviation = np.abs(savgol_high_pass(signal[:, [channel]], params.savgol_order, window))
        for start, stop in runs(noisy[:, channel]):
            if stop - start < shortest:
                continue
            ratio = float(np.median(magnitude[start:stop, channel]) / threshold[channel])
            found.append(
                Finding(
                    int(channel),
                    int(start),
                    int(stop),
                    Kind.NOISE,
                    max(ratio, 1.0),
                    float(deviation[start:stop].max()),
                )
            )
    return found
