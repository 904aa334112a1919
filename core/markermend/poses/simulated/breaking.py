"""The worst faults of real sensors, simulated: joints wrong without a word about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from markermend.errors import DataError
from markermend.poses.faults.finding import FROZEN, MISPLACED, REPEATED, SWAPPED, VANISHED
from markermend.poses.nuitrack import JOINTS, LIMBS
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN

_LENGTH_S = (0.15, 0.8)
_JUMP_MM = 400.0
_STRANGER_MM = 700.0
# Joints that are most of 17, and what is brief, in frames from one to below the other.
_MOST, _BRIEF = 11, (2, 4)
# Frames from one fault to the next, the least.
_ROOM = 8
KINDS = MappingProxyType(
    {
        VANISHED: VANISHED,
        FROZEN: FROZEN,
        "jumped": MISPLACED,
        SWAPPED: SWAPPED,
        "stranger": MISPLACED,
    }
)
"""What can go wrong, and the name by which it is to be found."""
HOLDS = MappingProxyType(
    {
        "whole pose held": REPEATED,
        "three limbs held": FROZEN,
        "most joints held": FROZEN,
        "held but turning": FROZEN,
        "briefly held": FROZEN,
    }
)
"""More ways to stand still, apart from the others for those to stay as they were drawn."""


@dataclass(frozen=True)
class Broken:
    """Joints that were made wrong together.

    Attributes
    ----------
    kind : one of :data:`KINDS` or :data:`HOLDS`
    joints : indices
    start, stop : frames ``[start, stop)``
    """

    kind: str
    joints: tuple[int, ...]
    start: int
    stop: int


def break_pose(
    pose: Pose, *, each: int, seed: int, what: Mapping[str, str] = KINDS
) -> tuple[Pose, tuple[Broken, ...]]:
    """Break a clean recording, every time for 0.15 to 0.8 seconds, never twice at once.

    Parameters
    ----------
    pose : of Nuitrack's 17 joints
    each : faults of each kind
    seed : same seed, same faults
    what : :data:`KINDS`, a joint at 0, 0, 0; held; somewhere else in every frame; limbs of left and
        right exchanged; a limb of somebody smaller, who stands beside; or :data:`HOLDS`, all
        joints held, three limbs, eleven joints, a limb whose joints turn as before, and a limb for
        two or three poses only

    Returns
    -------
    the recording, confident throughout, and what was done to it

    Raises
    ------
    DataError
        when it is too short for so many
    """
    random = np.random.default_rng(seed)
    positions, rotations = np.array(pose.positions), np.array(pose.rotations)
    slots = np.linspace(2, pose.frames - 2, each * len(what) + 1).astype(int)
    if np.diff(slots).min() < _ROOM:
        raise DataError(
            f"The recording is too short to be broken {each * len(what)} times: it has"
            f" {pose.frames} poses, and that takes {_ROOM * each * len(what) + 4} or more;"
            " leave it out."
        )
    kinds, done = tuple(what), []
    for slot, n in enumerate(random.permutation(each * len(what)).tolist()):
        kind, room = kinds[n % len(kinds)], int(slots[slot + 1] - slots[slot]) - 2
        length = min(max(round(random.uniform(*_LENGTH_S) * pose.rate), 2), room)
        start = int(slots[slot]) + 1
        frames = slice(start, start + length)
        limb = LIMBS[random.integers(len(LIMBS))]
        joint = int(random.choice(limb))
        touched: tuple[int, ...] = (joint,)
        match kind:
            case "vanished":
                positions[frames, joint], rotations[frames, joint] = 0.0, NO_TURN
            case "frozen":
                positions[frames, joint] = positions[start - 1, joint]
                rotations[frames, joint] = rotations[start - 1, joint]
            case "jumped":
                away = random.normal(size=(length, 3))
                away *= _JUMP_MM / np.sqrt(np.sum(away**2, axis=1, keepdims=True))
                positions[frames, joint] += away
            case "swapped":
                pair = LIMBS[:2] if limb in LIMBS[:2] else LIMBS[2:]
                for a, b in zip(*pair, strict=True):
                    for values in (positions, rotations):
                        values[frames, [a, b]] = values[frames, [b, a]]
                touched = (*pair[0], *pair[1])
            case "stranger":
                then = int(random.integers(pose.frames - length))
                away = _STRANGER_MM * np.array([1.0, 0.0, random.choice([-1.0, 1.0])])
                other = slice(then, then + length)
                middle = pose.positions[other, :1]
                there = 0.9 * (pose.positions[other][:, limb] - middle)
                positions[frames, limb] = there + pose.positions[frames, :1] + away
                rotations[frames, limb] = pose.rotations[other][:, limb]
                touched = limb
            case _:
                touched, frames = _held(kind, limb, frames, random)
                positions[frames, touched] = positions[start - 1, touched]
                if kind != "held but turning":
                    rotations[frames, touched] = rotations[start - 1, touched]
        done.append(Broken(kind, touched, frames.start, frames.stop))
    return pose.with_samples(positions, rotations, np.ones_like(pose.confidence)), tuple(done)


def _held(
    kind: str, limb: tuple[int, ...], frames: slice, random: np.random.Generator
) -> tuple[tuple[int, ...], slice]:
    """Joints of one of :data:`HOLDS`, and the frames in which they are held."""
    match kind:
        case "whole pose held":
            return tuple(range(len(JOINTS))), frames
        case "three limbs held":
            return tuple(j for other in LIMBS if other != limb for j in other), frames
        case "most joints held":
            return tuple(sorted(random.permutation(len(JOINTS))[:_MOST].tolist())), frames
        case "briefly held":
            stop = frames.start + int(random.integers(*_BRIEF))
            return limb, slice(frames.start, min(stop, frames.stop))
        case _:
            return limb, frames
