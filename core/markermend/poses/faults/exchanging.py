"""Left and right that changed places for a while, found by where joints go on and what fits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray, median_of_seen, runs
from markermend.poses.normal import bone_lengths
from markermend.poses.nuitrack import twins
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, lengths_of, turn

# To change places, or to change back, costs as much as a joint's way of this share of a mean bone.
_CHANGE = 0.25
# A joint changed places when it then is within this share of its bone, and of the mean bone, of
# what is usual; one that only jumped to the other's place leaves that one where it belongs.
_OFF, _OFF_BONE = 0.15, 0.12
# Where left and right hang on the same joint, they stand within this share of what is between them
# of where they usually do, in its axes; otherwise these tell nothing.
_STANDS = 0.3


@dataclass(frozen=True, eq=False)
class _Pair:
    """The first joints of two limbs, and what hangs on them on both sides.

    Attributes
    ----------
    left, right : indices, the first joint first and its counterpart in the same place
    """

    left: tuple[int, ...]
    right: tuple[int, ...]


def changed_back(pose: Pose) -> tuple[Pose, BoolArray]:
    """Let left and right change places where they then go on as before and fit the body.

    Parameters
    ----------
    pose : any skeleton whose names tell the sides (:func:`markermend.poses.nuitrack.twins`);
        what changes places is a limb from any joint down to its end

    Returns
    -------
    the recording with positions, rotations and confidence changed back, and (frames, joints) bool,
    where they were
    """
    bones = bone_lengths(pose.positions, pose.parents)
    changed = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    if np.isnan(bones).all():
        return pose, changed
    size = float(np.nanmean(bones))
    positions = np.array(pose.positions)
    rotations, confidence = np.array(pose.rotations), np.array(pose.confidence)
    for pair in _pairs(pose):
        wrong = _crossed(positions, rotations, pose.parents, pair, bones, size)
        if not wrong.any():
            continue
        here, there = [*pair.left, *pair.right], [*pair.right, *pair.left]
        rows = np.flatnonzero(wrong)[:, None]
        for values in (positions, rotations, confidence):
            values[rows, here] = values[rows, there]
        # What hangs on a limb that changed places, and had changed them again, was right.
        changed[rows, here] ^= True
    if not changed.any():
        return pose, changed
    return pose.with_samples(positions, rotations, confidence), changed


def _pairs(pose: Pose) -> Iterator[_Pair]:
    """Joints and their counterparts, parents first, each with all that hangs on both alike."""
    other = twins(pose.joints)
    for joint in pose.order:
        twin, parent = other[joint], pose.parents[joint]
        if twin <= joint or parent < 0 or pose.parents[twin] != other[parent]:
            continue
        left = [joint]
        for below in pose.order:
            above = pose.parents[below]
            if (
                above in left
                and other[below] != below
                and pose.parents[other[below]] == other[above]
            ):
                left.append(below)
        yield _Pair(tuple(left), tuple(other[n] for n in left))


def _crossed(
    positions: FloatArray,
    rotations: FloatArray,
    parents: tuple[int, ...],
    pair: _Pair,
    bones: FloatArray,
    size: float,
) -> BoolArray:
    """(frames,) bool: the pair stands, and goes, where the other side does.

    Of all ways to change places back and forth, the one is taken on which joints go the shortest
    way and are nearest to where they fit.
    """
    wrong = np.zeros(len(positions), dtype=bool)
    a, b = pair.left[0], pair.right[0]
    both = np.flatnonzero(~np.isnan(positions[:, [a, b], 0]).any(axis=1))
    if len(both) < 2:
        return wrong
    path = positions[both][:, [a, b]]
    fits, room = _fits(positions[both], rotations[both], parents, (a, b), bones, size)
    cost = np.minimum(fits, size).sum(axis=2)
    steps = _steps(path) / np.diff(both)[:, None, None]
    straight, across = steps.sum(axis=1).T
    if not ((cost[:, 1] < cost[:, 0]).any() or (across < straight).any()):
        return wrong
    state = cheapest(cost, straight, across, _CHANGE * size)
    beside = np.diff(both) == 1
    for start, stop in runs(state).tolist():
        ends = [n for n in (start - 1, stop - 1) if 0 <= n < len(steps) and beside[n]]
        # Both must go on where the other is, not one that jumped next to the other alone.
        as_is, changed = steps[ends].sum(axis=0).T
        goes_on = not ends or bool((changed < as_is).all())
        if goes_on and (np.median(fits[start:stop, 1], axis=0) < room).all():
            wrong[both[start] : both[stop - 1] + 1] = True
    return wrong


def _fits(
    positions: FloatArray,
    rotations: FloatArray,
    parents: tuple[int, ...],
    pair: tuple[int, int],
    bones: FloatArray,
    size: float,
) -> tuple[FloatArray, FloatArray]:
    """(frames, 2, 2) mm by which joints do not fit as they are and changed; and (2,) how few do.

    By the lengths of their bones, and where both hang on one joint by where they are in its axes.
    """
    (a, b), (pa, pb) = pair, (parents[pair[0]], parents[pair[1]])
    if pa == pb:
        back = inverse(rotations[:, pa])
        places = [turn(back, positions[:, j] - positions[:, pa]) for j in pair]
        usual = [median_of_seen(p) for p in places]
        apart = float(lengths_of(usual[0] - usual[1]))
        stray = [lengths_of(places[m] - usual[n]) for m, n in ((0, 0), (1, 1), (1, 0), (0, 1))]
        if median_of_seen(stray[0] + stray[1]) < 2.0 * _STANDS * apart:
            fits = np.nan_to_num(np.stack(stray, axis=1).reshape(-1, 2, 2))
            return fits, np.full(2, 0.5 * apart)
    lengths = [
        np.abs(lengths_of(positions[:, j] - positions[:, p]) - bones[n])
        for j, p, n in ((a, pa, a), (b, pb, b), (b, pa, a), (a, pb, b))
    ]
    fits = np.nan_to_num(np.stack(lengths, axis=1).reshape(-1, 2, 2))
    return fits, _OFF * bones[[a, b]] + _OFF_BONE * size


def _steps(path: FloatArray) -> FloatArray:
    """(frames - 1, 2, 2) mm that each of two joints goes, as they are and if they change places."""
    ways = [lengths_of(there - path[:-1]) for there in (path[1:], path[1:, ::-1])]
    return np.stack(ways, axis=2)


def cheapest(
    cost: FloatArray, straight: FloatArray, across: FloatArray, change: float
) -> BoolArray:
    """Whether two change places, on the cheapest of all ways to do so back and forth.

    Parameters
    ----------
    cost : (frames, 2) of each frame as it is, and changed
    straight, across : (frames - 1,) of each step without and with a change
    change : of a change, in addition

    Returns
    -------
    (frames,) bool
    """
    room, own = across + change - straight, cost[:, 1] - cost[:, 0]
    # What counts of two ways is by how much the one that ends changed is dearer.
    dearer = [float(own[0])]
    for more, here in zip(room.tolist(), own[1:].tolist(), strict=True):
        kept, most = (dearer[-1], more) if more >= 0 else (-dearer[-1], -more)
        dearer.append((most if kept > most else -most if kept < -most else kept) + here)
    before = np.array(dearer[:-1])
    came = np.stack([before < -room, before > room], axis=1)
    state = np.full(len(cost), dearer[-1] < 0)
    for n in range(int(np.flatnonzero(came.any(axis=1)).max(initial=-1)), -1, -1):
        state[n] = state[n + 1] ^ came[n, int(state[n + 1])]
    return state
