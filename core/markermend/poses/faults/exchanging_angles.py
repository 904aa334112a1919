"""Left and right whose angles changed places for a while: bones of a skeleton file never break."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.poses.faults.exchanging import cheapest
from markermend.poses.nuitrack import twins
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of
from markermend.poses.skeleton import Movement, forward_kinematics

# To change places costs as much as turning by this, all angles of a limb together; to stay changed
# a little, for what is usual to be what there is more of.
_CHANGE_DEG, _STAY_DEG = 20.0, 1e-3
# Joints then go on with steps, where it begins and ends, this much smaller together.
_SMOOTHER = 0.5
# Up to an end of the recording only one step tells, and where another was missed that is of no use.
_TO_AN_END_S = 1.0
# Positions are those of the file that was read when they differ by less.
_SAME_MM = 1e-3


def angles_changed_back(pose: Pose) -> tuple[Pose, BoolArray]:
    """Let angles of left and right limbs change places where both then go on as before.

    Parameters
    ----------
    pose : of a skeleton with angles, such as an AMC or a BVH; where it is not as it was read, and
        where there are none, nothing is done

    Returns
    -------
    the recording with the positions and rotations of these angles, and (frames, joints) bool, where
    they were changed
    """
    changed = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    movement = pose.source
    if not isinstance(movement, Movement) or movement.frames != pose.frames:
        return pose, changed
    positions, rotations = np.array(pose.positions), np.array(pose.rotations)
    for left, right in _limbs(pose, movement):
        steps = np.stack([_steps(movement, a, b) for a, b in zip(left, right, strict=True)])
        for start, stop in runs(_crossed(steps)).tolist():
            ends = [n for n in (start - 1, stop - 1) if 0 <= n < pose.frames - 1]
            if len(ends) < 2 and (not ends or stop - start > _TO_AN_END_S * pose.rate):
                continue
            # Of a limb only what then goes on, on both sides, changed places.
            as_is, across = np.moveaxis(steps[:, ends].sum(axis=1), 2, 0)
            pairs = [(left[n], right[n]) for n in np.flatnonzero((across < as_is).all(axis=1))]
            rows = slice(max(start - 1, 0), min(stop + 1, pose.frames))
            here, there = (
                forward_kinematics(m.part(rows.start, rows.stop), pose.rate)
                for m in (movement, _changed(movement, pairs, slice(start, stop)))
            )
            at = [n - rows.start for n in ends]
            apart = np.abs(here.positions - pose.positions[rows])
            if (apart > _SAME_MM).any() or _ends(there, at) > _SMOOTHER * _ends(here, at):
                continue
            moved = (np.abs(there.positions - here.positions) > _SAME_MM).any(axis=2)
            positions[rows][moved], rotations[rows][moved] = (
                there.positions[moved],
                there.rotations[moved],
            )
            changed[rows] |= moved
    if not changed.any():
        return pose, changed
    return pose.with_samples(positions, rotations, pose.confidence), changed


def _limbs(pose: Pose, movement: Movement) -> list[tuple[list[str], list[str]]]:
    """Segments of left limbs that turn, and the right ones that turn alike, in the same order."""
    other, limbs = twins(pose.joints), []
    dofs = {s.name: s.dofs for s in movement.skeleton.segments if s.name in movement.channels}
    for first, parent in enumerate(pose.parents):
        if parent < 0 or other[first] <= first or other[parent] != parent:
            continue
        pairs = [(pose.joints[j], pose.joints[other[j]]) for j in pose.hanging_on(first)]
        pairs = [(a, b) for a, b in pairs if a != b and dofs.get(a) and dofs.get(a) == dofs.get(b)]
        if pairs:
            limbs.append(([a for a, _ in pairs], [b for _, b in pairs]))
    return limbs


def _steps(movement: Movement, left: str, right: str) -> FloatArray:
    """(frames - 1, 2, 2) degrees that two segments turn, as they are and if they change places."""
    path = np.stack([movement.channels[left], movement.channels[right]], axis=1)
    ways = [np.abs(there - path[:-1]).sum(axis=2) for there in (path[1:], path[1:, ::-1])]
    return np.asarray(np.nan_to_num(np.stack(ways, axis=2)))


def _crossed(steps: FloatArray) -> BoolArray:
    """(frames,) bool: limbs have each other's angles, by all of their steps together."""
    straight, across = steps.sum(axis=(0, 2)).T
    if not (across < straight - _CHANGE_DEG).any():
        return np.zeros(len(straight) + 1, dtype=bool)
    cost = np.tile((0.0, _STAY_DEG), (len(straight) + 1, 1))
    return cheapest(cost, straight, across, _CHANGE_DEG)


def _changed(movement: Movement, pairs: list[tuple[str, str]], rows: slice) -> Movement:
    """The movement with angles of both sides changed in some frames."""
    channels = dict(movement.channels)
    for a, b in pairs:
        left, right = np.array(channels[a]), np.array(channels[b])
        left[rows], right[rows] = channels[b][rows], channels[a][rows]
        channels[a], channels[b] = left, right
    return replace(movement, channels=channels)


def _ends(pose: Pose, at: list[int]) -> float:
    """Mm that all joints go in some steps, all together."""
    after, before = (pose.positions[[n + m for n in at]] for m in (1, 0))
    return float(np.nansum(lengths_of(after - before)))
