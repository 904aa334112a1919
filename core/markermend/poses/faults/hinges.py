"""A recording of rigid bones as turns of joints in their parents' axes, as files of angles are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from markermend.arrays import FloatArray, IntArray
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, multiply, turn

# Bones are rigid that stray by less; so many poses tell soon where they are not.
_RIGID_MM, _SOME = 0.05, 32


@dataclass(frozen=True, eq=False)
class Hinges:
    """Turns and bones that make up a recording, but for its root's way.

    Attributes
    ----------
    pose : the recording
    turns : (frames, joints, 4) in the axes of each joint's parent; NaN where not known
    bones : (joints, 3) mm from its parent to each joint; 0 for the root
    own : bones turn with the joint at their end (Acclaim), not with the one before (Biovision)
    """

    pose: Pose
    turns: FloatArray
    bones: FloatArray
    own: bool

    def placed(
        self, rows: slice, others: Mapping[int, FloatArray]
    ) -> tuple[FloatArray, FloatArray]:
        """Positions and rotations, (frames, joints, 3 and 4), of some frames.

        Parameters
        ----------
        rows : the frames
        others : turns, (frames, 4), that some joints have instead of theirs
        """
        positions, rotations = (
            np.array(part[rows]) for part in (self.pose.positions, self.pose.rotations)
        )
        for joint in self.pose.order:
            parent = self.pose.parents[joint]
            if parent < 0:
                continue
            turned = multiply(rotations[:, parent], others.get(joint, self.turns[rows, joint]))
            rotations[:, joint] = turned
            bone = np.broadcast_to(self.bones[joint], (len(turned), 3))
            along = turn(turned if self.own else rotations[:, parent], bone)
            positions[:, joint] = positions[:, parent] + along
        return positions, rotations

    def bridged(self, joint: int, rows: slice) -> FloatArray:
        """(frames, 4) turns of a joint from what it has before some frames to what after."""
        last = self.pose.frames - 1
        before, after = max(rows.start - 1, 0), min(rows.stop, last)
        ends = [n for n, there in ((before, rows.start > 0), (after, rows.stop <= last)) if there]
        known = self.turns[ends or [before], joint]
        if len(known) < 2:
            return np.tile(known[0], (rows.stop - rows.start, 1))
        path = Slerp([before, after], Rotation.from_quat(known))
        return np.asarray(path(np.arange(rows.start, rows.stop)).as_quat())


def hinges_of(pose: Pose) -> Hinges | None:
    """Take a recording apart; None where bones are not rigid, as those of sensors.

    Parameters
    ----------
    pose : positions and rotations of an AMC, a BVH or another file of angles
    """
    every = np.arange(pose.frames)
    some = every[:: max(pose.frames // _SOME, 1)]
    for own in (True, False):
        bones = None if _bones(pose, some, own) is None else _bones(pose, every, own)
        if bones is not None:
            above = np.maximum(np.asarray(pose.parents), 0)
            turns = multiply(inverse(pose.rotations[:, above]), pose.rotations)
            return Hinges(pose, turns, bones, own)
    return None


def _bones(pose: Pose, rows: IntArray, own: bool) -> FloatArray | None:
    """(joints, 3) bones where they are rigid in some poses, else None."""
    bones = np.zeros((len(pose.joints), 3))
    for joint, parent in enumerate(pose.parents):
        if parent < 0:
            continue
        along = pose.positions[rows, joint] - pose.positions[rows, parent]
        seen = turn(inverse(pose.rotations[rows, joint if own else parent]), along)
        seen = seen[~np.isnan(seen).any(axis=1)]
        if len(seen):
            bones[joint] = np.median(seen, axis=0)
            if np.abs(seen - bones[joint]).max() > _RIGID_MM:
                return None
    return bones
