"""Distances that hardly change, and pulling guessed positions towards them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray

# Markers of a segment keep their distance to a few millimetres, and within a share of it.
LEAST_SPREAD_MM, MOST_SPREAD_MM, MOST_SHARE = 1.0, 15.0, 0.1
# A marker is held by so many others at most.
MOST_BONES = 4
# Too few frames with both markers say nothing about their distance.
LEAST_FRAMES = 20
STEPS = 6


@dataclass(frozen=True, eq=False)
class Bones:
    """Pairs of markers of nearly constant distance.

    Attributes
    ----------
    ends : (k, 2) columns
    length : (k,) mm
    spread : (k,) standard deviation of the length, mm
    """

    ends: IntArray
    length: FloatArray
    spread: FloatArray


def find_bones(positions: FloatArray, known: BoolArray) -> Bones:
    """Pairs of markers that keep their distance.

    Parameters
    ----------
    positions : (n, m, 3) mm
    known : (n, m) bool
    """
    markers = positions.shape[1]
    found: dict[tuple[int, int], tuple[float, float]] = {}
    for i in range(markers):
        both = known[:, [i]] & known
        distance = np.where(both, np.linalg.norm(positions - positions[:, [i]], axis=2), np.nan)
        usable = both.sum(axis=0) >= LEAST_FRAMES
        usable[i] = False
        columns = np.flatnonzero(usable)
        length = np.nanmean(distance[:, columns], axis=0)
        spread = np.nanstd(distance[:, columns], axis=0)
        for k in np.argsort(spread, kind="stable")[:MOST_BONES]:
            if spread[k] <= min(MOST_SPREAD_MM, MOST_SHARE * length[k]):
                pair = (min(i, int(columns[k])), max(i, int(columns[k])))
                found[pair] = (float(length[k]), max(float(spread[k]), LEAST_SPREAD_MM))
    sizes = np.array(list(found.values())).reshape(-1, 2)
    return Bones(np.array(list(found), dtype=np.int64).reshape(-1, 2), sizes[:, 0], sizes[:, 1])


def pull(positions: FloatArray, doubt: FloatArray, missing: BoolArray, bones: Bones) -> FloatArray:
    """Move guessed markers until lengths and guesses agree best.

    Parameters
    ----------
    positions : (n, m, 3) mm; guesses where missing
    doubt : (n, m) standard deviation of a guess's coordinate, mm
    missing : (n, m) bool, markers that may move
    bones : lengths to come near to

    Returns
    -------
    (n, m, 3) mm

    Notes
    -----
    Minimises Σ ‖x − x̂‖² / doubt² + Σ (‖xᵢ − xⱼ‖ − length)² / spread² by Gauss–Newton: the soft
    constraints of BoLeRO (li2010) with the data's own variances as weights.
    """
    result = positions.copy()
    patterns, which = np.unique(missing, axis=0, return_inverse=True)
    for i, pattern in enumerate(patterns):
        moving = np.flatnonzero(pattern)
        held = pattern[bones.ends].any(axis=1) if len(bones.ends) else np.zeros(0, dtype=bool)
        if held.any():
            rows = np.flatnonzero(which.ravel() == i)
            chosen = Bones(bones.ends[held], bones.length[held], bones.spread[held])
            result[rows] = _settle(positions[rows], doubt[rows], moving, chosen)
    return result


def _settle(positions: FloatArray, doubt: FloatArray, moving: IntArray, bones: Bones) -> FloatArray:
    """Gauss–Newton over frames in which the same markers move."""
    n, m = len(positions), len(moving)
    place = np.full(positions.shape[1], -1)
    place[moving] = np.arange(m)
    trust = np.repeat(1.0 / doubt[:, moving] ** 2, 3, axis=1)
    guess, now = positions[:, moving].reshape(n, -1), positions.copy()
    diagonal = np.arange(3 * m)
    for _ in range(STEPS):
        normal = np.zeros((n, 3 * m, 3 * m))
        normal[:, diagonal, diagonal] = trust
        x = now[:, moving].reshape(n, -1)
        slope = trust * (guess - x)
        for (a, b), length, spread in zip(bones.ends, bones.length, bones.spread, strict=True):
            apart = now[:, a] - now[:, b]
            far = np.linalg.norm(apart, axis=1)
            along = apart / np.maximum(far, 1e-6)[:, None]
            miss = (length - far)[:, None] * along / spread**2
            block = along[:, :, None] * along[:, None, :] / spread**2
            ends = [(place[a], 1.0), (place[b], -1.0)]
            inside = [(slice(3 * k, 3 * k + 3), sign) for k, sign in ends if k >= 0]
            for one, sign in inside:
                slope[:, one] += sign * miss
                for other, turned in inside:
                    normal[:, one, other] += sign * turned * block
        x = x + np.linalg.solve(normal, slope[:, :, None])[:, :, 0]
        now[:, moving] = x.reshape(n, m, 3)
    return now
