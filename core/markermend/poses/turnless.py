"""Joints that never have a rotation of their own, as depth sensors give the ends of chains."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN


def turnless(pose: Pose) -> BoolArray:
    """(joints,) bool: the joint was seen, and never has a rotation."""
    return np.asarray(pose.seen.any(axis=0) & np.isnan(pose.rotations[..., 3]).all(axis=0))


def turned_as_parents(pose: Pose, without: BoolArray | None = None) -> Pose:
    """The same with joints that never have a rotation turned as their parents are.

    A root without one stays unturned.

    Parameters
    ----------
    pose : the recording
    without : (joints,) bool, those that never have one, where the recording that this is a part
        of tells
    """
    rotations = np.array(pose.rotations)
    without = turnless(pose) if without is None else without
    for joint in pose.order:
        if without[joint]:
            parent = pose.parents[joint]
            rotations[:, joint] = rotations[:, parent] if parent >= 0 else NO_TURN
    return pose.with_samples(pose.positions, rotations, pose.confidence)
