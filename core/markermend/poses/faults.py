"""Find joints that a sensor reports wrongly without saying so, and what is wrong with them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_closing

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.poses.normal import bone_lengths
from markermend.poses.nuitrack import usual_name
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, turn

VANISHED, FROZEN, MISPLACED, SWAPPED = "vanished", "frozen", "misplaced", "swapped"
FAULTS = (VANISHED, FROZEN, MISPLACED, SWAPPED)

# Frames in a row that must be the same to the last digit, and how far the body moves meanwhile.
_FROZEN_FRAMES, _SAME_MM, _MOVED_MM = 4, 1e-6, 2.0
# A distance is impossible when off by this share of itself and of the mean bone.
_OFF, _OFF_BONE = 0.15, 0.12
_USUAL = (2.0, 98.0)
# So few possible frames in a row, between or beside impossible ones, may be so by chance; beside
# them they are where the next frame could only be reached by turning this fast.
_BY_CHANCE, _FASTEST_RAD_S = 2, 20.0
# Where its parent is misplaced, a joint whose bone is as usual in this share of frames went along.
_ALONG = 0.8
_SIDES = (("left_shoulder", "left_elbow", "left_wrist"), ("left_hip", "left_knee", "left_ankle"))


@dataclass(frozen=True)
class Fault:
    """One joint that was wrong for a while.

    Attributes
    ----------
    kind : ``"vanished"`` (at 0, 0, 0), ``"frozen"`` (stands still to the last digit while the body
        moves), ``"misplaced"`` (where its bones cannot reach: jumped, or another person's), or
        ``"swapped"`` (left and right)
    joint : index
    start, stop : frames ``[start, stop)``
    """

    kind: str
    joint: int
    start: int
    stop: int


def mend_faults(pose: Pose) -> tuple[Pose, tuple[Fault, ...]]:
    """Take out what is wrong: swaps are undone, other faults become joints that were not seen.

    Parameters
    ----------
    pose : any skeleton; swaps are looked for where joints have usual names

    Returns
    -------
    the recording, and what was wrong with it, in the order of frames
    """
    vanished = _vanished(pose)
    pose = _hidden(pose, vanished)
    frozen = _frozen(pose)
    pose = _hidden(pose, frozen)
    pose, swapped = _unswapped(pose)
    misplaced = _misplaced(pose)
    kinds = {VANISHED: vanished, FROZEN: frozen, SWAPPED: swapped, MISPLACED: misplaced}
    faults = [
        Fault(kind, joint, start, stop)
        for kind, wrong in kinds.items()
        for joint in range(len(pose.joints))
        for start, stop in runs(wrong[:, joint]).tolist()
    ]
    return _hidden(pose, misplaced), tuple(sorted(faults, key=lambda f: (f.start, f.joint)))


def _hidden(pose: Pose, wrong: BoolArray) -> Pose:
    """The recording without what is wrong."""
    if not wrong.any():
        return pose
    confidence = np.where(wrong, 0.0, pose.confidence)
    return pose.with_samples(pose.positions, pose.rotations, confidence)


def _vanished(pose: Pose) -> BoolArray:
    """(frames, joints) joints said to be seen at exactly 0, 0, 0; a root may stand there."""
    zero = np.asarray((pose.positions == 0).all(axis=2))
    zero[:, [j for j, parent in enumerate(pose.parents) if parent < 0]] = False
    return zero


def _frozen(pose: Pose) -> BoolArray:
    """(frames, joints) joints that repeat themselves while the middle joint of the body moves."""
    frozen = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    if pose.frames <= _FROZEN_FRAMES:
        return frozen
    steps = np.sqrt(np.sum(np.diff(pose.positions, axis=0) ** 2, axis=2))
    turns = np.nan_to_num(np.abs(np.diff(pose.rotations, axis=0)).max(axis=2))
    still = (steps < _SAME_MM) & (turns < _SAME_MM)
    body = np.nan_to_num(np.nanmedian(np.where(np.isnan(steps), 0.0, steps), axis=1))
    for joint in range(len(pose.joints)):
        for start, stop in runs(still[:, joint]).tolist():
            if stop - start >= _FROZEN_FRAMES - 1 and body[start:stop].sum() > _MOVED_MM:
                # The first of equal frames is still true.
                frozen[start + 1 : stop + 1, joint] = True
    return frozen


def _unswapped(pose: Pose) -> tuple[Pose, BoolArray]:
    """Undo frames in which a limb's first joint stands where the other side's usually does."""
    at = {usual_name(joint): j for j, joint in enumerate(pose.joints)}
    swapped = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    positions, rotations = np.array(pose.positions), np.array(pose.rotations)
    confidence, root = np.array(pose.confidence), pose.order[0]
    axes = inverse(pose.rotations[:, root])
    for limb in _SIDES:
        pairs = [(at.get(left), at.get(left.replace("left", "right"))) for left in limb]
        both = [(a, b) for a, b in pairs if a is not None and b is not None]
        if not both or both[0][0] != at.get(limb[0]):
            continue
        left, right = (turn(axes, pose.positions[:, j] - pose.positions[:, root]) for j in both[0])
        if np.isnan(left).all() or np.isnan(right).all():
            continue
        usual = np.nanmedian(left, axis=0), np.nanmedian(right, axis=0)
        keep = np.stack([_far(left, usual[0]), _far(right, usual[1])])
        change = np.stack([_far(left, usual[1]), _far(right, usual[0])])
        # One that jumped to the other's place leaves that one where it belongs.
        wrong = np.flatnonzero(
            (change.sum(axis=0) < 0.5 * keep.sum(axis=0)) & (change < 4.0 * keep).all(axis=0)
        )
        for a, b in both:
            for values in (positions, rotations, confidence):
                values[wrong, a], values[wrong, b] = values[wrong, b], values[wrong, a].copy()
            swapped[wrong, a] = swapped[wrong, b] = True
    if not swapped.any():
        return pose, swapped
    return pose.with_samples(positions, rotations, confidence), swapped


def _misplaced(pose: Pose) -> BoolArray:
    """(frames, joints) joints that stand where their bones cannot reach.

    Where a joint was misplaced, its child is judged from the joint's parent, unless it went along:
    an elbow that jumped leaves the wrist alone, another person's arm takes it along.
    """
    wrong = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    bones = bone_lengths(pose.positions, pose.parents)
    if np.isnan(bones).all():
        return wrong
    room = _OFF_BONE * float(np.nanmean(bones))
    for joint in pose.order:
        parent = pose.parents[joint]
        if parent < 0:
            continue
        mine, seen = _out_of_reach(pose, joint, wrong, room), pose.seen[:, joint]
        bone = pose.positions[:, joint] - pose.positions[:, parent]
        alike = np.abs(_length(bone) - bones[joint]) < _OFF * bones[joint]
        bone[wrong[:, parent]] = np.nan
        mine |= seen & _by_chance(mine, bone, _FASTEST_RAD_S / pose.rate * bones[joint] + room)
        for start, stop in runs(seen & wrong[:, parent]).tolist():
            if alike[start:stop].mean() >= _ALONG:
                mine[start:stop] = True
        wrong[:, joint] = mine
    return wrong


def _out_of_reach(pose: Pose, joint: int, wrong: BoolArray, room: float) -> BoolArray:
    """(frames,) bool: its distance from the nearest ancestor in its place is impossible."""
    out = np.zeros(pose.frames, dtype=bool)
    ancestor, unjudged = pose.parents[joint], pose.seen[:, joint].copy()
    usual = unjudged.copy()
    while ancestor >= 0 and unjudged.any():
        far = _length(pose.positions[:, joint] - pose.positions[:, ancestor])
        usual &= ~wrong[:, ancestor]
        shown = far[usual & ~np.isnan(far)]
        judged = unjudged & ~wrong[:, ancestor] & ~np.isnan(far)
        if len(shown):
            low, high = np.percentile(shown, _USUAL)
            if ancestor == pose.parents[joint]:
                low = high = np.median(shown)
            out |= judged & ((far > (1 + _OFF) * high + room) | (far < (1 - _OFF) * low - room))
        unjudged &= ~judged
        ancestor = pose.parents[ancestor]
    return out


def _by_chance(wrong: BoolArray, bone: FloatArray, step: float) -> BoolArray:
    """(frames,) bool: frames between wrong ones, or from which the next good one is too far."""
    joined, far = wrong.copy(), _length(np.diff(bone, axis=0)) > step
    for _ in range(_BY_CHANCE):
        after, before = joined[:-2] & far[1:], joined[2:] & far[:-1]
        joined[1:-1] |= (after & ~joined[2:]) | (before & ~joined[:-2])
    return np.asarray(joined | binary_closing(joined, np.ones(_BY_CHANCE + 1, dtype=bool)))


def _length(vectors: FloatArray) -> FloatArray:
    """Length of each vector."""
    return np.asarray(np.sqrt(np.sum(vectors**2, axis=-1)))


def _far(points: FloatArray, place: FloatArray) -> FloatArray:
    """(frames,) squared distance."""
    return np.asarray(np.sum((points - place) ** 2, axis=1))
