"""Turns about axes, by the numbers that a recording would go on with."""

from __future__ import annotations

from warnings import catch_warnings, filterwarnings

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray, IntArray, runs


def angles_of(turned: Rotation, axes: str) -> FloatArray:
    """(frames, axes) degrees of turns about these axes, one after the other, that come nearest.

    Parameters
    ----------
    turned : of every frame
    axes : one to three different letters of x, y and z, the first turned about first; or three of
        X, Y and Z, each about an axis that those before have turned

    Notes
    -----
    Three tell every rotation. Euler angles cut to fewer tell another one where the middle one is
    near 90 degrees or beyond; so of two turns each is read from the axis that only it moves.
    """
    if len(axes) == 3:
        with catch_warnings():
            # Where two axes fall together one of their turns is as good as the other.
            filterwarnings("ignore", message="Gimbal lock")
            return np.asarray(turned.as_euler(axes, degrees=True))  # type: ignore[call-overload]
    matrix = turned.as_matrix()
    if len(axes) == 1:
        i = "xyz".index(axes)
        j, k = (i + 1) % 3, (i + 2) % 3
        sine, cosine = matrix[:, k, j] - matrix[:, j, k], matrix[:, j, j] + matrix[:, k, k]
        return np.asarray(np.degrees(np.arctan2(sine, cosine)))[:, None]
    i, j = map("xyz".index, axes)
    k, sign = 3 - i - j, 1.0 if j == (i + 1) % 3 else -1.0
    first = np.arctan2(-sign * matrix[:, j, k], matrix[:, j, j])
    second = np.arctan2(-sign * matrix[:, k, i], matrix[:, i, i])
    return np.asarray(np.degrees(np.stack([first, second], axis=1)))


def told_alike(angles: FloatArray, rows: IntArray, given: FloatArray | None) -> FloatArray:
    """Tell rotations by those angles that mean the same with which a recording goes on.

    Parameters
    ----------
    angles : (rows, axes) degrees, about axes that differ
    rows : ascending frames that these are of
    given : (frames, axes) a recording's own angles, NaN where it has none; or that has none at all

    Returns
    -------
    (rows, axes)
        nearest to what the recording has there, else to what is before, or at its beginning after
    """
    if given is None:
        given = np.full((int(rows.max(initial=-1)) + 1, angles.shape[1]), np.nan)
    there = np.asarray(~np.isnan(given).any(axis=1))
    path = np.array(given)
    path[rows] = np.where(there[rows, None], _nearest(angles, given[rows]), angles)
    told = np.flatnonzero(~np.isnan(path).any(axis=1))
    path[told] = going_on(path[told], np.asarray(~there[told]))
    return path[rows]


def going_on(angles: FloatArray, anew: BoolArray) -> FloatArray:
    """Tell some frames' rotations by the angles with which those beside them go on.

    What is between frames is often made of their angles, and would spin where these jump.

    Parameters
    ----------
    angles : (frames, ..., axes) degrees about axes that differ
    anew : (frames,) bool, whose are to be told so: from the frame before on, beyond 180 degrees
        where a turn goes on; those at the beginning from the frame after back

    Returns
    -------
    (frames, ..., axes)
    """
    path = np.array(angles)
    for start, stop in runs(anew).tolist():
        if start == 0 and stop < len(path):
            path[:stop] = _onwards(path[:stop][::-1], path[stop])[::-1]
        else:
            path[start:stop] = _onwards(path[start:stop], path[max(start - 1, 0)])
    return path


def _onwards(angles: FloatArray, before: FloatArray) -> FloatArray:
    """Angles (frames, ..., axes) from those of the frame before (..., axes) on."""
    told = angles
    if angles.shape[-1] == 3:
        # Both are one rotation, and from one to the other it is as far whichever is the one before.
        over = _over(angles)
        last = np.concatenate([before[None], angles[:-1]])
        stay, change = (np.abs(_half_turns(way - last)).sum(axis=-1) for way in (angles, over))
        changed = np.cumsum(change < stay, axis=0) % 2 == 1
        told = np.where(changed[..., None], over, angles)
    steps = _half_turns(np.diff(told, axis=0, prepend=before[None]))
    path = before + np.cumsum(steps, axis=0)
    return np.asarray(told + 360.0 * np.round((path - told) / 360.0))


def _over(angles: FloatArray) -> FloatArray:
    """The other three angles (..., 3) of a rotation, whose middle one comes from the other side."""
    return np.asarray(angles * (1.0, -1.0, 1.0) + 180.0)


def _half_turns(angles: FloatArray) -> FloatArray:
    """The same within 180 degrees to either side."""
    return angles - 360.0 * np.round(angles / 360.0)


def _nearest(angles: FloatArray, like: FloatArray) -> FloatArray:
    """Angles (..., axes) that turn as these, nearest to others."""
    ways = [angles]
    if angles.shape[-1] == 3:
        ways.append(_over(angles))
    near = [way + 360.0 * np.round((like - way) / 360.0) for way in ways]
    far = [np.abs(way - like).sum(axis=-1, keepdims=True) for way in near]
    return near[0] if len(near) == 1 else np.where(far[1] < far[0], near[1], near[0])
