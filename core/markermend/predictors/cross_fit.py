"""A marker foretold from its neighbours by fits that never saw the moment they foretell.

What a fit has seen of a drift it half believes. So every stretch is foretold by a fit without
itself and the stretches beside it; closed form, from Gram matrices added up by stretch.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

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
    both = np.hstack([features, goal])
    edges = np.append(np.arange(0, len(rows), BLOCK), len(rows))
    learnt = weight > 0
    first, best, error = np.inf, ridge, None
    rest = _rest(both, weight, edges)
    for factor in STIFFER:
        e = np.linalg.norm(goal - _left_out(both, rest, factor * ridge, edges), axis=1)
        middle = float(np.median(e[learnt]))
        cost = float(np.minimum(e[learnt], LARGEST * middle).mean())
        if cost < first:
            first, best, error = cost, factor * ridge, e
    assert error is not None
    weight /= np.maximum(1.0, error / max(2.0 * float(np.median(error[learnt])), 1e-9))
    local = _left_out(both, _rest(both, weight, edges), best, edges)
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


def _rest(both: FloatArray, weight: FloatArray, edges: IntArray) -> _Rest:
    """Add up what is learnt from for each block, from features beside the goal.

    Block by block, so that what is added up stays in the processor's cache.
    """
    blocks, count = list(pairwise(edges)), both.shape[1] - COORDINATES
    grams = np.empty((len(blocks), count, both.shape[1]))
    for gram, (a, b) in zip(grams, blocks, strict=True):
        np.matmul((both[a:b, :count] * weight[a:b, None]).T, both[a:b], out=gram)
    masses = np.array([weight[a:b].sum() for a, b in blocks])
    total, rest, mass = grams.sum(axis=0), np.empty_like(grams), np.empty_like(masses)
    for i in range(len(blocks)):
        beside = slice(max(i - 1, 0), i + 2)
        np.subtract(total, grams[beside].sum(axis=0), out=rest[i])
        mass[i] = max(masses.sum() - masses[beside].sum(), 1.0)
    return _Rest(rest, mass)


def _left_out(both: FloatArray, rest: _Rest, ridge: FloatArray, edges: IntArray) -> FloatArray:
    """Weighted ridge regression, each block by a fit without it and the blocks beside it."""
    from scipy.linalg.lapack import dposv

    count = len(ridge)
    said = np.empty((len(both), COORDINATES))
    for (a, b), gram, mass in zip(pairwise(edges), rest.gram, rest.mass, strict=True):
        left, right = gram[:, :count] + np.diag(mass * ridge), gram[:, count:]
        _, solved, failed = dposv(left, right)
        if failed:
            solved = np.linalg.solve(left, right)
        np.matmul(both[a:b, :count], solved, out=said[a:b])
    return said
