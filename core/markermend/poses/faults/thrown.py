"""Angles of a skeleton file that jump away and back: no bone breaks, but a limb is thrown off."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.ndimage import median_filter

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.faults.jumping import trips
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, lengths_of, multiply, rotation_vector
from markermend.poses.skeleton import TURNS, Movement, forward_kinematics

# A step of an angle is a jump when it differs by so much from those in this time around it, and by
# so many times what all but this share of its steps do.
_JUMP_DEG, _TIMES, _USUAL = 15.0, 5.0, 99.0
_AROUND_S, _LEAST_AROUND = 0.05, 2
# A joint was thrown off that is elsewhere by this much once angles are as before and after.
_ELSEWHERE_MM = 5.0
# They then go on, where it begins and ends, with steps that differ from those beside by this share.
_SMOOTHER = 0.5
# Positions are those of the file that was read when they differ by less.
_SAME_MM = 1e-3


def thrown_off(pose: Pose) -> BoolArray:
    """Find joints that hang on an angle which jumps away and comes back within a second.

    Parameters
    ----------
    pose : of a skeleton with angles, such as an AMC; where it is not as it was read, and where
        there are none, nothing is found

    Returns
    -------
    (frames, joints) bool

    Notes
    -----
    A limb that is elsewhere for half a second comes back to somewhere else, since the body went on,
    and the jumps of its joints do not take each other back. Those of its angles do.
    """
    off = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    movement = pose.source
    if not isinstance(movement, Movement) or movement.frames != pose.frames:
        return off
    if movement.skeleton.names != pose.joints or pose.frames < 2 * _LEAST_AROUND + 1:
        return off
    for joint, parent in enumerate(pose.parents):
        columns = turns_of(movement, pose.joints[joint])
        if parent < 0 or not columns:
            continue
        local = multiply(inverse(pose.rotations[:, parent]), pose.rotations[:, joint])
        turned = np.degrees(rotation_vector(multiply(local[1:], inverse(local[:-1]))))
        # No step differs from others by more than twice the longest.
        if not (2.0 * lengths_of(turned) > _JUMP_DEG).any():
            continue
        far = lengths_of(_odd(turned, pose.rate))
        leaps = far > max(_JUMP_DEG, _TIMES * float(np.percentile(far, _USUAL)))
        if not leaps.any():
            continue
        # A turn may be told as one beyond 180 degrees.
        steps = np.diff(movement.channels[pose.joints[joint]][:, columns], axis=0)
        odd = _odd((steps + 180.0) % 360.0 - 180.0, pose.rate)
        for out, home in trips(odd, leaps, pose.rate):
            rows = slice(out + 1, home + 1)
            off[rows] |= _elsewhere(pose, movement, joint, rows)
    return off


def turns_of(movement: Movement, name: str) -> list[int]:
    """Columns of a segment's channels that are angles."""
    if name not in movement.channels:
        return []
    segment = movement.skeleton.segments[movement.skeleton.names.index(name)]
    return [k for k, dof in enumerate(segment.dofs) if dof in TURNS]


def bridged_angles(movement: Movement, names: Sequence[str], rows: slice) -> Movement:
    """Frames of a movement with some segments' channels from what is before to what is after."""
    inside = movement.part(rows.start, rows.stop)
    channels = dict(inside.channels)
    last = movement.frames - 1
    share = (np.arange(rows.start, rows.stop) - rows.start + 1.0) / (rows.stop - rows.start + 1)
    for name in names:
        path, turns = movement.channels[name], turns_of(movement, name)
        before, after = path[max(rows.start - 1, 0)], np.array(path[min(rows.stop, last)])
        if rows.start == 0:
            before = after
        elif rows.stop > last:
            after = np.array(before)
        # An angle may be told as one that went round.
        rounds = np.round((after[turns] - before[turns]) / 360.0)
        after[turns] -= 360.0 * rounds
        channels[name] = before + share[:, None] * (after - before)
    return replace(inside, channels=channels)


def _odd(steps: FloatArray, rate: float) -> FloatArray:
    """(frames - 1, n) by how much steps differ from the usual ones around them."""
    around = 2 * max(round(_AROUND_S * rate), _LEAST_AROUND) + 1
    steps = np.nan_to_num(steps)
    return np.asarray(steps - median_filter(steps, (around, 1), mode="nearest"))


def _elsewhere(pose: Pose, movement: Movement, joint: int, rows: slice) -> BoolArray:
    """(joints,) bool: what an angle threw off in some frames; none where all goes on as it is.

    A root that is turned wrongly has angles jump that keep the body where it is.
    """
    around = slice(max(rows.start - 2, 0), min(rows.stop + 2, pose.frames))
    inside = slice(rows.start - around.start, rows.stop - around.start)
    here = forward_kinematics(movement.part(around.start, around.stop), pose.rate).positions
    as_read = (np.abs(here - pose.positions[around])[inside] < _SAME_MM).all(axis=(0, 2))
    there = here.copy()
    bridged = bridged_angles(movement, [pose.joints[joint]], rows)
    there[inside] = forward_kinematics(bridged, pose.rate).positions
    thrown = as_read & (lengths_of(there - here).max(axis=0) > _ELSEWHERE_MM)
    before, after = (_ends(path[:, thrown], inside) for path in (here, there))
    return np.asarray(thrown & (after < _SMOOTHER * before))


def _ends(path: FloatArray, rows: slice) -> float:
    """Mm by which steps on which joints leave and come back differ from those beside, in all."""
    steps, total = np.diff(path, axis=0), 0.0
    for there, beside in ((rows.start - 1, rows.start - 2), (rows.stop - 1, rows.stop)):
        if 0 <= there < len(steps):
            usual = steps[beside] if 0 <= beside < len(steps) else 0.0
            total += float(lengths_of(steps[there] - usual).sum())
    return total
