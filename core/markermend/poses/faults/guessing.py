"""Joints that a sensor did not see but guessed, and says so: believed where the body agrees."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from markermend.arrays import BoolArray, runs
from markermend.poses.faults.finding import GUESSED, Fault
from markermend.poses.pose import Pose
from markermend.progress import Progress, part

if TYPE_CHECKING:
    from markermend.poses.restore import Restored

INFERRED = 0.5
"""Confidence of a joint that was not seen but worked out, as depth sensors write it."""

# A guess is wrong that is mostly further off than so many times as far as the rest of the body is
# expected to be, which is at least so sure.
_TIMES_OFF, _SURE_MM = 3.0, 10.0


def guessed(pose: Pose) -> BoolArray:
    """(frames, joints) bool: guesses at joints that were mostly seen; the root's are taken as seen.

    Of what was hardly ever seen nothing tells better.
    """
    unsure = pose.seen & (pose.confidence <= INFERRED)
    unsure[:, pose.order[0]] = False
    surely = np.count_nonzero(pose.confidence > INFERRED, axis=0)
    return np.asarray(unsure & (surely > np.count_nonzero(unsure, axis=0)))


def restored_beside_guesses(
    pose: Pose,
    guesses: BoolArray,
    restore: Callable[[Pose, Progress], Restored],
    tell: Progress,
) -> Restored:
    """Restore a recording without its guesses, and once more with those that agree with that.

    Parameters
    ----------
    pose : the recording
    guesses : (frames, joints) bool
    restore : what it is restored by
    tell : told the share done; may raise to stop

    Returns
    -------
    Restored
        in which guesses that were believed keep their confidence, and are expected to be as far off
        as what would have been filled there; wrong ones are faults
    """
    hidden = _with(pose, guesses, 0.0)
    without = restore(hidden, part(tell, 0.0, 0.5))
    wrong = _wrong(pose, without, guesses)
    kept = guesses & ~wrong
    told = without
    if kept.any():
        told = restore(_with(_with(pose, wrong, 0.0), kept, 1.0), part(tell, 0.5, 1.0))
    kept &= ~told.filled
    faults = [
        Fault(GUESSED, joint, start, stop)
        for joint in np.flatnonzero(wrong.any(axis=0)).tolist()
        for start, stop in runs(wrong[:, joint]).tolist()
    ]
    confidence = np.where(kept, pose.confidence, told.pose.confidence)
    return replace(
        told,
        pose=told.pose.with_samples(told.pose.positions, told.pose.rotations, confidence),
        error_mm=np.where(kept, np.fmax(told.error_mm, without.error_mm), told.error_mm),
        faults=tuple(sorted([*told.faults, *faults], key=lambda f: (f.start, f.joint))),
    )


def _with(pose: Pose, those: BoolArray, confidence: float) -> Pose:
    """The recording with another confidence in some joints."""
    sure = np.where(those, confidence, pose.confidence)
    return pose.with_samples(pose.positions, pose.rotations, sure)


def _wrong(pose: Pose, without: Restored, guesses: BoolArray) -> BoolArray:
    """(frames, joints) bool: guesses that are elsewhere than the body tells, as long as each is."""
    off = np.sqrt(np.sum((pose.positions - without.pose.positions) ** 2, axis=2))
    times = off / np.maximum(without.error_mm, _SURE_MM)
    wrong = np.zeros(guesses.shape, dtype=bool)
    for joint in np.flatnonzero(guesses.any(axis=0)).tolist():
        for start, stop in runs(guesses[:, joint]).tolist():
            wrong[start:stop, joint] = np.median(times[start:stop, joint]) > _TIMES_OFF
    return wrong
