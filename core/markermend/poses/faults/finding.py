"""Find joints that a sensor reports wrongly without saying so, and what is wrong with them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, runs
from markermend.poses.faults.exchanging import changed_back
from markermend.poses.faults.exchanging_angles import angles_changed_back
from markermend.poses.faults.holding import held
from markermend.poses.faults.jumping import carried_off
from markermend.poses.faults.misplacing import misplaced
from markermend.poses.faults.stiffening import stiff
from markermend.poses.faults.thrown import thrown_off
from markermend.poses.faults.vanishing import vanished
from markermend.poses.filling.bridging import bridged
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of

VANISHED, FROZEN, MISPLACED, SWAPPED = "vanished", "frozen", "misplaced", "swapped"
CROSSED, CARRIED, REPEATED = "given each other's angles", "carried off", "repeated"
THROWN, GUESSED = "thrown off", "guessed wrongly"
FAULTS = (VANISHED, FROZEN, MISPLACED, SWAPPED, CROSSED, CARRIED, REPEATED, THROWN, GUESSED)

# Frames in a row that must be the same to the last digit, and how far the body moves meanwhile.
_FROZEN_FRAMES, _SAME_MM, _MOVED_MM = 4, 1e-6, 2.0


@dataclass(frozen=True)
class Fault:
    """One joint that was wrong for a while.

    Attributes
    ----------
    kind : ``"vanished"`` (at 0, 0, 0), ``"frozen"`` (stands still to the last digit, or its limb
        is bent no more, while the body moves), ``"repeated"`` (with all that is seen),
        ``"misplaced"`` (where its bones cannot reach: jumped, or another person's), ``"swapped"``
        (left and right, or in a file of angles ``"given each other's angles"``), ``"carried off"``
        (with the whole body), ``"thrown off"`` (where bones are rigid, by an angle that jumps
        away and back), or ``"guessed wrongly"`` (by a sensor that says that it guessed)
    joint : index
    start, stop : frames ``[start, stop)``
    """

    kind: str
    joint: int
    start: int
    stop: int


def mend_faults(pose: Pose) -> tuple[Pose, tuple[Fault, ...]]:
    """Take out what is wrong: what can be undone is, the rest was not seen then.

    Parameters
    ----------
    pose : any skeleton; swaps are looked for where names tell the sides

    Returns
    -------
    the recording, and what was wrong with it, in the order of frames
    """
    pose, bent = angles_changed_back(pose)
    thrown = thrown_off(pose) & pose.seen
    pose = _hidden(pose, thrown)
    gone = vanished(pose.positions, pose.parents, pose.joints)
    pose = _hidden(pose, gone)
    stands, whole = held(pose)
    repeated = stands & whole[:, None]
    frozen = (stands | _frozen(pose)) & ~repeated
    pose = _hidden(pose, frozen | repeated)
    carried = carried_off(pose)
    pose = _carried_back(pose, carried)
    pose, swapped = changed_back(pose)
    # What changed places stood still only while nobody knew.
    still = stiff(pose) & pose.seen
    frozen, pose = frozen | still, _hidden(pose, still)
    wrong = misplaced(pose)
    # Of a joint that would never be in its place nobody could tell where that is.
    wrong[:, ~(pose.seen & ~wrong).any(axis=0)] = False
    kinds = {
        VANISHED: gone,
        FROZEN: frozen,
        REPEATED: repeated,
        SWAPPED: swapped,
        CROSSED: bent,
        THROWN: thrown,
        MISPLACED: wrong,
        CARRIED: carried[:, None] & pose.seen & ~wrong,
    }
    faults = [
        Fault(kind, joint, start, stop)
        for kind, mask in kinds.items()
        for joint in range(len(pose.joints))
        for start, stop in runs(mask[:, joint]).tolist()
    ]
    return _hidden(pose, wrong), tuple(sorted(faults, key=lambda f: (f.start, f.joint)))


def _hidden(pose: Pose, wrong: BoolArray) -> Pose:
    """The recording without what is wrong."""
    if not wrong.any():
        return pose
    confidence = np.where(wrong, 0.0, pose.confidence)
    return pose.with_samples(pose.positions, pose.rotations, confidence)


def _carried_back(pose: Pose, carried: BoolArray) -> Pose:
    """The recording with the body on its root's way wherever it was elsewhere as a whole."""
    if not carried.any():
        return pose
    root = pose.order[0]
    path = pose.positions[:, root]
    known = np.repeat((pose.seen[:, root] & ~carried)[:, None], 3, axis=1)
    back = np.where(carried[:, None], bridged(path, known) - path, 0.0)
    return pose.with_samples(pose.positions + back[:, None], pose.rotations, pose.confidence)


def _frozen(pose: Pose) -> BoolArray:
    """(frames, joints) joints that repeat themselves while the middle joint of the body moves."""
    frozen = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    if pose.frames <= _FROZEN_FRAMES:
        return frozen
    steps = lengths_of(np.diff(pose.positions, axis=0))
    if not (steps < _SAME_MM).any():
        return frozen
    turns = np.nan_to_num(np.abs(np.diff(pose.rotations, axis=0)).max(axis=2))
    still = (steps < _SAME_MM) & (turns < _SAME_MM)
    body = np.nan_to_num(np.nanmedian(np.where(np.isnan(steps), 0.0, steps), axis=1))
    for joint, parent in enumerate(pose.parents):
        own = pose.positions[pose.seen[:, joint], joint]
        if parent < 0 and len(own) and np.ptp(own, axis=0).max() < _SAME_MM:
            # It does not stand still, but is where others are measured from.
            continue
        for start, stop in runs(still[:, joint]).tolist():
            if stop - start >= _FROZEN_FRAMES - 1 and body[start:stop].sum() > _MOVED_MM:
                # The first of equal frames is still true.
                frozen[start + 1 : stop + 1, joint] = True
    return frozen
