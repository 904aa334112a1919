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
    edges = np.append(np.arange(0, len(rows), BLOCK), len(rows))
    learnt = weight > 0
    first, best, error = np.inf, ridge, None
    rest = _rest(features, goal, weight, edges)
    for factor in STIFFER:
        e = np.linalg.norm(goal - _left_out(features, rest, factor * ridge, edges), axis=1)
        middle = float(np.median(e[learnt]))
        cost = float(np.minimum(e[learnt], LARGEST * middle).mean())
        if cost < first:
            first, best, error = cost, factor * ridge, e
    assert error is not None
    weight /= np.maximum(1.0, error / max(2.0 * float(np.median(error[learnt])), 1e-9))
    local = _left_out(features, _rest(features, goal, weight, edges), best, edges)
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


def _rest(features: FloatArray, goal: FloatArray, weight: FloatArray, edges: IntArray) -> _Rest:
    """Add up what is learnt from for each block."""
    both = np.hstack([features, goal])
    weighted = features * weight[:, None]
    blocks = list(pairwise(edges))
    grams = np.empty((len(blocks), features.shape[1], both.shape[1]))
    for gram, (a, b) in zip(grams, blocks, strict=True):
        np.matmul(weighted[a:b].T, both[a:b], out=gram)
    masses = np.array([weight[a:b].sum() for a, b in blocks])
    mass = np.maximum(masses.sum() - _with_neighbours(masses), 1.0)
    rest = _with_neighbours(grams)
    return _Rest(np.subtract(grams.sum(axis=0), rest, out=rest), mass)


def _with_neighbours(values: FloatArray) -> FloatArray:
    """Each block's added to those of the blocks beside it."""
    total = values.copy()
    total[1:] += values[:-1]
    total[:-1] += values[1:]
    return total


def _left_out(features: FloatArray, rest: _Rest, ridge: FloatArray, edges: IntArray) -> FloatArray:
    """Weighted ridge regression, each block by a fit without it and the blocks beside it."""
    count = features.shape[1]
    gram = rest.gram[:, :, :count] + rest.mass[:, None, None] * np.diag(ridge)
    solved = np.linalg.solve(gram, rest.gram[:, :, count:])
    each = zip(pairwise(edges), solved, strict=True)
    return np.concatenate([features[a:b] @ s for (a, b), s in each])
