"""Joints filled in the axes of what they hang on, and mixed with what the whole body tells of them.

As the root sees it, all that hangs on a limb moves when the limb turns, and few seconds of a body
that no prior fits show too little of how. In its parent's axes a thumb, a foot or a head hardly
moves at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.filling.covariance import Moments
from markermend.poses.filling.filling import fill
from markermend.poses.filling.likeness import MOMENTS
from markermend.poses.normal import FEATURES
from markermend.poses.nuitrack import JOINTS, usual_name
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, lengths_of, multiply, turn, unit, unrolled

# Squared errors of what the whole body tells are larger than is said, the more so the less of it
# was recorded: by this time over the recording's.
_TOO_SURE_S = 8.0
# Nothing is surer than this, squared.
_SURE = 1e-9


def hanging_joints(pose: Pose, moments: Moments | None) -> BoolArray:
    """(joints,) bool, those that are told by what they hang on, too; never the root.

    Parameters
    ----------
    pose : a recording
    moments : of its channels, by a prior that fits; None without one

    Notes
    -----
    Where a prior tells of the 17 usual joints these are nearer without. Others, as of hands, or of
    a skeleton of one's own, come nearer, whether or not a prior tells of them.
    """
    hanging = np.array([usual_name(joint) not in JOINTS for joint in pose.joints])
    others = np.arange(len(hanging)) != pose.order[0]
    if moments is None:
        hanging[:] = True
    elif moments.told is not None:
        hanging[others] |= ~moments.told[::FEATURES]
    return np.asarray(hanging & others)


def by_parents(
    features: FloatArray,
    variance: FloatArray,
    known: tuple[BoolArray, BoolArray],
    parents: Sequence[int],
    order: Sequence[int],
    rate: float,
    beside: FloatArray,
    noise: float = 0.0,
) -> tuple[FloatArray, FloatArray]:
    """Let what was filled be told by joints in their parents' axes, too.

    Parameters
    ----------
    features : (frames, joints, 7) filled, in mean bone lengths and quaternions of unit length; NaN
        where nothing tells
    variance : (frames, joints, 7) of what was filled
    known : (frames, joints) bool each, positions and rotations that are known
    parents : index of each joint's parent, -1 for the root
    order : joints, parents first
    rate : frames per second
    beside : (frames, n) what else tells of joints, known in every frame
    noise : standard deviation of what is left of noise in the known values

    Returns
    -------
    (frames, joints, 7) features and variances, those that are known as they were. Where parents
    tell nothing features stay, and variances are larger by what the whole body is too sure of.

    Notes
    -----
    Both ways err differently, and their mean, each counting by how sure it is, is nearer than
    either. A parent that was filled itself is where this mean has it, and what is unsure of it is
    added.
    """
    local, sure = _in_parents(features, known, parents)
    joints = [joint for joint in order if parents[joint] >= 0]
    told, unsure = _filled(local[:, joints], sure[:, joints], rate, beside, noise)
    out, left = features.copy(), (1.0 + _TOO_SURE_S * rate / len(features)) * variance
    seen, turned = known
    for n, joint in enumerate(joints):
        above, frames = parents[joint], ~(seen[:, joint] & turned[:, joint])
        place, way = told[frames, n, :3], told[frames, n, 3:]
        axes, off = out[frames, above, 3:], left[frames, above]
        far = lengths_of(place)[:, None]
        placed = out[frames, above, :3] + turn(axes, place)
        # A small turn moves a quaternion by half of it, and what is that far away by all of it.
        swung = 4.0 * far**2 * off[:, 3:].mean(axis=1, keepdims=True)
        unsure_place = unsure[frames, n, :3] + off[:, :3] + swung
        way = multiply(axes, way)
        way *= np.where(np.sum(way * out[frames, joint, 3:], axis=1, keepdims=True) < 0, -1.0, 1.0)
        unsure_way = unsure[frames, n, 3:] + off[:, 3:]
        for part, there, new, doubt in (
            (slice(0, 3), seen, placed, unsure_place),
            (slice(3, FEATURES), turned, way, unsure_way),
        ):
            own = out[frames, joint, part], left[frames, joint, part]
            value, spread = _mean(*own, new, doubt)
            stays = there[frames, joint, None]
            out[frames, joint, part] = np.where(stays, own[0], value)
            left[frames, joint, part] = np.where(stays, own[1], spread)
        out[frames, joint, 3:] = unit(out[frames, joint, 3:])
    return out, left


def _mean(
    own: FloatArray, unsure: FloatArray, other: FloatArray, doubt: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mean of two estimates by how sure each is, and its variance; the first where it is alone."""
    ours, theirs = (x.sum(axis=1, keepdims=True) + _SURE for x in (unsure, doubt))
    missing = np.isnan(other + theirs).any(axis=1, keepdims=True)
    share = np.where(missing, 0.0, ours / (ours + np.where(missing, 1.0, theirs)))
    value = own + share * (np.where(missing, own, other) - own)
    return value, (1.0 - share) * unsure


def _in_parents(
    features: FloatArray, known: tuple[BoolArray, BoolArray], parents: Sequence[int]
) -> tuple[FloatArray, BoolArray]:
    """(frames, joints, 7) each: features in parents' axes, and what is known of them."""
    above = np.maximum(parents, 0)
    axes = inverse(features[:, above, 3:])
    away = features[..., :3] - features[:, above, :3]
    local = np.concatenate([turn(axes, away), multiply(axes, features[..., 3:])], axis=2)
    local[..., 3:] = unrolled(local[..., 3:])
    seen, turned = known
    placed = (seen & seen[:, above] & turned[:, above])[..., None]
    whole = (turned & turned[:, above])[..., None]
    sure = np.concatenate([np.repeat(placed, 3, axis=2), np.repeat(whole, 4, axis=2)], axis=2)
    return local, sure & ~np.isnan(local)


def _filled(
    local: FloatArray, known: BoolArray, rate: float, beside: FloatArray, noise: float
) -> tuple[FloatArray, FloatArray]:
    """(frames, joints, 7) each: features in parents' axes without gaps, and their variances."""
    frames = len(local)
    values, sure = local.reshape(frames, -1), known.reshape(frames, -1)
    usable = sure.any(axis=0)
    given = np.where(sure, values, 0.0)[:, usable]
    joints = np.flatnonzero(usable) // FEATURES
    told, unsure = np.full((2, *values.shape), np.nan)
    if usable.any():
        look = partial(
            fill, given, sure[:, usable], rate, beside=beside, noise=noise, joints=joints
        )
        found = look()
        if found.lasting:
            found = look(near=found, compared=MOMENTS)
        told[:, usable], unsure[:, usable] = found.values, found.variance
    told, unsure = told.reshape(local.shape), unsure.reshape(local.shape)
    told[..., 3:] = unit(told[..., 3:])
    return told, unsure
