"""Let what was measured, what was filled and the way a body is built agree."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.body.bones import Bones, find_bones, fuse, keep_lengths, swing
from markermend.poses.body.jointed import Jointed
from markermend.poses.body.settling import settle, settle_in_time
from markermend.poses.body.stretching import stretched
from markermend.poses.channels import Channels, columns_of, to_features
from markermend.poses.filling.expecting import left_of_noise
from markermend.poses.normal import FEATURES
from markermend.poses.pose import Pose

NOISY = 2e-3
"""Noise above this, in mean bone lengths, makes it worth to let positions and rotations agree."""
SURE = 2e-3
"""What is known exactly is taken for this sure."""

# The way a body bends may change what was filled only so much: its squared errors count as this
# share of themselves where nothing is noisy, and where it is.
_FIRM = (0.25, 0.4)
# Poses that it takes to tell how a body bends.
_SETTLES = 30


def agreeing(
    values: FloatArray,
    variance: FloatArray,
    channels: Channels,
    pose: Pose,
    known: tuple[BoolArray, BoolArray],
    noise: float,
    body: Jointed | None,
    rounds: int,
) -> tuple[FloatArray, Bones]:
    """Let a body settle where it is noisy or was filled, and keep bones.

    Parameters
    ----------
    values : (frames, columns) of all joints but the root; NaN of what was never known
    variance : (frames, columns) of their errors
    channels : that they are of
    pose : the recording
    known : positions and rotations, (frames, joints) bool each
    noise : overall, in mean bone lengths; 0 where there is none
    body : joints that it settles by; None for positions alone
    rounds : how many times

    Returns
    -------
    (frames, joints, 7), and the bones found
    """
    features = to_features(values, channels)
    bones = find_bones(features, *known, pose.parents, left_of_noise(pose.rate) * noise)
    noisy, hidden = noise > NOISY, ~np.stack(known)
    if not (noisy or hidden.any()):
        return features, bones
    unsure = np.ones(features.shape)
    unsure[:, channels.joints] = variance.reshape(pose.frames, -1, FEATURES)
    # Three numbers say where a joint is, four how it is turned.
    filled = np.repeat(hidden, (3, 4), axis=0).transpose(1, 2, 0)
    unsure = np.maximum(np.where(filled, _FIRM[int(noisy)] * unsure, unsure), SURE**2)
    if body is None and pose.frames >= _SETTLES:
        loose = np.where(noisy | hidden[0], unsure[..., :3].mean(axis=2), 0.0)
        loose[:, channels.normal.root] = 0.0
        features[..., :3] = stretched(features[..., :3], loose, bones, pose.order)
        return features, bones
    for _ in range(rounds):
        if noisy:
            pilot = fuse(features, bones, channels.normal.root)
        else:
            pilot = with_bones(features, known, bones)
        if pose.frames < _SETTLES or body is None:
            return pilot, bones
        unsettled = None if noisy else body.hidden(*known)
        given = body.of(features), body.unsure(unsure), body.of(pilot)
        settled = settle(*given, body.parents, body.order, pose.rate, unsettled, body.others)
        settled = body.back(settled, features)
        if not noisy:
            settled[..., :3][known[0]] = features[..., :3][known[0]]
            settled[..., 3:][known[1]] = features[..., 3:][known[1]]
        features = settled
    return features, bones


def agreeing_in_time(
    features: FloatArray,
    channels: Channels,
    noise: FloatArray,
    pose: Pose,
    body: Jointed | None,
) -> FloatArray:
    """(frames, joints, 7) smoothed from what was measured in the coordinates of joints.

    Parameters
    ----------
    features : (frames, joints, 7) as they came out so far
    channels, pose, body : as for :func:`agreeing`
    noise : (columns,) standard deviation of what was measured
    """
    if pose.frames < _SETTLES or body is None:
        return features
    pilot = columns_of(features, channels)
    measured = features.copy()
    values = np.where(channels.known, channels.values, pilot)
    measured[:, channels.joints] = values.reshape(pose.frames, -1, FEATURES)
    variance = np.ones(features.shape)
    variance[:, channels.joints] = (noise**2).reshape(-1, FEATURES)
    given = body.of(measured), body.unsure(variance), body.of(features)
    settled = settle_in_time(*given, body.parents, body.order, pose.rate, body.others)
    return body.back(settled, features)


def with_bones(
    features: FloatArray, known: tuple[BoolArray, BoolArray], bones: Bones
) -> FloatArray:
    """(frames, joints, 7) whose bones keep their length, by moving and turning what is not known.

    Parameters
    ----------
    features : (frames, joints, 7)
    known : positions and rotations, (frames, joints) bool each
    bones : what is constant
    """
    seen, turned = known
    out = features.copy()
    out[..., :3] = keep_lengths(features[..., :3], seen, bones)
    return swing(out, ~turned, bones)
