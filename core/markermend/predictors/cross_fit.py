"""A marker foretold from its neighbours by fits that never saw the moment they foretell.

What a fit has seen of a drift it half believes. So every stretch is foretold by a fit without
itself and the stretches beside it; closed form, from Gram matrices added up by stretch.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.predictors.local import align, complete, expand

BLOCK = 64
"""Frames of a stretch."""
STIFFER = (1.0, 10.0)
"""Factors on the ridge, of which the smallest left-out error chooses."""
LARGEST = 3.0
"""Errors count up to so many times their median, so that damage does not choose."""
COORDINATES = 3


def distance_spreads(positions: FloatArray, usable: BoolArray) -> FloatArray:
    """Median absolute deviation of the distance of each two markers.

    Parameters
    ----------
    positions : (frames, markers, 3) mm; NaN = missing
    usable : (frames, markers) bool, samples that count

    Returns
    -------
    (markers, markers) mm; infinite for a marker with itself, and for two seldom seen together
    """
    frames, markers = usable.shape
    some = slice(None, None, 4 if frames >= 400 else 1)
    points = np.where(usable[some, :, None], positions[some], np.nan)
    spread = np.full((markers, markers), np.inf)
    for m in range(markers - 1):
        apart = np.sqrt(((points[:, m + 1 :] - points[:, m, None]) ** 2).sum(axis=2))
        often = (~np.isnan(apart)).sum(axis=0) >= max(3.0, 0.2 * usable[some, m].sum())
        apart = apart[:, often]
        away = np.abs(apart - np.nanmedian(apart, axis=0)) if often.any() else apart
        others = m + 1 + np.flatnonzero(often)
        spread[m, others] = spread[others, m] = np.nanmedian(away, axis=0)
    return spread


def predict_cross_fitted(
    positions: FloatArray, marker: int, references: IntArray, usable: BoolArray
) -> FloatArray:
    """Foretell a marker all through a take.

    Parameters
    ----------
    positions : (frames, markers, 3) mm; NaN = missing
    marker : column to foretell
    references : (k,) columns, the best first; the first 6 span the local frame
    usable : (frames, markers) bool, samples that may be used, as target or reference

    Returns
    -------
    (frames, 3) mm; NaN where fewer than three references are seen, and everywhere when there
    are too few frames to learn from
    """
    predicted = np.full((len(positions), 3), np.nan)
    rows = np.flatnonzero(usable[:, references].sum(axis=1) >= 3)
    weight = usable[rows, marker].astype(np.float64)
    if len(references) < 3 or weight.sum() < 4 * BLOCK:
        return predicted
    seen = usable[np.ix_(rows, references)]
    points = np.where(seen[:, :, None], positions[rows[:, None], references], np.nan)
    motion = align(points)
    inputs = complete(motion.to_local(points).reshape(len(rows), -1))
    goal = np.nan_to_num(motion.to_local(positions[rows, marker][:, None])[:, 0])
    features, ridge = expand(inputs, weight)
    count, frames = features.shape[1], len(rows)
    # The last block is filled up with rows that weigh nothing.
    filling = -frames % BLOCK
    both = np.pad(np.hstack([features, goal]), ((0, filling), (0, 0)))
    both = both.reshape(-1, BLOCK, count + COORDINATES)

    def rest(weight: FloatArray) -> _Rest:
        return _rest(both, np.pad(weight, (0, filling)).reshape(-1, BLOCK))

    def left_out(rest: _Rest, ridge: FloatArray) -> FloatArray:
        said = _left_out(both[:, :, :count], rest, ridge)
        return said.reshape(-1, COORDINATES)[:frames]

    learnt = weight > 0
    first, best, error = np.inf, ridge, None
    evenly = rest(weight)
    for factor in STIFFER:
        e = np.linalg.norm(goal - left_out(evenly, factor * ridge), axis=1)
        middle = float(np.median(e[learnt]))
        cost = float(np.minimum(e[learnt], LARGEST * middle).mean())
        if cost < first:
            first, best, error = cost, factor * ridge, e
    assert error is not None
    weight /= np.maximum(1.0, error / max(2.0 * float(np.median(error[learnt])), 1e-9))
    local = left_out(rest(weight), best)
    predicted[rows] = motion.to_lab(local[:, None])[:, 0]
    return predicted


@dataclass(frozen=True, eq=False)
class _Rest:
    """What all but each block and those beside it say.

    Attributes
    ----------
    gram : (blocks, features, features + 3) weighted products of features with them and the goal
    mass : (blocks,) sum of weights
    """

    gram: FloatArray
    mass: FloatArray


def _rest(both: FloatArray, weight: FloatArray) -> _Rest:
    """Add up what is learnt from for each block, from features beside the goal.

    Parameters
    ----------
    both : (blocks, BLOCK, features + 3)
    weight : (blocks, BLOCK)
    """
    weighted = both[:, :, :-COORDINATES] * weight[:, :, None]
    grams, masses = weighted.transpose(0, 2, 1) @ both, weight.sum(axis=1)
    gram, mass = grams.sum(axis=0) - grams, masses.sum() - masses
    for left, own in ((gram, grams), (mass, masses)):
        left[1:] -= own[:-1]
        left[:-1] -= own[1:]
    return _Rest(gram, np.maximum(mass, 1.0))


def _left_out(features: FloatArray, rest: _Rest, ridge: FloatArray) -> FloatArray:
    """Weighted ridge regression, each block by a fit without it and the blocks beside it."""
    from scipy.linalg.lapack import dposv

    count = len(ridge)
    fits = np.empty((len(features), count, COORDINATES))
    left = np.empty((count, count))
    diagonal = left.reshape(-1)[:: count + 1]
    for fit, gram, mass in zip(fits, rest.gram, rest.mass, strict=True):
        left[:], right = gram[:, :count], gram[:, count:]
        diagonal += mass * ridge
        # Turned, it lies as LAPACK wants it, and is not copied.
        _, fit[:], failed = dposv(left.T, right, lower=1, overwrite_a=1)
        if failed:
            fit[:] = np.linalg.solve(gram[:, :count] + np.diag(mass * ridge), right)
    return np.asarray(features @ fits)
