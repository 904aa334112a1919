"""What tells where a marker is in a moving frame: the body's pose, gravity, and acceleration."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray

# Spreads below this make no difference to how much a reference counts.
NEAR_MM = 3.0
# References from the nearest on: how many, how far the marker may follow them linearly (mm), and
# the inverse square of the length, in standard deviations, over which their poses are alike.
GROUPS = ((4, 12.0, 0.5), (8, 12.0, 0.5), (None, 8.0, 0.4))
# The same for the direction of gravity and for the acceleration of the frame, which move skin.
GRAVITY = FORCE = (2.0, 0.1)
# Acceleration is a difference over this time on either side.
FORCE_S = 0.05
LEAST = 1e-6


def describe_poses(
    points: FloatArray,
    spread: FloatArray,
    gravity: FloatArray,
    force: FloatArray,
    *,
    distant: bool = False,
) -> tuple[FloatArray, FloatArray]:
    """Describe the pose of the references in moving frames, scaled for the parts of the process.

    Parameters
    ----------
    points : (views, points, 3, frames) references in each moving frame, mm, the nearest first
    spread : (points,) of each reference's distance to the marker, mm
    gravity : (views, 3, frames) direction that points up, in the moving frame
    force : (views, 3, frames) acceleration of the frame, in it, any unit
    distant : let distant references count more for the non-linear part: they tell one movement
        from another

    Returns
    -------
    linear, curved : (views, features, frames)
    """
    views, count, _, frames = points.shape
    pose = np.concatenate([gravity, force, points.reshape(views, -1, frames)], axis=1)
    pose -= pose.mean(axis=2, keepdims=True)
    variance = np.einsum("vif,vif->vi", pose, pose) / frames
    variance[:, :3] = variance[:, :3].mean(axis=1, keepdims=True)
    deviation = np.sqrt(variance) + LEAST
    weight = 1.0 / (spread + NEAR_MM)
    followed, compared = (
        w / np.sqrt(np.mean(w**2)) for w in (weight, np.sqrt(weight) if distant else weight)
    )
    parts = [(np.ones(1), np.ones(1), *of_frame) for of_frame in (GRAVITY, FORCE)]
    first = 0
    for group, far, alike in GROUPS:
        last = count if group is None else min(first + group, count)
        if last > first:
            parts.append((followed[first:last], compared[first:last], far, alike))
        first = last
    linear = np.concatenate([w * (far / np.sqrt(3 * len(w))) for w, _, far, _ in parts])
    curved = np.concatenate([w * np.sqrt(alike / (3 * len(w))) for _, w, _, alike in parts])
    of_linear, of_curved = (np.repeat(w, 3) / deviation for w in (linear, curved))
    return pose * of_linear[:, :, None], pose * of_curved[:, :, None]
