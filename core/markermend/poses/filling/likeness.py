"""What other moments of the same recording tell of joints that were not seen for long."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate, pairwise

import numpy as np

from markermend.arrays import Float32Array, FloatArray, IntArray
from markermend.poses.filling.borders import Borders
from markermend.poses.solving import add_to_diagonal, solved

MOMENTS, SOME_MOMENTS, FEW_MOMENTS = (250, 200, 200), (100, 60, 80), (30, 20, 0)
"""Of a whole recording compared with a gap, as it is and mirrored, and of others.

Some are enough where gaps are so many that time counts, few where gaps are filled again.
"""

# Moments compared beside a gap: seconds each side, and how many of a second.
_BESIDE_S, _BESIDE_HZ = 0.5, 60.0
# Poses are alike when they move alike, too: what changes within this time counts as much.
_MOVES_S = 0.1
# What is particular to a time lasts this long; its share, and that of chance.
_LASTS_S, _PASSING, _CHANCE = 0.45, np.float32(0.2), 0.001
# A joint hides about so many numbers. Where more are gone at once, poses further away are asked, by
# this power of how many times as many, and less of what these show is taken for chance.
_A_JOINT, _REACH = 11, 0.75
_LEAST_MOMENTS = 30
# The other side of the body, and other recordings of it: how much alike they move, what their
# chance has more, and how sure it is that they move about where this one does.
_SAME_WAY, _OTHERS_CHANCE, _ASKEW = np.float32(0.85), 0.02, np.float32(2.0)
# After so many times as long nothing is left of it (1e-12).
_FORGOTTEN = 15.0
# What is divided by is at least so much.
_TINY = 1e-30
# Numbers that count alike.
_ALIKE = np.ones(1, dtype=np.float32)
# What it never saw, the process does not expect: squared errors are larger by about this.
_TOO_SURE = 3.5
# How sure it is is asked of every so many frames.
_EVERY = 4


def moments_to_compare(
    there: IntArray, start: int, stop: int, rate: float, most: int = MOMENTS[0]
) -> IntArray:
    """Frames that tell of a gap: those beside it, and some of all others.

    Parameters
    ----------
    there : frames in turn in which everything is known that is unknown within the gap
    start, stop : the gap
    rate : frames per second
    most : moments that are not beside the gap

    Returns
    -------
    (moments,) none where too little is known
    """
    reach = round(_BESIDE_S * rate)
    first, last = np.searchsorted(there, [start - reach, stop + reach])
    near = there[first:last]
    away = np.maximum(start - near, near - stop + 1)
    beside = near[(away - 1) % max(round(rate / _BESIDE_HZ), 1) == 0]
    chosen = np.append(beside, some_of(np.append(there[:first], there[last:]), most))
    return chosen if len(chosen) >= _LEAST_MOMENTS else chosen[:0]


def reach_of(channels: int) -> float:
    """How many times as far away poses may be that are asked, where so many channels are gone."""
    return float(max(channels / _A_JOINT, 1.0) ** _REACH)


def some_of(there: IntArray, most: int) -> IntArray:
    """Frames, or so many of them, evenly."""
    return there[:: max(-(-len(there) // most), 1)]


def moving(poses: Float32Array, rate: float, frames: IntArray | None = None) -> Float32Array:
    """(frames, 2 · channels) poses, and how they change, which count alike in comparing them.

    Parameters
    ----------
    poses : (n, channels)
    rate : frames per second
    frames : (frames,) those that are asked for; None for all
    """
    asked = np.arange(len(poses)) if frames is None else frames
    lag, last = max(round(_MOVES_S * rate), 1), len(poses) - 1
    change = poses[np.minimum(asked + lag, last)] - poses[np.maximum(asked - lag, 0)]
    return np.hstack([poses if frames is None else poses[frames], change])


def weights_of(by: Float32Array, joints: IntArray) -> Float32Array:
    """(channels,) how much the joint of each tells a regression; 1 on average of what tells."""
    weight, told = np.sqrt(np.bincount(joints, np.sum(by**2, axis=1)))[joints], by.any(axis=1)
    if told.any():
        weight /= weight[told].mean()
    return np.asarray(weight, dtype=np.float32)


@dataclass(frozen=True, eq=False)
class Telling:
    """Moments that tell of a gap.

    Attributes
    ----------
    moved : (moments, 2 · channels) rows of :func:`moving`, without NaN
    targets : (moments, n) what is to be predicted, as it was then
    frames : (moments,) when that was, in frames
    path : (frames, n) what a gap hides, over the whole recording that they are of, without NaN;
        needed for others' moments where borders are compared
    """

    moved: Float32Array
    targets: Float32Array
    frames: IntArray
    path: Float32Array | None = None


def by_likeness(
    moved: Float32Array,
    start: int,
    own: Telling,
    trust: Float32Array,
    weights: Float32Array,
    rate: float,
    noise: float = 0.0,
    others: Sequence[Telling] = (),
    borders: Borders | None = None,
) -> tuple[Float32Array, Float32Array]:
    """Predict what was not seen by a Gaussian process over poses and time.

    Parameters
    ----------
    moved : (length, 2 · channels) rows of :func:`moving` within the gap, without NaN
    start : frame that the gap begins with
    own : moments in which the same was seen
    trust : (channels,) how much each counts where poses are compared; 0 for those to be predicted
    weights : (channels, n) regression of what is to be predicted on poses; 0 as in ``trust``
    rate : frames per second
    noise : standard deviation of what targets stray by chance
    others : moments in which the other side of the body was seen, as a mirror shows them, and those
        of other recordings, each by themselves
    borders : of the gap, by which moments are compared, too

    Returns
    -------
    (length, n) values, and variances of their errors

    Notes
    -----
    Its covariance is the sum of one that falls with the difference of poses and of their movement,
    Matérn's of order 3/2, and one that falls with time, of order 5/2. So a movement that the
    recording has elsewhere is followed, and the sides of the gap are met at the speed they have.
    Half of a difference is of all that is seen, half of what the regression makes of it, which
    leaves out what a limb has no part in. Where more than a joint is gone, poses further away tell,
    too. The other side of the body moves much the same way, but for a constant and for what is
    particular to a time; so do other recordings. Where what is hidden was before and after tells
    less the nearer a border is, since what stands beside it tells more there.
    """
    moments, length = len(own.frames), len(moved)
    ends = list(accumulate([moments, *(len(other.frames) for other in others)]))
    theirs = [slice(*both) for both in pairwise(ends)]
    count, inside = ends[-1], np.arange(start, start + length)
    rows = np.vstack([own.moved, *(other.moved for other in others), moved])
    told = (rows.reshape(-1, len(trust)) @ weights).reshape(len(rows), -1)
    # Those that tell with each other, and below them those inside with those that tell.
    far = _apart([(rows, 0.5, np.tile(trust, 2)), (told, 0.5, _ALIKE)], count, moments)
    reach = reach_of(own.targets.shape[1])
    mine = slice(0, moments)
    lasts = _LASTS_S * rate
    lasting = np.zeros_like(far)
    lasting[mine, mine] = _PASSING * _nearness(own.frames, own.frames, lasts)
    lasting[count:, mine] = _PASSING * _nearness(inside, own.frames, lasts)
    for its, other in zip(theirs, others, strict=True):
        lasting[its, its] = _PASSING * _nearness(other.frames, other.frames, lasts) + _ASKEW
    usual = own.targets.mean(axis=0)
    left = own.targets - usual
    variance = np.mean(left**2, axis=0)
    spread = max(float(variance.mean()), noise**2, _TINY)
    chance = np.full(count, _CHANCE / reach**2 + noise**2 / spread, dtype=np.float32)
    chance[moments:] += _OTHERS_CHANCE
    add_to_diagonal(lasting[:count], chance)
    targets = np.vstack([left, *(other.targets - usual for other in others)])
    values, unsure = np.zeros((length, left.shape[1]), dtype=np.float32), np.zeros(length)
    looks = [(0, slice(0, length), np.ones(length))] if borders is None else borders.looks()
    for place, part, share in looks:
        those = slice(count + part.start, count + part.stop)
        system, across = far[:count], far[those]
        if borders is not None:
            ways = [(other.frames, other.path) for other in others if other.path is not None]
            views = borders.views(place, own.frames, ways)
            more = _apart([(*view, _ALIKE) for view in views], count, moments)
            system, across = system + more[:count], across + more[count:]
        system, across = _likeness(system, reach), _likeness(across, reach)
        for its in theirs:
            for rest in (slice(0, its.start), slice(its.stop, count)):
                system[its, rest] *= _SAME_WAY
                system[rest, its] *= _SAME_WAY
            across[:, its] *= _SAME_WAY
        found, doubt = _told(system + lasting[:count], across + lasting[those], targets)
        values[part] += share[:, None].astype(np.float32) * found
        unsure[part] += share * doubt
    return values + usual, _TOO_SURE * unsure[:, None] * variance


def _told(
    system: Float32Array, across: Float32Array, targets: Float32Array
) -> tuple[Float32Array, FloatArray]:
    """(frames, n) what moments tell by their covariance, and (frames,) the share left open."""
    # How sure it is changes slowly.
    frames, columns, whole = len(across), targets.shape[1], 1.0 + _PASSING
    places = np.append(np.arange(0, frames - 1, _EVERY), frames - 1)
    asked = across[places].T
    found = solved(system, np.hstack([targets, asked]))
    unsure = np.maximum(whole - np.sum(asked * found[:, columns:], axis=0), 0.0) / whole
    return across @ found[:, :columns], np.interp(np.arange(frames), places, unsure)


def _apart(
    views: Sequence[tuple[Float32Array, float, Float32Array]], count: int, usual: int
) -> Float32Array:
    """(frames, count) squared distances of all from the first ones, by the sum of several views.

    Each view is (frames, n), with how much it counts, and how much each of its columns does, over
    the mean square of the distances it shows between as many of the first as are usual.
    """
    rows = np.hstack([view for view, *_ in views])
    # Far from the middle differences drown.
    rows -= rows[:usual].mean(axis=0)
    spread = np.einsum("ij,ij->j", rows[:usual], rows[:usual]) / usual
    counting, first = np.empty_like(spread), 0
    for view, weight, trust in views:
        part = slice(first, first + view.shape[1])
        square = 2.0 * float(np.sum(trust**2 * spread[part]))
        counting[part] = trust * np.float32(np.sqrt(weight / max(square, _TINY)))
        first = part.stop
    rows *= counting
    length = np.einsum("ij,ij->i", rows, rows)
    squared = rows @ rows[:count].T
    squared *= -2
    squared += length[:, None]
    squared += length[:count]
    return np.asarray(np.maximum(squared, 0, out=squared))


def _likeness(squared: Float32Array, reach: float) -> Float32Array:
    """Matérn's covariance of order 3/2, in the place of the squared distances."""
    far = np.sqrt(squared, out=squared)
    far *= np.float32(-np.sqrt(3.0) / reach)
    falls = np.exp(far)
    np.subtract(1, far, out=far)
    far *= falls
    return far


def _nearness(frames: IntArray, others: IntArray, lasts: float) -> Float32Array:
    """(frames, others) Matérn's covariance of order 5/2, whose samples have a speed."""
    falling = _falling(lasts)
    apart = np.abs(frames[:, None] - others)
    return np.asarray(falling.take(apart, mode="clip"))


@lru_cache(maxsize=16)
def _falling(lasts: float) -> Float32Array:
    """The same for 0, 1, 2, … frames apart, until nothing is left of it."""
    scaled = np.sqrt(5.0) / lasts * np.arange(int(_FORGOTTEN * lasts) + 2)
    return np.asarray((1.0 + scaled + scaled**2 / 3.0) * np.exp(-scaled), dtype=np.float32)
