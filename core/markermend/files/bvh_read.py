"""Read Biovision hierarchies (BVH)."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import FileFormatError
from markermend.files.bvh_hierarchy import Joint, hierarchy_of, is_count, placed, unit_by_size
from markermend.files.plausible import read_as_missing
from markermend.files.text import lines_of, number
from markermend.poses.pose import Pose
from markermend.rates import rate_of

HEAD = re.compile(r"\s*MOTION\s+Frames\s*:\s*(\S+)\s+Frame\s*Time\s*:\s*(\S+)", re.IGNORECASE)
# Lines of a movement's head, blank ones among them.
_MOST_HEAD = 20


@dataclass(frozen=True, eq=False)
class Channels:
    """What a file says, as its joints' channels have it.

    Attributes
    ----------
    file : the file
    joints : parents first
    values : (frames, channels) numbers in the file's units
    scale_mm : mm in its unit of length
    rate : poses per second by its time between frames
    first : which of its poses, from 0, is the first of these
    """

    file: Path
    joints: tuple[Joint, ...]
    values: FloatArray
    scale_mm: float
    rate: float
    first: int = 0

    def part(self, start: int, stop: int) -> Channels:
        """Those of an interval [start, stop) of the poses."""
        return replace(self, values=self.values[start:stop], first=self.first + start)


@dataclass(frozen=True, eq=False)
class Content:
    """The text of a file, read as numbers.

    Attributes
    ----------
    joints : parents first
    values : (frames, channels) numbers in the file's units
    seconds : from one frame to the next
    warnings : a sentence for each oddity
    """

    joints: list[Joint]
    values: FloatArray
    seconds: float
    warnings: list[str]


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
    found = content_of(path.read_bytes(), path.name)
    joints, warnings = found.joints, found.warnings
    # Frame times are rounded.
    stated = float(np.round(1.0 / found.seconds, 3))
    if rate is None:
        rate_of(1.0 / found.seconds, path.name)
    scale, unit = (unit_mm, "") if unit_mm else unit_by_size(joints)
    if unit:
        warnings.append(f"The file tells no unit; {unit} were assumed.")
    positions, rotations, wild = placed(joints, found.values, scale)
    return Pose(
        positions,
        rotations,
        tuple(joint.name for joint in joints),
        tuple(joint.parent for joint in joints),
        stated if rate is None else rate,
        np.where(wild, 0.0, 1.0),
        source=Channels(path, tuple(joints), found.values, scale, stated),
        warnings=(*warnings, *read_as_missing(int(wild.sum()))),
    )


def content_of(raw: bytes, name: str) -> Content:
    """Read what is in a file.

    Parameters
    ----------
    raw : its bytes
    name : of the file, for what is wrong with it

    Raises
    ------
    FileFormatError
        when it is damaged
    """
    lines = lines_of(raw, name)
    first = next((n for n, line in enumerate(lines) if line.split()[:1] == ["MOTION"]), len(lines))
    try:
        joints = hierarchy_of(" ".join(lines[:first]).split())
        frames, step, body = _movement(lines, first)
        width = sum(len(joint.channels) for joint in joints)
        if frames < 1 or not step > 0 or not width:
            raise ValueError("it has no frame, no channel, or no time between frames")
        values, warnings = _values(body, frames, width)
    except (IndexError, ValueError) as error:
        reason = "it is cut short" if isinstance(error, IndexError) else str(error)
        raise FileFormatError(f"{name} is damaged: {reason}.") from error
    return Content(joints, values, step, warnings)


def _movement(lines: list[str], first: int) -> tuple[int, float, list[tuple[int, list[str]]]]:
    """Frames, seconds between them, and number and words of each line that follows."""
    if first == len(lines):
        raise IndexError
    head, found, at = "", None, first
    while found is None and at < min(len(lines), first + _MOST_HEAD):
        head += lines[at] + " "
        found = HEAD.match(head)
        at += 1
    if found is None:
        raise ValueError("after its hierarchy no movement with frames and frame time follows")
    frames, time = found.groups()
    if not is_count(frames):
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
