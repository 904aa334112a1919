"""Heavy noise: many peaks next to each other.

Section 3.4.3 of skurowski2022, equations 26 to 30. The structuring element is printed as
2·minLen - 1, 39 frames. A jump rings for 6 frames to either side, so a closing over 39 frames
makes heavy noise of the two jumps of a step shorter than about 51, where the paper reports hardly
any step as noise. It is read as minLen - 1, 19 frames (``noise_element``): on a calm take steps
found rise from 66 to 90 %, the precision of heavy noise from 60 to 75 %. Closing twice is then as
good as once, since it commutes with a threshold.

Beyond the paper, only with ``confirm``: closing also joins lone outliers of fast motion into a
segment; a segment is kept only if a third of its differentials, before closing, are above the
threshold and above what the largest of them leaves by ringing. Peaks right beside heavy noise are
part of it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.artifact import Kind
from markermend.detectors.channels import judged, thresholds
from markermend.detectors.finding import Finding
from markermend.detectors.highpass import differential, savgol_high_pass, scaled, scaled_odd
from markermend.detectors.morphology import closing
from markermend.detectors.params import PaperParams

# White noise stands out in most of its frames. The jumps of a short step, which the closing joins,
# do not: their ringing passes this share of the jump in five frames each.
LEAST_SHARE = 1 / 3
RINGING = 0.15


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
    params : ``noise_*``, ``savgol_*`` and ``confirm``

    Returns
    -------
    Findings whose ratio is the median of the closed magnitude over the threshold and whose
    amplitude is the largest distance from the smoothed course.
    """
    shortest = scaled(params.noise_length, rate)
    element = scaled_odd(params.noise_element, rate, least=1)
    valid = judged(seen)
    change = high_passed_differential(signal, valid, rate, params)
    threshold = thresholds(params.noise_k, change, valid, confirm=params.confirm)
    magnitude = closing(np.abs(change), element)
    noisy = closing(magnitude > threshold, element) & seen
    window = scaled_odd(params.savgol_window, rate, least=params.savgol_order + 2)

    found = []
    for channel in np.flatnonzero(noisy.any(axis=0)):
        deviation = np.abs(savgol_high_pass(signal[:, [channel]], params.savgol_order, window))
        for start, stop in runs(noisy[:, channel]):
            if stop - start < shortest:
                continue
            inside = np.abs(change[start:stop, channel])
            if params.confirm and not _dense(inside, float(threshold[channel])):
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


def absorb_peaks(
    earlier: list[Finding], new: list[Finding], rate: float, params: PaperParams
) -> list[Finding]:
    """Join findings of two stages; peaks next to heavy noise of their channel become part of it.

    Parameters
    ----------
    earlier, new : findings of the stages before and of this one
    rate : frames per second
    params : ``peak_size``; next to means within the window that makes a peak a lone one

    Returns
    -------
    All findings but the peaks absorbed; a noise that absorbs one reaches to it.
    """
    reach = scaled(params.peak_size, rate) + 1
    peaks = [f for f in earlier if f.kind is Kind.PEAK]
    grown = []
    for noise in new:
        if noise.kind is Kind.NOISE:
            near = [
                f
                for f in peaks
                if f.channel == noise.channel
                and f.start < noise.stop + reach
                and noise.start - reach < f.stop
            ]
            peaks = [f for f in peaks if f not in near]
            noise = replace(
                noise,
                start=min([noise.start, *(f.start for f in near)]),
                stop=max([noise.stop, *(f.stop for f in near)]),
                amplitude_mm=max([noise.amplitude_mm, *(f.amplitude_mm for f in near)]),
            )
        grown.append(noise)
    return peaks + [f for f in earlier if f.kind is not Kind.PEAK] + grown


def _dense(magnitude: FloatArray, threshold: float) -> bool:
    """Whether a third of a segment stands out, from the clean signal and from ringing."""
    level = max(threshold, RINGING * float(magnitude.max()))
    return bool((magnitude > level).mean() >= LEAST_SHARE)
