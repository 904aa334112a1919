"""Take the noise out of a root, which the rest of the body is looked at from."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.body.bones import noise_by, third_differences
from markermend.poses.channels import Channels
from markermend.poses.normal import FEATURES
from markermend.poses.pose import Pose
from markermend.poses.quaternion import unit, unrolled
from markermend.poses.smoothing import noise_level, smooth, smooth_again

# A variance that so many third differences tell by their median is off by this share over the root
# of their number, and no less than so many times that is told from nothing.
_SHARE, _TOLD = 2.3, 3.0


def root_noise_mm(pose: Pose) -> float:
    """Standard deviation of the noise of a root's coordinates, as lengths of its bones show; mm.

    Parameters
    ----------
    pose : any skeleton with one root

    Returns
    -------
    float
        0 where these change by no more than those of other bones, of which both ends are noisy;
        movement has no part in either
    """
    root = pose.order[0]
    power, off = np.zeros((2, 2))
    for own in (0, 1):
        thirds = [
            third_differences(pose.positions, pose.seen, joint, parent)
            for joint, parent in enumerate(pose.parents)
            if parent >= 0 and (parent == root) == bool(own)
        ]
        told = np.concatenate(thirds) if thirds else np.zeros(0)
        if not len(told):
            return 0.0
        power[own] = noise_by(told) ** 2
        off[own] = power[own] * _SHARE / np.sqrt(len(told))
    more = power[1] - 0.5 * power[0]
    return float(np.sqrt(more)) if more > _TOLD * np.hypot(off[1], 0.5 * off[0]) else 0.0


def calmed(
    channels: Channels,
    noisy: FloatArray,
    smoothed: FloatArray,
    noise: FloatArray,
    root_noise: float,
    rate: float,
) -> Channels:
    """The same with a root that is smoothed together with what was made of the other joints.

    Parameters
    ----------
    channels : relative to axes that follow the root smoothly
    noisy : (frames, joints · 7) the columns of other joints, without NaN
    smoothed : (frames, n) those of them that were ever known, their noise taken out
    noise : (n,) standard deviation of what is left of it
    root_noise : that of the root's coordinates, in mean bone lengths
    rate : frames per second
    """
    own = channels.root.copy()
    own[:, 3:] = unrolled(own[:, None, 3:])[:, 0]
    known = np.pad(channels.known, ((0, 0), (FEATURES, 0)), constant_values=True)
    level = noise_level(np.hstack([own, noisy]), known)[:FEATURES]
    values = np.hstack([own, smoothed])
    level[:3] = root_noise
    level = np.append(level, noise)
    found = smooth(values, level, rate)
    pilot = np.hstack([found[:, :FEATURES], smoothed])
    found = smooth_again(values, pilot, level, rate)
    own = found[:, :FEATURES]
    own[:, 3:] = unit(own[:, 3:])
    return replace(channels, root=own)
