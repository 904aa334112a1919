"""Heavy noise: many peaks next to each other.

Section 3.4.3 of skurowski2022, equations 26 to 30. Beyond the paper: closing over 39 frames also
joins the two jumps of a step shorter than about half a second, and lone outliers of fast motion,
into a segment; a segment is kept only if two fifths of its differentials are above the threshold
before closing.
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


# White noise stands above the threshold in most of its frames; the two jumps of a short step, which
# the closing joins, do so only while they ring.
LEAST_SHARE = 0.4


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
    above = np.abs(change) > threshold
    noisy = closing(magnitude > threshold, element) & seen
    window = scaled_odd(params.savgol_window, rate, least=params.savgol_order + 2)

    found = []
    for channel in np.flatnonzero(noisy.any(axis=0)):
        deviation = np.abs(savgol_high_pass(signal[:, [channel]], params.savgol_order, window))
        for start, stop in runs(noisy[:, channel]):
            if stop - start < shortest or above[start:stop, channel].mean() < LEAST_SHARE:
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
