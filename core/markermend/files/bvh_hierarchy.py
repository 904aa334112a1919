"""The hierarchy of a BVH: its joints, the unit they are in, and where channels have them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray
from markermend.files.body_size import unit_of_body
from markermend.files.plausible import FARTHEST
from markermend.files.text import number
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN, inverse, multiply, turn

END = "_end"
CM = 10.0
MOVES = {"Xposition": 0, "Yposition": 1, "Zposition": 2}
TURNS = {"Xrotation": "X", "Yrotation": "Y", "Zrotation": "Z"}
# Mean length of bones, in the file's own unit, below which it must be metres, or centimetres, where
# no whole body tells.
_METRES, _CENTIMETRES = 1.0, 60.0
_MOST_JOINTS = 10_000
_MOST_DIGITS = 15
# A name of more words is none.
_MOST_WORDS = 10


class Joint:
    """One joint of a hierarchy.

    Attributes
    ----------
    name : its own, or that of an end
    parent : index of the joint it hangs on, -1 for a root
    ends : how many ends its bone has
    offset : (3,) from its parent, in the file's unit
    channels : their names, in order
    begins_at, offset_at, channels_at : which words of the hierarchy are its ROOT, JOINT or End, its
        OFFSET and its CHANNELS; 0 where it has none
    is_end : whether it is an end of its parent's bone
    """

    def __init__(self, name: str, parent: int, begins_at: int, *, is_end: bool) -> None:
        self.name, self.parent, self.ends, self.is_end = name, parent, 0, is_end
        self.offset = np.zeros(3)
        self.channels: list[str] = []
        self.begins_at, self.offset_at, self.channels_at = begins_at, 0, 0


def unit_of(hierarchy: str) -> float:
    """Millimetres in the unit that a hierarchy, up to its movement, is read in.

    Raises
    ------
    ValueError
        when it cannot be read
    IndexError
        when it is cut short
    """
    return unit_by_size(hierarchy_of(hierarchy.split()))[0]


def end_name(joint: str, before: int) -> str:
    """Name of an end of a joint's bone, of which it has had some before."""
    return joint + END + (str(before + 1) if before else "")


def hierarchy_of(words: list[str]) -> list[Joint]:
    """Joints, parents first, of the words of a hierarchy.

    Raises
    ------
    ValueError
        when it cannot be read
    IndexError
        when it is cut short
    """
    if not words or words[0] != "HIERARCHY":
        raise ValueError("it does not begin with HIERARCHY")
    joints: list[Joint] = []
    stack: list[int] = []
    at = 1
    while at < len(words):
        if not stack and words[at] in ("End", "OFFSET", "CHANNELS", "}"):
            raise ValueError(f"“{words[at]}” stands outside of every joint")
        match words[at]:
            case "ROOT" | "JOINT":
                name = _name(words[at + 1 :][:_MOST_WORDS])
                parent = stack[-1] if stack else -1
                joints.append(Joint(" ".join(name), parent, at, is_end=False))
                stack.append(len(joints) - 1)
                at += 2 + len(name)
            case "End":
                above = joints[stack[-1]]
                called = end_name(above.name, above.ends)
                joints.append(Joint(called, stack[-1], at, is_end=True))
                above.ends += 1
                stack.append(len(joints) - 1)
                at += 3
            case "OFFSET":
                joints[stack[-1]].offset = _offset(words[at + 1 : at + 4], joints[stack[-1]])
                joints[stack[-1]].offset_at = at
                at += 4
            case "CHANNELS":
                joints[stack[-1]].channels = _channels(words[at + 1 :], joints[stack[-1]])
                joints[stack[-1]].channels_at = at
                at += 2 + len(joints[stack[-1]].channels)
            case "}":
                stack.pop()
                at += 1
            case other:
                raise ValueError(f"“{other[:40]}” has no place in a hierarchy")
    if len(joints) > _MOST_JOINTS:
        raise ValueError(f"it tells of {len(joints):,} joints")
    seen: set[str] = set()
    for joint in joints:
        if joint.name in seen:
            raise ValueError(f"it has two joints called “{joint.name}”")
        seen.add(joint.name)
    return joints


def _name(words: list[str]) -> list[str]:
    """The words of a joint's name, up to the brace that follows it."""
    if "{" in words[1:]:
        return words[: words.index("{", 1)]
    if len(words) < 2:
        raise IndexError
    raise ValueError(f"no {{ follows the joint “{words[0][:40]}”")


def _offset(words: list[str], joint: Joint) -> FloatArray:
    """Where a joint lies from its parent."""
    if len(words) < 3:
        raise IndexError
    values = np.array([number(word) for word in words])
    if not (np.abs(values) <= FARTHEST).all():
        raise ValueError(f"the OFFSET of “{joint.name}” is “{' '.join(words)}”")
    return values


def is_count(word: str) -> bool:
    """Whether a word is a number of channels or frames; Python reads none of too many digits."""
    return word.isascii() and word.isdigit() and len(word) <= _MOST_DIGITS


def _channels(words: list[str], joint: Joint) -> list[str]:
    """Channels of a joint, by the words behind CHANNELS."""
    if not is_count(words[0]):
        raise ValueError(f"“{words[0][:40]}” is no number of channels of “{joint.name}”")
    names = words[1 : 1 + int(words[0])]
    unknown = [name for name in names if name not in MOVES and name not in TURNS]
    if unknown:
        raise ValueError(f"“{unknown[0]}” is no channel")
    if len(set(names)) < len(names):
        raise ValueError(f"“{joint.name}” has a channel twice")
    return names


def unit_by_size(joints: list[Joint]) -> tuple[float, str]:
    """Millimetres in the file's unit, and its name, by the size of a body or its bones."""
    lengths = np.array([float(np.sqrt(joint.offset @ joint.offset)) for joint in joints])
    parents = tuple(joint.parent for joint in joints)
    told = unit_of_body(lengths, parents, [joint.name for joint in joints])
    if told is not None:
        return told
    bones = lengths[np.array(parents) >= 0]
    mean = float(np.mean(bones)) if bones.size else _CENTIMETRES
    if mean < _METRES:
        return 1000.0, "metres"
    return (CM, "centimetres") if mean < _CENTIMETRES else (1.0, "millimetres")


def placed(
    joints: Sequence[Joint], values: FloatArray, scale: float
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Where channels have joints.

    Parameters
    ----------
    joints : parents first
    values : (frames, channels) numbers in the file's units
    scale : mm in its unit of length

    Returns
    -------
    positions (frames, joints, 3), rotations (frames, joints, 4), and (frames, joints) bool, which
    are no measurement
    """
    frames = len(values)
    positions = np.zeros((frames, len(joints), 3))
    rotations = np.zeros((frames, len(joints), 4))
    wild = np.zeros((frames, len(joints)), dtype=bool)
    column = 0
    for i, joint in enumerate(joints):
        own = values[:, column : column + len(joint.channels)]
        column += len(joint.channels)
        scales = np.array([scale if name in MOVES else 1.0 for name in joint.channels])
        wild[:, i] = (np.abs(own) > FARTHEST / scales).any(axis=1)
        if joint.parent >= 0:
            wild[:, i] |= wild[:, joint.parent]
        own = np.where(wild[:, i, None], 0.0, own)
        place = np.tile(joint.offset, (frames, 1))
        for k, name in enumerate(joint.channels):
            if name in MOVES:
                place[:, MOVES[name]] = own[:, k]
        turns = [k for k, name in enumerate(joint.channels) if name in TURNS]
        order = "".join(TURNS[joint.channels[k]] for k in turns)
        local = turned_by(order, own[:, turns])
        if joint.parent < 0:
            positions[:, i], rotations[:, i] = place * scale, local
        else:
            above = rotations[:, joint.parent]
            positions[:, i] = positions[:, joint.parent] + turn(above, place * scale)
            rotations[:, i] = multiply(above, local)
    return positions, rotations, wild


def turned_by(order: str, angles: FloatArray) -> FloatArray:
    """(frames, 4) rotations of degrees (frames, n) about axes, as ``ZXY``; of none, no turn."""
    if not order:
        return np.tile(NO_TURN, (len(angles), 1))
    return np.asarray(Rotation.from_euler(order, angles, degrees=True).as_quat())


def offsets_by(pose: Pose, by: Iterable[int]) -> FloatArray:
    """(frames, joints, 3) mm from each joint's parent, in the axes of the joints in ``by``.

    Of the root its position.
    """
    found = pose.positions.copy()
    for joint, (parent, axes) in enumerate(zip(pose.parents, by, strict=True)):
        if parent >= 0:
            bone = pose.positions[:, joint] - pose.positions[:, parent]
            found[:, joint] = turn(inverse(pose.rotations[:, axes]), bone)
    return found


def own_turn(pose: Pose, joint: int) -> FloatArray:
    """(frames, 4) how a joint is turned in the axes of its parent."""
    parent = pose.parents[joint]
    if parent < 0:
        return np.asarray(pose.rotations[:, joint])
    return multiply(inverse(pose.rotations[:, parent]), pose.rotations[:, joint])
