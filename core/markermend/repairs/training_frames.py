"""Frames of a take from which a regression learns how a marker follows its body.

Time grows with the cube of their number, so they are chosen: densely beside the interval, then
an even sample of the rest of the take, then those in which the body is most as it is in the
interval. In a movement that is rare in the take an even sample has hardly a frame of it.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, samples_of
from markermend.artifact import Artifact
from markermend.progress import heed

# Within so many seconds of the interval every frame is learnt from, further away every second and
# then every fourth: they tell nearly the same.
DENSE_S, HALF_DENSE_S = 0.1, 0.25
# Likeness is judged by the distances among so many of the nearest references, on every fourth
# frame, to so many frames of the interval.
LIKE_BY, STRIDE, WITHIN = 8, 4, 6
LEAST_MM = 1e-6


def choose_frames(
    usable: BoolArray,
    near: BoolArray,
    artifact: Artifact,
    rate: float,
    positions: FloatArray,
    references: IntArray,
    *,
    even: int,
    alike: int,
) -> IntArray:
    """Choose frames to learn from.

    Parameters
    ----------
    usable : (frames,) bool, in which the marker and all references are seen
    near : (frames,) bool, those beside the interval
    artifact : the interval
    rate : frames per second
    positions : (frames, markers, 3) mm
    references : columns, the nearest first, seen where usable and all through the interval
    even : about so many from the rest of the take, evenly spaced
    alike : at most so many more, in which the references lie as they do in the interval

    Returns
    -------
    (k,) frames in order
    """
    frames = np.flatnonzero(usable & near)
    away = np.maximum(artifact.start - frames, frames - artifact.stop + 1) / rate
    every = np.where(away <= DENSE_S, 1, np.where(away <= HALF_DENSE_S, 2, 4))
    beside = frames[frames % every == 0]
    rest = np.flatnonzero(usable & ~near)
    step = max(1, len(rest) // even)
    spaced = rest[step // 2 :: step]
    others = np.setdiff1d(rest[::STRIDE], spaced, assume_unique=True)
    count = min(WITHIN, artifact.length)
    asked = np.linspace(artifact.start, artifact.stop - 1, count).round().astype(np.int64)
    likest = others[_most_alike(positions, references[:LIKE_BY], others, asked, alike // count)]
    return np.sort(np.concatenate([beside, spaced, likest]))


def near_interval(frames: int, artifact: Artifact, margin: float) -> BoolArray:
    """(frames,) bool, which lie within a margin of the interval, both in frames."""
    at = np.arange(frames)
    return np.asarray((at >= artifact.start - margin) & (at < artifact.stop + margin))


def _most_alike(
    positions: FloatArray, references: IntArray, others: IntArray, asked: IntArray, count: int
) -> IntArray:
    """Places in `others` of the `count` frames most like each of those asked for, each once."""
    if count == 0 or len(others) == 0:
        return np.zeros(0, dtype=np.int64)
    points = samples_of(positions, np.concatenate([others, asked]), references).transpose(1, 0, 2)
    points = np.ascontiguousarray(points)
    pairs = list(combinations(points, 2))
    apart = np.empty((len(pairs), points.shape[1]))
    # Pair by pair, since arrays of all pairs at once do not fit where they would be quick.
    for row, (one, other) in zip(apart, pairs, strict=True):
        heed()
        way = one - other
        np.einsum("fk,fk->f", way, way, out=row)
    np.sqrt(apart, out=apart)
    apart /= apart.std(axis=1, keepdims=True) + LEAST_MM
    known, wanted = apart[:, : len(others)], apart[:, len(others) :]
    unlike = np.einsum("pf,pf->f", known, known) - 2.0 * wanted.T @ known
    count = min(count, len(others))
    return np.unique(np.argpartition(unlike, count - 1, axis=1)[:, :count])
