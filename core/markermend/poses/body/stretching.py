"""Positions alone: each moved by as much as it is unsure, until bones have their length."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.body.bones import Bones
from markermend.poses.quaternion import lengths_of

# A rigid bone's length is known to this, in mean bone lengths.
_LENGTH = 0.003
# Steps that are linear each: a knee filled on the line from hip to ankle bends too far in two.
_ROUNDS = 3


def stretched(
    places: FloatArray, variance: FloatArray, bones: Bones, order: Sequence[int]
) -> FloatArray:
    """Return the most probable positions, given unsure ones and bones that keep their length.

    Parameters
    ----------
    places : (frames, joints, 3) over the mean bone length; NaN of a joint that was never seen
    variance : (frames, joints) of each coordinate; 0 of those that stay
    bones : what is constant
    order : joints, parents first

    Returns
    -------
    (frames, joints, 3)

    Notes
    -----
    Joints are a tree and each bone binds two of them in one direction, so least squares over all is
    solved exactly by a filter from the ends of limbs to the root and a smoother back (Kalman 1960;
    Rauch, Tung and Striebel 1965), along bones instead of time.
    """
    now = places.copy()
    for _ in range(_ROUNDS):
        now = now + _step(now, places - now, variance, bones, order)
    return now


def _step(
    places: FloatArray,
    away: FloatArray,
    variance: FloatArray,
    bones: Bones,
    order: Sequence[int],
) -> FloatArray:
    """(frames, joints, 3) the step that is most probable where bones are linear in it.

    ``away`` is (frames, joints, 3): the step if there were no bones.
    """
    step = away.copy()
    spread = variance[..., None, None] * np.eye(3)
    bound = [joint for joint in order if not np.isnan(bones.lengths[joint])]
    told = {}
    for joint in reversed(bound):
        parent = bones.parents[joint]
        bone = places[:, joint] - places[:, parent]
        far = np.maximum(lengths_of(bone), np.finfo(float).tiny)
        along = bone / far[:, None]
        short = bones.lengths[joint] - far
        moves, own = _along(spread[:, joint], along)
        told[joint] = along, short, moves, own
        its_moves, its = _along(spread[:, parent], along)
        gain = its_moves / (its + own + _LENGTH**2)[:, None]
        apart = np.sum(along * (step[:, joint] - step[:, parent]), axis=1) - short
        step[:, parent] += gain * apart[:, None]
        spread[:, parent] -= gain[:, :, None] * its_moves[:, None]
    for joint in bound:
        along, short, moves, own = told[joint]
        apart = np.sum(along * (step[:, bones.parents[joint]] - step[:, joint]), axis=1) + short
        step[:, joint] += moves * (apart / (own + _LENGTH**2))[:, None]
    return step


def _along(spread: FloatArray, way: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(frames, 3) how a joint goes along with a step in a direction, and (frames,) how unsure."""
    moves = (spread @ way[:, :, None])[:, :, 0]
    return moves, np.sum(way * moves, axis=1)
