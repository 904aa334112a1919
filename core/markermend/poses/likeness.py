"""What other moments of the same recording tell of joints that were not seen for long."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, Float32Array, IntArray
from markermend.poses.solving import solved

MOMENTS, FEW_MOMENTS = 150, 75
"""Of a whole recording compared with a gap; the few are enough for what is filled again."""

# Moments compared beside a gap: seconds each side, and how many of a second.
_BESIDE_S, _BESIDE_HZ = 0.5, 60.0
# Poses are alike when they move alike, too: what changes within this time counts as much.
_MOVES_S = 0.1
# What is particular to a time lasts this long; its share, and that of chance.
_LASTS_S, _PASSING, _CHANCE = 0.6, 0.2, 0.001
_LEAST_MOMENTS = 30
# What is divided by is at least so much.
_TINY = 1e-30
# What it never saw, the process does not expect: squared errors are larger by about this.
_TOO_SURE = 5.0


def moments_to_compare(
    known: BoolArray, start: int, stop: int, rate: float, most: int = MOMENTS
) -> IntArray:
    """Frames that tell of a gap: those beside it, and some of all others.

    Parameters
    ----------
    known : (frames,) bool, everything that is unknown within the gap
    start, stop : the gap
    rate : frames per second
    most : moments that are not beside the gap

    Returns
    -------
    (moments,) none where too little is known
    """
    there = np.flatnonzero(known)
    away = np.maximum(start - there, there - stop + 1)
    near = away <= _BESIDE_S * rate
    beside = there[near & ((away - 1) % max(round(rate / _BESIDE_HZ), 1) == 0)]
    far = there[~near]
    chosen = np.append(beside, far[:: max(-(-len(far) // most), 1)])
    return chosen if len(chosen) >= _LEAST_MOMENTS else chosen[:0]


def moving(poses: Float32Array, rate: float) -> Float32Array:
    """(frames, 2 · channels) poses, and how they change, which count alike in comparing them."""
    frames = np.arange(len(poses))
    lag = max(round(_MOVES_S * rate), 1)
    change = poses[np.minimum(frames + lag, len(poses) - 1)] - poses[np.maximum(frames - lag, 0)]
    return np.hstack([poses, change])


def by_likeness(
    moved: Float32Array,
    trust: Float32Array,
    weights: Float32Array,
    targets: Float32Array,
    chosen: IntArray,
    start: int,
    stop: int,
    rate: float,
    noise: float = 0.0,
) -> tuple[Float32Array, Float32Array]:
    """Predict what was not seen by a Gaussian process over poses and time.

    Parameters
    ----------
    moved : (frames, 2 · channels) without NaN, of :func:`moving`
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
    count = len(chosen)
    frames = np.append(chosen, np.arange(start, stop))
    rows = moved[frames]
    told = (rows.reshape(-1, len(trust)) @ weights).reshape(len(frames), -1)
    # The chosen with each other, and below those inside with the chosen.
    gone = np.abs(frames[:, None] - chosen).astype(np.float32)
    system = _likeness(_apart([rows * np.tile(trust, 2), told], count))
    system += np.float32(_PASSING) * _nearness(gone / np.float32(_LASTS_S * rate))
    system, across = system[:count], system[count:]
    usual = targets.mean(axis=0)
    left = targets - usual
    spread = max(float(np.mean(left**2)), noise**2, _TINY)
    system[np.diag_indices(count)] += _CHANCE + noise**2 / spread
    found = solved(system, np.hstack([left, across.T]))
    columns = left.shape[1]
    whole = 1.0 + _PASSING
    unsure = np.maximum(whole - np.sum(across.T * found[:, columns:], axis=0), 0.0) / whole
    variance = _TOO_SURE * unsure[:, None] * np.mean(left**2, axis=0)
    return across @ found[:, :columns] + usual, variance


def _apart(views: list[Float32Array], count: int) -> Float32Array:
    """(frames, count) distances of all from the first ones, by the mean of several views.

    Each view is (frames, n), and counts by one over the mean square of the distances it shows
    between the first ones.
    """
    scaled = []
    for view in views:
        # Far from the middle differences drown.
        centred = view - view[:count].mean(axis=0)
        usual = 2.0 * float(np.vdot(centred[:count], centred[:count])) / count
        scaled.append(centred * np.float32(np.sqrt(0.5 / max(usual, _TINY))))
    rows = np.hstack(scaled)
    length = np.einsum("ij,ij->i", rows, rows)
    squared = rows @ rows[:count].T
    squared *= -2
    squared += length[:, None]
    squared += length[:count]
    return np.asarray(np.sqrt(np.maximum(squared, 0)))


def _likeness(far: Float32Array) -> Float32Array:
    """Matérn's covariance of order 3/2."""
    scaled = far * np.float32(np.sqrt(3.0))
    return np.asarray((1 + scaled) * np.exp(-scaled))


def _nearness(far: Float32Array) -> Float32Array:
    """Matérn's covariance of order 5/2, whose samples have a speed."""
    scaled = far * np.float32(np.sqrt(5.0))
    return np.asarray((1 + scaled + scaled * scaled / 3) * np.exp(-scaled))
