"""Limbs whose angles stand still: carried along by the body, but bent no more."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.poses.faults.holding import goes_on_elsewhere
from markermend.poses.nuitrack import twins
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, lengths_of, turn

# What stands still in another joint's axes moves less than this from frame to frame: the last
# digits of files with six for rotations. A joint that mostly does is fixed there.
_SAME_MM, _FIXED = 5e-3, 0.5
# So long a limb must stand still, in frames and in time, while joints of others go so far (their
# median) beside what they hang on; and so many joints of it, or it may be by chance.
_FRAMES, _LASTS_S, _MOVED_MM = 8, 0.1, 5.0
_JOINTS = 2
# Where it stops dead and goes on elsewhere, so many frames are enough, whatever others do.
_BRIEF = 2
# Nearer than this a limb that moved would not be again by chance.
_AGAIN_MM = 0.1


def stiff(pose: Pose) -> BoolArray:
    """Find limbs that stay as they are bent while others move, or that then go on elsewhere.

    Parameters
    ----------
    pose : any skeleton whose names tell the sides, with rotations

    Returns
    -------
    (frames, joints) bool, from the second of the frames that are alike; of the joints that stand
    still there and move otherwise, and of all that hangs on them
    """
    found = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    limbs = _limbs(pose)
    if pose.frames <= _FRAMES or not limbs:
        return found
    paths = {
        (base, joints): lengths_of(np.diff(_beside(pose, base, joints), axis=0))
        for base, joints in limbs
    }
    for base, joints in limbs:
        others = [p for (b, j), p in paths.items() if not set(j) & set(joints)]
        # Feet and hands often stand still by themselves.
        for above in (base, joints[0]):
            below = joints if above == base else joints[1:]
            places = _beside(pose, above, below)
            steps = lengths_of(np.diff(places, axis=0))
            still = steps < _SAME_MM
            moves = still.mean(axis=0) < _FIXED
            held = (still & moves).sum(axis=1) >= _JOINTS
            for start, stop in runs(held).tolist():
                if stop - start < _BRIEF:
                    continue
                throughout = still[start:stop].all(axis=0) & moves
                # Before a limb first moves, or after it last does, nothing tells where it went.
                if _at_an_end(places[:, throughout], start):
                    continue
                long = stop - start >= max(_FRAMES, _LASTS_S * pose.rate)
                if (long and _usual_way(others, start, stop) > _MOVED_MM) or goes_on_elsewhere(
                    steps[:, throughout], start, stop
                ):
                    for joint in np.array(below)[throughout].tolist():
                        found[start + 1 : stop + 1, pose.hanging_on(joint)] = True
    return found


def _limbs(pose: Pose) -> list[tuple[int, tuple[int, ...]]]:
    """The joint in the middle of the body that each limb hangs on, and the limb's joints."""
    other = twins(pose.joints)
    first = [
        (parent, j)
        for j, parent in enumerate(pose.parents)
        if parent >= 0 and other[j] != j and other[parent] == parent
    ]
    return [(parent, pose.hanging_on(j)) for parent, j in first]


def _beside(pose: Pose, base: int, joints: tuple[int, ...]) -> FloatArray:
    """(frames, joints, 3) mm of joints in the axes of another; NaN where one is not seen."""
    apart = pose.positions[:, joints] - pose.positions[:, [base]]
    return turn(inverse(pose.rotations[:, [base]]), apart)


def _at_an_end(places: FloatArray, frame: int) -> bool:
    """Whether joints are where they are when the recording first shows them, or last does."""
    seen = np.flatnonzero(~np.isnan(places).any(axis=(1, 2)))
    away = lengths_of(places[[seen[0], seen[-1]]] - places[frame])
    return bool((away < _AGAIN_MM).all(axis=1).any())


def _usual_way(paths: list[FloatArray], start: int, stop: int) -> float:
    """Mm that the joint in the middle of some goes, from the one that goes least on."""
    ways = [np.nansum(p[start:stop], axis=0) for p in paths]
    return float(np.median(np.concatenate(ways))) if ways else 0.0
