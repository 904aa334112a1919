"""Joints that jump away and come back, told by where they jump and which bones that breaks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.ndimage import median_filter

from markermend.arrays import BoolArray, FloatArray, median_of_seen
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of

# A step is a jump when it differs by this share of a mean bone from those in this time around it.
_JUMP, _AROUND_S, _LEAST_AROUND = 0.25, 0.05, 2
# No joint changes its speed by so much from one frame to the next, and no body all at once.
_FASTEST_MM_S, _FASTEST_BODY_MM_S = 25_000.0, 8_000.0
# A joint comes back within this time, and but for this share of the jump to where it would be.
_AWAY_S, _BACK = 1.0, 0.5
# So many jumps with at most one frame of rest between any two are one trip, of somewhere else in
# every frame; two of them may well seem to take it back by chance.
_RESTLESS, _REST = 5, 2
# Meanwhile bones are broken when, from one frame to the next, their length changes by this share
# of it, and by so many times the standard deviation of what it usually changes.
_BREAKS, _UNUSUAL = 0.05, 6.0
_DEVIATION = 0.6745
# A body goes as one when joints jump as the root does but for this share.
_TOGETHER = 0.3
# A joint goes along when it makes the same jumps, and its bone is, but for this share, as long as
# it usually is in this share of the frames.
_ALIKE, _ALONG = 0.15, 0.8


def jumped(pose: Pose, bones: FloatArray) -> BoolArray:
    """Find joints that are away for up to a second, while those beside them are where they were.

    Parameters
    ----------
    pose : any skeleton
    bones : (joints,) usual length of the bone to the parent, mm; NaN for the root

    Returns
    -------
    (frames, joints) bool. What jumped is wrong for all of that time, wherever its bones happen to
    reach; and with it what hangs on it and jumped along, as another person's arm does.
    """
    away = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    if pose.frames < 2 * _LEAST_AROUND + 1:
        return away
    least = _JUMP * float(np.nanmean(bones))
    odd = _odd_steps(pose, least)
    leaps = lengths_of(odd) > least
    suspects = np.flatnonzero(leaps.any(axis=0)).tolist()
    if not suspects:
        return away
    far = _bones_of(pose)
    breaks = _breaks(far, bones)
    alike = np.abs(far - bones) < _ALIKE * bones
    root = pose.order[0]
    hanging = [joint for joint, parent in enumerate(pose.parents) if parent == root]
    for joint in suspects:
        for out, home in trips(odd[:, joint], leaps[:, joint], pose.rate):
            meanwhile = slice(out + 1, home + 1)
            if away[out + 1, joint]:
                continue
            same = np.flatnonzero(leaps[out] & leaps[home]).tolist()
            whole = alike[meanwhile].mean(axis=0) >= _ALONG
            group = _along(joint, same, whole, pose.parents)
            ends = [
                j for j, p in enumerate(pose.parents) if p >= 0 and (j in group) != (p in group)
            ]
            broken = bool(breaks[out, ends].any() and breaks[home, ends].any())
            if broken or lengths_of(odd[[out, home], joint]).min() * pose.rate > _FASTEST_MM_S:
                # Where all that hangs on the root is elsewhere, that was turned.
                group |= {root} if set(hanging) <= group else set()
                away[meanwhile, sorted(group)] = True
    return away


def carried_off(pose: Pose) -> BoolArray:
    """Find frames in which the whole body is elsewhere, as if a root alone had been misread.

    Parameters
    ----------
    pose : any skeleton

    Returns
    -------
    (frames,) bool
    """
    away = np.zeros(pose.frames, dtype=bool)
    if pose.frames < 2 * _LEAST_AROUND + 1:
        return away
    root, least = pose.order[0], _FASTEST_BODY_MM_S / pose.rate
    steps = lengths_of(np.diff(pose.positions[:, root], axis=0))
    if not (2.0 * steps > least).any():
        return away
    odd = _odd_steps(pose, least)
    # Joints that are not seen go nowhere.
    moved = np.where((pose.seen[1:] & pose.seen[:-1])[..., None], odd, np.nan)
    leaps = lengths_of(odd[:, root]) > least
    leaps[leaps] = [
        bool(np.nanmax(lengths_of(m - r)) < _TOGETHER * lengths_of(r))
        for m, r in zip(moved[leaps], odd[leaps, root], strict=True)
    ]
    for out, home in trips(odd[:, root], leaps, pose.rate):
        away[out + 1 : home + 1] = True
    return away


def _odd_steps(pose: Pose, least: float) -> FloatArray:
    """(frames - 1, joints, 3) mm by which steps differ from the usual one around them.

    0 for joints that never do by the ``least``: no more than twice their longest step.
    """
    steps = np.nan_to_num(np.diff(pose.positions, axis=0))
    odd = np.zeros_like(steps)
    far = np.flatnonzero(2.0 * lengths_of(steps).max(axis=0) > least)
    if len(far):
        around = 2 * max(round(_AROUND_S * pose.rate), _LEAST_AROUND) + 1
        some = steps[:, far]
        odd[:, far] = some - median_filter(some, (around, 1, 1), mode="nearest")
    return odd


def _bones_of(pose: Pose) -> FloatArray:
    """(frames, joints) mm from each joint to its parent; NaN for roots."""
    far = np.full((pose.frames, len(pose.joints)), np.nan)
    for joint, parent in enumerate(pose.parents):
        if parent >= 0:
            far[:, joint] = lengths_of(pose.positions[:, joint] - pose.positions[:, parent])
    return far


def _breaks(far: FloatArray, bones: FloatArray) -> BoolArray:
    """(frames - 1, joints) bool: the bone to the parent suddenly has another length."""
    change = np.abs(np.diff(far, axis=0))
    usual = median_of_seen(change) / _DEVIATION
    return np.asarray(change > np.maximum(_BREAKS * bones, _UNUSUAL * usual))


def trips(odd: FloatArray, leaps: BoolArray, rate: float) -> Iterator[tuple[int, int]]:
    """Steps on which a joint leaves, and comes back with the next jump that takes it there.

    Where it is somewhere else in every frame that is the last jump in a row.
    """
    at, done = np.flatnonzero(leaps).tolist(), -1
    for n, out in enumerate(at):
        if out <= done:
            continue
        last, longest = n, _AWAY_S * rate
        while last + 1 < len(at) and at[last + 1] - at[last] <= _REST and at[last] - out <= longest:
            last += 1
        if last - n + 1 >= _RESTLESS and at[last] - out <= longest:
            done = at[last]
            yield out, done
            continue
        for home in at[n + 1 :]:
            if home - out > longest:
                break
            left = lengths_of(odd[out] + odd[home])
            if left < _BACK * min(lengths_of(odd[out]), lengths_of(odd[home])):
                yield out, home
                done = home
                break


def _along(joint: int, same: list[int], whole: BoolArray, parents: tuple[int, ...]) -> set[int]:
    """Joints that are one piece with a joint, of those that make the same trip."""
    group, size = {joint}, 0
    while len(group) > size:
        size = len(group)
        for j in same:
            above = parents[j]
            if above >= 0 and whole[j] and (above in group or (j in group and above in same)):
                group |= {j, above}
    return group
