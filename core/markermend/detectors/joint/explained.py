"""A candidate judged by the noise that is left once it is taken out.

A drift's own kinks make its surroundings loud, and so hide it: the noise around them was measured
with the drift in it. What is truly a drift leaves quiet behind when its fitted shape is taken out;
a hill of the body does not.
"""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray
from markermend.detectors.joint.bands import CLIPS, DUST_MM, WIDTHS, WINDOWS
from markermend.detectors.joint.loudness import loudness
from markermend.detectors.joint.views import Seen


def explained(seen: Seen, whole: FloatArray, size: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Score candidates under the noise that they leave.

    Parameters
    ----------
    seen : the shapes at their places
    whole : (n, bands, frames) mm, unclipped innovations there
    size : (n,) mm, fitted heights

    Returns
    -------
    score : (n,) signal to noise
    quieter : (n,) log of how many times less noise power there is, where the shape weighs
    """
    shape = seen.shape
    rest = whole - size[:, None, None] * shape
    inside = seen.weight > 0
    weight = np.empty_like(rest)
    for b, window in enumerate(WINDOWS):
        weight[:, b] = WIDTHS[b] / (loudness(rest[:, b], window) + DUST_MM) ** 2
    weight *= inside
    most = np.array(CLIPS)[:, None] * np.sqrt(
        np.array(WIDTHS)[:, None] / np.where(inside, weight, 1.0)
    )
    error = size[:, None, None] * shape + np.clip(rest, -most, most)
    power = np.maximum((shape**2 * weight).sum(axis=(1, 2)), 1e-9)
    before = np.maximum((shape**2 * seen.weight).sum(axis=(1, 2)), 1e-9)
    score = (shape * error * weight).sum(axis=(1, 2)) / np.sqrt(power)
    return np.abs(score), np.log(power / before)
