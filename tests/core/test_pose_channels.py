"""Skeleton recordings as columns, seen from the root and from axes that follow it smoothly."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from markermend.poses.channels import steadied, to_channels, to_features
from markermend.poses.normal import denormalise
from markermend.poses.nuitrack import twins
from markermend.poses.pose import Pose
from markermend.poses.quaternion import multiply, turn, unit

RATE = 100.0


def shaken(frames=300):
    """A body that walks and turns; its limbs go smoothly in the world, its root shakes."""
    t = np.arange(frames) / RATE
    half = 0.4 * np.sin(t)
    heading = np.stack([0 * t, np.sin(half), 0 * t, np.cos(half)], axis=1)
    jitter = unit(
        np.append(
            np.random.default_rng(0).normal(0, 0.01, (frames, 3)), 0 * heading[:, :1] + 1, axis=1
        )
    )
    positions, rotations = np.zeros((frames, 3, 3)), np.zeros((frames, 3, 4))
    positions[:, 0] = np.stack([900 * t, 900 + 20 * np.sin(5 * t), 0 * t], axis=1)
    rotations[:, 0] = multiply(heading, jitter)
    for joint in (1, 2):
        rotations[:, joint] = heading
        bone = np.broadcast_to([100.0 * joint, 300.0, 0.0], (frames, 3))
        positions[:, joint] = positions[:, 0] + turn(heading, bone)
    return Pose(positions, rotations, ("root", "a", "b"), (-1, 0, 1), RATE)


def test_what_a_root_shakes_is_seen_from_beside_it():
    pose = shaken()
    own = to_channels(pose)
    beside = steadied(own, RATE)
    shaking, calm = (np.std(np.diff(c.values, 3, axis=0)) for c in (own, beside))
    assert calm < 0.05 * shaking


def test_a_recording_comes_back_from_axes_that_follow_the_root():
    pose = shaken()
    hidden = np.ones((pose.frames, 3))
    hidden[40:60, 2] = 0.0
    channels = steadied(
        to_channels(pose.with_samples(pose.positions, pose.rotations, hidden)), RATE
    )
    positions, rotations = denormalise(to_features(channels.values, channels), channels.normal)
    seen = hidden > 0
    assert_allclose(positions[seen], pose.positions[seen], atol=1e-9)
    assert_allclose(
        np.abs(np.sum(rotations * pose.rotations, axis=2))[:, [0, 2]][seen[:, [0, 2]]], 1.0
    )
    assert (channels.values[~channels.known] == 0).all()


def test_every_joint_knows_the_other_side_of_the_body():
    assert twins(["left_knee", "neck", "right_knee", "right_hip"]) == [2, 1, 0, 3]
    assert twins(["lfemur", "rfemur", "lowerback", "rfoot"]) == [1, 0, 2, 3]
    assert twins(["mixamorig:LeftArm", "mixamorig:RightArm"]) == [1, 0]
    assert twins(["thigh.L", "thigh.R", "Bip01 L Hand", "Bip01 R Hand"]) == [1, 0, 3, 2]
    assert twins(["lShin", "rShin", "FootLeft", "FootRight"]) == [1, 0, 3, 2]
    assert twins(["leftarm", "rightarm", "larm", "rarm"]) == [1, 0, 3, 2]
