"""Angles that carried a limb off: only they were wrong, and what hangs on them keeps its own."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.faults.finding import MISPLACED, THROWN, Fault
from markermend.poses.faults.thrown import bridged_angles, turns_of
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of
from markermend.poses.reaching import reach
from markermend.poses.skeleton import Movement, forward_kinematics

# An angle is wrong that jumps by so much more than it does beside, where its limb leaves and where
# it comes back.
_LEAP_DEG = 10.0
_BESIDE = 4
# With the others as they were, joints must come as near to where they were filled as this share of
# how far off they had been, or this near.
_NEAR, _NEAR_MM = 0.5, 10.0
# Positions are those of the file that was read when they differ by less.
_SAME_MM = 1e-3


def with_own_angles(told: Pose, given: Pose, faults: Iterable[Fault]) -> Pose:
    """Let joints that a wrong angle carried off keep their own angles.

    Parameters
    ----------
    told : restored
    given : the recording as it was read; of a skeleton with angles, such as an AMC, else nothing is
        done
    faults : that were found in it; joints that were misplaced together are one event

    Returns
    -------
    Pose
        where angles jump as the joints leave and come back, and with other values of these angles
        alone the joints come near to where they were filled: so turned. Bones and all other angles
        are then those of the file.
    """
    movement = given.source
    if not isinstance(movement, Movement) or movement.frames != given.frames:
        return told
    positions, rotations = np.array(told.positions), np.array(told.rotations)
    events: dict[tuple[int, int], list[int]] = {}
    for fault in faults:
        if fault.kind in (MISPLACED, THROWN):
            events.setdefault((fault.start, fault.stop), []).append(fault.joint)
    for (start, stop), joints in events.items():
        found = _turned_back(told, given, movement, start, stop, joints)
        if found is None:
            continue
        rows = slice(start, stop)
        above = [given.parents[j] for j in joints if given.parents[j] >= 0]
        positions[rows, joints] = found.positions[:, joints]
        both = sorted({*joints, *above})
        turned, signs = found.rotations[:, both], told.rotations[rows, both]
        other = np.sum(turned * signs, axis=2, keepdims=True) < 0
        rotations[rows, both] = np.where(other, -turned, turned)
    return told.with_samples(positions, rotations, told.confidence)


def _turned_back(
    told: Pose, given: Pose, movement: Movement, start: int, stop: int, joints: list[int]
) -> Pose | None:
    """These frames with the wrong angles alone turned; None where that does not explain it."""
    names = movement.skeleton.names
    around = slice(max(start - 1, 0), min(stop + 1, given.frames))
    here = forward_kinematics(movement.part(around.start, around.stop), given.rate)
    apart = np.abs(here.positions - given.positions[around])
    if here.joints != given.joints or not (apart[given.seen[around]] < _SAME_MM).all():
        return None
    may = {*joints, *(given.parents[j] for j in joints)} - {-1}
    wrong = [j for j in sorted(may) if _leaps(movement, names[j], start, stop)]
    if not wrong or not told.seen[start:stop, joints].all():
        return None
    turned = bridged_angles(movement, [names[j] for j in wrong], slice(start, stop))
    free = np.zeros((stop - start, len(names)), dtype=bool)
    free[:, wrong] = True
    places = np.full(told.positions[start:stop].shape, np.nan)
    places[:, joints] = told.positions[start:stop, joints]
    found = reach(movement.skeleton, turned.channels, places, free)
    there = forward_kinematics(replace(turned, channels=found), given.rate)
    first = start - around.start
    off, away = (
        float(lengths_of(placed[:, joints] - told.positions[start:stop, joints]).mean())
        for placed in (there.positions, here.positions[first : first + stop - start])
    )
    return there if off <= max(_NEAR * away, _NEAR_MM) else None


def _leaps(movement: Movement, name: str, start: int, stop: int) -> bool:
    """Whether an angle of a segment jumps where an interval begins, and where it ends."""
    columns = turns_of(movement, name)
    if not columns:
        return False
    path = movement.channels[name][:, columns]
    ends = [n for n in (start, stop) if 0 < n < movement.frames]
    return bool(ends) and all(
        _step(path, n) > _LEAP_DEG + max(map(partial(_step, path), _beside(n, start, stop, path)))
        for n in ends
    )


def _beside(at: int, start: int, stop: int, path: FloatArray) -> list[int]:
    """Steps outside an interval next to one of its ends."""
    if at == start:
        return list(range(max(at - _BESIDE, 1), at)) or [at]
    return list(range(at + 1, min(at + 1 + _BESIDE, len(path)))) or [at]


def _step(path: FloatArray, n: int) -> float:
    """Degrees that angles turn by to a pose from the one before, the one that turns most."""
    turned = np.abs(np.nan_to_num(path[n] - path[n - 1]) + 180.0)
    return float(np.max(np.abs(turned % 360.0 - 180.0)))
