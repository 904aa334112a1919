"""Joints that stand where their bones cannot reach."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import binary_closing

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.poses.faults.jumping import jumped
from markermend.poses.normal import bone_lengths
from markermend.poses.pose import Pose, parents_first
from markermend.poses.quaternion import lengths_of

OFF, OFF_BONE = 0.15, 0.12
"""A distance is impossible when off by this share of itself and of the mean bone."""
FASTEST_RAD_S = 20.0
"""No bone turns faster."""

_USUAL = (2.0, 98.0)
# A distance is a bone's where in half of the frames it differs by no more than this share.
_MOSTLY, _RIGID = (25.0, 50.0, 75.0), 0.05
# So few possible frames in a row, between or beside impossible ones, may be so by chance; beside
# them they are where the next frame could only be reached by turning this fast.
_BY_CHANCE = 2
# Where its parent is misplaced, a joint whose bone is as usual in this share of frames went along.
_ALONG = 0.8
# Bodies may be looked at from joints that this many bones meet at, besides from the root.
_MEET = 3


def misplaced(pose: Pose) -> BoolArray:
    """Find joints that stand where their bones cannot reach.

    Parameters
    ----------
    pose : any skeleton

    Returns
    -------
    (frames, joints) bool. Which end of an impossible bone is wrong depends on where one looks
    from: in every frame the body is looked at from its root and from where limbs meet, and what
    makes the fewest joints wrong is taken.
    """
    bones = bone_lengths(pose.positions, pose.parents)
    nowhere = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    if np.isnan(bones).all():
        return nowhere
    room = OFF_BONE * float(np.nanmean(bones))
    gone = jumped(pose, bones)
    wrong = _seen_from(pose, pose.parents, gone, room)
    # From elsewhere no more can be wrong than where a root, or what hangs on it, is.
    for joint in _meetings(pose.parents):
        doubtful = np.flatnonzero(wrong.sum(axis=1) > 1)
        if not len(doubtful):
            break
        other = _seen_from(pose, _from(joint, pose.parents), gone, room)
        fewer = other.sum(axis=1) < wrong.sum(axis=1)
        wrong[fewer] = other[fewer]
    return wrong


def _meetings(parents: tuple[int, ...]) -> list[int]:
    """Joints that several bones meet at, but for the root."""
    bones = [
        sum(p == joint for p in parents) + (parents[joint] >= 0) for joint in range(len(parents))
    ]
    return [j for j, count in enumerate(bones) if count >= _MEET and parents[j] >= 0]


def _from(joint: int, parents: tuple[int, ...]) -> tuple[int, ...]:
    """Parents in the same tree as it hangs on another joint."""
    out, child, above = list(parents), -1, joint
    while above >= 0:
        out[above], child, above = child, above, parents[above]
    return tuple(out)


def _seen_from(pose: Pose, parents: tuple[int, ...], gone: BoolArray, room: float) -> BoolArray:
    """(frames, joints) joints that are out of reach of those above them, whose root is right.

    Where a joint was misplaced, its child is judged from the joint's parent, unless it went along:
    an elbow that jumped leaves the wrist alone, another person's arm takes it along.
    """
    wrong = gone.copy()
    bones = bone_lengths(np.where(gone[..., None], np.nan, pose.positions), parents)
    for joint in parents_first(parents, pose.joints):
        parent = parents[joint]
        if parent < 0:
            continue
        mine, seen = (
            gone[:, joint] | _out_of_reach(pose, parents, joint, wrong, room),
            pose.seen[:, joint],
        )
        bone = pose.positions[:, joint] - pose.positions[:, parent]
        alike = np.abs(lengths_of(bone) - bones[joint]) < OFF * bones[joint]
        bone[wrong[:, parent]] = np.nan
        mine |= seen & _by_chance(mine, bone, FASTEST_RAD_S / pose.rate * bones[joint] + room)
        for start, stop in runs(seen & wrong[:, parent]).tolist():
            # Whether it went along where its parent jumped away and came back is known already.
            if alike[start:stop].mean() >= _ALONG and not gone[start:stop, parent].all():
                mine[start:stop] = True
        wrong[:, joint] = mine
    return wrong


def _out_of_reach(
    pose: Pose, parents: tuple[int, ...], joint: int, wrong: BoolArray, room: float
) -> BoolArray:
    """(frames,) bool: its distance from the nearest ancestor in its place is impossible."""
    out = np.zeros(pose.frames, dtype=bool)
    ancestor, unjudged = parents[joint], pose.seen[:, joint].copy()
    usual = unjudged & ~wrong[:, joint]
    while ancestor >= 0 and unjudged.any():
        far = lengths_of(pose.positions[:, joint] - pose.positions[:, ancestor])
        usual &= ~wrong[:, ancestor]
        shown = far[usual & ~np.isnan(far)]
        judged = unjudged & ~wrong[:, ancestor] & ~np.isnan(far)
        if len(shown):
            low, high = np.percentile(shown, _USUAL)
            calm, usually, most = np.percentile(shown, _MOSTLY)
            # Over a joint that a sensor leaves out, the distance to the next one is no bone.
            if ancestor == parents[joint] and most - calm <= _RIGID * usually + room:
                low = high = usually
            out |= judged & ((far > (1 + OFF) * high + room) | (far < (1 - OFF) * low - room))
        unjudged &= ~judged
        ancestor = parents[ancestor]
    return out


def _by_chance(wrong: BoolArray, bone: FloatArray, step: float) -> BoolArray:
    """(frames,) bool: frames between wrong ones, or from which the next good one is too far."""
    joined, far = wrong.copy(), lengths_of(np.diff(bone, axis=0)) > step
    for _ in range(_BY_CHANCE):
        after, before = joined[:-2] & far[1:], joined[2:] & far[:-1]
        joined[1:-1] |= (after & ~joined[2:]) | (before & ~joined[:-2])
    return np.asarray(joined | binary_closing(joined, np.ones(_BY_CHANCE + 1, dtype=bool)))
