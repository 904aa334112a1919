"""How the features of a body move together: over a whole recording, and within a moment."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.bridging import SIDE, bridge

# Lengths in seconds for which movement within a gap is learnt.
LENGTHS_S = (0.008, 0.017, 0.033, 0.067, 0.133, 0.25, 0.5, 1.0, 2.0, 4.0)
_INSIDE = 5
_WINDOWS_A_LENGTH = 8


@dataclass(frozen=True, eq=False)
class Moments:
    """Means and covariances of features ``(channels,)``.

    Attributes
    ----------
    mean : (channels,)
    whole : (channels, channels) covariance over all poses
    within : one (channels, channels) covariance for each of :data:`LENGTHS_S`, of the deviations
        from the bridge over that time
    weight : poses all this counts for when another recording's are added
    """

    mean: FloatArray
    whole: FloatArray
    within: FloatArray
    weight: float

    def at(self, seconds: float) -> int:
        """Place of the nearest length in :data:`LENGTHS_S`."""
        return int(np.argmin(np.abs(np.log(np.array(LENGTHS_S) / max(seconds, 1e-6)))))


def deviations(values: FloatArray, length: int) -> FloatArray:
    """How far features stray from the bridge over windows all along a recording.

    Parameters
    ----------
    values : (frames, channels) without NaN
    length : of the windows, in frames

    Returns
    -------
    (samples, channels); none where the recording is too short
    """
    inside = np.unique(np.linspace(0.15 * length, 0.85 * length, _INSIDE).astype(int))
    inside = inside[inside < length]
    step = max(length // _WINDOWS_A_LENGTH, 1)
    starts = np.arange(SIDE, len(values) - length - SIDE + 1, step)
    sides = np.r_[-SIDE:0, length : length + SIDE]
    weights = bridge(length)[inside]
    parts = []
    for weight, place in zip(weights, inside, strict=True):
        line = sum(w * values[starts + side] for w, side in zip(weight, sides, strict=True))
        parts.append(values[starts + place] - line)
    return np.concatenate(parts) if len(starts) else np.empty((0, values.shape[1]))


def learn(values: FloatArray, rate: float, prior: Moments | None = None) -> Moments:
    """Learn moments from a recording, starting from those of others.

    Parameters
    ----------
    values : (frames, channels) without NaN
    rate : frames per second
    prior : of the same channels
    """
    frames, channels = values.shape
    n0 = prior.weight if prior is not None else 0.0
    mean = values.mean(axis=0)
    centred = values - mean
    whole = centred.T @ centred
    within = np.zeros((len(LENGTHS_S), channels, channels))
    for i, seconds in enumerate(LENGTHS_S):
        length = max(round(seconds * rate), 1)
        strays = deviations(values, length)
        # Neighbouring windows repeat each other.
        fresh = min(1.0, frames / max(len(strays), 1))
        within[i] = fresh * (strays.T @ strays)
        count = fresh * len(strays)
        if prior is not None:
            within[i] += n0 * prior.within[i]
            count += n0
        within[i] /= max(count, 1.0)
    if prior is not None:
        whole += n0 * prior.whole
    return Moments(mean, whole / (frames + n0), within, float(frames))
