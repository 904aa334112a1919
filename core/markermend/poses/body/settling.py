"""Let a whole body settle where its noisy joints and the way it is built agree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import BoolArray, Float32Array, FloatArray, IntArray
from markermend.poses.body.bending import Bends, OthersBends, find_bends
from markermend.poses.smoothing import smooth_bands
from markermend.poses.solving import solved

# Frames in a row that share their slopes: for this long, but so many at least; groups of them that
# are solved at once.
_ALIKE_S, _ALIKE, _AT_ONCE = 0.085, 5, 32


def settle(
    features: FloatArray,
    variance: FloatArray,
    pilot: FloatArray,
    parents: Sequence[int],
    order: Sequence[int],
    rate: float,
    wanted: BoolArray | None = None,
    others: OthersBends | None = None,
) -> FloatArray:
    """Return the most probable poses, given noisy ones and how this body bends.

    Parameters
    ----------
    features : (frames, joints, 7) relative to the root, without NaN
    variance : (frames, joints, 7) of their errors
    pilot : (frames, joints, 7) poses near the truth, which say how the body bends; with the root of
        the noisy ones, and rotations of unit length
    parents : index of each joint's parent, -1 for the root
    order : joints, parents first
    rate : frames per second
    wanted : (frames,) bool, poses that are to settle; others may stay. None for all
    others : how others bend, as :func:`markermend.poses.body.bending.find_bends` takes it

    Notes
    -----
    In its parent's axes a joint of a body keeps its place and turns about few axes: an elbow about
    one. A normal distribution over those local coordinates of the pilot, all joints together, is
    the prior, in which others' recordings have their share. Features are linearised at the pilot,
    and each frame is one least-squares problem. A few frames in a row bend alike and share slopes
    and variances; where only some poses are to settle, each is between what it is with the slopes
    of those beside it, so that none jumps where the next ones begin.
    """
    given = _single(features)
    bends = find_bends(_signed(_single(pilot), given), parents, order, others)
    rows = np.arange(len(given))
    if not bends.at.shape[1] or (wanted is not None and not wanted.any()):
        return features
    if wanted is not None:
        alike = _alike(rate)
        rows = rows[np.logical_or.reduceat(wanted, rows[::alike])[rows // alike]]
        bends = bends.of(rows)
    given, settled = given[rows], features.copy()
    groups = _groups(rows, rate, fading=wanted is not None)
    moved, _ = _solved(bends, given, variance[rows], bends.back, groups)
    settled[rows] = bends.features(bends.at + moved, given)
    return settled


def settle_in_time(
    features: FloatArray,
    variance: FloatArray,
    pilot: FloatArray,
    parents: Sequence[int],
    order: Sequence[int],
    rate: float,
    others: OthersBends | None = None,
) -> FloatArray:
    """Return poses smoothed in the coordinates that this body bends in.

    Parameters
    ----------
    features : (frames, joints, 7) relative to the root, as noisy as they were measured; the pilot's
        where they were not
    variance : (frames, joints, 7) of their white noise
    pilot, parents, order, others : as for :func:`settle`
    rate : frames per second

    Notes
    -----
    Each frame of :func:`settle` by itself, drawn to the pilot instead of to the mean, leaves noise
    in far fewer coordinates than there are features. Made white by what all frames know of them on
    average, they pass :func:`markermend.poses.smoothing.smooth_bands`.
    """
    given = _single(features)
    bends = find_bends(_signed(_single(pilot), given), parents, order, others)
    if not bends.at.shape[1]:
        return features
    groups = _groups(np.arange(len(given)), rate)
    moved, known = _solved(bends, given, variance, np.zeros_like(bends.at), groups)
    white = np.linalg.cholesky(known)
    found = smooth_bands((bends.at + moved) @ white, bends.at @ white, rate)
    settled = bends.features(np.linalg.solve(white.T, found.T).T, given)
    return np.asarray(settled, dtype=np.float64)


def _single(values: NDArray[Any]) -> NDArray[Any]:
    """As precise as it takes beside what noise leaves, in half the time."""
    return np.asarray(values, dtype=np.float32)


def _signed(pilot: FloatArray, features: FloatArray) -> FloatArray:
    """The pilot with the signs of rotations that features have."""
    poses = pilot.copy()
    other = np.einsum("tji,tji->tj", pilot[..., 3:], features[..., 3:]) < 0
    poses[..., 3:][other] *= -1.0
    return poses


@dataclass(frozen=True, eq=False)
class _Groups:
    """Frames in a row that bend alike.

    Attributes
    ----------
    firsts, counts : (groups,) their first frame, and how many there are
    rows : (groups, n) frames that each is solved for
    shares : (groups, n) how much what comes out counts; of each frame 1 in sum
    """

    firsts: IntArray
    counts: IntArray
    rows: IntArray
    shares: FloatArray


def _groups(frames: IntArray, rate: float, fading: bool = False) -> _Groups:
    """Group frames, which are whole groups of a recording.

    Where they are ``fading``, each counts less from its middle to those of its neighbours, unless
    what lies between is not among the frames.
    """
    alike, last = _alike(rate), len(frames) - 1
    firsts = np.arange(0, len(frames), alike)
    counts = np.diff(np.append(firsts, len(frames)))
    reach = alike // 2 if fading else 0
    rows = firsts[:, None] + np.arange(-reach, alike + reach)
    inside = (rows >= firsts[:, None]) & (rows < (firsts + counts)[:, None])
    shares = inside.astype(float)
    if fading:
        middles = firsts + (counts - 1) / 2.0
        between, follows = np.diff(middles)[:, None], np.diff(frames[firsts]) == alike
        away = rows - middles[:, None]
        for some, side in ((np.s_[:-1], away[:-1]), (np.s_[1:], -away[1:])):
            less = np.maximum(1.0 - side / between, 0.0)
            # Where one takes over from another nothing shall bend.
            less = less**2 * (3.0 - 2.0 * less)
            shares[some] = np.where((side > 0) & follows[:, None], less, shares[some])
        shares *= (rows >= 0) & (rows <= last)
    return _Groups(firsts, counts, rows.clip(0, last), shares)


def _solved(
    bends: Bends, features: FloatArray, variance: FloatArray, back: FloatArray, groups: _Groups
) -> tuple[FloatArray, FloatArray]:
    """(frames, n) the most probable steps, and (n, n) mean precision.

    ``back`` is (frames, n): minus the step that would be most probable if features told nothing.
    """
    frames, joints, count = len(features), list(bends.joints), bends.at.shape[1]
    firsts, counts = groups.firsts, groups.counts
    unsure = variance[:, joints].reshape(frames, -1)
    certain = 1.0 / np.sqrt(np.add.reduceat(unsure, firsts) / counts[:, None])
    left = (features - bends.poses)[:, joints].reshape(frames, -1)
    moved, total = np.zeros_like(bends.at), np.zeros((count, count))
    starts = range(0, len(firsts), _AT_ONCE)
    for first, told in zip(starts, bends.slopes(firsts + counts // 2, _AT_ONCE), strict=True):
        some = slice(first, first + _AT_ONCE)
        rows, shares = groups.rows[some], groups.shares[some, :, None]
        given = certain[some], left[rows], back[rows]
        try:
            steps, precision = _stepped(told, *map(_single, given))
        except np.linalg.LinAlgError:
            # Beside what is sure by a million, single precision does not see the rest.
            steps, precision = _stepped(told, *given)
        total += precision
        np.add.at(moved, rows, (shares * steps.transpose(0, 2, 1)).astype(moved.dtype))
    return moved, total / len(firsts)


def _stepped(
    told: Float32Array, certain: NDArray[Any], left: NDArray[Any], back: NDArray[Any]
) -> tuple[NDArray[Any], NDArray[Any]]:
    """(groups, n, frames) steps of groups that bend alike, and (n, n) the sum of their precisions.

    Raises
    ------
    numpy.linalg.LinAlgError
        when what is given is not precise enough to tell some step
    """
    slopes = told * certain[:, :, None]
    across = slopes.transpose(0, 2, 1)
    wanted = across @ (left * certain[:, None]).transpose(0, 2, 1) - back.transpose(0, 2, 1)
    among = across @ slopes
    diagonal = np.arange(among.shape[1])
    among[:, diagonal, diagonal] += 1
    whole = among.sum(axis=0)
    return np.stack([solved(*one) for one in zip(among, wanted, strict=True)]), whole


def _alike(rate: float) -> int:
    """Frames in a row that bend alike."""
    return max(round(_ALIKE_S * rate), _ALIKE)
