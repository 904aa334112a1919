"""Write an Acclaim movement over the file it came from: what it does not change stays as it is."""

from __future__ import annotations

import re
from collections.abc import Collection, Container
from math import isfinite, pi
from pathlib import Path

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.skeleton import TURNS, Movement
from markermend.progress import Progress

_COMMENT = re.compile(rb"#|//|;")
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_SAME = 1e-9
_POSES_A_REPORT = 256


def starts_pose(word: str, segments: Container[str]) -> bool:
    """Whether a line begins with the number of a pose; what stands behind it is a comment."""
    return word.isdigit() and word not in segments


def tells_degrees(line: str) -> bool | None:
    """Whether a line of the header says that angles are in degrees; None where it says nothing."""
    word = "".join(line.split()).upper()
    return True if word.startswith(":DEGREES") else False if word.startswith(":RADIANS") else None


def patched(path: Path, movement: Movement, progress: Progress) -> bytes | None:
    """A movement's file with other numbers where the movement is another.

    Header, comments, order of segments, endings of lines and every number that is not changed stay
    the same bytes. A segment that a pose leaves out gets a line where other poses have it.

    Parameters
    ----------
    path : the file, as it was when the movement was read
    movement : of the same poses; where a segment is NaN its line goes
    progress : told the share of poses written; may raise to stop

    Returns
    -------
    The file's content; None where the file is not there any more or has other poses
    """
    try:
        lines = path.read_bytes().splitlines(keepends=True)
    except OSError:
        return None
    told = _in_file(movement, degrees=movement.skeleton.degrees)
    head, poses = _poses(lines, told)
    for line in head:
        degrees = tells_degrees(" ".join(_words(line)))
        if degrees is not None:
            told = _in_file(movement, degrees=degrees)
    if len(poses) != movement.frames:
        return None
    usual, out = _usual_order(poses, told), head
    for pose, block in enumerate(poses):
        if pose % _POSES_A_REPORT == 0:
            progress(pose / movement.frames, "Writing poses")
        values = {name: rows[pose] for name, rows in told.items() if all(map(isfinite, rows[pose]))}
        out += _patched_pose(block, values, told, usual)
    return b"".join(out)


def _poses(lines: list[bytes], told: Collection[str]) -> tuple[list[bytes], list[list[bytes]]]:
    """Lines before the first pose, and those of each, its number first."""
    head: list[bytes] = []
    poses: list[list[bytes]] = []
    for line in lines:
        words = _words(line)
        if words and starts_pose(words[0], told):
            poses.append([])
        (poses[-1] if poses else head).append(line)
    return head, poses


def _words(line: bytes) -> list[str]:
    """Words of a line, without its comment."""
    bare = _COMMENT.split(line, maxsplit=1)[0].removeprefix(_BYTE_ORDER_MARK)
    return bare.decode("latin-1").split()


def _usual_order(poses: list[list[bytes]], told: Collection[str]) -> list[str]:
    """Segments in the order of the pose that has most of them; others after these."""
    fullest = max(poses, key=len, default=[])
    there = [words[0] for words in map(_words, fullest) if words and words[0] in told]
    return [*dict.fromkeys((*there, *told))]


def _patched_pose(
    block: list[bytes], values: dict[str, list[float]], told: Collection[str], usual: list[str]
) -> list[bytes]:
    """The lines of a pose that has these values: what it lacks comes after what it follows."""
    out: list[bytes] = []
    ends = dict[str, int]()
    for line in block:
        name, *cells = _words(line) or [""]
        if name not in told:
            out.append(line)
        elif name in values:
            row = values[name]
            out.append(line if _says(cells, row) else _said(line, name, row))
            ends[name] = len(out)
    missing = [name for name in usual if name in values and name not in ends]
    if not missing:
        return out
    ending = block[0][len(block[0].rstrip(b"\r\n")) :] or b"\n"
    if not out[-1].endswith((b"\r", b"\n")):
        # The last line of the file.
        out[-1] += ending
    for name in missing:
        before = usual[: usual.index(name)]
        place = max((ends[other] for other in before if other in ends), default=1)
        ends = {other: end + (end > place) for other, end in ends.items()} | {name: place + 1}
        out.insert(place, _said(ending, name, values[name]))
    return out


def _in_file(movement: Movement, *, degrees: bool) -> dict[str, list[list[float]]]:
    """Channels of each segment, pose by pose, with angles as the file has them."""
    turn = 1.0 if degrees else pi / 180.0
    found = {}
    for segment in movement.skeleton.segments:
        if segment.name in movement.channels and segment.dofs:
            scales: FloatArray = np.array([turn if dof in TURNS else 1.0 for dof in segment.dofs])
            found[segment.name] = (movement.channels[segment.name] * scales).tolist()
    return found


def _says(cells: list[str], values: list[float]) -> bool:
    """Whether a line has these values already."""
    try:
        there = [float(cell) for cell in cells]
    except ValueError:
        return False
    return len(there) == len(values) and all(
        abs(a - b) <= _SAME * max(abs(b), 1.0) for a, b in zip(there, values, strict=True)
    )


def _said(line: bytes, name: str, values: list[float]) -> bytes:
    """The line with other values; its comment and ending stay."""
    ending = line[len(line.rstrip(b"\r\n")) :]
    comment = _COMMENT.search(line.rstrip())
    also = b" " + line.rstrip()[comment.start() :] if comment else b""
    return " ".join([name, *(f"{v:.9g}" for v in values)]).encode("latin-1") + also + ending
