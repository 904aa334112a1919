"""A body of an arm, as a skeleton recording, and what a sensor does not see of it."""

from __future__ import annotations

import numpy as np

from markermend.poses import Pose
from markermend.poses.quaternion import turn


def arm(frames=400, rate=100.0):
    """A body of five joints whose arm swings, and how it moves in columns."""
    t = np.arange(frames) / rate
    lengths = [300.0, 250.0, 200.0, 150.0]
    angle = np.cumsum([0.4 * np.sin(2 * np.pi * (0.3 + 0.1 * k) * t + k) for k in range(4)], axis=0)
    positions, rotations = np.zeros((frames, 5, 3)), np.zeros((frames, 5, 4))
    rotations[..., 3] = 1.0
    positions[:, 0] = np.stack([500 * t, 900 + 20 * np.sin(5 * t), 0 * t], axis=1)
    for k in range(4):
        half = angle[k] / 2
        turned = np.stack([0 * half, 0 * half, np.sin(half), np.cos(half)], axis=1)
        rotations[:, k] = turned
        bone = np.broadcast_to([0.0, lengths[k], 0.0], (frames, 3))
        positions[:, k + 1] = positions[:, k] + turn(turned, bone)
    rotations[:, 4] = rotations[:, 3]
    return Pose(positions, rotations, ("root", "a", "b", "c", "d"), (-1, 0, 1, 2, 3), rate)


def hide(pose, frames, joint):
    confidence = np.array(pose.confidence)
    confidence[frames, joint] = 0
    return pose.with_samples(pose.positions, pose.rotations, confidence)
