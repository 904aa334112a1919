"""A root that is no part of the body, as the origin that animation programs hang bodies on."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from markermend.poses.normal import bone_lengths
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of

if TYPE_CHECKING:
    from markermend.poses.restore import Restored

# How far apart two joints of a body are does not vary, between these percentiles, by a mean bone.
_USUAL = (10.0, 90.0)


def body_of(pose: Pose) -> Pose:
    """The body alone: a recording without its root, where that is no part of it."""
    return without_loose_root(pose) or pose


def without_loose_root(pose: Pose) -> Pose | None:
    """The body alone; None where its root is a part of it.

    Parameters
    ----------
    pose : a skeleton with one root

    Returns
    -------
    Pose
        all joints but the root, if that was always seen, one joint alone hangs on it, and by no
        bone: it comes and goes
    """
    root = pose.order[0]
    below = [joint for joint, parent in enumerate(pose.parents) if parent == root]
    if len(below) != 1 or pose.parents.count(-1) != 1 or not pose.seen[:, root].all():
        return None
    bones = bone_lengths(pose.positions, pose.parents)
    bones[below] = np.nan
    far = lengths_of(pose.positions[:, below[0]] - pose.positions[:, root])
    far = far[~np.isnan(far)]
    if np.isnan(bones).all() or not len(far):
        return None
    low, high = np.percentile(far, _USUAL)
    if high - low <= np.nanmean(bones):
        return None
    others = _others(pose, root)
    place = {joint: n for n, joint in enumerate(others)}
    return Pose(
        pose.positions[:, others],
        pose.rotations[:, others],
        tuple(pose.joints[joint] for joint in others),
        tuple(place.get(pose.parents[joint], -1) for joint in others),
        pose.rate,
        pose.confidence[:, others],
    )


def with_loose_root(body: Restored, pose: Pose) -> Restored:
    """A body that was restored, on its root, which stays as it was recorded.

    Parameters
    ----------
    body : restored from what :func:`without_loose_root` made
    pose : the recording
    """
    others = _others(pose, pose.order[0])
    positions, rotations, confidence = (
        np.array(part) for part in (pose.positions, pose.rotations, pose.confidence)
    )
    positions[:, others], rotations[:, others] = body.pose.positions, body.pose.rotations
    confidence[:, others] = body.pose.confidence
    error, noise = np.zeros(pose.seen.shape), np.zeros(len(pose.joints))
    error[:, others], noise[others] = body.error_mm, body.noise_mm
    filled = np.zeros(pose.seen.shape, dtype=bool)
    filled[:, others] = body.filled
    return replace(
        body,
        pose=pose.with_samples(positions, rotations, confidence),
        error_mm=error,
        noise_mm=noise,
        filled=filled,
        faults=tuple(replace(fault, joint=others[fault.joint]) for fault in body.faults),
    )


def _others(pose: Pose, root: int) -> list[int]:
    """All joints but the root."""
    return [joint for joint in range(len(pose.joints)) if joint != root]
