"""How hidden joints hang on seen ones: how many bones away, and where their bones reach."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

import numpy as np

from markermend.arrays import FloatArray

_ROUNDS = 2

Bones = Sequence[tuple[int, int]]
"""Joint and parent of each bone, the upper ones first."""


def bones_more(bones: Bones, hidden: Collection[int]) -> float:
    """How many bones more than one hidden joints are from the nearest seen ones, on the mean.

    Parameters
    ----------
    bones : those of a body
    hidden : joints; 0 of none
    """
    if not hidden:
        return 0.0
    most = len(bones) + 1
    far = {end: most * (end in hidden) for bone in bones for end in bone}
    for way in (bones, bones[::-1]):
        for joint, parent in way:
            far[joint] = min(far[joint], far[parent] + 1)
            far[parent] = min(far[parent], far[joint] + 1)
    return sum(far.get(joint, 1) - 1 for joint in hidden) / len(hidden)


def with_bones(
    positions: FloatArray, bones: Bones, lengths: Sequence[float], shown: Sequence[bool]
) -> FloatArray:
    """Move joints that are not seen to where their bones reach.

    Bones on which no seen joint hangs come out as long as they are; between seen joints they are
    nearly so.

    Parameters
    ----------
    positions : (joints, 3) mm
    bones : those that are to keep their length
    lengths : (joints,) mm of the bone from each joint to its parent
    shown : (joints,) joints that stay where they are
    """
    loose = [(j, p) for j, p in bones if not (shown[j] and shown[p])]
    if not loose:
        return positions
    # Of so few numbers Python's own are faster.
    places = positions.tolist()
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
    carries = list(shown)
    for joint, parent in reversed(bones):
        carries[parent] = carries[parent] or carries[joint]
    for joint, parent in loose:
        if not carries[joint]:
            (x, y, z), (u, v, w) = places[joint], places[parent]
            bone = (x - u, y - v, z - w)
            share = lengths[joint] / (math.hypot(*bone) or 1.0)
            places[joint] = (u + share * bone[0], v + share * bone[1], w + share * bone[2])
    return np.array(places)
