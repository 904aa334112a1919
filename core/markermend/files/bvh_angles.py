"""Angles that turn joints as a BVH has them: one axis after the other, told so that none jumps."""

from __future__ import annotations

from warnings import catch_warnings, filterwarnings

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import FloatArray
from markermend.poses.quaternion import NO_TURN


def turned_by(order: str, angles: FloatArray) -> FloatArray:
    """(frames, 4) rotations of degrees (frames, n) about axes, as ``ZXY``; of none, no turn."""
    if not order:
        return np.tile(NO_TURN, (len(angles), 1))
    return np.asarray(Rotation.from_euler(order, angles, degrees=True).as_quat())


def angles_of(rotations: FloatArray, order: str) -> FloatArray:
    """(frames, 3) degrees about three axes, as ``ZXY``, of rotations (frames, 4)."""
    with catch_warnings():
        # Where two axes fall together one of their turns is as good as the other.
        filterwarnings("ignore", message="Gimbal lock")
        angles = Rotation.from_quat(rotations).as_euler(order, degrees=True)  # type: ignore[call-overload]
    return np.asarray(angles)


def unrolled_angles(angles: FloatArray, before: FloatArray) -> FloatArray:
    """The same rotations by the angles that are nearest to those of the frame before.

    What is between frames is often made of their angles, and would spin where these jump.

    Parameters
    ----------
    angles : (frames, ..., 3) degrees about three different axes
    before : (..., 3) those of the frame before the first

    Returns
    -------
    (frames, ..., 3) degrees, beyond 180 where a turn goes on
    """
    over = angles + 180.0
    over[..., 1] = 180.0 - angles[..., 1]
    # Both are one rotation, and from one to the other it is as far whichever is the one before.
    last = np.concatenate([before[None], angles[:-1]])
    stay, change = (np.abs(_half_turns(way - last)).sum(axis=-1) for way in (angles, over))
    changed = np.cumsum(change < stay, axis=0) % 2 == 1
    told = np.where(changed[..., None], over, angles)
    steps = _half_turns(np.diff(told, axis=0, prepend=before[None]))
    path = before + np.cumsum(steps, axis=0)
    return np.asarray(told + 360.0 * np.round((path - told) / 360.0))


def _half_turns(angles: FloatArray) -> FloatArray:
    """The same within 180 degrees to either side."""
    return angles - 360.0 * np.round(angles / 360.0)
