"""Shapes of slow changes, and how well each fits at every frame of a whitened residual."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from markermend.arrays import FloatArray
from markermend.detectors.joint.whiten import CLIP, LAGS, White

SHORTEST, LONGEST = 22, 100
STRIDE = 4
"""Norms change slowly: they are worked out every fourth frame."""


@lru_cache(maxsize=1)
def bank() -> tuple[FloatArray, tuple[tuple[str, int], ...]]:
    """Make the shapes.

    Returns
    -------
    shapes : (longest, n) float64, height 1, from the first row on
    names : (kind, length in frames) of each: sharp, rounded triangles and Hann
    """
    names: list[tuple[str, int]] = []
    columns = []
    for kind, step in (("sharp", 2), ("rounded", 4), ("hann", 4)):
        for length in range(SHORTEST, LONGEST + 1, step):
            names.append((kind, length))
            columns.append(np.pad(shape_of(kind, length), (0, LONGEST - length)))
    return np.column_stack(columns), tuple(names)


def shape_of(kind: str, length: int) -> FloatArray:
    """One shape of height 1, (length,): ``sharp``, ``rounded`` over 11 frames, or ``hann``."""
    if kind == "hann":
        return np.asarray(np.hanning(length + 2)[1:-1])
    if kind == "rounded":
        smooth = np.hanning(13)[1:-1]
        inner = _triangle(max(length - 10, 3))
        rounded = np.convolve(inner, smooth / smooth.sum())[:length]
        rounded = np.pad(rounded, (0, length - len(rounded)))
        return np.asarray(rounded / rounded.max())
    return _triangle(length)


def _triangle(length: int) -> FloatArray:
    """Symmetric triangle of height 1, nowhere zero."""
    ramp = np.arange(1, length + 1, dtype=np.float64)
    return np.asarray(np.minimum(ramp, ramp[::-1]) / ((length + 1) // 2))


def scores(white: White) -> tuple[FloatArray, FloatArray]:
    """Fit every shape at every frame.

    Parameters
    ----------
    white : whitened residual of (frames,)

    Returns
    -------
    score : (frames, n) signed signal-to-noise ratio of each shape that begins there
    size : (frames, n) mm, its fitted height; shapes that do not end within the take have 0
    """
    shapes, names = bank()
    push, stiffness = adjoint(white)
    numerator = _correlate(push, shapes)
    thin = np.zeros((len(range(0, len(push), STRIDE)), shapes.shape[1]))
    for lag in range(LAGS + 1):
        shifted = np.zeros_like(shapes)
        shifted[: len(shapes) - lag] = shapes[: len(shapes) - lag] * shapes[lag:]
        thin += (1 if lag == 0 else 2) * _correlate(stiffness[:, lag], shifted, STRIDE)
    at = np.minimum(np.arange(len(push)) / STRIDE, len(thin) - 1)
    low = np.minimum(at.astype(int), len(thin) - 2) if len(thin) > 1 else np.zeros(len(push), int)
    high = np.minimum(low + 1, len(thin) - 1)
    share = (at - low)[:, None]
    norm = np.maximum(thin[low] * (1 - share) + thin[high] * share, 1e-9)
    lengths = np.array([length for _, length in names])
    inside = np.arange(len(push))[:, None] + lengths <= len(push)
    score = np.where(inside, numerator / np.sqrt(norm), 0.0)
    return score, np.where(inside, numerator / norm, 0.0)


def adjoint(white: White) -> tuple[FloatArray, FloatArray]:
    """Turn innovations into what a shape is correlated with, and the quadratic form of its norm.

    Returns
    -------
    push : (frames,) so that Σ shape · push is the matched filter's output
    stiffness : (frames, 9) diagonals of the banded form whose value is its variance
    """
    frames = len(white.error)
    clipped = np.clip(white.error, -CLIP * white.sigma, CLIP * white.sigma)
    precision = 1.0 / white.sigma**2
    habit = np.pad(white.habit, ((0, LAGS), (0, 0)))
    pulled = np.pad(clipped * precision, (0, LAGS))
    precise = np.pad(precision, (0, LAGS))
    push = np.zeros(frames)
    stiffness = np.zeros((frames, LAGS + 1))
    for k in range(LAGS + 1):
        later = slice(k, k + frames)
        push += habit[later, k] * pulled[later]
        for lag in range(k + 1):
            stiffness[:, lag] += habit[later, k] * habit[later, k - lag] * precise[later]
    return push, stiffness


def _correlate(signal: FloatArray, shapes: FloatArray, stride: int = 1) -> FloatArray:
    """Σ_j signal[t + j] · shapes[j] for every ``stride``-th t, (frames, n)."""
    windows = sliding_window_view(np.pad(signal, (0, len(shapes) - 1)), len(shapes))[::stride]
    return np.asarray(windows @ shapes)


def local_level(score: FloatArray, inner: int = 60, outer: int = 250) -> FloatArray:
    """How large scores usually are around, over what white noise gives: (frames,), at least 0.7.

    The 80th percentile of magnitudes 60 to 250 frames away, over 1.28.
    """
    some = np.abs(score[::5, ::5])
    frames = len(score)
    level = np.empty(len(range(0, frames, 25)))
    for n, t in enumerate(range(0, frames, 25)):
        left = some[max(0, (t - outer) // 5) : max(0, (t - inner) // 5)]
        right = some[(t + inner) // 5 : (t + outer) // 5]
        around = np.concatenate([left, right]).ravel()
        around = around[around > 0]
        level[n] = np.quantile(around, 0.8) / 1.28 if len(around) else 1.0
    return np.asarray(
        np.maximum(np.interp(np.arange(frames), np.arange(0, frames, 25), level), 0.7)
    )
