"""What a depth sensor would have made of a recording, simulated: no real one has a truth."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, lengths_of, multiply, turn

RATE_HZ = 30.0
_PROPORTION = 0.08
_CENTRE = 0.08
_AXES_DEG = 10.0


def as_depth_sensor(pose: Pose, *, seed: int = 1) -> Pose:
    """Give a recording the rate, proportions, joint centres and axes of another sensor.

    Parameters
    ----------
    pose : 17 joints, clean
    seed : same seed, same sensor

    Returns
    -------
    Pose
        the nearest rate to 30 Hz that whole frames allow. Each bone is longer or shorter by about
        8 %, its end lies elsewhere by about 8 % of its length, and each joint's axes are turned
        by about 10°; all constant, so that the poses are clean.
    """
    random = np.random.default_rng(seed)
    step = max(round(pose.rate / RATE_HZ), 1)
    positions, rotations = pose.positions[::step], pose.rotations[::step]
    count = len(pose.joints)
    longer = 1.0 + random.normal(0.0, _PROPORTION, count)
    elsewhere = random.normal(0.0, _CENTRE / np.sqrt(3.0), (count, 3))
    tilt = random.normal(0.0, _AXES_DEG / np.sqrt(3.0), (count, 3))
    moved = np.array(positions)
    for joint in pose.order:
        parent = pose.parents[joint]
        if parent >= 0:
            bone = positions[:, joint] - positions[:, parent]
            local = turn(inverse(rotations[:, parent]), bone)
            aside = elsewhere[joint] * np.nanmedian(lengths_of(local))
            own = turn(rotations[:, parent], local * longer[joint] + aside)
            moved[:, joint] = moved[:, parent] + own
    turned = multiply(rotations, Rotation.from_rotvec(tilt, degrees=True).as_quat())
    return Pose(moved, turned, pose.joints, pose.parents, pose.rate / step, pose.confidence[::step])
