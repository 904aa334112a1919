"""Joints that never have a rotation of their own, as depth sensors give the ends of chains.

Sensors that know no rotation at all leave it out, or write that nothing is ever turned.
"""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN

# How far from 1 the product of rotations may be that are one, for the digits they are written with.
_SAME = 1e-9


def turnless(pose: Pose) -> BoolArray:
    """(joints,) bool: the joint was seen, and never has a rotation."""
    return np.asarray(pose.seen.any(axis=0) & np.isnan(pose.rotations[..., 3]).all(axis=0))


def given_turns(rotations: FloatArray, seen: BoolArray) -> BoolArray:
    """(joints,) bool: of one pose, joints that were seen with a rotation.

    Parameters
    ----------
    rotations : (joints, 4); 0 or NaN of a joint that has none
    seen : (joints,) bool
    """
    return np.asarray(seen & np.isfinite(rotations).all(axis=1) & (rotations != 0).any(axis=1))


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


def without_one_turn(pose: Pose) -> Pose:
    """The same without rotations, if those of all joints in all frames are one, which tells none.

    Taken for measured they would be noiseless, and positions beside them no noisier.
    """
    known = pose.rotations[~np.isnan(pose.rotations[..., 3])]
    if not len(known) or (np.abs(np.abs(known @ known[0]) - 1.0) > _SAME).any():
        return pose
    return pose.with_samples(pose.positions, np.full(pose.rotations.shape, np.nan), pose.confidence)


def with_one_turn(pose: Pose, turned: Pose) -> Pose:
    """The same with the rotations of a recording whose rotations are all one.

    Parameters
    ----------
    pose : without rotations
    turned : of the same frames and joints
    """
    known = ~np.isnan(turned.rotations[..., 3])
    rotations = np.where(known[..., None], turned.rotations, turned.rotations[known][0])
    return pose.with_samples(pose.positions, rotations, pose.confidence)
