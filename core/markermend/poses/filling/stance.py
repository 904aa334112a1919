"""How the root is held in the world, which tells of limbs that joints relative to it do not."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.normal import Normal
from markermend.poses.quaternion import inverse, turn

# So much it counts beside joints, whose features are of the same size.
_SHARE = 0.5

IN_MIRROR = (-1.0, 1.0, 1.0, 1.0)
"""Signs of what :func:`stance` tells as a mirrored body has it."""


def stance(normal: Normal) -> FloatArray:
    """Which way is up as the root has it, and how high the root is.

    Parameters
    ----------
    normal : of a recording whose root is known in every frame

    Returns
    -------
    (frames, 4) a direction in the root's axes, and a height over the mean bone length

    Notes
    -----
    A foot is on the ground or not, arms hang: root-relative features do not say where the ground
    is. Up is the axis of the world that the root's own, along the spine, is nearest to on average.
    """
    spine = turn(normal.rotation, np.broadcast_to([0.0, 1.0, 0.0], normal.position.shape))
    lean = spine.mean(axis=0)
    axis = int(np.argmax(np.abs(lean)))
    up = np.zeros_like(normal.position)
    up[:, axis] = 1.0 if lean[axis] >= 0 else -1.0
    height = np.sum(up * normal.position, axis=1, keepdims=True) / normal.scale
    return _SHARE * np.hstack([turn(inverse(normal.rotation), up), height - height.mean()])
