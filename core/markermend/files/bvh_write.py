"""Write Biovision hierarchies (BVH)."""

from __future__ import annotations

from typing import IO

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import ExportError
from markermend.files.bvh_hierarchy import (
    CM,
    END,
    MOVES,
    end_name,
    offsets_by,
    own_turn,
    unit_of,
)
from markermend.files.bvh_patch import DIGITS, RIGID_MM, patched, rounded
from markermend.poses.angles import angles_of, going_on
from markermend.poses.pose import Pose
from markermend.poses.turnless import turned_as_parents, turnless
from markermend.progress import Progress

# Millimetres in units that one may be written in; one of them is told by every size.
_UNITS = (CM, 1.0, 1000.0)
_WRITTEN = "ZXY"
_POSES_A_REPORT = 1024
_MOST_NAMED = 8


def write_bvh(
    pose: Pose, file: IO[bytes], progress: Progress, *, whole: Pose | None = None
) -> None:
    """Write a hierarchy, and its movement: over the file it was read from, else anew.

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
        when there is no pose, a joint was not seen, rotations are unknown, or what is read again
        would have two joints of one name

    Notes
    -----
    What follows is about a file that is written anew, as of a recording that was no BVH.

    The unit is centimetres, or another where a body of that size would be taken to be in another,
    since the file tells none.

    Joints that never have a rotation, as the ends of a Kinect's limbs, are turned as their parents.

    A joint of a BVH stands where its bone begins and carries those below it. Where joints of a
    recording stand where their bone ends, as those of an AMC, they are written so, and the ends of
    chains as its ends; those that a hierarchy was read for, which has such ends, stay. A joint that
    others do not carry along, as a shoulder in the trunk, has channels of position besides, so that
    it is where the recording has it.
    """
    pose, told = _writable(pose, whole)
    content = patched(pose, progress)
    if content is not None:
        file.write(content)
        return
    offsets = offsets_by(told, told.parents)
    by_own = _strays(offsets_by(told, range(len(told.joints))))
    if not _has_ends(told) and by_own.sum() + RIGID_MM < _strays(offsets).sum():
        pose, told = _at_starts(pose), _at_starts(told)
        offsets = offsets_by(told, told.parents)
    children: dict[int, list[int]] = {}
    for joint, parent in enumerate(pose.parents):
        children.setdefault(parent, []).append(joint)
    carried = (_strays(offsets) < RIGID_MM) & (np.array(pose.parents) >= 0)
    usual = np.median(offsets, axis=0)
    if whole is not None:
        offsets = offsets_by(pose, pose.parents)
    for unit in _UNITS:
        lines, order = ["HIERARCHY"], list[int]()
        _describe(children[-1][0], pose, children, usual / unit, carried, lines, order)
        if _unit_read_again(lines) == unit:
            break
    lines += ["MOTION", f"Frames: {pose.frames}", f"Frame Time: {1.0 / pose.rate:.9g}"]
    file.write(("\n".join(lines) + "\n").encode())
    columns = []
    own = (Rotation.from_quat(own_turn(pose, joint)) for joint in order)
    turns = np.stack([angles_of(turned, _WRITTEN) for turned in own], axis=1)
    turns = going_on(turns, np.arange(pose.frames) > 0)
    for place, joint in enumerate(order):
        if not carried[joint]:
            columns.append(offsets[:, joint] / unit)
        columns.append(turns[:, place])
    table = rounded(np.concatenate(columns, axis=1))
    for start in range(0, pose.frames, _POSES_A_REPORT):
        progress(start / pose.frames, "Writing poses")
        rows = table[start : start + _POSES_A_REPORT].tolist()
        file.write(
            "".join(" ".join(f"{v:.{DIGITS}f}" for v in row) + "\n" for row in rows).encode()
        )


def _writable(pose: Pose, whole: Pose | None) -> tuple[Pose, Pose]:
    """The poses with every joint turned, and those that tell how joints hang together."""
    if not pose.positions.size:
        raise ExportError("There is no pose to write into a BVH.")
    if np.isnan(pose.rotations).all():
        raise ExportError("A BVH holds rotations, which this recording has none of; write a CSV.")
    every = whole or pose
    never = [joint for i, joint in enumerate(pose.joints) if not every.seen[:, i].any()]
    if never:
        raise ExportError(
            f"A BVH holds every joint of every pose, and {', '.join(never)} was never seen; write"
            " a CSV."
        )
    without = turnless(every)
    pose = turned_as_parents(pose, without)
    gaps = np.asarray(np.isnan(pose.positions).any(axis=2) | np.isnan(pose.rotations).any(axis=2))
    if gaps.any():
        raise ExportError(
            "A BVH holds every joint of every pose. Frames in which joints are not known:"
            f" {_in_words(pose, gaps)}. Repair these gaps first, in the window by F, or all of them"
            " by markermend clean; or write a CSV."
        )
    if sum(parent < 0 for parent in pose.parents) != 1:
        raise ExportError("A BVH has one root; this recording has several.")
    return pose, pose if whole is None else _complete(turned_as_parents(whole, without))


def _unit_read_again(lines: list[str]) -> float:
    """Millimetres in the unit that a hierarchy would be read in; refuse one that cannot be."""
    try:
        return unit_of(" ".join(lines))
    except (ValueError, IndexError) as error:
        reason = str(error) or "its names have braces"
        raise ExportError(
            f"A BVH of these joints could not be read again: {reason}; rename joints, or write a"
            " CSV."
        ) from error


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
        (*pose.joints, *(pose.joints[end] + END for end in ends)),
        (*pose.parents, *ends),
        pose.rate,
    )


def _describe(
    root: int,
    pose: Pose,
    children: dict[int, list[int]],
    offsets: FloatArray,
    carried: BoolArray,
    lines: list[str],
    order: list[int],
) -> None:
    """Add a joint and all below it to the hierarchy, however deep that goes."""
    waiting: list[tuple[int, int] | str] = [(root, 0)]
    while waiting:
        now = waiting.pop()
        if isinstance(now, str):
            lines.append(now)
            continue
        joint, depth = now
        tab, parent, below = "  " * depth, pose.parents[joint], children.get(joint, [])
        order.append(joint)
        offset = offsets[joint] if parent >= 0 else np.zeros(3)
        moves = "3" if carried[joint] else f"6 {' '.join(MOVES)}"
        name = pose.joints[joint].replace(" ", "_")
        lines += [f"{tab}{'ROOT' if parent < 0 else 'JOINT'} {name}"]
        lines += [tab + "{", f"{tab}  OFFSET {_three(offset)}"]
        lines.append(f"{tab}  CHANNELS {moves} Zrotation Xrotation Yrotation")
        ends = _ends(below, pose, children, carried)
        tips = [offsets[end] for end in ends] or ([] if below else [np.zeros(3)])
        # What comes last is written first.
        waiting.append(tab + "}")
        for tip in reversed(tips):
            site = [f"{tab}  End Site", tab + "  {", f"{tab}    OFFSET {_three(tip)}", tab + "  }"]
            waiting.append("\n".join(site))
        waiting += [(child, depth + 1) for child in reversed(below) if child not in ends]


def _has_ends(pose: Pose) -> bool:
    """Whether joints are those of a hierarchy: chains end in one that is called so."""
    above = zip(pose.joints, pose.parents, strict=True)
    return any(p >= 0 and joint == end_name(pose.joints[p], 0) for joint, p in above)


def _ends(
    below: list[int], pose: Pose, children: dict[int, list[int]], carried: BoolArray
) -> list[int]:
    """Those below a joint that are nothing but ends of its bone, and are called so again."""
    ends = list[int]()
    for child in below:
        name = end_name(pose.joints[pose.parents[child]], len(ends))
        if child not in children and carried[child] and pose.joints[child] == name:
            ends.append(child)
    return ends


def _three(values: FloatArray) -> str:
    return " ".join(f"{value:.{DIGITS}f}" for value in rounded(values).tolist())
