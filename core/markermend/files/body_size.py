"""The unit of a skeleton recording that tells none, by how large a body is."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import FloatArray
from markermend.files.units import MILLIMETRES
from markermend.poses.nuitrack import twins
from markermend.poses.pose import parents_first

# From foot to hand along bones a body is 1.25 to 1.5 times as long as it is tall. So, between
# persons of 1.1 m and 2 m, each unit has lengths of its own: up to the number that stands here.
# Most BVH files of the CMU database are in the units of its skeletons, of 1/0.45 inches.
_UNITS = (
    (10.0, 1000.0, "metres"),
    (54.0, MILLIMETRES["in"] / 0.45, "1/0.45 inches (as in files of the CMU database)"),
    (129.0, MILLIMETRES["in"], "inches"),
    (648.0, 10.0, "centimetres"),
    (np.inf, 1.0, "millimetres"),
)


def unit_of_body(
    lengths: FloatArray, parents: tuple[int, ...], joints: Sequence[str]
) -> tuple[float, str] | None:
    """Which unit lengths of bones are in.

    Parameters
    ----------
    lengths : (joints,) of the bone to each one's parent, NaN where it is not known
    parents : index of each joint's parent, -1 for a root
    joints : their names, which tell left from right

    Returns
    -------
    Millimetres in it, and its name; None where there is no whole body: its farthest joints are to
    be of an arm and of a leg, which begin at different joints. Of less, as an upper body or a hand,
    the size does not tell.

    Raises
    ------
    DataError
        when parents do not make a tree
    """
    bones = np.nan_to_num(lengths).tolist()
    order = parents_first(parents, tuple(joints))
    ends, far = (-1, -1), 0.0
    for root in (joint for joint in order if parents[joint] < 0):
        one, _ = _farthest(root, bones, parents, order)
        other, length = _farthest(one, bones, parents, order)
        if length > far:
            ends, far = (one, other), length
    if not far:
        return None
    twin = twins(joints)
    first, second = (_begins(joint, twin, parents) for joint in ends)
    if first is None or second is None or first == second:
        return None
    return next((mm, name) for most, mm, name in _UNITS if far < most)


def _farthest(
    start: int, bones: list[float], parents: tuple[int, ...], order: Sequence[int]
) -> tuple[int, float]:
    """The joint that is farthest along bones from one, and how far."""
    away, joint = {start: 0.0}, start
    while parents[joint] >= 0:
        away[parents[joint]] = away[joint] + bones[joint]
        joint = parents[joint]
    for below in order:
        if below not in away and parents[below] in away:
            away[below] = away[parents[below]] + bones[below]
    last = max(away, key=lambda one: away[one])
    return last, away[last]


def _begins(joint: int, twin: list[int], parents: tuple[int, ...]) -> int | None:
    """Where the limb that a joint is of hangs on what has no side; None for the trunk and head."""
    found = None
    while joint >= 0:
        if twin[joint] != joint:
            found = parents[joint]
        joint = parents[joint]
    return found
