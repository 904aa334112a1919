"""What a marker does beyond its body's say and its own habit: the residual made white."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from markermend.arrays import BoolArray, FloatArray
from markermend.detectors.joint.loudness import loudness

LAGS, LEADS = 8, 3
BLOCK, AROUND = 50, 6
WHOLE_WEIGHT = 0.05
PASSES = 3
SIGMA_WINDOW = 65
DUST_MM = 0.002
CLIP = 6.0


@dataclass(frozen=True, eq=False)
class White:
    """Whitened residual of one coordinate.

    Attributes
    ----------
    error : (frames,) mm, the innovation
    sigma : (frames,) mm, its local standard deviation
    habit : (frames, 9) the filter that whitens: 1 and minus the own-lag coefficients
    """

    error: FloatArray
    sigma: FloatArray
    habit: FloatArray


def whiten(residual: FloatArray, movers: FloatArray, trusted: BoolArray) -> White:
    """Foretell a residual from its own past and from how its body moves, and keep the rest.

    Parameters
    ----------
    residual : (frames,) mm, measured minus predicted
    movers : (frames, k) what else may explain it, such as :func:`body_motion`
    trusted : (frames,) bool, samples that may be learned from

    Returns
    -------
    White. One filter every 50 frames, learned from 300 frames either side and, at low weight,
    from the whole take, never from its own block or those beside it.
    """
    frames = len(residual)
    residual = residual - np.median(residual)
    count = LAGS + movers.shape[1]
    both = np.empty((frames, count + 1))
    both[:, :LAGS] = sliding_window_view(np.pad(residual, (LAGS, 0)), LAGS)[:frames, ::-1]
    both[:, LAGS:count], both[:, count] = movers, residual
    away = both[:, :count] - np.full(frames, 1.0 / frames) @ both[:, :count]
    scale = np.maximum(np.sqrt(np.einsum("fc,fc->c", away, away) / frames), 1e-9)
    both[:, :count] /= scale
    blocks = max(1, frames // BLOCK)
    edges = np.linspace(0, frames, blocks + 1).astype(int)
    sizes = np.diff(edges)
    block_of = np.repeat(np.arange(blocks), sizes)
    # Blocks as long as the longest, the shorter ones with empty rows, are multiplied all at once.
    longest = int(sizes.max())
    row_of = np.arange(frames) + (longest * np.arange(blocks) - edges[:-1])[block_of]
    whole = np.zeros((blocks * longest, count + 1))
    whole[row_of] = both
    whole = whole.reshape(blocks, longest, count + 1)
    columns, weighted = whole[:, :, :count], np.empty((blocks, longest, count))
    weight, weight_of = trusted.astype(np.float64), np.zeros((blocks, longest))
    total = np.zeros((blocks + 1, count, count + 1))
    for _ in range(PASSES):
        weight_of.reshape(-1)[row_of] = weight
        np.multiply(columns, weight_of[:, :, None], out=weighted)
        np.cumsum(weighted.transpose(0, 2, 1) @ whole, axis=0, out=total[1:])
        own = _around(total, 1)
        gram = _around(total, AROUND) - own + WHOLE_WEIGHT * (total[-1] - own)
        diagonal = gram.reshape(blocks, -1)[:, :: count + 2]
        diagonal += 1e-5 * diagonal.mean(axis=1, keepdims=True) + 1e-12
        solved = np.linalg.solve(gram[:, :, :count], gram[:, :, count:])[:, :, 0]
        error = residual - (columns @ solved[:, :, None]).reshape(-1)[row_of]
        sigma = loudness(error, SIGMA_WINDOW) + DUST_MM
        weight = trusted / sigma**2 / np.maximum(1.0, np.abs(error) / (2.5 * sigma))
    # The first have no past to be foretold from.
    error[:LAGS] = 0.0
    habit = np.ones((frames, LAGS + 1))
    habit[:, 1:] = -(solved[:, :LAGS] / scale[:LAGS])[block_of]
    return White(error, sigma, habit)


def body_motion(body: FloatArray, *others: FloatArray) -> FloatArray:
    """Make what a residual may follow besides its own past.

    Parameters
    ----------
    body : (frames,) mm, one axis of the prediction
    others : (frames,) mm each, the same from other references

    Returns
    -------
    (frames, 7 + 2 len(others)) the body's velocity three frames back to three ahead; how far the
    others lie from it, and the velocity of that
    """
    moves = sliding_window_view(np.pad(np.gradient(body), LEADS, mode="edge"), 2 * LEADS + 1)
    apart = [other - body for other in others]
    return np.column_stack([moves, *apart, *(np.gradient(a) for a in apart)])


def _around(total: FloatArray, reach: int) -> FloatArray:
    """Sum over the blocks up to ``reach`` away, itself included, of sums of all before each."""
    at = np.arange(len(total) - 1)
    return np.asarray(total[np.minimum(at + reach + 1, len(at))] - total[np.maximum(at - reach, 0)])
