"""What other moments of the same recording tell of joints that were not seen for long."""

from __future__ import annotations

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from markermend.arrays import BoolArray, Float32Array, FloatArray, IntArray

# Moments compared: of the whole recording, and beside a gap, seconds each side and a second.
_MOMENTS = 150
_BESIDE_S, _BESIDE_HZ = 0.5, 60.0
# Poses are alike when they move alike, too: what changes within this time counts as much.
_MOVES_S = 0.1
# What is particular to a time lasts this long; its share, and that of chance.
_LASTS_S, _PASSING, _CHANCE = 0.6, 0.2, 0.001
_LEAST_MOMENTS = 30
# What it never saw, the process does not expect: squared errors are larger by about this.
_TOO_SURE = 5.0


def moments_to_compare(known: BoolArray, start: int, stop: int, rate: float) -> IntArray:
    """Frames that tell of a gap: those beside it, and some of all others.

    Parameters
    ----------
    known : (frames,) bool, everything that is unknown within the gap
    start, stop : the gap
    rate : frames per second

    Returns
    -------
    (moments,) none where too little is known
    """
    there = np.flatnonzero(known)
    away = np.maximum(start - there, there - stop + 1)
    near = away <= _BESIDE_S * rate
    beside = there[near & ((away - 1) % max(round(rate / _BESIDE_HZ), 1) == 0)]
    far = there[~near]
    chosen = np.append(beside, far[:: max(-(-len(far) // _MOMENTS), 1)])
    return chosen if len(chosen) >= _LEAST_MOMENTS else chosen[:0]


def by_likeness(
    poses: FloatArray,
    trust: FloatArray,
    weights: FloatArray,
    targets: FloatArray,
    chosen: IntArray,
    start: int,
    stop: int,
    rate: float,
    noise: float = 0.0,
) -> tuple[FloatArray, FloatArray]:
    """Predict what was not seen by a Gaussian process over poses and time.

    Parameters
    ----------
    poses : (frames, channels) without NaN
    trust : (channels,) how much each is to be relied on; 0 for those to be predicted
    weights : (channels, n) regression of what is to be predicted on poses; 0 as in ``trust``
    targets : (moments, n) what is to be predicted as it was at the chosen frames
    chosen : (moments,) frames that tell
    start, stop : the gap
    rate : frames per second
    noise : standard deviation of what targets stray by chance

    Returns
    -------
    (stop - start, n) values, and variances of their errors

    Notes
    -----
    Its covariance is the sum of one that falls with the difference of poses and of their movement,
    Matérn's of order 3/2, and one that falls with time, of order 5/2. So a movement that the
    recording has elsewhere is followed, and the sides of the gap are met at the speed they have.
    Half of a difference is of all that is seen, half of what the regression makes of it, which
    leaves out what a limb has no part in.
    """
    inside = np.arange(start, stop)
    lag = max(round(_MOVES_S * rate), 1)
    mean = poses[chosen].mean(axis=0)
    system, across = np.zeros((len(chosen),) * 2), np.zeros((len(inside), len(chosen)))
    # So precise as it takes to compare them.
    views = [
        [np.hstack([*view]).astype(np.float32) for view in (both * trust, both @ weights)]
        for both in (_moving(poses, frames, lag, mean) for frames in (chosen, inside))
    ]
    for there, here in zip(*views, strict=True):
        apart = _squared(there, there)
        half = 0.5 / max(float(apart.mean()), np.finfo(float).tiny)
        system += half * apart
        across += half * _squared(here, there)
    system, across = _likeness(np.sqrt(system)), _likeness(np.sqrt(across))
    system += _PASSING * _nearness(np.abs(chosen[:, None] - chosen) / (_LASTS_S * rate))
    across += _PASSING * _nearness(np.abs(inside[:, None] - chosen) / (_LASTS_S * rate))
    usual = targets.mean(axis=0)
    left = targets - usual
    spread = max(float(np.mean(left**2)), noise**2, np.finfo(float).tiny)
    system[np.diag_indices(len(chosen))] += _CHANCE + noise**2 / spread
    factor = cho_factor(system, lower=True, check_finite=False)
    solved = cho_solve(factor, np.hstack([left, across.T]), check_finite=False)
    count = left.shape[1]
    whole = 1.0 + _PASSING
    unsure = np.maximum(whole - np.sum(across.T * solved[:, count:], axis=0), 0.0) / whole
    variance = _TOO_SURE * unsure[:, None] * np.mean(left**2, axis=0)
    return across @ solved[:, :count] + usual, variance


def _moving(poses: FloatArray, frames: IntArray, lag: int, mean: FloatArray) -> FloatArray:
    """(2, frames, channels) poses from the mean, and how they change."""
    last = len(poses) - 1
    change = poses[np.minimum(frames + lag, last)] - poses[np.maximum(frames - lag, 0)]
    return np.stack([poses[frames] - mean, change])


def _squared(a: Float32Array, b: Float32Array) -> FloatArray:
    """(len(a), len(b)) squared distances of rows."""
    far = np.sum(a**2, axis=1)[:, None] + np.sum(b**2, axis=1) - 2 * (a @ b.T)
    return np.asarray(np.maximum(far, 0.0), dtype=np.float64)


def _likeness(far: FloatArray) -> FloatArray:
    """Matérn's covariance of order 3/2."""
    scaled = np.sqrt(3.0) * far
    return np.asarray((1.0 + scaled) * np.exp(-scaled))


def _nearness(far: FloatArray) -> FloatArray:
    """Matérn's covariance of order 5/2, whose samples have a speed."""
    scaled = np.sqrt(5.0) * far
    return np.asarray((1.0 + scaled + scaled**2 / 3.0) * np.exp(-scaled))
