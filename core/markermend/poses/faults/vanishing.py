"""Joints at exactly 0, 0, 0: where many programs put those that were not seen."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.pose import parents_first

# Two joints no further apart than by noise of computing stand at one place, mm.
_SAME = 1e-6


def vanished(positions: FloatArray, parents: tuple[int, ...], joints: tuple[str, ...]) -> BoolArray:
    """Joints that are at exactly 0, 0, 0 and cannot be there.

    A root may stand there, and so may a joint whose bone to its parent never has a length, with
    that: in hierarchies some joints only give others an axis more to turn about.

    Parameters
    ----------
    positions : (frames, joints, 3) mm, NaN where a joint was not seen
    parents : index of each joint's parent, -1 for a root
    joints : their names

    Returns
    -------
    (frames, joints) bool

    Raises
    ------
    DataError
        when parents do not make a tree
    """
    zero = np.asarray((positions == 0).all(axis=2))
    gone = zero.copy()
    for joint in parents_first(parents, joints):
        parent = parents[joint]
        if parent < 0:
            gone[:, joint] = False
        elif zero[:, joint].any():
            apart = np.abs(positions[:, joint] - positions[:, parent]).max(axis=1)
            if not (apart > _SAME).any():
                gone[:, joint] &= ~zero[:, parent] | gone[:, parent]
    return gone
