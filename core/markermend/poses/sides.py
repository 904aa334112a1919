"""What one side of a body tells of the other: a left limb moves much like a mirrored right one."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.poses.normal import FEATURES
from markermend.poses.nuitrack import MIRROR

OTHER_SIDE = 0.2
"""How much a side's movement counts for the other side; the rest is its own."""

_TURN = 3


def mirror_signs(usual: FloatArray, twins: IntArray) -> FloatArray:
    """Signs that features have in a mirror, of q and -q the one nearer to the other side's own.

    Parameters
    ----------
    usual : (joints · 7,) a pose or a mean
    twins : (joints · 7,) each column's counterpart on the other side of the body

    Returns
    -------
    (joints · 7,) 1 or -1
    """
    own = usual.reshape(-1, FEATURES)[:, _TURN:]
    signs = np.tile(MIRROR, (len(own), 1))
    there = usual[twins].reshape(-1, FEATURES)[:, _TURN:] * signs[:, _TURN:]
    signs[np.sum(own * there, axis=1) < 0, _TURN:] *= -1.0
    return signs.ravel()


def both_sides(covariance: FloatArray, twins: IntArray, signs: FloatArray) -> FloatArray:
    """Mix a covariance with that of the mirrored body.

    Parameters
    ----------
    covariance : (joints · 7, joints · 7)
    twins, signs : (joints · 7,), the latter of :func:`mirror_signs`
    """
    mirrored = signs[:, None] * covariance[np.ix_(twins, twins)] * signs
    return np.asarray((1.0 - OTHER_SIDE) * covariance + OTHER_SIDE * mirrored)


def both_sides_moved(moved: FloatArray, twins: IntArray, signs: FloatArray) -> FloatArray:
    """Rows whose products add up to what :func:`both_sides` makes of those of the given ones.

    Parameters
    ----------
    moved : (n, joints · 7)
    twins, signs : (joints · 7,), the latter of :func:`mirror_signs`

    Returns
    -------
    (2 · n, joints · 7)
    """
    mirrored = moved[:, twins] * signs
    return np.vstack([np.sqrt(1.0 - OTHER_SIDE) * moved, np.sqrt(OTHER_SIDE) * mirrored])
