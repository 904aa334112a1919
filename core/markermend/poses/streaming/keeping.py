"""Keep bones as long as they are where one of their ends is filled."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from markermend.arrays import BoolArray, FloatArray

_ROUNDS = 2


def with_bones(
    positions: FloatArray,
    seen: BoolArray,
    bones: Sequence[tuple[int, int]],
    bone_lengths: FloatArray,
) -> FloatArray:
    """Move joints that are not seen to where their bones reach.

    Parameters
    ----------
    positions : (joints, 3) of one pose, mm
    seen : (joints,) bool, joints that stay
    bones : joint and parent of each
    bone_lengths : (joints,) mm, to the parent
    """
    loose = [(j, p) for j, p in bones if not (seen[j] and seen[p])]
    if not loose:
        return positions
    # Of so few numbers Python's own are faster.
    places, lengths, shown = positions.tolist(), bone_lengths.tolist(), seen.tolist()
    for joint, parent in loose * _ROUNDS:
        (x, y, z), (u, v, w) = places[joint], places[parent]
        bone = (x - u, y - v, z - w)
        share = lengths[joint] / (math.hypot(*bone) or 1.0) - 1.0
        if not (shown[joint] or shown[parent]):
            share *= 0.5
        i, j, k = (share * way for way in bone)
        if not shown[joint]:
            places[joint] = (x + i, y + j, z + k)
        if not shown[parent]:
            places[parent] = (u - i, v - j, w - k)
    return np.array(places)
