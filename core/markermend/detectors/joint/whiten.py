"""What a marker does beyond its body's say and its own habit: the residual made white."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from markermend.arrays import BoolArray, FloatArray

LAGS, LEADS = 8, 3
BLOCK, AROUND = 50, 6
WHOLE_WEIGHT = 0.05
PASSES = 3
SIGMA_WINDOW, STRIDE = 65, 8
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
    past = sliding_window_view(np.pad(residual, (LAGS, 0)), LAGS)[:frames, ::-1]
    columns = np.hstack([past, movers])
    scale = np.maximum(columns.std(axis=0), 1e-9)
    columns = columns / scale
    both = np.hstack([columns, residual[:, None]])
    count = columns.shape[1]
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
    weight, weighted = trusted.astype(np.float64), np.zeros((blocks, longest, count))
    for _ in range(PASSES):
        weighted.reshape(-1, count)[row_of] = columns * weight[:, None]
        grams = weighted.transpose(0, 2, 1) @ whole
        total = np.cumsum(np.concatenate([np.zeros_like(grams[:1]), grams]), axis=0)
        own = _around(total, 1)
        gram = _around(total, AROUND) - own + WHOLE_WEIGHT * (total[-1] - own)
        left = gram[:, :, :count]
        size = np.trace(left, axis1=1, axis2=2) / count
        left = left + (1e-5 * size + 1e-12)[:, None, None] * np.eye(count)
        solved = np.linalg.solve(left, gram[:, :, count:])[:, :, 0]
        error = residual - (whole[:, :, :count] @ solved[:, :, None]).reshape(-1)[row_of]
        sigma = _local_sigma(error)
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


def _local_sigma(error: FloatArray) -> FloatArray:
    """Robust standard deviation over 65 frames, worked out every eighth, (frames,) mm."""
    half = SIGMA_WINDOW // 2
    windows = sliding_window_view(np.pad(np.abs(error), half, mode="reflect"), SIGMA_WINDOW)
    middle = np.partition(windows[::STRIDE], half, axis=1)[:, half]
    level = middle / 0.6745 + DUST_MM
    frames = np.arange(len(error))
    return np.asarray(np.interp(frames, frames[::STRIDE], level))


def _around(total: FloatArray, reach: int) -> FloatArray:
    """Sum over the blocks up to ``reach`` away, itself included, of sums of all before each."""
    at = np.arange(len(total) - 1)
    return np.asarray(total[np.minimum(at + reach + 1, len(at))] - total[np.maximum(at - reach, 0)])
