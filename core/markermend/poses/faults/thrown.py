"""Angles of a skeleton file that jump away and back: no bone breaks, but a limb is thrown off."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.ndimage import median_filter

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.faults.hinges import Hinges, hinges_of
from markermend.poses.faults.jumping import trips
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, lengths_of, multiply, rotation_vector
from markermend.poses.skeleton import TURNS, Movement

# A step of an angle is a jump when it differs by so much from those in this time around it, and by
# so many times what all but this share of its steps do, or all but a few of a short recording.
_JUMP_DEG, _TIMES, _UNUSUAL, _FEW = 15.0, 5.0, 0.01, 8
_AROUND_S, _LEAST_AROUND = 0.05, 2
# A joint was thrown off that is elsewhere by this much once angles are as before and after.
_ELSEWHERE_MM = 5.0
# They then go on, where it begins and ends, with steps that differ from those beside by this share.
_SMOOTHER = 0.5


def thrown_off(pose: Pose) -> BoolArray:
    """Find joints that hang on an angle which jumps away and comes back within a second.

    Parameters
    ----------
    pose : of rigid bones, as files of angles have them; where they are not, nothing is found

    Returns
    -------
    (frames, joints) bool

    Notes
    -----
    A limb that is elsewhere for half a second comes back to somewhere else, since the body went on,
    and the jumps of its joints do not take each other back. Those of its angles do: as the file has
    them, in the axes that are turned, or in those that they are turned from.
    """
    off = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    hinges = hinges_of(pose) if pose.frames > 2 * _LEAST_AROUND else None
    if hinges is None:
        return off
    for joint, parent in enumerate(pose.parents):
        turned = None if parent < 0 else steps_of(hinges.turns[:, joint])
        # No step differs from others by more than twice the longest.
        if turned is None or not (2.0 * lengths_of(turned) > _JUMP_DEG).any():
            continue
        odd = _odd(turned, pose.rate)
        far = lengths_of(odd)
        usual = float(np.quantile(far, max(1.0 - max(_UNUSUAL, _FEW / len(far)), 0.0)))
        leaps = far > max(_JUMP_DEG, _TIMES * usual)
        if not leaps.any():
            continue
        ways = [steps_of(hinges.turns[:, joint], within=True), _angle_steps(pose, joint)]
        for way in (odd, *(_odd(steps, pose.rate) for steps in ways if steps is not None)):
            for out, home in trips(way, leaps, pose.rate):
                rows = slice(out + 1, home + 1)
                off[rows] |= _elsewhere(hinges, joint, rows)
    return off


def steps_of(turns: FloatArray, *, within: bool = False) -> FloatArray:
    """(frames - 1, 3) degrees from each of (frames, 4) turns to the next, 0 where not known.

    About the axes that are turned from, or ``within`` those that are turned.
    """
    before, after = turns[:-1], turns[1:]
    step = multiply(inverse(before), after) if within else multiply(after, inverse(before))
    return np.asarray(np.degrees(np.nan_to_num(rotation_vector(step))))


def _angle_steps(pose: Pose, joint: int) -> FloatArray | None:
    """(frames - 1, n) degrees that a joint's angles change by, where its file has some."""
    movement, name = pose.source, pose.joints[joint]
    if not isinstance(movement, Movement) or movement.frames != pose.frames:
        return None
    if name not in movement.channels:
        return None
    (segment,) = (s for s in movement.skeleton.segments if s.name == name)
    columns = [k for k, dof in enumerate(segment.dofs) if dof in TURNS]
    steps = np.diff(movement.channels[name][:, columns], axis=0)
    # A turn may be told as one beyond 180 degrees.
    return np.asarray(np.nan_to_num((steps + 180.0) % 360.0 - 180.0))


def _odd(steps: FloatArray, rate: float) -> FloatArray:
    """(frames - 1, n) by how much steps differ from the usual ones around them."""
    around = 2 * max(round(_AROUND_S * rate), _LEAST_AROUND) + 1
    return np.asarray(steps - median_filter(steps, (around, 1), mode="nearest"))


def _elsewhere(hinges: Hinges, joint: int, rows: slice) -> BoolArray:
    """(joints,) bool: what an angle threw off in some frames; none where all goes on as it is.

    A root that is turned wrongly has angles jump that keep the body where it is.
    """
    pose = hinges.pose
    there, _ = hinges.placed(rows, {joint: hinges.bridged(joint, rows)})
    around = slice(max(rows.start - 2, 0), rows.stop + 2)
    far = np.nan_to_num(lengths_of(there - pose.positions[rows])).max(axis=0)
    thrown = (far > _ELSEWHERE_MM) & pose.seen[around].all(axis=0)
    return np.asarray(thrown & goes_on(pose.positions, there, rows, thrown))


def goes_on(
    positions: FloatArray, there: FloatArray, rows: slice, joints: Sequence[int] | BoolArray
) -> bool:
    """Whether joints leave and come back with far less of a jump where they are elsewhere.

    Parameters
    ----------
    positions : (frames, joints, 3) of a whole recording, without NaN beside and in the ``rows``
    there : (rows, joints, 3) elsewhere, in these
    joints : that are looked at, all together
    """
    around = slice(max(rows.start - 2, 0), min(rows.stop + 2, len(positions)))
    inside = slice(rows.start - around.start, rows.stop - around.start)
    before = positions[around][:, joints]
    after = np.array(before)
    after[inside] = there[:, joints]
    return _ends(after, inside) < _SMOOTHER * _ends(before, inside)


def _ends(path: FloatArray, rows: slice) -> float:
    """Mm by which steps on which joints leave and come back differ from those beside, in all."""
    steps, total = np.diff(path, axis=0), 0.0
    for there, beside in ((rows.start - 1, rows.start - 2), (rows.stop - 1, rows.stop)):
        if 0 <= there < len(steps):
            usual = steps[beside] if 0 <= beside < len(steps) else 0.0
            total += float(lengths_of(steps[there] - usual).sum())
    return total
