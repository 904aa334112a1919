"""Gaussian processes of pose and time, conditioned on the frames that are known, and averaged.

The covariance of a marker's place in two frames is a sum of terms: a linear function of the pose
(ridge regression), a smooth non-linear one (rational quadratic), and three that only know the
time between the frames (Matérn, rasmussen2006, 4.2). One factorisation gives the mean, its
deviation, and what would have been predicted for any known stretch had it been hidden. The sizes
are fixed: chosen by likelihood they fit the calm frames, of which there are most, and gaps in rare
movements, which make up most of the error, came out worse.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, median_of_seen
from markermend.progress import heed
from markermend.repairs.body_frame import to_lab

# Prior standard deviations in mm: of the place itself, of the non-linear part, and of the parts
# that only time knows, at their scales.
PLACE_MM, CURVED_MM = 25.0, 7.0
TIME_MM, TIME_S = (1.5, 1.0, 1.5), (0.067, 0.5, 8.0)
# Noise of the process, in standard deviations of the measurement's.
NOISE = 3.0
# Intervals shorter than this are judged by the frames near them, which are the most like them.
SHORT_S = 0.25
# Power of its inverse variance by which a view counts, and a variance no view is surer than.
SURENESS, LEAST_MM2 = 2.0, 1e-12
# Triangular matrices up to this size are inverted as they are.
LEAST_HALVED = 48
# Length of a 90 % ball in standard deviations of one coordinate, in three dimensions.
BALL_90 = 2.5003


@dataclass(frozen=True, eq=False)
class View:
    """One way to look at the marker and its body: everything in a frame that moves with them.

    Attributes
    ----------
    linear, curved : (learnt + wanted, features) pose, scaled for the linear and the non-linear
        part: mm, and lengths over which poses have something to say to each other
    target : (learnt, 3) place of the marker, mm
    rotation : (learnt + wanted, 3, 3) from the laboratory into the frame
    centre : (learnt + wanted, 3) its origin, mm
    """

    linear: FloatArray
    curved: FloatArray
    target: FloatArray
    rotation: FloatArray
    centre: FloatArray


@dataclass(frozen=True, eq=False)
class Part:
    """Views that learn from the same of the known frames.

    Attributes
    ----------
    learnt : (learnt,) places of these among the known frames, in order
    views : one at least
    """

    learnt: IntArray
    views: tuple[View, ...]


@dataclass(frozen=True, eq=False)
class _Prediction:
    """What one view says, in laboratory axes.

    Attributes
    ----------
    mean, variance : (wanted, 3) mm, (wanted,) mm²
    miss, expected : (known, 3) mm, (known,) mm²; by how much the known frames would have been
        missed, were they hidden in blocks, and the variance expected of that: infinite where it
        does not learn from a frame
    freedom : effective number of parameters for each coordinate, the trace of the smoother
        (rasmussen2006, 2.6)
    """

    mean: FloatArray
    variance: FloatArray
    miss: FloatArray
    expected: FloatArray
    freedom: float


def condition(
    frames: IntArray,
    rate: float,
    parts: Sequence[Part],
    noise_mm: float,
    block: int,
    near: BoolArray,
) -> tuple[FloatArray, FloatArray, int]:
    """Predict the place of a marker in some frames from its place in others.

    Parameters
    ----------
    frames : (known + wanted,) frame numbers, the known ones first
    rate : frames per second
    parts : views, whose predictions are averaged, in each frame by the inverse square of the
        variance that each expects there, scaled by how far off it was where known stretches were
        hidden
    noise_mm : least standard deviation of the measurement
    block : length of the stretches that are hidden to see how far off the process is, in frames
    near : (known,) bool, frames near the interval, from which all views learn

    Returns
    -------
    mean : (wanted, 3) mm
    deviation : (wanted,) standard deviation of each coordinate, mm, scaled so that a 90 % ball
        held nine in ten of the known frames when stretches of `block` frames were hidden
    learnt : effective number of parameters, of all coordinates; the views' mean, as they are
        averages of each other
    """
    known = len(near)
    noise = (NOISE * noise_mm) ** 2
    blocks = frames[:known] // max(block, 1)
    # Rounded up, so that most intervals of a take share it.
    nearness = _from_time(1 << int(np.ptp(frames)).bit_length(), rate)
    said = [p for part in parts for p in _predict(part, frames, nearness, noise, blocks)]
    judged = near if block < SHORT_S * rate and near.any() else np.ones(known, dtype=bool)
    doubt = [_doubt(p.miss[judged], p.expected[judged]) for p in said]
    expected = np.array([d * p.expected[judged] for d, p in zip(doubt, said, strict=True)])
    variance = np.array([d * p.variance for d, p in zip(doubt, said, strict=True)])
    # The hidden stretches are mixed as the interval is, so that their misses tell of its own.
    miss = _mix(np.array([p.miss[judged] for p in said]), expected)
    usual = _mix(expected[:, :, None], expected)[:, 0]
    ratio = np.linalg.norm(miss, axis=1) / np.sqrt(usual)
    scale = float(np.quantile(ratio, 0.9)) / BALL_90
    spread = _mix(variance[:, :, None], variance)[:, 0]
    learnt = round(3 * float(np.mean([p.freedom for p in said])))
    return _mix(np.array([p.mean for p in said]), variance), scale * np.sqrt(spread), learnt


def _doubt(miss: FloatArray, expected: FloatArray) -> float:
    """Mean square of what was missed, by the variance expected of it."""
    return float(np.mean((np.sum(miss**2, axis=1) / expected)[np.isfinite(expected)]))


def _mix(values: FloatArray, variance: FloatArray) -> FloatArray:
    """Average (views, frames, k) values by (views, frames) variance, the surer views the more.

    Views that do not know of a frame, whose variance is infinite, have no say in it.
    """
    weight = np.maximum(variance, LEAST_MM2) ** -SURENESS
    said = np.where(np.isfinite(variance)[:, :, None], values, 0.0)
    return np.asarray(np.einsum("vf,vfk->fk", weight / weight.sum(axis=0), said))


def _predict(
    part: Part, frames: IntArray, nearness: FloatArray, noise: float, blocks: IntArray
) -> tuple[_Prediction, ...]:
    """Condition each view of a part on what is known."""
    learnt, known = len(part.learnt), len(blocks)
    at = np.concatenate([frames[part.learnt], frames[known:]])
    # What the views have in common: the place itself, and time.
    alike = PLACE_MM**2 + nearness[np.abs(at[:, None] - at[:learnt])]
    solved = [_solve(view, alike, noise) for view in part.views]
    inverse, weights = (np.stack([s[i] for s in solved]) for i in (2, 3))
    missed, usually = _hide(blocks[part.learnt], inverse, weights)
    rotation = np.stack([view.rotation[:learnt] for view in part.views])
    miss = np.zeros((len(solved), known, 3))
    expected = np.full((len(solved), known), np.inf)
    miss[:, part.learnt] = np.einsum("vfj,vfij->vfi", missed, rotation)
    expected[:, part.learnt] = usually
    freedom = learnt - noise * np.trace(inverse, axis1=1, axis2=2)
    return tuple(
        _Prediction(mean, variance, miss[i], expected[i], float(freedom[i]))
        for i, (mean, variance, _, _) in enumerate(solved)
    )


def _solve(
    view: View, alike: FloatArray, noise: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Mean and variance where wanted, inverse covariance (its lower triangle), and weights."""
    from scipy.linalg import cholesky
    from scipy.linalg.blas import dtrmm
    from scipy.linalg.lapack import dlauum

    heed()
    learnt = len(view.target)
    usual = median_of_seen(view.target)
    covariance = _from_pose(view, learnt)
    covariance += alike
    covariance[np.diag_indices(learnt)] += noise
    # Transposed, as LAPACK keeps its arrays, so that nothing is copied.
    factor = cholesky(covariance[:learnt].T, lower=True, overwrite_a=True, check_finite=False)
    root = _inverse_of_triangle(factor)
    explained = dtrmm(1.0, root, covariance[learnt:].T, lower=1, overwrite_b=1)
    own = root @ (view.target - usual)
    alone = PLACE_MM**2 + CURVED_MM**2 + sum(size**2 for size in TIME_MM)
    prior = alone + np.sum(view.linear[learnt:] ** 2, axis=1)
    variance = np.maximum(prior - np.einsum("lw,lw->w", explained, explained), noise)
    mean = to_lab(usual + explained.T @ own, view.rotation[learnt:], view.centre[learnt:])
    weights = root.T @ own
    inverse, _ = dlauum(root, lower=1, overwrite_c=1)
    return mean, variance, inverse, weights


def _inverse_of_triangle(factor: FloatArray) -> FloatArray:
    """Inverse of a lower triangular matrix, by halves: LAPACK's own takes twice as long."""
    from scipy.linalg.lapack import dtrtri

    size = len(factor)
    if size <= LEAST_HALVED:
        return np.asarray(dtrtri(factor, lower=1)[0])
    half = size // 2
    inverse = np.zeros((size, size), order="F")
    inverse[:half, :half] = _inverse_of_triangle(factor[:half, :half])
    inverse[half:, half:] = _inverse_of_triangle(factor[half:, half:])
    inverse[half:, :half] = -inverse[half:, half:] @ (factor[half:, :half] @ inverse[:half, :half])
    return inverse


def _from_pose(view: View, learnt: int) -> FloatArray:
    """(frames, learnt) covariance in mm² that comes from the likeness of poses."""
    curved, one = view.curved.T, np.ones((1, len(view.curved)))
    half = 0.5 * np.sum(curved**2, axis=0, keepdims=True)
    # One and half the squared distance, in one product: each pass over the array costs time.
    total = np.concatenate([curved, half, one]).T @ np.concatenate(
        [-curved[:, :learnt], one[:, :learnt], 1.0 + half[:, :learnt]]
    )
    np.divide(CURVED_MM**2, total, out=total)
    total += view.linear @ view.linear[:learnt].T
    return np.asarray(total)


@lru_cache(maxsize=4)
def _from_time(frames: int, rate: float) -> FloatArray:
    """(frames,) covariance in mm² that comes from nearness in time, by how far apart frames are."""
    passed = np.arange(frames) / rate
    kernels = zip(TIME_MM, TIME_S, (_matern52, _matern32, _matern32), strict=True)
    nearness = np.asarray(sum(size**2 * matern(passed / scale) for size, scale, matern in kernels))
    nearness.flags.writeable = False
    return nearness


def _matern32(distance: FloatArray) -> FloatArray:
    scaled = np.sqrt(3.0) * distance
    return np.asarray((1.0 + scaled) * np.exp(-scaled))


def _matern52(distance: FloatArray) -> FloatArray:
    scaled = np.sqrt(5.0) * distance
    return np.asarray((1.0 + scaled + scaled**2 / 3.0) * np.exp(-scaled))


def _hide(
    blocks: IntArray, inverse: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """By how much the known frames are missed, and the variance expected, a block left out each.

    `inverse` holds the lower triangles of the (views, known, known) inverse covariances, `weights`
    are (views, known, 3). What is predicted for a block without it follows from the inverse alone
    (rasmussen2006, eq. 5.12, for blocks).
    """
    edges = np.flatnonzero(np.diff(blocks, prepend=blocks[0] - 1, append=blocks[-1] + 1))
    starts, lengths = edges[:-1], np.diff(edges)
    miss, expected = np.empty_like(weights), np.empty(weights.shape[:2])
    for length in np.unique(lengths):
        # One inversion for all blocks of a length: of small matrices most of the time is the call.
        at = starts[lengths == length][:, None] + np.arange(length)
        corner = np.tril(inverse[:, at[:, :, None], at[:, None, :]])
        covariance = np.linalg.inv(corner + np.tril(corner, -1).swapaxes(2, 3))
        miss[:, at] = covariance @ weights[:, at]
        expected[:, at] = np.diagonal(covariance, axis1=2, axis2=3)
    return miss, expected
