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


def describe_pose(
    points: FloatArray,
    spread: FloatArray,
    gravity: FloatArray,
    force: FloatArray,
    *,
    distant: bool = False,
) -> tuple[FloatArray, FloatArray]:
    """Describe the pose of the references, scaled for the parts of the process.

    Parameters
    ----------
    points : (frames, points, 3) references in the moving frame, mm, the nearest first
    spread : (points,) of each reference's distance to the marker, mm
    gravity : (frames, 3) direction that points up, in the moving frame
    force : (frames, 3) acceleration of the frame, in it, any unit
    distant : let distant references count more for the non-linear part: they tell one movement
        from another

    Returns
    -------
    linear, curved : (frames, features)
    """
    coordinates = points.reshape(len(points), -1)
    coordinates = coordinates - coordinates.mean(axis=0)
    coordinates /= coordinates.std(axis=0) + LEAST
    weight = 1.0 / (spread + NEAR_MM)
    followed, compared = (
        coordinates * np.repeat(w / np.sqrt(np.mean(w**2)), 3)
        for w in (weight, np.sqrt(weight) if distant else weight)
    )
    upright = gravity - gravity.mean(axis=0)
    pushed = force - force.mean(axis=0)
    upright /= upright.std() + LEAST
    pushed /= pushed.std(axis=0) + LEAST
    parts = [(upright, upright, *GRAVITY), (pushed, pushed, *FORCE)]
    first = 0
    for count, far, alike in GROUPS:
        last = coordinates.shape[1] if count is None else first + 3 * count
        if followed[:, first:last].shape[1]:
            parts.append((followed[:, first:last], compared[:, first:last], far, alike))
        first = last
    linear = [part * (far / np.sqrt(part.shape[1])) for part, _, far, _ in parts]
    curved = [part * np.sqrt(alike / part.shape[1]) for _, part, _, alike in parts]
    return np.hstack(linear), np.hstack(curved)
