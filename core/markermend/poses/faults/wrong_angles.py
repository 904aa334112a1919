"""Angles that threw a limb off: only they were wrong, and what hangs on them keeps its own."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.faults.finding import MISPLACED, THROWN, Fault
from markermend.poses.faults.hinges import Hinges, hinges_of
from markermend.poses.faults.swinging import nearest_turns
from markermend.poses.faults.thrown import goes_on, steps_of
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, lengths_of, multiply
from markermend.poses.reaching import reach
from markermend.poses.skeleton import TURNS, Movement, forward_kinematics

# A joint is turned wrongly that turns by so much more than it does beside, where its limb leaves
# and where it comes back.
_LEAP_DEG = 10.0
_BESIDE = 4
# Others are wrong, too, that turn by so much more than beside, and than this share of their steps.
_USUAL = 0.99
# With the others as they were, joints must come as near to where they were filled as this share of
# how far off they had been, or this near.
_NEAR, _NEAR_MM = 0.5, 10.0
# No bone to a joint that stays may change by more.
_BROKEN_MM = 5.0
# Positions are those of the file that was read when they differ by less.
_SAME_MM = 1e-3


def with_own_angles(told: Pose, given: Pose, faults: Iterable[Fault]) -> Pose:
    """Let joints that a wrong angle threw off keep their own angles.

    Parameters
    ----------
    told : restored
    given : the recording as it was read; of rigid bones, as files of angles have them, else nothing
        is done
    faults : that were found in it; joints that were misplaced together are one event

    Returns
    -------
    Pose
        where joints turn by a jump as a limb leaves and as it comes back, and the limb, turned
        otherwise at these alone, comes near to where it was filled: so turned. Where it comes near
        most of the time only, and leaves and comes back without a jump once these turn steadily
        from what is before to what is after: so. Bones and all other angles are then those of the
        file.
    """
    events: dict[tuple[int, int], list[int]] = {}
    for fault in faults:
        if fault.kind in (MISPLACED, THROWN):
            events.setdefault((fault.start, fault.stop), []).append(fault.joint)
    hinges = hinges_of(given) if events else None
    if hinges is None:
        return told
    positions, rotations = np.array(told.positions), np.array(told.rotations)
    for (start, stop), joints in events.items():
        rows = slice(start, stop)
        found = _turned_back(told, hinges, rows, joints)
        if found is None:
            continue
        places, turns = found
        above = [given.parents[j] for j in joints if given.parents[j] >= 0]
        positions[rows, joints] = places[:, joints]
        both = sorted({*joints, *above})
        other = np.sum(turns[:, both] * told.rotations[rows, both], axis=2, keepdims=True) < 0
        rotations[rows, both] = np.where(other, -turns[:, both], turns[:, both])
    return told.with_samples(positions, rotations, told.confidence)


def _turned_back(
    told: Pose, hinges: Hinges, rows: slice, joints: list[int]
) -> tuple[FloatArray, FloatArray] | None:
    """Places and rotations, the wrong angles alone turned; None where that does not explain it."""
    given, wanted = hinges.pose, told.positions[rows]
    may = {*joints, *(given.parents[j] for j in joints)}
    may = {j for j in may if j >= 0 and given.parents[j] >= 0}
    wrong = [j for j in given.order if j in may and _leaps(hinges.turns[:, j], rows)]
    if not wrong or np.isnan(wanted[:, joints]).any() or np.isnan(given.positions[rows]).any():
        return None
    if any(_leaps_within(hinges.turns[:, j], rows) for j in may - set(wrong)):
        # Something else is wrong for a part of that time.
        return None
    by = _by_channels if _as_read(given, rows) else _by_turns
    reached, bridged = by(hinges, rows, wanted, wrong, joints)
    off, away = (
        lengths_of(placed[:, joints] - wanted[:, joints]).mean(axis=1)
        for placed in (reached[0], given.positions[rows])
    )
    if (off <= np.maximum(_NEAR * away, _NEAR_MM)).all():
        found = reached
    elif off.sum() <= _NEAR * away.sum() and goes_on(given.positions, bridged[0], rows, joints):
        # What was filled is itself far off for a part of that time.
        found = bridged
    else:
        return None
    return found if _whole(hinges, found[0], wanted, joints) else None


def _as_read(given: Pose, rows: slice) -> bool:
    """Whether a recording is in some frames as the channels that it was read from have it."""
    movement = given.source
    if not isinstance(movement, Movement) or movement.frames != given.frames:
        return False
    if movement.skeleton.names != given.joints:
        return False
    here = forward_kinematics(movement.part(rows.start, rows.stop), given.rate)
    return bool((np.abs(here.positions - given.positions[rows]) < _SAME_MM).all())


def _whole(hinges: Hinges, found: FloatArray, wanted: FloatArray, joints: list[int]) -> bool:
    """Whether bones between joints that come and those that stay are as long as they were."""
    places = wanted.copy()
    places[:, joints] = found[:, joints]
    for joint, parent in enumerate(hinges.pose.parents):
        if parent >= 0 and (joint in joints) != (parent in joints):
            far = lengths_of(places[:, joint] - places[:, parent])
            usual = float(lengths_of(hinges.bones[joint]))
            if np.nanmax(np.abs(far - usual), initial=0.0) > _BROKEN_MM:
                return False
    return True


def _by_channels(
    hinges: Hinges, rows: slice, wanted: FloatArray, wrong: list[int], joints: list[int]
) -> tuple[tuple[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]:
    """Turn segments as far as their degrees of freedom go: to what is wanted, and steadily."""
    given = hinges.pose
    movement = given.source
    assert isinstance(movement, Movement)
    names = movement.skeleton.names
    inside = movement.part(rows.start, rows.stop)
    channels, held = dict(inside.channels), list[tuple[str, int]]()
    for j in wrong:
        path, name = _bridged(movement, names[j], rows), names[j]
        still = _still(movement, name, rows)
        path[:, still] = channels[name][:, still]
        channels[name] = path
        held += [(name, column) for column in still]
    free = np.zeros((inside.frames, len(names)), dtype=bool)
    free[:, wrong] = True
    places = np.full(wanted.shape, np.nan)
    places[:, joints] = wanted[:, joints]
    found = reach(movement.skeleton, channels, places, free, held=held)
    there, between = (
        forward_kinematics(replace(inside, channels=ways), given.rate) for ways in (found, channels)
    )
    return (there.positions, there.rotations), (between.positions, between.rotations)


def _bridged(movement: Movement, name: str, rows: slice) -> FloatArray:
    """(frames, n) channels of a segment from what is before some frames to what is after."""
    path, last = movement.channels[name], movement.frames - 1
    segment = movement.skeleton.segments[movement.skeleton.names.index(name)]
    turns = [k for k, dof in enumerate(segment.dofs) if dof in TURNS]
    before, after = path[max(rows.start - 1, 0)], np.array(path[min(rows.stop, last)])
    if rows.start == 0:
        before = after
    elif rows.stop > last:
        after = np.array(before)
    # An angle may be told as one that went round.
    after[turns] -= 360.0 * np.round((after[turns] - before[turns]) / 360.0)
    share = (np.arange(rows.start, rows.stop) - rows.start + 1.0) / (rows.stop - rows.start + 1)
    return np.asarray(before + share[:, None] * (after - before))


def _still(movement: Movement, name: str, rows: slice) -> list[int]:
    """Columns of a segment that do not jump where an interval begins or ends, if some do."""
    path = movement.channels[name]
    ends = [n for n in (rows.start, rows.stop) if 0 < n < len(path)]
    # An angle may be told as one that went round.
    steps = np.abs((path[ends] - path[[n - 1 for n in ends]] + 180.0) % 360.0 - 180.0)
    still = np.flatnonzero((steps < _LEAP_DEG).any(axis=0)).tolist()
    return still if len(still) < path.shape[1] else []


def _by_turns(
    hinges: Hinges, rows: slice, wanted: FloatArray, wrong: list[int], joints: list[int]
) -> tuple[tuple[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]:
    """Turn joints freely, those nearer to the root first: to what is wanted, and steadily."""
    pose = hinges.pose
    turns = {j: hinges.bridged(j, rows) for j in wrong}
    between = hinges.placed(rows, turns)
    for j in wrong:
        positions, rotations = hinges.placed(rows, turns)
        hinge = pose.parents[j] if hinges.own else j
        moved = [k for k in joints if k in pose.hanging_on(j) and k != hinge]
        if not moved:
            continue
        arms, there = (x[:, moved] - positions[:, [hinge]] for x in (positions, wanted))
        further = multiply(nearest_turns(arms, there), rotations[:, j])
        turns[j] = multiply(inverse(rotations[:, pose.parents[j]]), further)
    return hinges.placed(rows, turns), between


def _leaps(turns: FloatArray, rows: slice) -> bool:
    """Whether a joint turns by a jump where an interval begins, and where it ends."""
    steps = lengths_of(steps_of(turns))
    ends = [
        (at - 1, beside)
        for at, beside in zip((rows.start, rows.stop), _beside(rows), strict=True)
        if 0 < at < len(turns)
    ]
    return bool(ends) and all(
        steps[there] > _LEAP_DEG + steps[beside].max(initial=0.0) for there, beside in ends
    )


def _leaps_within(turns: FloatArray, rows: slice) -> bool:
    """Whether a joint turns by a jump somewhere from the beginning of an interval to its end."""
    steps = lengths_of(steps_of(turns))
    beside = max(steps[some].max(initial=0.0) for some in _beside(rows))
    usual = max(beside, float(np.quantile(steps, _USUAL)))
    return bool(steps[max(rows.start - 1, 0) : rows.stop].max(initial=0.0) > _LEAP_DEG + usual)


def _beside(rows: slice) -> tuple[slice, slice]:
    """Steps before an interval and after it."""
    first = max(rows.start - 1, 0)
    return slice(max(first - _BESIDE, 0), first), slice(rows.stop, rows.stop + _BESIDE)
