"""Limbs whose angles stand still: carried along by the body, but bent no more."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.poses.nuitrack import twins
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, turn

# What stands still in another joint's axes moves less than this from frame to frame: the last
# digits of files with six for rotations. A joint that mostly does is fixed there.
_SAME_MM, _FIXED = 5e-3, 0.5
# So long a limb must stand still, in frames and in time, while what moves of the others goes so far
# in the axes of the joint that they hang on; and so many joints of it, or it may be by chance.
_FRAMES, _LASTS_S, _MOVED_MM = 8, 0.1, 5.0
_JOINTS = 2


def stiff(pose: Pose) -> BoolArray:
    """Find limbs that stay as they are bent, to the last digit, while others move.

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
    paths = {(base, joints): _steps_beside(pose, base, joints) for base, joints in limbs}
    for (base, joints), steps in paths.items():
        others = [p for (b, j), p in paths.items() if not set(j) & set(joints)]
        # Feet and hands often stand still by themselves.
        for above in (base, joints[0]):
            below = joints if above == base else joints[1:]
            here = steps if above == base else _steps_beside(pose, above, joints)
            here = here[:, [joints.index(j) for j in below]]
            still = here < _SAME_MM
            moves = still.mean(axis=0) < _FIXED
            held = (still & moves).sum(axis=1) >= _JOINTS
            for start, stop in runs(held).tolist():
                # Before a limb first moves, or after it last does, nothing tells where it went.
                inside = start > 0 and stop < len(held)
                long = stop - start >= max(_FRAMES, _LASTS_S * pose.rate)
                if inside and long and _farthest(others, start, stop) > _MOVED_MM:
                    throughout = still[start:stop].all(axis=0) & moves
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


def _steps_beside(pose: Pose, base: int, joints: tuple[int, ...]) -> FloatArray:
    """(frames - 1, joints) mm that joints go in the axes of another; NaN where one is not seen."""
    apart = pose.positions[:, joints] - pose.positions[:, [base]]
    return _length(np.diff(turn(inverse(pose.rotations[:, [base]]), apart), axis=0))


def _farthest(paths: list[FloatArray], start: int, stop: int) -> float:
    """Mm that the joint goes that goes farthest."""
    return max((float(np.nansum(p[start:stop], axis=0).max()) for p in paths), default=0.0)


def _length(vectors: FloatArray) -> FloatArray:
    """Length of each vector."""
    return np.asarray(np.sqrt(np.sum(vectors**2, axis=-1)))
