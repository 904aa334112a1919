"""Write an Acclaim movement over the file it came from: what it does not change stays as it is."""

from __future__ import annotations

import re
from collections.abc import Container
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
    the same bytes.

    Parameters
    ----------
    path : the file, as it was when the movement was read
    movement : of the same poses; where a segment is NaN its line goes
    progress : told the share of poses written; may raise to stop

    Returns
    -------
    The file's content; None where the file is not there any more or has not the lines that the
    movement needs, as one with other poses
    """
    try:
        lines = path.read_bytes().splitlines(keepends=True)
    except OSError:
        return None
    told = _in_file(movement, degrees=movement.skeleton.degrees)
    out, pose, written = [], -1, 0
    for line in lines:
        bare = _COMMENT.split(line, maxsplit=1)[0].removeprefix(_BYTE_ORDER_MARK)
        name, *cells = bare.decode("latin-1").split() or [""]
        degrees = tells_degrees(bare.decode("latin-1")) if pose < 0 else None
        if degrees is not None:
            told = _in_file(movement, degrees=degrees)
        if starts_pose(name, told):
            pose += 1
            if pose >= movement.frames:
                return None
            if pose % _POSES_A_REPORT == 0:
                progress(pose / movement.frames, "Writing poses")
        if pose < 0 or name not in told:
            out.append(line)
            continue
        values = told[name][pose]
        if all(map(isfinite, values)):
            written += 1
            out.append(line if _says(cells, values) else _said(line, name, values))
    needed = sum(all(map(isfinite, values)) for rows in told.values() for values in rows)
    fits = pose + 1 == movement.frames and written == needed
    return b"".join(out) if fits else None


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
