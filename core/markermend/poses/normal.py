"""Poses of any person and sensor made comparable, and back (goncalves2024, 3.2.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import DataError
from markermend.poses.nuitrack import JOINTS, PARENT_OF, aligned_axis, usual_name
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN, inverse, multiply, turn, unit

FEATURES = 7
"""Of a joint: position x, y, z and rotation x, y, z, w."""


@dataclass(frozen=True, eq=False)
class Normal:
    """What normalisation took away, to be given back.

    Attributes
    ----------
    root : index of the joint everything is relative to
    position : (frames, 3) of the root, mm
    rotation : (frames, 4) of the root as aligned
    scale : mean bone length, mm
    offset : (joints, 4) rotation from each joint's own axes to its aligned ones
    """

    root: int
    position: FloatArray
    rotation: FloatArray
    scale: float
    offset: FloatArray


def normalise(pose: Pose) -> tuple[FloatArray, Normal]:
    """Express a recording relative to its root, over its mean bone length, axes aligned.

    Parameters
    ----------
    pose : a recording whose root is known in every frame

    Returns
    -------
    features : (frames, joints, 7) position over mean bone length and rotation, both in the root's
        axes; the root's own are 0, 0, 0, 0, 0, 0, 1. NaN where a joint was not seen. Signs of the
        quaternions are as they come.
    normal : for :func:`denormalise`

    Raises
    ------
    DataError
        when no bone was ever seen
    """
    root = pose.order[0]
    bones = bone_lengths(pose.positions, pose.parents)
    lengths = bones[[j for j, parent in enumerate(pose.parents) if parent >= 0]]
    if not len(lengths) or np.isnan(lengths).all() or np.nanmean(lengths) == 0:
        raise DataError(
            "No bone of this recording was ever seen whole; a joint and the one that it hangs on"
            " must be seen in one pose."
        )
    scale = float(np.nanmean(lengths))
    offset = _offsets(pose)
    turned = multiply(pose.rotations, offset)
    normal = Normal(root, pose.positions[:, root], turned[:, root], scale, offset)
    back = inverse(normal.rotation)[:, None]
    places = turn(back, pose.positions - normal.position[:, None]) / scale
    return np.concatenate([places, multiply(back, turned)], axis=2), normal


def denormalise(features: FloatArray, normal: Normal) -> tuple[FloatArray, FloatArray]:
    """Return positions in mm and unit rotations, global: the exact inverse.

    Parameters
    ----------
    features : (frames, joints, 7)
    normal : of the same frames
    """
    forth = normal.rotation[:, None]
    positions = turn(forth, features[..., :3] * normal.scale) + normal.position[:, None]
    rotations = multiply(multiply(forth, unit(features[..., 3:])), inverse(normal.offset))
    return positions, rotations


def bone_lengths(positions: FloatArray, parents: tuple[int, ...]) -> FloatArray:
    """Median length of each joint's bone to its parent, NaN for roots and bones never seen.

    Parameters
    ----------
    positions : (frames, joints, 3)
    parents : index of each joint's parent, -1 for a root
    """
    lengths = np.full(len(parents), np.nan)
    for joint, parent in enumerate(parents):
        if parent >= 0:
            far = np.sqrt(np.sum((positions[:, joint] - positions[:, parent]) ** 2, axis=1))
            far = far[~np.isnan(far)]
            lengths[joint] = np.median(far) if len(far) else np.nan
    return lengths


def _offsets(pose: Pose) -> FloatArray:
    """(joints, 4) constant rotation that lays each joint's bone along its axis."""
    offsets = np.tile(NO_TURN, (len(pose.joints), 1))
    usual = [usual_name(name) for name in pose.joints]
    # Of several children the first of Nuitrack's order, in whatever order the file has them.
    by_rank = sorted(
        range(len(usual)),
        key=lambda j: JOINTS.index(usual[j]) if usual[j] in JOINTS else len(JOINTS),
    )
    child_of = {pose.parents[j]: j for j in reversed(by_rank)}
    for joint, name in enumerate(usual):
        child = child_of.get(joint)
        # A hand on a wrist turns no wrist that other sensors show without a hand.
        if child is None or name not in JOINTS or name not in PARENT_OF.values():
            continue
        bone = pose.positions[:, child] - pose.positions[:, joint]
        local, trusted = turn(inverse(pose.rotations[:, joint]), bone), pose.turned[:, joint]
        # A limb beside it that is never seen makes no other axis of it.
        local = local[trusted] if trusted.any() else local
        local = local[~np.isnan(local[:, 0])]
        if len(local):
            offsets[joint] = _onto_axis(np.median(local, axis=0), *aligned_axis(name))
    return offsets


def _onto_axis(bone: FloatArray, axis: int, sign: int) -> FloatArray:
    """Return the rotation that takes an axis to a bone: about one other axis, then the last."""
    x, y, z = (sign * bone).tolist()
    if axis == 0:
        first, second = (
            np.array([0.0, 0.0, np.arctan2(y, x)]),
            np.array([0.0, -np.arctan2(z, np.hypot(x, y)), 0.0]),
        )
    else:
        first, second = (
            np.array([0.0, 0.0, np.arctan2(-x, y)]),
            np.array([np.arctan2(z, np.hypot(x, y)), 0.0, 0.0]),
        )
    return multiply(_about(first), _about(second))


def _about(angles: FloatArray) -> FloatArray:
    """Quaternion of a rotation vector, in radians."""
    angle = float(np.sqrt(np.sum(angles**2)))
    if angle == 0:
        return np.array(NO_TURN)
    return np.append(np.sin(angle / 2) * angles / angle, np.cos(angle / 2))
