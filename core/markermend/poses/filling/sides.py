"""What one side of a body tells of the other: a left limb moves much like a mirrored right one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.arrays import BoolArray, Float32Array, FloatArray, IntArray
from markermend.poses.filling.covariance import Moments
from markermend.poses.normal import FEATURES
from markermend.poses.nuitrack import MIRROR, twins
from markermend.poses.solving import part_of

OTHER_SIDE = 0.2
"""How much a side's movement counts for the other side; the rest is its own."""

_TURN = 3


@dataclass(frozen=True, eq=False)
class Mirror:
    """How poses in columns look in a mirror.

    Attributes
    ----------
    twins : (channels,) each column's counterpart on the other side of the body
    signs : (channels,) 1 or -1, what that is multiplied with
    """

    twins: IntArray
    signs: Float32Array

    def image(self, rows: Float32Array) -> Float32Array:
        """(n, k · channels) rows as the mirrored body has them."""
        poses = rows.reshape(-1, len(self.twins))
        return np.asarray(poses[:, self.twins] * self.signs).reshape(rows.shape)

    def of(self, kept: BoolArray) -> Mirror | None:
        """The same for some columns; None where the counterpart of one is not among them.

        Parameters
        ----------
        kept : (channels,) bool
        """
        if (kept[self.twins] != kept).any():
            return None
        return Mirror((np.cumsum(kept) - 1)[self.twins[kept]], self.signs[kept])


def mirror_of(joints: Sequence[str], usual: FloatArray, beside: Sequence[float]) -> Mirror:
    """Return the mirror of a body's columns, and of some more that are their own counterparts.

    Parameters
    ----------
    joints : names, without the root
    usual : (joints · 7,) a pose or a mean
    beside : signs of the columns beside those of joints
    """
    columns = twin_columns(joints)
    own = np.arange(len(columns), len(columns) + len(beside))
    signs = np.append(mirror_signs(usual, columns), beside)
    return Mirror(np.append(columns, own), signs.astype(np.float32))


def twin_columns(joints: Sequence[str]) -> IntArray:
    """(joints · 7,) column of each feature's counterpart on the other side of the body."""
    at_other = np.array(twins(joints))
    return np.asarray((at_other[:, None] * FEATURES + np.arange(FEATURES)).ravel())


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


def both_sides(
    covariance: FloatArray, twins: IntArray, signs: FloatArray | Float32Array
) -> FloatArray:
    """Mix a covariance with that of the mirrored body.

    Parameters
    ----------
    covariance : (channels, channels)
    twins, signs : (channels,), as a :class:`Mirror` has them
    """
    mirrored = signs[:, None] * part_of(covariance, twins, twins) * signs
    return np.asarray((1.0 - OTHER_SIDE) * covariance + OTHER_SIDE * mirrored)


def of_both_sides(moments: Moments, mirror: Mirror) -> Moments:
    """Moments in which each side of the body tells of the other, too.

    Parameters
    ----------
    moments : of the mirror's channels
    mirror : of all of them
    """
    whole, *within = (
        both_sides(covariance, mirror.twins, mirror.signs)
        for covariance in (moments.whole, *moments.within)
    )
    return replace(moments, whole=whole, within=np.stack(within))


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
