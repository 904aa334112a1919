"""How far off what was filled is, tried where the recording is known."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, free_starts, runs
from markermend.poses.filling.bridging import bridging_error
from markermend.poses.quaternion import lengths_of

if TYPE_CHECKING:
    from markermend.poses.pose import Pose
    from markermend.poses.restore import Restored

# Gaps tried at most; shorter ones are crossed by time, of which single frames tell enough.
_MOST, _LEAST_S = 12, 0.1
# Few tell little: with fewer than these there are others elsewhere, while all together hide no
# more than this share of the frames.
_FEW, _SHARE = 4, 0.25
# Frames that must be known on either side.
_BESIDE = 2
# Of a long recording so many frames are tried on, which is slower by as much.
_ENOUGH = 2000
# What is tried tells of gaps up to so many times as long.
_LONGER = 2.0


@dataclass(frozen=True)
class Trial:
    """Joints, by index, to be hidden over frames ``[start, stop)``."""

    start: int
    stop: int
    joints: tuple[int, ...]


def enough_around(filled: BoolArray) -> slice:
    """Frames of a long recording about the middle of what was filled; of a short one all.

    Parameters
    ----------
    filled : (frames, joints) bool
    """
    frames = len(filled)
    there = np.flatnonzero(filled.any(axis=1))
    if frames <= _ENOUGH or not len(there):
        return slice(0, frames)
    start = min(max(int(np.median(there)) - _ENOUGH // 2, 0), frames - _ENOUGH)
    return slice(start, start + _ENOUGH)


def trials_of(filled: BoolArray, rate: float) -> tuple[Trial, ...]:
    """Stretches that are known, as long and of the same joints as some that were filled.

    Parameters
    ----------
    filled : (frames, joints) bool
    rate : frames per second

    Returns
    -------
    None two at the same time; each as near as there is room to what it stands for, or shorter than
    that where there is none
    """
    least = max(round(_LEAST_S * rate), 1)
    together: dict[tuple[int, int], list[int]] = {}
    for joint in range(filled.shape[1]):
        for start, stop in runs(filled[:, joint]).tolist():
            if stop - start >= least:
                together.setdefault((start, stop), []).append(joint)
    places = sorted(together)
    chosen = places[:: max(-(-len(places) // _MOST), 1)]
    found: list[Trial] = []
    taken = np.zeros(len(filled), dtype=bool)
    for n, (start, stop) in enumerate(chosen * _FEW):
        joints, length = together[start, stop], stop - start
        free = ~(taken | filled[:, joints].any(axis=1))
        if n < len(chosen):
            room, length = _room(free, length, least)
            away = -np.abs(room - start)
        else:
            if not found or len(found) >= _FEW or taken.sum() + length > _SHARE * len(filled):
                continue
            room = free_starts(free, length, _BESIDE)
            away = np.min([np.abs(room - trial.start) for trial in found], axis=0)
        if len(room):
            at = int(room[np.argmax(away)])
            found.append(Trial(at, at + length, tuple(joints)))
            taken[at : at + length] = True
    return tuple(found)


def _room(free: BoolArray, length: int, least: int) -> tuple[IntArray, int]:
    """Starts of free stretches, and how long they are: shorter where none is as long."""
    room = free_starts(free, length, _BESIDE)
    if not len(room):
        longest = int(np.max(np.diff(runs(free), axis=1), initial=0)) - 2 * _BESIDE
        if longest >= least:
            return free_starts(free, longest, _BESIDE), longest
    return room, length


def hidden_in(trials: Sequence[Trial], frames: int, joints: int) -> BoolArray:
    """(frames, joints) bool, what is hidden in trials."""
    hidden = np.zeros((frames, joints), dtype=bool)
    for trial in trials:
        hidden[trial.start : trial.stop, trial.joints] = True
    return hidden


def tried(restored: Restored, hanging: BoolArray, again: Callable[[Pose], Restored]) -> Restored:
    """Expect the errors that are made where something known is hidden.

    Parameters
    ----------
    restored : what was made of a recording
    hanging : (joints,) bool of :func:`markermend.poses.filling.hanging.hanging_joints`
    again : restores a recording in the same way

    Notes
    -----
    A body's covariances fit the recording that they were learnt from, and so say too little of
    what they foretell elsewhere in it. Others' recordings keep them from that; of joints that are
    told by what they hang on it is tried, on stretches as long, of the same joints, as some that
    were filled.
    """
    whole, rows = restored.pose, enough_around(restored.filled)
    trials = trials_of(restored.filled[rows], whole.rate)
    if not trials:
        return replace(restored, error_mm=_untried(restored, restored.error_mm, hanging, rows, ()))
    positions, rotations = whole.positions[rows], whole.rotations[rows]
    hidden = hidden_in(trials, len(positions), len(whole.joints))
    known = whole.with_samples(positions, rotations, np.where(hidden, 0.0, 1.0))
    found = again(known)
    away = np.sum((found.pose.positions - positions) ** 2, axis=2)
    error = restored.error_mm.copy()
    for joints in (hanging, ~hanging):
        # Of a root, which everything is measured from, no error is expected.
        judged = hidden & (found.error_mm > 0) & joints
        if judged.any():
            more = float(np.sqrt(np.sum(away[judged]) / np.sum(found.error_mm[judged] ** 2)))
            error[restored.filled & joints] *= max(more, 1.0)
    return replace(restored, error_mm=_untried(restored, error, hanging, rows, trials))


def _untried(
    restored: Restored,
    error_mm: FloatArray,
    hanging: BoolArray,
    rows: slice,
    trials: Sequence[Trial],
) -> FloatArray:
    """Expect no less than what time alone would miss of gaps far longer than any tried.

    Where so little was seen a body's covariances fit it by chance, and tell nothing of the rest.
    Time alone misses a joint by no more than as far as it is from what was seen.
    """
    error, whole = error_mm.copy(), restored.pose
    tried = max((trial.stop - trial.start for trial in trials), default=0)
    enough = max(_LONGER * tried, _LEAST_S * whole.rate)
    paths = whole.positions - whole.positions[:, whole.order[0], None]
    for joint in np.flatnonzero(hanging & restored.filled[rows].any(axis=0)).tolist():
        filled = restored.filled[:, joint]
        longer = np.zeros(len(filled), dtype=bool)
        for start, stop in runs(filled).tolist():
            longer[start:stop] = stop - start > enough
        if longer.any():
            missed = bridging_error(paths[:, joint], ~filled)
            missed = np.fmin(missed, _from_seen(restored, joint, longer))
            error[longer, joint] = np.fmax(error[longer, joint], missed[longer])
    return error


def _from_seen(restored: Restored, joint: int, frames: BoolArray) -> float:
    """Length of all bones from a joint up to the next one that is seen in some frames; mm."""
    pose, far = restored.pose, 0.0
    while pose.parents[joint] >= 0 and restored.filled[frames, joint].any():
        parent = pose.parents[joint]
        bone = pose.positions[frames, joint] - pose.positions[frames, parent]
        far += float(np.median(lengths_of(bone)))
        joint = parent
    return far
