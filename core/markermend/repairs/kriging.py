"""One Gaussian process of pose and time, conditioned on the frames that are known.

The covariance of a marker's place in two frames is a sum of terms: a linear function of the pose
(ridge regression), a smooth non-linear one (rational quadratic), and three that only know the
time between the frames (Matérn, rasmussen2006, 4.2). How large the latter and the noise are
beside the pose is chosen by likelihood. One factorisation gives the mean, its deviation, and what
would have been predicted for any known stretch had it been hidden.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise, product

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray

# Prior standard deviations in mm: of the place itself, of the part linear in the pose, of the
# non-linear part, and of the slowly changing parts.
PLACE_MM, LINEAR_MM, CURVED_MM = 25.0, 20.0, 6.0
TIME_MM = (2.0, 1.0, 1.0)
# Poses so far apart, in standard deviations of a coordinate, have little to say to each other.
CURVED_SCALE = 0.7
TIME_S = (0.067, 0.5, 8.0)
# Sizes of what changes in time and of the noise among which the likelihood chooses.
TIME_SIZES, NOISE_SIZES = (0.3, 1.0), (1.0, 3.0, 10.0)
# Of the frames that are not near, the likelihood looks at every so many.
LIKELIHOOD_STRIDE = 4
# Intervals shorter than this are judged by the frames near them, where every frame is used.
SHORT_S = 0.25
# Length of a 90 % ball in standard deviations of one coordinate, in three dimensions.
BALL_90 = 2.5003


@dataclass(frozen=True, eq=False)
class Conditioned:
    """What the process says about the frames that are wanted.

    Attributes
    ----------
    mean : (wanted, 3) mm
    deviation : (wanted,) standard deviation of each coordinate, mm, scaled so that a 90 % ball
        held nine in ten of the known frames when stretches as long as the interval were hidden
    """

    mean: FloatArray
    deviation: FloatArray


def condition(
    frames: IntArray,
    rate: float,
    pose: FloatArray,
    target: FloatArray,
    noise_mm: float,
    block: int,
    near: BoolArray,
) -> Conditioned:
    """Predict the place of a marker in some frames from its place in others.

    Parameters
    ----------
    frames : (known + wanted,) frame numbers, the known ones first
    rate : frames per second
    pose : (known + wanted, features) pose of the body in these frames, mean square 1
    target : (known, 3) place of the marker in the known ones, mm
    noise_mm : least standard deviation of the measurement
    block : length of the stretches that are hidden to see how far off the process is, in frames
    near : (known,) frames near the interval, of which none is left out

    Returns
    -------
    Conditioned
    """
    from scipy.linalg import cho_factor, cho_solve, solve_triangular
    from scipy.linalg.lapack import dpotri

    known = len(target)
    offset = target - np.median(target, axis=0)
    body, time = _from_pose(pose, known), _from_time(frames, rate, known)
    few = np.flatnonzero(near | (np.arange(known) % LIKELIHOOD_STRIDE == 0))
    corner = np.ix_(few, few)
    time_size, noise_size = _likeliest(body[corner], time[corner], offset[few], noise_mm)
    noise = (noise_size * noise_mm) ** 2
    prior = body + time_size**2 * time
    covariance = prior[:known].copy()
    covariance[np.diag_indices(known)] += noise
    factor, _ = cho_factor(covariance, lower=True, overwrite_a=True)
    weights = cho_solve((factor, True), offset)
    across = prior[known:]
    explained = solve_triangular(factor, across.T, lower=True)
    alone = _variance(pose[known:]) + time_size**2 * sum(size**2 for size in TIME_MM)
    variance = np.maximum(alone - np.sum(explained**2, axis=0), noise)
    inverse, _ = dpotri(factor, lower=1)
    judged = near if block < SHORT_S * rate and near.any() else np.ones(known, dtype=bool)
    scale = _scale(frames[:known] // block, np.tril(inverse), weights, judged)
    return Conditioned(target[0] - offset[0] + across @ weights, scale * np.sqrt(variance))


def _likeliest(
    body: FloatArray, time: FloatArray, offset: FloatArray, noise_mm: float
) -> tuple[float, float]:
    """Sizes of the parts in time and of the noise, by likelihood with the common scale free."""
    from scipy.linalg import cho_factor, cho_solve

    best, chosen = -np.inf, (1.0, 1.0)
    for time_size, noise_size in product(TIME_SIZES, NOISE_SIZES):
        covariance = body + time_size**2 * time
        covariance[np.diag_indices_from(covariance)] += (noise_size * noise_mm) ** 2
        factor, _ = cho_factor(covariance, lower=True, overwrite_a=True)
        fit = np.sum(offset * cho_solve((factor, True), offset))
        spread = np.log(np.diag(factor)).sum() / len(offset)
        likelihood = -0.5 * np.log(max(fit, 1e-300)) - spread
        if likelihood > best:
            best, chosen = likelihood, (time_size, noise_size)
    return chosen


def _from_pose(pose: FloatArray, known: int) -> FloatArray:
    """(frames, known) covariance in mm² that comes from the likeness of poses."""
    features = pose.shape[1]
    alike = pose @ pose[:known].T
    square = np.sum(pose**2, axis=1)
    apart = (square[:, None] + square[None, :known] - 2.0 * alike) / features
    total = PLACE_MM**2 + (LINEAR_MM**2 / features) * alike
    total += CURVED_MM**2 / (1.0 + np.maximum(apart, 0.0) / (2.0 * CURVED_SCALE**2))
    return np.asarray(total)


def _from_time(frames: IntArray, rate: float, known: int) -> FloatArray:
    """(frames, known) covariance in mm² that comes from nearness in time."""
    apart = np.abs(frames[:, None] - frames[None, :known])
    # There are far fewer different distances than pairs of frames.
    passed = np.arange(apart.max() + 1) / rate
    kernels = zip(TIME_MM, TIME_S, (_matern52, _matern32, _matern32), strict=True)
    by_distance = sum(size**2 * matern(passed / scale) for size, scale, matern in kernels)
    return np.asarray(np.asarray(by_distance)[apart])


def _variance(pose: FloatArray) -> FloatArray:
    """Prior variance of single frames that comes from the pose."""
    return np.asarray(PLACE_MM**2 + CURVED_MM**2 + LINEAR_MM**2 * np.mean(pose**2, axis=1))


def _matern32(distance: FloatArray) -> FloatArray:
    scaled = np.sqrt(3.0) * distance
    return np.asarray((1.0 + scaled) * np.exp(-scaled))


def _matern52(distance: FloatArray) -> FloatArray:
    scaled = np.sqrt(5.0) * distance
    return np.asarray((1.0 + scaled + scaled**2 / 3.0) * np.exp(-scaled))


def _scale(blocks: IntArray, inverse: FloatArray, weights: FloatArray, judged: BoolArray) -> float:
    """How much larger errors are than the process thinks, from blocks left out one at a time.

    `inverse` is the lower triangle of the inverse covariance. What is predicted for a block
    without it follows from the inverse alone (rasmussen2006, eq. 5.12, for blocks).
    """
    edges = np.flatnonzero(np.diff(blocks, prepend=blocks[0] - 1, append=blocks[-1] + 1))
    ratios = []
    for start, stop in pairwise(edges):
        corner = inverse[start:stop, start:stop]
        corner = corner + np.tril(corner, -1).T
        covariance = np.linalg.inv(corner)
        miss = covariance @ weights[start:stop]
        ratio = np.linalg.norm(miss, axis=1) / np.sqrt(np.diag(covariance))
        ratios.append(ratio[judged[start:stop]])
    return float(np.quantile(np.concatenate(ratios), 0.9)) / BALL_90
