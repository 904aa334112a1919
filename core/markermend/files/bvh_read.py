"""Read Biovision hierarchies (BVH)."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import FileFormatError
from markermend.files.body_size import unit_of_body
from markermend.files.plausible import FARTHEST, read_as_missing
from markermend.files.text import number, read_lines
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN, multiply, turn
from markermend.rates import rate_of

END = "_end"
CM = 10.0
MOVES = {"Xposition": 0, "Yposition": 1, "Zposition": 2}
_TURNS = {"Xrotation": "X", "Yrotation": "Y", "Zrotation": "Z"}
# Mean length of bones, in the file's own unit, below which it must be metres, or centimetres, where
# no whole body tells.
_METRES, _CENTIMETRES = 1.0, 60.0
_MOST_JOINTS = 10_000
_HEAD = re.compile(r"\s*MOTION\s+Frames\s*:\s*(\S+)\s+Frame\s*Time\s*:\s*(\S+)", re.IGNORECASE)
# Lines of a movement's head, blank ones among them.
_MOST_HEAD = 20
_MOST_DIGITS = 15
# A name of more words is none.
_MOST_WORDS = 10


class _Joint:
    """One joint while the hierarchy is read."""

    def __init__(self, name: str, parent: int) -> None:
        self.name, self.parent, self.ends = name, parent, 0
        self.offset = np.zeros(3)
        self.channels: list[str] = []


def read_bvh(path: Path, *, rate: float | None = None, unit_mm: float | None = None) -> Pose:
    """Read a hierarchy and its movement.

    Parameters
    ----------
    path : the file; ends of chains become joints named after theirs, with ``_end``. The file tells
        no unit: metres, inches, centimetres and millimetres are told apart by how large a body is
        (:mod:`markermend.files.body_size`), or how long bones are.
    rate : poses per second, instead of what the file says
    unit_mm : millimetres in the file's unit, where that is known

    Raises
    ------
    FileFormatError
        when the file is damaged
    """
    lines = read_lines(path)
    first = next((n for n, line in enumerate(lines) if line.split()[:1] == ["MOTION"]), len(lines))
    try:
        joints = _hierarchy(" ".join(lines[:first]).split())
        frames, step, body = _movement(lines, first)
        width = sum(len(joint.channels) for joint in joints)
        if frames < 1 or not step > 0 or not width:
            raise ValueError("it has no frame, no channel, or no time between frames")
        values, warnings = _values(body, frames, width)
    except (IndexError, ValueError) as error:
        reason = "it is cut short" if isinstance(error, IndexError) else str(error)
        raise FileFormatError(f"{path.name} is damaged: {reason}.") from error
    # Frame times are rounded.
    hertz = float(np.round(rate_of(1.0 / step, path.name), 3)) if rate is None else rate
    scale, unit = (unit_mm, "") if unit_mm else _unit(joints)
    if unit:
        warnings.append(f"The file tells no unit; {unit} were assumed.")
    positions, rotations, wild = _placed(joints, values, scale)
    return Pose(
        positions,
        rotations,
        tuple(joint.name for joint in joints),
        tuple(joint.parent for joint in joints),
        hertz,
        np.where(wild, 0.0, 1.0),
        warnings=(*warnings, *read_as_missing(int(wild.sum()))),
    )


def unit_of(hierarchy: str) -> float:
    """Millimetres in the unit that a hierarchy, up to its movement, is read in.

    Raises
    ------
    ValueError
        when it cannot be read
    IndexError
        when it is cut short
    """
    return _unit(_hierarchy(hierarchy.split()))[0]


def end_name(joint: str, before: int) -> str:
    """Name of an end of a joint's bone, of which it has had some before."""
    return joint + END + (str(before + 1) if before else "")


def _hierarchy(words: list[str]) -> list[_Joint]:
    """Joints, parents first."""
    if not words or words[0] != "HIERARCHY":
        raise ValueError("it does not begin with HIERARCHY")
    joints: list[_Joint] = []
    stack: list[int] = []
    at = 1
    while at < len(words):
        if not stack and words[at] in ("End", "OFFSET", "CHANNELS", "}"):
            raise ValueError(f"“{words[at]}” stands outside of every joint")
        match words[at]:
            case "ROOT" | "JOINT":
                name = _name(words[at + 1 :][:_MOST_WORDS])
                joints.append(_Joint(" ".join(name), stack[-1] if stack else -1))
                stack.append(len(joints) - 1)
                at += 2 + len(name)
            case "End":
                above = joints[stack[-1]]
                joints.append(_Joint(end_name(above.name, above.ends), stack[-1]))
                above.ends += 1
                stack.append(len(joints) - 1)
                at += 3
            case "OFFSET":
                joints[stack[-1]].offset = _offset(words[at + 1 : at + 4], joints[stack[-1]])
                at += 4
            case "CHANNELS":
                joints[stack[-1]].channels = _channels(words[at + 1 :], joints[stack[-1]])
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


def _offset(words: list[str], joint: _Joint) -> FloatArray:
    """Where a joint lies from its parent."""
    if len(words) < 3:
        raise IndexError
    values = np.array([number(word) for word in words])
    if not (np.abs(values) <= FARTHEST).all():
        raise ValueError(f"the OFFSET of “{joint.name}” is “{' '.join(words)}”")
    return values


def _is_count(word: str) -> bool:
    """Whether a word is a number of channels or frames; Python reads none of too many digits."""
    return word.isascii() and word.isdigit() and len(word) <= _MOST_DIGITS


def _channels(words: list[str], joint: _Joint) -> list[str]:
    """Channels of a joint, by the words behind CHANNELS."""
    if not _is_count(words[0]):
        raise ValueError(f"“{words[0][:40]}” is no number of channels of “{joint.name}”")
    names = words[1 : 1 + int(words[0])]
    unknown = [name for name in names if name not in MOVES and name not in _TURNS]
    if unknown:
        raise ValueError(f"“{unknown[0]}” is no channel")
    if len(set(names)) < len(names):
        raise ValueError(f"“{joint.name}” has a channel twice")
    return names


def _movement(lines: list[str], first: int) -> tuple[int, float, list[tuple[int, list[str]]]]:
    """Frames, seconds between them, and number and words of each line that follows."""
    if first == len(lines):
        raise IndexError
    head, found, at = "", None, first
    while found is None and at < min(len(lines), first + _MOST_HEAD):
        head += lines[at] + " "
        found = _HEAD.match(head)
        at += 1
    if found is None:
        raise ValueError("after its hierarchy no movement with frames and frame time follows")
    frames, time = found.groups()
    if not _is_count(frames):
        raise ValueError(f"“{frames[:40]}” is no number of frames")
    step = number(time)
    if not np.isfinite(step):
        raise ValueError(f"“{time[:40]}” is no time between frames")
    rest = head[found.end() :].split()
    body = [(n, line.split()) for n, line in enumerate(lines[at:], at + 1) if line.strip()]
    return int(frames), step, [(at, rest), *body] if rest else body


def _values(
    body: list[tuple[int, list[str]]], frames: int, width: int
) -> tuple[FloatArray, list[str]]:
    """(frames, width) numbers, and a sentence where the file ends before they do."""
    warnings = []
    cells = [word for _, words in body for word in words]
    odd = next(((n, len(words)) for n, words in body[:-1] if len(words) != width), None)
    # Poses may go over several lines as long as none begins where it should not.
    if odd is not None and len(cells) != frames * width:
        raise ValueError(f"line {odd[0]} has {odd[1]} numbers for {width} channels")
    if len(cells) > frames * width:
        raise ValueError(f"more poses follow than the {frames} that it tells of")
    if len(cells) < frames * width:
        frames = len(cells) // width
        if frames < 1:
            raise IndexError
        warnings.append("The file is cut short; the poses before its end were read.")
    try:
        values = np.array(cells[: frames * width], dtype=np.float64).reshape(frames, width)
    except ValueError:
        values = np.array([np.nan])
    if not np.isfinite(values).all():
        n, word = next((n, w) for n, row in body for w in row if not np.isfinite(number(w)))
        raise ValueError(f"“{word[:40]}” in line {n} is no finite number")
    return values, warnings


def _unit(joints: list[_Joint]) -> tuple[float, str]:
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


def _placed(
    joints: list[_Joint], values: FloatArray, scale: float
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Positions and rotations (frames, joints, 3 and 4), and which are no measurement."""
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
        turns = [k for k, name in enumerate(joint.channels) if name in _TURNS]
        local = np.tile(NO_TURN, (frames, 1))
        if turns:
            order = "".join(_TURNS[joint.channels[k]] for k in turns)
            local = Rotation.from_euler(order, own[:, turns], degrees=True).as_quat()
        if joint.parent < 0:
            positions[:, i], rotations[:, i] = place * scale, local
        else:
            above = rotations[:, joint.parent]
            positions[:, i] = positions[:, joint.parent] + turn(above, place * scale)
            rotations[:, i] = multiply(above, local)
    return positions, rotations, wild
