"""Joints that are held in one place, told by how they stop and how they go on."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of

# Joints are where they were when they went less; in a file with coarser digits than these one
# joint may be so by chance, half of a body not.
_SAME_MM, _FINE_MM = 1e-6, 0.01
# What was held goes on with a step this much longer than those beside it, and so far at least.
# What pauses sets out with short steps, and its last one before is this much shorter than another.
_LONGER, _FAR_MM, _SLOWS = 1.5, 2.0, 0.35
# What trembles in so many frames on either side, neighbouring changes of its steps being as unlike
# as this (-2/3 for noise alone), by so much, does not stand still in between, unless its last step
# before or the first after is this much shorter than others: of one joint it may be so by chance.
_AROUND, _UNLIKE, _TREMBLES_MM = 8, -0.3, 0.05
_SHORT, _SHORT_ALONE = 0.6, 0.3
# Whole poses repeated more often than this, with no time lost, come of another rate.
_OFTEN_HZ = 3.0
# So many poses show the last digit of a file.
_SOME = 500


def held(pose: Pose) -> tuple[BoolArray, BoolArray]:
    """Find joints that stand in one place, to the last digit, though they cannot have stopped.

    Parameters
    ----------
    pose : any skeleton

    Returns
    -------
    (frames, joints) bool, from the second of the frames that are alike, and (frames,) bool, where
    that is all that is seen. How joints are turned meanwhile does not matter. What was held is
    elsewhere all at once when it goes on, or trembles before and after; who stands still to the
    last digit, as in an animation, slows down before and sets out slowly.
    """
    found = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    whole = np.zeros(pose.frames, dtype=bool)
    steps = lengths_of(np.diff(pose.positions, axis=0))
    still = steps < _SAME_MM
    if not still.any():
        return found, whole
    groups, seen = together(still), pose.seen[1:]
    everybody = {steps for steps in groups if still[steps[0], seen[steps[0]]].all()}
    resampled = len(everybody) * pose.rate > _OFTEN_HZ * pose.frames
    fine, half = _finest(pose.positions) < _FINE_MM, len(pose.joints) / 2
    for (start, stop), joints in groups.items():
        is_all, many = (start, stop) in everybody, len(joints) >= half
        if not (fine or many) or (is_all and resampled and stop - start == 1):
            continue
        first = max(start - _AROUND, 0)
        mine = steps[first : stop + _AROUND + 1, joints]
        where = pose.positions[first : stop + _AROUND + 2, joints]
        stands = start - first, stop - first
        if goes_on_elsewhere(mine, *stands) or (
            not (is_all and resampled) and _trembles(where, mine, *stands, many=many)
        ):
            found[start + 1 : stop + 1, joints] = True
            whole[start + 1 : stop + 1] |= is_all
    return found, whole


def together(still: BoolArray) -> dict[tuple[int, int], list[int]]:
    """Joints by the steps ``[start, stop)`` in which they stand still, (steps, joints) bool."""
    groups: dict[tuple[int, int], list[int]] = {}
    for joint in np.flatnonzero(still.any(axis=0)).tolist():
        for start, stop in runs(still[:, joint]).tolist():
            groups.setdefault((start, stop), []).append(joint)
    return groups


def goes_on_elsewhere(steps: FloatArray, start: int, stop: int) -> bool:
    """Whether joints stop dead, and go on with a step that takes up what they missed.

    Parameters
    ----------
    steps : (frames - 1, joints) mm; NaN where a joint was not seen
    start, stop : the steps ``[start, stop)`` in which they stand still
    """
    if start < 2 or stop + 1 >= len(steps):
        return False
    ways = np.nansum(steps, axis=1)
    far, before, after = ways[stop], ways[max(start - 3, 0) : start], ways[stop + 1 : stop + 3]
    # The least of two steps, since just before it may have been held, and have caught up.
    stops_dead = before[-1] > _SLOWS * before[:-1].min()
    apart = np.nan_to_num(steps[stop]).max() > _FAR_MM
    return bool(stops_dead and after.any() and apart and far > _LONGER * max(before[-1], after[0]))


def _trembles(
    positions: FloatArray, steps: FloatArray, start: int, stop: int, *, many: bool
) -> bool:
    """Whether joints, (frames, joints, 3), tremble before and after they stand still."""
    ways = np.nansum(steps, axis=1)
    before, after = ways[:start], ways[stop:]
    if not (len(before) and len(after)) or not (np.nan_to_num(steps[stop]) > _FAR_MM).any():
        return False
    short = _SHORT if many else _SHORT_ALONE
    if min(before[-1], after[0]) < short * np.median(np.concatenate([before, after])):
        return False
    return _noisy(positions[: start + 1]) and _noisy(positions[stop + 1 :])


def _noisy(positions: FloatArray) -> bool:
    """Whether steps of joints change to and fro, as none of a body do."""
    changes = np.nan_to_num(np.diff(positions, n=2, axis=0))
    square = np.sum(changes**2)
    if len(changes) < 3 or square == 0:
        return False
    alike = np.sum(changes[1:] * changes[:-1])
    # Noise of unit variance changes steps with a variance of six in each of three coordinates.
    size = np.sqrt(square / (18.0 * changes[..., 0].size))
    return bool(alike < _UNLIKE * square and size > _TREMBLES_MM)


def _finest(positions: FloatArray) -> float:
    """Mm of the smallest change in any coordinate of some poses: the last digit of the file."""
    changes = np.abs(np.diff(positions[:: max(len(positions) // _SOME, 1)], axis=0))
    return float(np.min(changes, where=changes > _SAME_MM, initial=np.inf))
