"""A marker foretold from its neighbours by fits that never saw the moment they foretell.

What a fit has seen of a drift it half believes. So every stretch is foretold by a fit without
itself and the stretches beside it; closed form, from Gram matrices added up by stretch.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, deviation_of_seen, samples_of
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
        others = m + 1 + np.flatnonzero(often)
        spread[m, others] = spread[others, m] = deviation_of_seen(apart[:, often].T)
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
    points = samples_of(positions, rows, references)
    points[~seen] = np.nan
    motion = align(points)
    inputs = complete(motion.to_local(points).reshape(len(rows), -1))
    goal = np.nan_to_num(motion.to_local(positions[rows, marker][:, None])[:, 0])
    features, ridge = expand(inputs, weight)
    count, frames = features.shape[1], len(rows)
    # The last block is filled up with rows that weigh nothing.
    filling = -frames % BLOCK
    both = np.zeros((frames + filling, count + COORDINATES))
    both[:frames, :count], both[:frames, count:] = features, goal
    both = both.reshape(-1, BLOCK, count + COORDINATES)

    def foretold(weight: FloatArray, *ridges: FloatArray) -> list[FloatArray]:
        each = np.pad(weight, (0, filling)).reshape(-1, BLOCK)
        return [said.reshape(-1, COORDINATES)[:frames] for said in left_out(both, each, ridges)]

    learnt = weight > 0
    first, best, error = np.inf, ridge, None
    stiffer = [factor * ridge for factor in STIFFER]
    for one, said in zip(stiffer, foretold(weight, *stiffer), strict=True):
        e = np.linalg.norm(goal - said, axis=1)
        middle = float(np.median(e[learnt]))
        cost = float(np.minimum(e[learnt], LARGEST * middle).mean())
        if cost < first:
            first, best, error = cost, one, e
    assert error is not None
    weight /= np.maximum(1.0, error / max(2.0 * float(np.median(error[learnt])), 1e-9))
    (local,) = foretold(weight, best)
    predicted[rows] = motion.to_lab(local[:, None])[:, 0]
    return predicted


def left_out(
    both: FloatArray, weight: FloatArray, ridges: Sequence[FloatArray]
) -> list[FloatArray]:
    """Weighted ridge regression, each block by a fit without it and the blocks beside it.

    Parameters
    ----------
    both : (blocks, BLOCK, features + 3) features beside the goal
    weight : (blocks, BLOCK)
    ridges : (features,) each, per unit of weight

    Returns
    -------
    With each ridge what is said of the goal, (blocks, BLOCK, 3)
    """
    from scipy.linalg.lapack import dposv

    blocks, count = len(both), both.shape[2] - COORDINATES
    weighted = both[:, :, :count] * weight[:, :, None]
    # What is before the first block and after the last weighs nothing.
    grams, masses = np.zeros((blocks + 2, count, count + COORDINATES)), np.zeros(blocks + 2)
    np.matmul(weighted.transpose(0, 2, 1), both, out=grams[1:-1])
    masses[1:-1] = weight.sum(axis=1)
    whole, mass = grams.sum(axis=0), masses.sum()
    fits = np.empty((len(ridges), blocks, count, COORDINATES))
    rest, left = np.empty_like(whole), np.empty((count, count))
    diagonal = left.reshape(-1)[:: count + 1]
    for b in range(blocks):
        np.subtract(whole, grams[b + 1], out=rest)
        rest -= grams[b]
        rest -= grams[b + 2]
        heavy = max(mass - float(masses[b : b + 3].sum()), 1.0)
        gram, right = rest[:, :count], rest[:, count:]
        for fit, ridge in zip(fits, ridges, strict=True):
            left[:] = gram
            diagonal += heavy * ridge
            # Turned, it lies as LAPACK wants it, and is not copied.
            _, fit[b], failed = dposv(left.T, right, lower=1, overwrite_a=1)
            if failed:
                fit[b] = np.linalg.solve(gram + np.diag(heavy * ridge), right)
    features = both[:, :, :count]
    return [np.asarray(features @ fit) for fit in fits]
