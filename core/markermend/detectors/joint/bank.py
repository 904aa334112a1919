"""Shapes of slow changes, and how well each fits at every frame of a whitened residual."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from markermend.arrays import Float32Array, FloatArray
from markermend.detectors.joint.bands import BANDS, HALF, filter_matrix, filters
from markermend.detectors.joint.whiten import LAGS
from markermend.simulation.contamination import triangle

SHORTEST, LONGEST = 22, 100
WIDTH = LONGEST + LAGS + 2 * HALF
STRIDE, KNOTS = 16, (22, 30, 40, 52, 66, 82, 100)
"""Norms change slowly: they are worked out every so manieth frame, for these lengths."""


KINDS: dict[str, int] = {"sharp": 0, "rounded 9": 9, "rounded 15": 15, "hann": 0}
"""What a slow change may look like, and over how many frames its kinks are rounded."""
STEPS = {"sharp": 1, "rounded 9": 4, "rounded 15": 6, "hann": 6}
"""Frames from one length to the next: a sharp kink forgives nothing, a round one more. What an odd
length adds to a smoothed recording is quite another thing than what an even one adds."""
LEAST_NORM = 0.02


@lru_cache(maxsize=1)
def bank() -> tuple[Float32Array, tuple[tuple[str, int], ...]]:
    """Make the shapes.

    Returns
    -------
    shapes : (longest, n) float32, height 1, from the first row on
    names : (kind, length in frames) of each
    """
    names = tuple(
        (kind, length)
        for kind, step in STEPS.items()
        for length in range(SHORTEST, LONGEST + 1, step)
    )
    columns = [np.pad(shape_of(*name), (0, LONGEST - name[1])) for name in names]
    return np.column_stack(columns).astype(np.float32), names


@lru_cache(maxsize=1024)
def shape_of(kind: str, length: int) -> FloatArray:
    """One shape of height 1, (length,); ``kind`` is a key of :data:`KINDS`.

    A triangle, its kinks sharp or smoothed by a Hann window of 9 or 15 frames, or one period of
    a raised cosine.
    """
    if kind == "hann":
        return np.asarray(np.hanning(length + 2)[1:-1])
    return triangle(length, KINDS[kind])


def _knots(length: int) -> tuple[int, ...]:
    """Lengths between which a norm is interpolated: one highest frame differs from two."""
    return tuple(min(k + 1, LONGEST - 1) for k in KNOTS) if length % 2 else KNOTS


@lru_cache(maxsize=1)
def _norms() -> tuple[FloatArray, FloatArray]:
    """Some shapes in bands, multiplied with themselves lagged; and how norms follow from them.

    Returns
    -------
    products : (bands, lags, width, some)
    share : (some, n) interpolates over lengths
    """
    _, names = bank()
    some = sorted({(kind, knot) for kind, length in names for knot in _knots(length)})
    rows = np.stack([np.pad(shape_of(*name), (HALF, WIDTH - HALF - name[1])) for name in some])
    parts = (rows @ filter_matrix(WIDTH)).reshape(len(some), BANDS, WIDTH)
    products = np.zeros((BANDS, LAGS + 1, WIDTH, len(some)))
    for lag in range(LAGS + 1):
        twice = 1.0 if lag == 0 else 2.0
        lagged = twice * parts[:, :, : WIDTH - lag] * parts[:, :, lag:]
        products[:, lag, lag:] = lagged.transpose(1, 2, 0)
    share = np.zeros((len(some), len(names)))
    for n, (kind, length) in enumerate(names):
        knots = _knots(length)
        for k, knot in enumerate(knots):
            share[some.index((kind, knot)), n] = np.interp(length, knots, np.eye(len(knots))[k])
    return products, share


def scores(parts: FloatArray, weight: FloatArray, habit: FloatArray) -> Float32Array:
    """Fit every shape at every frame, in single precision: what stands out is measured again.

    Parameters
    ----------
    parts, weight : (bands, frames) innovations and their inverse noise power
    habit : (frames, 9) the filter that whitens

    Returns
    -------
    (frames, n) signed signal-to-noise ratio of each shape that begins there; 0 for those that
    do not end within the take
    """
    shapes, names = bank()
    frames = len(habit)
    norm = _norm(weight, habit)
    habit = np.pad(habit, ((0, LAGS), (0, 0)))
    pulled = sum(
        np.convolve(e * w, taps, "same")
        for e, w, taps in zip(parts, weight, filters(), strict=True)
    )
    pulled = np.pad(np.asarray(pulled), (0, LAGS))
    push = np.zeros(frames)
    for k in range(LAGS + 1):
        push += habit[k : k + frames, k] * pulled[k : k + frames]
    push = np.pad(push, (0, LONGEST - 1)).astype(np.float32)
    windows = sliding_window_view(push, LONGEST)
    # In place: of arrays as large as these copying would take longer than reckoning.
    score = windows @ shapes
    score /= np.sqrt(norm, out=norm)
    last = np.arange(max(0, frames - LONGEST), frames)
    score[last] *= last[:, None] + np.array([n for _, n in names]) <= frames
    return np.asarray(score)


def _norm(weight: FloatArray, habit: FloatArray) -> Float32Array:
    """Variance of the matched filter of each shape at each frame, (frames, n)."""
    products, share = _norms()
    frames = weight.shape[1]
    # Windows begin half a filter before the shape does. Beyond the take all is as at its ends:
    # cut off, the lags of a slope would no longer cancel.
    long = frames + WIDTH
    precise = np.pad(weight, ((0, 0), (HALF, WIDTH + LAGS)), mode="edge")
    habit = np.pad(habit, ((HALF, WIDTH + LAGS), (0, 0)), mode="edge")
    thin = np.zeros((len(range(0, frames, STRIDE)), share.shape[0]))
    for lag in range(LAGS + 1):
        stiff = np.zeros((BANDS, long))
        for k in range(LAGS + 1 - lag):
            both = habit[k : k + long, k] * habit[k : k + long, k + lag]
            stiff += both * precise[:, k : k + long]
        windows = sliding_window_view(stiff, WIDTH, axis=1)[:, :frames:STRIDE]
        for b in range(BANDS):
            thin += windows[b] @ products[b, lag]
    norm = thin @ share
    # Where a filter changes within a shape, what it makes of slopes may cancel to nothing.
    norm = np.maximum(norm, np.maximum(LEAST_NORM * np.median(norm, axis=0), 1e-9))
    norm = norm.astype(np.float32)
    part = np.arange(STRIDE, dtype=np.float32)[:, None] / STRIDE
    further = np.diff(norm, axis=0, append=norm[-1:])
    between = part * further[:, None]
    between += norm[:, None]
    return np.asarray(between.reshape(-1, norm.shape[1])[:frames])


def local_level(score: Float32Array, inner: int = 60, outer: int = 250) -> FloatArray:
    """How large scores usually are around, over what white noise gives: (frames,), at least 0.7.

    The 80th percentile of ``score``, (frames, n) magnitudes, 60 to 250 frames away, over 1.28.
    """
    some = score[::10, ::3]
    at = np.arange(0, len(score), 25)
    sides = [(at + side) // 10 for side in (-outer, inner)]
    row = np.hstack([side[:, None] + np.arange((outer - inner) // 10) for side in sides])
    within = (row >= 0) & (row < len(some))
    around = some[np.where(within, row, 0)] * within[:, :, None]
    # Sorted, what is not there comes first, and so do scores of 0, which do not count.
    around = np.sort(around.reshape(len(at), -1), axis=1)
    count = np.count_nonzero(around, axis=1)
    place = around.shape[1] - count + (0.8 * count).astype(int)
    level = np.where(count > 0, around[np.arange(len(at)), place - (count == 0)] / 1.28, 1.0)
    return np.asarray(np.maximum(np.interp(np.arange(len(score)), at, level), 0.7))
