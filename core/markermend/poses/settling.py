"""Let a whole body settle where its noisy joints and the way it is built agree."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import BoolArray, Float32Array, FloatArray
from markermend.poses.bending import Bends, OthersBends, find_bends
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
    others : how others bend, as :func:`markermend.poses.bending.find_bends` takes it

    Notes
    -----
    In its parent's axes a joint of a body keeps its place and turns about few axes: an elbow about
    one. A normal distribution over those local coordinates of the pilot, all joints together, is
    the prior, in which others' recordings have their share. Features are linearised at the pilot,
    and each frame is one least-squares problem. A few frames in a row bend alike and share slopes
    and variances.
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
    moved, _ = _solved(bends, given, variance[rows], bends.at, rate)
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
    moved, known = _solved(bends, given, variance, np.zeros_like(bends.at), rate)
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


def _solved(
    bends: Bends, features: FloatArray, variance: FloatArray, back: FloatArray, rate: float
) -> tuple[FloatArray, FloatArray]:
    """(frames, n) the most probable steps, and (n, n) mean precision.

    ``back`` is (frames, n): minus the step that would be most probable if features told nothing.
    """
    frames, joints, count = len(features), list(bends.joints), bends.at.shape[1]
    alike = _alike(rate)
    firsts = np.arange(0, frames, alike)
    counts = np.diff(np.append(firsts, frames))
    unsure = variance[:, joints].reshape(frames, -1)
    certain = 1.0 / np.sqrt(np.add.reduceat(unsure, firsts) / counts[:, None])
    left = (features - bends.poses)[:, joints].reshape(frames, -1)
    moved, total = np.empty_like(bends.at), np.zeros((count, count))
    starts = range(0, len(firsts), _AT_ONCE)
    for first, told in zip(starts, bends.slopes(firsts + counts // 2, _AT_ONCE), strict=True):
        some = slice(first, first + _AT_ONCE)
        rows = slice(firsts[first], firsts[some][-1] + counts[some][-1])
        given = certain[some], _grouped(left[rows], alike), _grouped(back[rows], alike)
        try:
            steps, precision = _stepped(told, *map(_single, given))
        except np.linalg.LinAlgError:
            # Beside what is sure by a million, single precision does not see the rest.
            steps, precision = _stepped(told, *given)
        total += precision
        moved[rows] = steps.transpose(0, 2, 1).reshape(-1, count)[: len(moved[rows])]
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


def _grouped(rows: FloatArray, size: int) -> FloatArray:
    """(groups, size, columns) of rows in turn, zeros after the last."""
    padded = np.pad(rows, ((0, -len(rows) % size), (0, 0)))
    return padded.reshape(-1, size, rows.shape[1])
