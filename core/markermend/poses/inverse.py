"""Channels that put the joints of a skeleton where a recording has them.

How a recording turns its joints and where it puts them need not agree to the last millimetre: each
was measured, or restored, by itself. What is looked at, and reviewed, is where joints are.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.angles import angles_of, told_alike
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of
from markermend.poses.reaching import SHIFTS, axes_of, reach
from markermend.poses.skeleton import TURNS, Movement, forward_kinematics
from markermend.progress import Progress, quiet

SAME = 1e-9
"""What normalising a quaternion once more may change; of places, in the skeleton's unit."""
BLOCK = 512
"""Frames worked on at a time."""


def inverse_kinematics(pose: Pose, source: Movement, *, progress: Progress = quiet) -> Movement:
    """Channels that move a skeleton as a recording has it: the inverse of forward kinematics.

    Parameters
    ----------
    pose : one joint per segment, in the skeleton's order
    source : whose skeleton and channels are followed; what the recording cannot tell (a length
        that changes, a shift of a segment that is no root) stays as it was there, and so does
        every channel in the frames in which its segment is as there, with all those that it hangs
        on and those that hang on it by one bone
    progress : told the share of frames done; may raise to stop

    Returns
    -------
    Movement
        with joints as near to the recording's as rigid segments and their degrees of freedom
        allow, and turned as there as far as that leaves open; only turned as there in frames in
        which every joint is where it was. A joint that was not seen there turns none that it hangs
        on, and its angles go on from those beside, in as many rounds. NaN where a joint or its
        parent was not seen.
    """
    turned, away, filled = _changes(pose, source)
    channels = _nearest_turns(pose, source, _with_parents(turned, pose))
    free = _free(turned, away, pose)
    # A skeleton by itself has nothing that could be turned.
    frames = np.flatnonzero((away | filled).any(axis=1) & bool(channels))
    # On matrices as small as these several threads only wait for each other.
    with threadpool_limits(1):
        for first in range(0, len(frames), BLOCK):
            progress(first / len(frames), "Writing poses")
            block = frames[first : first + BLOCK]
            given = {name: values[block] for name, values in channels.items()}
            found = reach(source.skeleton, given, pose.positions[block], free[block])
            for name, values in found.items():
                channels[name][block] = values
    return replace(source, channels=channels, frames=pose.frames)


def how_far_off(movement: Movement, pose: Pose) -> FloatArray:
    """(joints,) how far from a recording a movement has each joint at most, in mm.

    Infinite where it lacks the joint in a frame in which it was seen.
    """
    placed = forward_kinematics(movement, pose.rate)
    away = lengths_of(placed.positions - pose.positions)
    away = np.where(pose.seen, np.where(placed.seen, away, np.inf), 0.0)
    return np.asarray(away.max(axis=0, initial=0.0))


def _changes(pose: Pose, source: Movement) -> tuple[BoolArray, BoolArray, BoolArray]:
    """Whether joints are turned or seen otherwise than in the source, elsewhere, or new.

    All (frames, segments) bool; a root that is elsewhere counts for the first two, too.
    """
    if source.frames != pose.frames:
        every = np.ones(pose.rotations.shape[:2], dtype=bool)
        return every, every, every
    before = forward_kinematics(source, pose.rate)
    apart = np.abs(pose.positions - before.positions) > SAME * source.skeleton.scale_mm
    away = np.asarray(apart.any(axis=2))
    turned = (np.abs(pose.rotations - before.rotations) > SAME).any(axis=2)
    turned |= pose.seen != before.seen
    roots = [i for i, parent in enumerate(pose.parents) if parent < 0]
    turned[:, roots] |= away[:, roots]
    return turned, away, pose.seen & ~before.seen


def _with_parents(marked: BoolArray, pose: Pose) -> BoolArray:
    """Joints that are marked or whose parents are."""
    both = marked.copy()
    for joint, parent in enumerate(pose.parents):
        if parent >= 0:
            both[:, joint] |= marked[:, parent]
    return both


def _free(turned: BoolArray, away: BoolArray, pose: Pose) -> BoolArray:
    """Segments that may be turned so that joints come to their places.

    Those that are turned or elsewhere, those that these hang on, and all that hangs on either.
    """
    free = turned | away
    for joint, parent in enumerate(pose.parents):
        if parent >= 0:
            free[:, parent] |= away[:, joint]
    for joint, parent in enumerate(pose.parents):
        if parent >= 0:
            free[:, joint] |= free[:, parent]
    return free


def _nearest_turns(pose: Pose, source: Movement, turned: BoolArray) -> dict[str, FloatArray]:
    """Channels turned as the recording, as far as the degrees of freedom go."""
    skeleton = source.skeleton
    channels: dict[str, FloatArray] = {}
    for i, segment in enumerate(skeleton.segments):
        if segment.name not in source.channels or not segment.dofs:
            continue
        if source.frames != pose.frames:
            values = np.zeros((pose.frames, len(segment.dofs)))
        else:
            values = np.array(source.channels[segment.name])
        seen = ~np.isnan(pose.rotations[:, i, 3])
        if segment.parent >= 0:
            seen &= ~np.isnan(pose.rotations[:, segment.parent, 3])
        anew = np.flatnonzero(seen & turned[:, i])
        own = Rotation.from_quat(pose.rotations[anew, i])
        if segment.parent >= 0:
            own = Rotation.from_quat(pose.rotations[anew, segment.parent]).inv() * own
        turns = [k for k, dof in enumerate(segment.dofs) if dof in TURNS]
        if turns and len(anew):
            axes = "".join(segment.dofs[k][1] for k in turns)
            frame = axes_of(segment)
            angles = angles_of(frame.inv() * own * frame, axes)
            given = values[:, turns] if source.frames == pose.frames else None
            values[anew[:, None], turns] = told_alike(angles, anew, given)
        if segment.parent < 0:
            start = pose.positions[:, i] / skeleton.scale_mm - np.asarray(skeleton.position)
            for k, dof in enumerate(segment.dofs):
                if dof in SHIFTS:
                    values[anew, k] = start[anew, SHIFTS.index(dof)]
        # What hangs on a joint that was not seen keeps what was measured of it.
        values[~seen & turned[:, i]] = np.nan
        channels[segment.name] = values
    return channels
