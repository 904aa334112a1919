"""Read and write Biovision hierarchies (BVH)."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import IO
from warnings import catch_warnings, filterwarnings

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import ExportError, FileFormatError
from markermend.files.text import read_lines
from markermend.poses.pose import Pose
from markermend.poses.quaternion import inverse, multiply, turn
from markermend.progress import Progress

_END = "_end"
_CM = 10.0
# What a joint may come off its place in its parent's axes and still be written as fixed there.
_RIGID_MM = 1.0
# Mean length of bones, in the file's own unit, below which it must be metres, or centimetres.
_METRES, _CENTIMETRES = 1.0, 60.0
_MOVES = {"Xposition": 0, "Yposition": 1, "Zposition": 2}
_TURNS = {"Xrotation": "X", "Yrotation": "Y", "Zrotation": "Z"}
_WRITTEN = "ZXY"
_POSES_A_REPORT = 1024
_MOST_NAMED = 8


class _Joint:
    """One joint while the hierarchy is read."""

    def __init__(self, name: str, parent: int) -> None:
        self.name, self.parent = name, parent
        self.offset = np.zeros(3)
        self.channels: list[str] = []


def read_bvh(path: Path) -> Pose:
    """Read a hierarchy and its movement.

    Parameters
    ----------
    path : the file; ends of chains become joints named after theirs, with ``_end``. The file tells
        no unit: metres, centimetres or millimetres are told apart by how long bones are.

    Raises
    ------
    FileFormatError
        when the file is damaged
    """
    words = " ".join(read_lines(path)).split()
    try:
        return _read(words)
    except (IndexError, ValueError) as error:
        reason = "it is cut short" if isinstance(error, IndexError) else str(error)
        raise FileFormatError(f"{path.name} is damaged: {reason}.") from error


def _read(words: list[str]) -> Pose:
    joints, at = _hierarchy(words)
    if words[at : at + 2] != ["MOTION", "Frames:"] or words[at + 3 : at + 5] != ["Frame", "Time:"]:
        raise ValueError("after its hierarchy no movement with frames and frame time follows")
    frames, step = int(words[at + 2]), float(words[at + 5])
    width = sum(len(joint.channels) for joint in joints)
    if frames < 1 or step <= 0 or not width:
        raise ValueError("it has no frame, no channel, or no time between frames")
    cells = words[at + 6 :]
    warnings = []
    if len(cells) < frames * width:
        frames = len(cells) // width
        if frames < 1:
            raise IndexError
        warnings.append("The file is cut short; the poses before its end were read.")
    values = np.array(cells[: frames * width], dtype=np.float64).reshape(frames, width)
    if not np.isfinite(values).all():
        raise ValueError("a value of its movement is no finite number")
    bones = [float(np.sqrt(joint.offset @ joint.offset)) for joint in joints if joint.parent >= 0]
    mean = float(np.mean(bones)) if bones else _CENTIMETRES
    scale, unit = (
        (1000.0, "metres")
        if mean < _METRES
        else (_CM, "centimetres")
        if mean < _CENTIMETRES
        else (1.0, "millimetres")
    )
    warnings.append(f"The file tells no unit; {unit} were assumed.")
    positions = np.zeros((frames, len(joints), 3))
    rotations = np.zeros((frames, len(joints), 4))
    column = 0
    for i, joint in enumerate(joints):
        own = values[:, column : column + len(joint.channels)]
        column += len(joint.channels)
        place = np.tile(joint.offset, (frames, 1))
        for k, name in enumerate(joint.channels):
            if name in _MOVES:
                place[:, _MOVES[name]] = own[:, k]
        turns = [k for k, name in enumerate(joint.channels) if name in _TURNS]
        local = np.tile([0.0, 0.0, 0.0, 1.0], (frames, 1))
        if turns:
            order = "".join(_TURNS[joint.channels[k]] for k in turns)
            local = Rotation.from_euler(order, own[:, turns], degrees=True).as_quat()
        if joint.parent < 0:
            positions[:, i], rotations[:, i] = place * scale, local
        else:
            above = rotations[:, joint.parent]
            positions[:, i] = positions[:, joint.parent] + turn(above, place * scale)
            rotations[:, i] = multiply(above, local)
    return Pose(
        positions,
        rotations,
        tuple(joint.name for joint in joints),
        tuple(joint.parent for joint in joints),
        float(np.round(1.0 / step, 3)),
        warnings=tuple(warnings),
    )


def _hierarchy(words: list[str]) -> tuple[list[_Joint], int]:
    """Joints, parents first, and where the movement begins."""
    if not words or words[0] != "HIERARCHY":
        raise ValueError("it does not begin with HIERARCHY")
    joints: list[_Joint] = []
    stack: list[int] = []
    at = 1
    while words[at] != "MOTION":
        match words[at]:
            case "ROOT" | "JOINT":
                joints.append(_Joint(words[at + 1], stack[-1] if stack else -1))
                stack.append(len(joints) - 1)
                at += 3
            case "End":
                joints.append(_Joint(joints[stack[-1]].name + _END, stack[-1]))
                stack.append(len(joints) - 1)
                at += 3
            case "OFFSET":
                joints[stack[-1]].offset = np.array([float(w) for w in words[at + 1 : at + 4]])
                at += 4
            case "CHANNELS":
                count = int(words[at + 1])
                names = words[at + 2 : at + 2 + count]
                unknown = [name for name in names if name not in _MOVES and name not in _TURNS]
                if unknown:
                    raise ValueError(f"“{unknown[0]}” is no channel")
                joints[stack[-1]].channels = names
                at += 2 + count
            case "}":
                stack.pop()
                at += 1
            case other:
                raise ValueError(f"“{other[:40]}” has no place in a hierarchy")
    return joints, at


def write_bvh(
    pose: Pose, file: IO[bytes], progress: Progress, *, whole: Pose | None = None
) -> None:
    """Write a hierarchy in centimetres, and its movement.

    Parameters
    ----------
    pose : every joint seen in every frame, with rotations
    file : written from its beginning
    progress : told the share of poses written
    whole : the recording that this is a part of, whose hierarchy is written: a pose alone does not
        tell how joints hang together

    Raises
    ------
    ExportError
        when there is no pose, a joint was not seen, or rotations are unknown

    Notes
    -----
    A joint of a BVH stands where its bone begins and carries those below it. Where joints of a
    recording stand where their bone ends, as those of an AMC, they are written so, and the ends of
    chains as its ends. A joint that others do not carry along, as a shoulder in the trunk, has
    channels of position besides, so that it is where the recording has it.
    """
    if not pose.positions.size:
        raise ExportError("There is no pose to write into a BVH.")
    if np.isnan(pose.rotations).all(axis=(0, 2)).any():
        raise ExportError("A BVH holds rotations, which this recording has none of; write a CSV.")
    gaps = np.asarray(np.isnan(pose.positions).any(axis=2) | np.isnan(pose.rotations).any(axis=2))
    if gaps.any():
        raise ExportError(
            "A BVH holds every joint of every pose. Frames in which joints are not known:"
            f" {_in_words(pose, gaps)}. Repair these gaps first, in the window by F, or all of them"
            " by markermend clean; or write a CSV."
        )
    if sum(parent < 0 for parent in pose.parents) != 1:
        raise ExportError("A BVH has one root; this recording has several.")
    told = pose if whole is None else _complete(whole)
    offsets = _offsets(told, told.parents)
    by_own = _strays(_offsets(told, range(len(told.joints))))
    if by_own.sum() + _RIGID_MM < _strays(offsets).sum():
        pose, told = _at_starts(pose), _at_starts(told)
        offsets = _offsets(told, told.parents)
    children: dict[int, list[int]] = {}
    for joint, parent in enumerate(pose.parents):
        children.setdefault(parent, []).append(joint)
    carried = (_strays(offsets) < _RIGID_MM) & (np.array(pose.parents) >= 0)
    lines, order = ["HIERARCHY"], list[int]()
    usual = np.median(offsets, axis=0)
    if whole is not None:
        offsets = _offsets(pose, pose.parents)
    _describe(children[-1][0], pose, children, usual, carried, lines, order)
    lines += ["MOTION", f"Frames: {pose.frames}", f"Frame Time: {1.0 / pose.rate:.7f}"]
    file.write(("\n".join(lines) + "\n").encode())
    columns = []
    for joint in order:
        local, parent = pose.rotations[:, joint], pose.parents[joint]
        if parent >= 0:
            local = multiply(inverse(pose.rotations[:, parent]), local)
        if not carried[joint]:
            columns.append(offsets[:, joint] / _CM)
        columns.append(_angles(local))
    table = np.concatenate(columns, axis=1)
    for start in range(0, pose.frames, _POSES_A_REPORT):
        progress(start / pose.frames, "Writing poses")
        rows = table[start : start + _POSES_A_REPORT].tolist()
        file.write("".join(" ".join(f"{v:.6f}" for v in row) + "\n" for row in rows).encode())


def _in_words(pose: Pose, gaps: BoolArray) -> str:
    """Which joints are not known, and in how many frames."""
    times = np.count_nonzero(gaps, axis=0).tolist()
    there = [f"{joint} {n}" for joint, n in zip(pose.joints, times, strict=True) if n]
    more = len(there) - _MOST_NAMED
    return ", ".join(there[:_MOST_NAMED]) + (f" (+ {more})" if more > 0 else "")


def _complete(pose: Pose) -> Pose:
    """Those poses of a recording in which every joint was seen."""
    rows = ~np.isnan(pose.rotations).any(axis=(1, 2))
    return Pose(pose.positions[rows], pose.rotations[rows], pose.joints, pose.parents, pose.rate)


def _angles(rotations: FloatArray) -> FloatArray:
    """(frames, 3) degrees about the axes in the order written."""
    with catch_warnings():
        # Where two axes fall together one of their turns is as good as the other.
        filterwarnings("ignore", message="Gimbal lock")
        angles = Rotation.from_quat(rotations).as_euler(_WRITTEN, degrees=True)  # type: ignore[call-overload]
    return np.asarray(angles)


def _offsets(pose: Pose, by: Iterable[int]) -> FloatArray:
    """(frames, joints, 3) mm from each joint's parent, in the axes of the joints in ``by``.

    Of the root its position.
    """
    found = pose.positions.copy()
    for joint, (parent, axes) in enumerate(zip(pose.parents, by, strict=True)):
        if parent >= 0:
            bone = pose.positions[:, joint] - pose.positions[:, parent]
            found[:, joint] = turn(inverse(pose.rotations[:, axes]), bone)
    return found


def _strays(offsets: FloatArray) -> FloatArray:
    """(joints,) mm, how far they come from their usual place; a root goes where it likes."""
    away = np.linalg.norm(offsets - np.median(offsets, axis=0), axis=2)
    return np.asarray(away.max(axis=0))


def _at_starts(pose: Pose) -> Pose:
    """The same with joints where their bones begin, and a joint more at each end."""
    above = [joint if parent < 0 else parent for joint, parent in enumerate(pose.parents)]
    ends = sorted(set(range(len(pose.joints))) - set(pose.parents))
    return Pose(
        np.concatenate([pose.positions[:, above], pose.positions[:, ends]], axis=1),
        np.concatenate([pose.rotations, pose.rotations[:, ends]], axis=1),
        (*pose.joints, *(pose.joints[end] + _END for end in ends)),
        (*pose.parents, *ends),
        pose.rate,
    )


def _describe(
    joint: int,
    pose: Pose,
    children: dict[int, list[int]],
    offsets: FloatArray,
    carried: BoolArray,
    lines: list[str],
    order: list[int],
    depth: int = 0,
) -> None:
    """Add a joint and all below it to the hierarchy."""
    tab, parent, below = "  " * depth, pose.parents[joint], children.get(joint, [])
    order.append(joint)
    offset = offsets[joint] if parent >= 0 else np.zeros(3)
    moves = "3" if carried[joint] else f"6 {' '.join(_MOVES)}"
    lines += [f"{tab}{'ROOT' if parent < 0 else 'JOINT'} {pose.joints[joint].replace(' ', '_')}"]
    lines += [tab + "{", f"{tab}  OFFSET {_three(offset)}"]
    lines.append(f"{tab}  CHANNELS {moves} Zrotation Xrotation Yrotation")
    ends = [c for c in below if _is_end(c, pose, children) and carried[c]]
    for child in below:
        if child not in ends:
            _describe(child, pose, children, offsets, carried, lines, order, depth + 1)
    tips = [offsets[end] for end in ends] or ([] if below else [np.zeros(3)])
    for tip in tips:
        lines += [f"{tab}  End Site", tab + "  {", f"{tab}    OFFSET {_three(tip)}", tab + "  }"]
    lines.append(tab + "}")


def _is_end(joint: int, pose: Pose, children: dict[int, list[int]]) -> bool:
    """Whether a joint is nothing but the end of its parent's bone."""
    return joint not in children and pose.joints[joint] == pose.joints[pose.parents[joint]] + _END


def _three(values: FloatArray) -> str:
    return " ".join(f"{value:.6f}" for value in (np.round(values / _CM, 6) + 0.0).tolist())
