"""Poses as columns of numbers, one for each coordinate that can be filled and smoothed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import gaussian_filter1d

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.body.rooting import rooted
from markermend.poses.normal import FEATURES, Normal, normalise
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN, inverse, multiply, turn, unit, unrolled
from markermend.poses.sides_of_turns import on_one_side

# A rotation this near to none is what sensors write where they know nothing.
_UNTURNED = 1e-9
# Axes follow the root over this time, and turn after one whose rotation joints tell over the other.
_FOLLOW_S, _FACE_S = 0.2, 0.4


@dataclass(frozen=True, eq=False)
class Channels:
    """A recording relative to its root.

    Attributes
    ----------
    values : (frames, joints · 7) of all joints but the root, normalised, signs of rotations
        unrolled; anything where not known
    known : (frames, joints · 7) bool
    joints : indices of the joints the columns belong to, seven each
    normal : to go back
    root : (frames, 7) features of the root in the axes that values are in
    """

    values: FloatArray
    known: BoolArray
    joints: tuple[int, ...]
    normal: Normal
    root: FloatArray


def to_channels(pose: Pose) -> Channels:
    """Lay a recording out in columns.

    Parameters
    ----------
    pose : any skeleton with one root; where that was not seen, what hangs on it and the frames
        beside tell (:func:`markermend.poses.body.rooting.rooted`)

    Raises
    ------
    DataError
        when no bone was ever seen whole
    """
    turned = trusted_turns(pose)
    root = pose.order[0]
    positions, rotations = np.array(pose.positions), np.array(pose.rotations)
    rotations[~turned] = np.nan
    base = rooted(pose, turned)
    positions[:, root], rotations[:, root] = base.position, base.rotation
    confidence = np.array(pose.confidence)
    confidence[:, root] = np.maximum(confidence[:, root], np.finfo(float).tiny)
    features, normal = normalise(pose.with_samples(positions, rotations, confidence))
    features[..., 3:] = on_one_side(features[..., 3:])
    joints = tuple(j for j in range(len(pose.joints)) if j != root)
    values = features[:, joints].reshape(pose.frames, -1)
    known = ~np.isnan(values)
    itself = np.tile((0.0, 0.0, 0.0, *NO_TURN), (pose.frames, 1))
    return Channels(np.where(known, values, 0.0), known, joints, normal, itself)


def steadied(channels: Channels, rate: float, faced: bool = False) -> Channels:
    """The same relative to axes that follow the root smoothly.

    Parameters
    ----------
    channels : relative to the root
    rate : frames per second
    faced : how the root is turned is told by the noisy joints beside it
        (:mod:`markermend.poses.body.facing`)

    Notes
    -----
    A root that shakes, if only by the errors of whoever solved for it, shakes all that is relative
    to it, while limbs move smoothly in the world, or stand on the ground. How the root goes is
    known in every frame, so nothing is lost by looking from beside it.
    """
    normal = channels.normal
    own, turns_s = unrolled(normal.rotation[:, None])[:, 0], _FACE_S if faced else _FOLLOW_S
    steady = unit(gaussian_filter1d(own, turns_s * rate, axis=0, mode="nearest"))
    calm = gaussian_filter1d(normal.position, _FOLLOW_S * rate, axis=0, mode="nearest")
    turned = multiply(inverse(steady), own)
    away = turn(inverse(steady), normal.position - calm) / normal.scale
    values = channels.values.reshape(len(own), -1, FEATURES).copy()
    values[..., :3] = turn(turned[:, None], values[..., :3]) + away[:, None]
    values[..., 3:] = multiply(turned[:, None], values[..., 3:])
    return replace(
        channels,
        values=np.where(channels.known, values.reshape(channels.values.shape), 0.0),
        normal=replace(normal, position=calm, rotation=steady),
        root=np.hstack([away, turned]),
    )


def to_features(values: FloatArray, channels: Channels) -> FloatArray:
    """Give columns back as (frames, joints, 7), the root among them, rotations of unit length.

    Parameters
    ----------
    values : (frames, joints · 7) as those of ``channels``; NaN goes through
    channels : what they were made from
    """
    frames = len(values)
    features = np.zeros((frames, len(channels.joints) + 1, FEATURES))
    features[:, channels.normal.root] = channels.root
    features[:, channels.joints] = values.reshape(frames, -1, FEATURES)
    features[..., 3:] = unit(features[..., 3:])
    return features


def columns_of(features: FloatArray, channels: Channels) -> FloatArray:
    """(frames, joints · 7) of all joints but the root."""
    return features[:, channels.joints].reshape(len(features), -1)


def of_all_joints(columns: FloatArray, channels: Channels) -> FloatArray:
    """(frames, joints, 7) of columns; 0 for the root."""
    whole = np.zeros((len(columns), len(channels.joints) + 1, FEATURES))
    whole[:, channels.joints] = columns.reshape(len(columns), -1, FEATURES)
    return whole


def trusted_turns(pose: Pose) -> BoolArray:
    """(frames, joints) bool: rotations that can be trusted.

    A root keeps its rotation where one of its limbs was not seen, since the others tell it, unless
    what stands there is no rotation at all.
    """
    turned = np.array(pose.turned)
    roots = [j for j, parent in enumerate(pose.parents) if parent < 0]
    own = pose.rotations[:, roots]
    blank = np.abs(np.abs(own) - NO_TURN).max(axis=2) < _UNTURNED
    turned[:, roots] = ~np.isnan(own[..., 3]) & ~(blank & ~turned[:, roots])
    return turned


def known_joints(channels: Channels, pose: Pose) -> tuple[BoolArray, BoolArray]:
    """(frames, joints) bool each: positions and rotations that are known, the root's always."""
    seen, turned = np.ones((2, pose.frames, len(pose.joints)), dtype=bool)
    seen[:, channels.joints] = channels.known[:, ::FEATURES]
    turned[:, channels.joints] = channels.known[:, FEATURES - 1 :: FEATURES]
    return seen, turned
