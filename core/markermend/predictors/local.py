"""Where a marker should be, from the markers that move with it: local frame and ridge regression.

Closed form, no training loop. The markers whose distance to the target varies least span a local
frame; in it the target is a regularised linear function of their positions and of products of
their principal components. The target's own samples serve to learn how it follows
the others, never as an input.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    deviation_of_seen,
    median_of_seen,
)
from markermend.errors import DataError
from markermend.progress import heed
from markermend.rotations import nearest_rotations

FRAME_MARKERS = 6
INPUT_MARKERS = 12
COMPONENTS = 8
# Ridge per sample and unit of variance. The products bend the fit where the body has been and fling
# it off where it has not: held back 300 times harder than the inputs, gaps of a seven-second take
# came out 7 mm wrong instead of 13, at the price of 0.1 to 0.25 mm in the frames learned from.
RIDGE, PRODUCT_RIDGE = 3e-4, 0.1
HUBER_PASSES = 3
# The other inputs hold the local frame only where too few of its own markers are seen.
SPARE_WEIGHT = 1e-4
# Samples a feature needs before it is worth having.
SAMPLES_PER_FEATURE = 4
CLIP = 4.0


def predict_local(
    positions: FloatArray,
    marker: int,
    *,
    start: int = 0,
    stop: int | None = None,
    trusted: BoolArray | None = None,
    memory: float | None = None,
) -> FloatArray:
    """Predict a marker from its neighbours, over the whole take or over one interval.

    Parameters
    ----------
    positions : (frames, markers, 3) float64, mm; NaN = missing
    marker : column to predict
    start, stop : interval asked for, half-open; by default the whole take. For a shorter interval
        the target's own samples inside it are never learned from, and markers seen all through
        it are preferred as references
    trusted : (frames, markers) bool, samples that may be used, as target or reference; by
        default all that are not missing
    memory : frames from the interval at which a sample counts half as much in learning; by
        default all count alike

    Returns
    -------
    (stop - start, 3) float64, mm; NaN where fewer than three references are seen, and
    everywhere when there is nothing to learn from

    Raises
    ------
    DataError
        when the marker or the interval lies outside the take

    Notes
    -----
    References are ranked by the median absolute deviation of their distance to the target on
    every fourth frame: the first 6 are aligned to a typical pose by orthogonal Procrustes, the
    first 12 are the inputs. Ridge regression on them and on the pairwise products of their first
    8 principal components (unit variance, clipped at 4), weights falling with the robust
    residual. Inputs missing in a frame are replaced by their expectation given the others.
    """
    frames, markers = positions.shape[:2]
    stop = frames if stop is None else stop
    if not 0 <= marker < markers:
        raise DataError(f"The take has {markers} markers; there is no marker {marker}.")
    if not 0 <= start <= stop <= frames:
        raise DataError(f"The interval [{start}, {stop}) lies outside the take's {frames} frames.")
    usable = ~np.isnan(positions[:, :, 0])
    if trusted is not None:
        usable &= trusted
    learn = usable[:, marker].copy()
    if stop - start < frames:
        learn[start:stop] = False
    nowhere = np.full((stop - start, 3), np.nan)
    with threadpool_limits(1):
        chosen = rank_references(positions, marker, usable, learn, start, stop)[:INPUT_MARKERS]
        if len(chosen) < 3 or not learn.any():
            return nowhere
        wanted = learn.copy()
        wanted[start:stop] = True
        rows = np.flatnonzero(wanted & (usable[:, chosen].sum(axis=1) >= 3))
        references = np.where(
            usable[np.ix_(rows, chosen)][:, :, None], positions[rows[:, None], chosen], np.nan
        )
        weight = learn[rows] * _time_weights(rows, start, stop, memory)
        inside = (rows >= start) & (rows < stop)
        if not weight.any() or not inside.any():
            return nowhere
        nowhere[rows[inside] - start] = _regress(
            references, positions[rows, marker], weight, inside
        )
    return nowhere


def rank_references(
    positions: FloatArray, marker: int, usable: BoolArray, learn: BoolArray, start: int, stop: int
) -> IntArray:
    """Order the markers that can stand for the target, the best first.

    Parameters
    ----------
    positions : (frames, markers, 3) float64, mm; NaN = missing
    marker : target column
    usable : (frames, markers) bool, samples that may be used
    learn : (frames,) bool, frames whose target sample may be learned from
    start, stop : interval to be predicted

    Returns
    -------
    (k,) int64 columns: by spread of the distance to the target, those missing in part of the
    interval later, those missing all through it, or seldom seen with the target, not at all
    """
    frames = np.flatnonzero(learn)
    frames = frames[:: 4 if len(frames) >= 400 else 1]
    both = usable[frames]
    apart = np.sqrt(((positions[frames] - positions[frames, marker][:, None]) ** 2).sum(axis=2))
    apart = np.where(both, apart, np.nan)
    absent = 1.0 - usable[start:stop].mean(axis=0) if stop > start else np.ones(both.shape[1])
    candidate = (both.sum(axis=0) >= max(3, 0.2 * len(frames))) & (absent < 1.0)
    candidate[marker] = False
    columns = np.flatnonzero(candidate)
    if not len(columns):
        return columns
    apart = apart[:, columns]
    spread = deviation_of_seen(apart.T)
    # Half a millimetre: the cameras' own noise, below which no marker is better than another.
    cost = (spread + 0.5) * (1.0 + 4.0 * absent[columns])
    return columns[np.argsort(cost, kind="stable")]


def _time_weights(rows: IntArray, start: int, stop: int, memory: float | None) -> FloatArray:
    """Weight of each frame by its distance from the interval."""
    if memory is None:
        return np.ones(len(rows))
    away = np.maximum(np.maximum(start - rows, rows - stop + 1), 0)
    weights: FloatArray = 1.0 / (1.0 + (away / memory) ** 2)
    return weights


@dataclass(frozen=True)
class Motion:
    """Rigid motion of the local frame: lab = local @ turn + origin, by frame."""

    turn: FloatArray
    origin: FloatArray

    def to_local(self, points: FloatArray) -> FloatArray:
        """(rows, points, 3) from the lab."""
        return np.asarray((points - self.origin[:, None]) @ self.turn.transpose(0, 2, 1))

    def to_lab(self, points: FloatArray) -> FloatArray:
        """(rows, points, 3) back to the lab."""
        return np.asarray(points @ self.turn + self.origin[:, None])


def _regress(
    references: FloatArray, target: FloatArray, weight: FloatArray, inside: BoolArray
) -> FloatArray:
    """Fit target on references where weight is positive, and predict the frames inside."""
    motion = align(references)
    heed()
    inputs = complete(motion.to_local(references).reshape(len(references), -1))
    heed()
    known = weight > 0
    goal = motion.to_local(target[:, None])[known, 0]
    features, ridge = expand(inputs, weight)
    learned, weight = features[known], weight[known]
    robust = np.ones(len(weight))
    for _ in range(HUBER_PASSES):
        heed()
        coefficients = _solve(learned, goal, weight * robust, ridge)
        error = np.sqrt(((goal - learned @ coefficients) ** 2).sum(axis=1))
        robust = 1.0 / np.maximum(1.0, error / max(2.0 * float(np.median(error)), 1e-9))
    inner = Motion(motion.turn[inside], motion.origin[inside])
    return inner.to_lab((features[inside] @ coefficients)[:, None])[:, 0]


def align(references: FloatArray) -> Motion:
    """Fit the references' typical pose onto every frame."""
    seen = ~np.isnan(references[:, :, 0])
    pose = _typical_pose(references, seen)
    unplaced = np.isnan(pose[:, 0])
    motion = _fit(pose, references, seen & ~unplaced)
    if unplaced.any():
        firm = (seen & ~unplaced).sum(axis=1) >= 3
        inner = Motion(motion.turn[firm], motion.origin[firm]).to_local(references[firm])
        placed = unplaced & seen[firm].any(axis=0)
        if placed.any():
            pose[placed] = median_of_seen(inner[:, placed])
        motion = _fit(pose, references, seen & ~np.isnan(pose[:, 0]))
    return motion


def _fit(pose: FloatArray, references: FloatArray, seen: BoolArray) -> Motion:
    """Rigid motion of the pose nearest to each frame (weighted orthogonal Procrustes)."""
    nearness = np.where(np.arange(len(pose)) < FRAME_MARKERS, 1.0, SPARE_WEIGHT)
    weight = np.where(seen, nearness, 0.0)
    weight = weight / np.maximum(weight.sum(axis=1, keepdims=True), SPARE_WEIGHT)
    pose = np.nan_to_num(pose)
    points = np.where(seen[:, :, None], references, 0.0)
    centre = (weight[:, None] @ points)[:, 0]
    pose_centre = weight @ pose
    arms = (points - centre[:, None]) * weight[:, :, None]
    turn = nearest_rotations((pose - pose_centre[:, None]).transpose(0, 2, 1) @ arms)
    return Motion(turn, centre - (pose_centre[:, None] @ turn)[:, 0])


def _typical_pose(references: FloatArray, seen: BoolArray) -> FloatArray:
    """The frame, of those with most references, whose distances are nearest to the usual ones."""
    i, j = np.triu_indices(references.shape[1], 1)
    most = np.flatnonzero(seen.sum(axis=1) == seen.sum(axis=1).max())
    some = references[most[:: max(1, len(most) // 400)]]
    apart = np.sqrt(((some[:, i] - some[:, j]) ** 2).sum(axis=2))
    known = ~np.isnan(apart).all(axis=0)
    usual = median_of_seen(apart[:, known])
    pose: FloatArray = some[int(np.nansum(np.abs(apart[:, known] - usual), axis=1).argmin())]
    return pose.copy()


def complete(inputs: FloatArray) -> FloatArray:
    """Replace missing inputs by their linear expectation given the others in the frame."""
    missing = np.isnan(inputs)
    if not missing.any():
        return inputs
    mean = np.nanmean(inputs, axis=0)
    mean = np.where(np.isnan(mean), 0.0, mean)
    centred = np.where(missing, 0.0, inputs - mean)
    common = np.maximum((~missing).T.astype(float) @ (~missing), 1.0)
    covariance = centred.T @ centred / common
    # Pairwise covariances need not be consistent: the ridge keeps the solution tame.
    ridge = np.diag(0.05 * covariance.diagonal() + 1e-6)
    filled = centred.copy()
    packed = np.packbits(missing, axis=1)
    keys = packed.view(np.dtype((np.void, packed.shape[1]))).ravel()
    _, first, which = np.unique(keys, return_index=True, return_inverse=True)
    for number, gone in enumerate(missing[first]):
        if not gone.any():
            continue
        heed()
        rows, there = np.flatnonzero(which.ravel() == number), ~gone
        solve = np.linalg.solve(
            (covariance + ridge)[np.ix_(there, there)], covariance[there][:, gone]
        )
        filled[np.ix_(rows, gone)] = centred[rows][:, there] @ solve
    return filled + mean


def expand(inputs: FloatArray, weight: FloatArray) -> tuple[FloatArray, FloatArray]:
    """One, the standardised inputs, products of their main components; and the ridge of each."""
    samples = np.count_nonzero(weight)
    share = weight / weight.sum()
    mean = share @ inputs
    # One scale a marker, not one an axis, so that the axes of the laboratory do not matter.
    variance = (share @ (inputs - mean) ** 2).reshape(-1, 3).mean(axis=1)
    scale = np.repeat(np.sqrt(variance), 3)
    # A constant input is left out by an infinite scale rather than blown up by its rounding.
    inputs = (inputs - mean) / np.where(scale > 1e-6, scale, np.inf)
    one = np.ones((len(inputs), 1))
    covariance = (inputs * share[:, None]).T @ inputs
    value, vector = np.linalg.eigh(covariance)
    value, vector = value[::-1][:COMPONENTS], vector[:, ::-1][:, :COMPONENTS]
    part = np.clip(inputs @ (vector / np.sqrt(np.maximum(value, 1e-6))), -CLIP, CLIP)
    i, j = np.triu_indices(part.shape[1])
    products = part[:, i] * part[:, j]
    products -= share @ products
    products /= np.sqrt(np.maximum(share @ products**2, 1e-12))
    affordable = samples // SAMPLES_PER_FEATURE
    if affordable < inputs.shape[1]:
        linear, products = part[:, : min(affordable, part.shape[1])], products[:, :0]
    elif affordable < inputs.shape[1] + products.shape[1]:
        linear, products = inputs, products[:, :0]
    else:
        linear = inputs
    ridge = np.repeat([1e-9, RIDGE, PRODUCT_RIDGE], [1, linear.shape[1], products.shape[1]])
    return np.hstack([one, linear, products]), ridge


def _solve(
    features: FloatArray, goal: FloatArray, weight: FloatArray, ridge: FloatArray
) -> FloatArray:
    """Weighted ridge regression."""
    weighted = features * weight[:, None]
    penalty = ridge * weight.sum()
    gram = weighted.T @ features + np.diag(penalty)
    return np.asarray(np.linalg.solve(gram, weighted.T @ goal), dtype=np.float64)
