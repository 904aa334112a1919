"""Recordings that a prior remembers, to ask them where a body moves alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.arrays import BoolArray, Float32Array, FloatArray, IntArray
from markermend.poses.filling.covariance import signs_like
from markermend.poses.filling.likeness import moving
from markermend.poses.normal import FEATURES

REMEMBERED_HZ = 30.0
"""Rate at which recordings are remembered."""

# Poses that are remembered at most, ten minutes: to keep more takes longer than it gains.
_MOST = 18_000
# Lengths of one performer's bones, over their mean, differ by less than this (root mean square);
# those of the CMU database's first three people by 0.04 to 0.07. Who is taken for another by
# mistake tells a little, too.
_SAME_BODY = 0.035
# So much of a body must be known to tell it from others.
_LEAST_BONES, _LEAST_SHARE = 3, 0.5
# Moments of all recordings that the nearest ones are looked for among.
_LOOKED_AT = 2000
# Places in a gap that moments are near to.
_PROBES = 6


@dataclass(frozen=True, eq=False)
class Remembered:
    """One recording that a prior remembers.

    Attributes
    ----------
    poses : (frames, joints · 7 + beside) at :data:`REMEMBERED_HZ`, without NaN: joints but the
        root, then what :func:`markermend.poses.filling.stance.stance` tells
    bones : (joints,) length of each joint's bone, over their mean
    """

    poses: Float32Array
    bones: Float32Array

    def of_body(self, bones: FloatArray) -> bool:
        """Whether a body with such bones is the same.

        Parameters
        ----------
        bones : (joints,) their lengths in any unit; NaN for those that are not known
        """
        known = ~np.isnan(bones)
        if known.sum() < _LEAST_BONES or known.mean() < _LEAST_SHARE:
            return False
        own, its = (x[known] / x[known].mean() for x in (self.bones, bones))
        return float(np.sqrt(np.mean((own - its) ** 2))) < _SAME_BODY

    def of(self, columns: IntArray) -> Remembered:
        """The same with some of the joints' columns, or all in another order.

        Parameters
        ----------
        columns : (joints · 7,) seven in a row of each joint
        """
        joints = columns[::FEATURES] // FEATURES
        count = FEATURES * len(self.bones)
        beside = np.arange(count, self.poses.shape[1])
        return Remembered(self.poses[:, np.append(columns, beside)], self.bones[joints])

    def some(self, kept: BoolArray) -> Remembered:
        """The same with some columns alone, for (columns,) bool."""
        return replace(self, poses=self.poses[:, kept])

    def signed_like(self, values: FloatArray) -> Remembered:
        """The same with the signs of rotations that others have: of q and -q the nearer one.

        Parameters
        ----------
        values : (joints · 7,) a pose or a mean; 0 where it tells nothing
        """
        count, poses = len(values), self.poses.copy()
        poses[:, :count] *= signs_like(poses[:, :count].mean(axis=0), values).astype(np.float32)
        return replace(self, poses=poses)


def shortened(recordings: Sequence[Remembered]) -> tuple[Remembered, ...]:
    """So much of recordings as is remembered: of each an equal share, from its middle."""
    whole = sum(len(one.poses) for one in recordings)
    found = []
    for one in recordings:
        frames = len(one.poses)
        kept = min(frames, frames * _MOST // max(whole, 1)) if whole > _MOST else frames
        first = (frames - kept) // 2
        if kept:
            found.append(replace(one, poses=one.poses[first : first + kept]))
    return tuple(found)


def resampled(poses: FloatArray | Float32Array, rate: float, wanted: float) -> Float32Array:
    """(frames, columns) at another rate, on straight lines between poses.

    Parameters
    ----------
    poses : (frames, columns) without NaN
    rate, wanted : frames per second
    """
    times = np.arange(int((len(poses) - 1) * wanted / rate) + 1) * (rate / wanted)
    first = np.minimum(times.astype(int), max(len(poses) - 2, 0))
    share = (times - first).astype(np.float32)[:, None]
    single = np.asarray(poses, dtype=np.float32)
    after = np.minimum(first + 1, len(poses) - 1)
    return np.asarray((1 - share) * single[first] + share * single[after], dtype=np.float32)


@dataclass(frozen=True, eq=False)
class Performances:
    """What is remembered of whom a recording shows, or of others, at its rate and in its columns.

    Attributes
    ----------
    paths : (frames, columns) each
    which, frames : (moments,) those that are looked at: of which path, and when
    moved : (moments, 2 · columns) rows of :func:`markermend.poses.filling.likeness.moving`
    """

    paths: tuple[Float32Array, ...]
    which: IntArray
    frames: IntArray
    moved: Float32Array

    def nearest(
        self, moved: Float32Array, trust: Float32Array, most: int
    ) -> list[tuple[int, IntArray]]:
        """Moments that are nearest to a gap's poses: places in ``moved``, path by path.

        Parameters
        ----------
        moved : (length, 2 · columns) rows of :func:`markermend.poses.filling.likeness.moving` in
            the gap
        trust : (columns,) how much each counts
        most : moments
        """
        counts = np.tile(trust, 2) ** 2
        some = moved[np.unique(np.linspace(0, len(moved) - 1, _PROBES).astype(int))]
        squared = (self.moved**2 @ counts)[:, None] - 2 * (self.moved @ (some * counts).T)
        squared += np.sum(some**2 * counts, axis=1)
        near = squared.min(axis=1)
        chosen = np.arange(len(near))
        if len(near) > most:
            chosen = np.sort(np.argpartition(near, most)[:most])
        return [
            (int(path), chosen[self.which[chosen] == path])
            for path in np.unique(self.which[chosen])
        ]


def performances(recordings: Sequence[Remembered], rate: float) -> Performances | None:
    """Lay remembered recordings out as one of a rate is restored; None where there are none."""
    paths = tuple(resampled(one.poses, REMEMBERED_HZ, rate) for one in recordings)
    if not paths:
        return None
    step = max(-(-sum(map(len, paths)) // _LOOKED_AT), 1)
    frames = [np.arange(0, len(path), step) for path in paths]
    which = np.repeat(np.arange(len(paths)), [len(some) for some in frames])
    moved = [moving(path, rate, some) for path, some in zip(paths, frames, strict=True)]
    return Performances(paths, which, np.concatenate(frames), np.vstack(moved))
