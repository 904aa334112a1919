"""Write an Acclaim movement over the file it came from: what it does not change stays as it is."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.skeleton import TURNS, Movement

_COMMENT = re.compile(rb"#|//|;")
_SAME = 1e-9
_NOT_MORE_DIGITS = ".9g"


def patched(path: Path, movement: Movement) -> bytes | None:
    """A movement's file with other numbers where the movement is another.

    Header, comments, order of segments, endings of lines and every number that is not changed stay
    the same bytes.

    Parameters
    ----------
    path : the file, as it was when the movement was read
    movement : of the same poses; where a segment is NaN its line goes

    Returns
    -------
    The file's content; None where the file is not there any more or has not the lines that the
    movement needs, as one with other poses
    """
    try:
        lines = path.read_bytes().splitlines(keepends=True)
    except OSError:
        return None
    needed = sum(
        int(np.isfinite(values).all(axis=1).sum())
        for values in movement.channels.values()
        if values.shape[1]
    )
    out, pose, written = [], -1, 0
    scales = _scales(movement, movement.skeleton.degrees)
    for line, words in zip(lines, _words(lines), strict=True):
        name = words[0] if words else ""
        if pose < 0 and name.upper() in (":RADIANS", ":DEGREES"):
            scales = _scales(movement, name.upper() == ":DEGREES")
        if name.isdigit() and len(words) == 1:
            pose += 1
        if pose >= movement.frames:
            return None
        if pose < 0 or name not in scales:
            out.append(line)
            continue
        values = movement.channels[name][pose] * scales[name]
        if not np.isfinite(values).all():
            continue
        written += 1
        out.append(line if _says(words[1:], values) else _said(line, name, values))
    fits = pose + 1 == movement.frames and written == needed
    return b"".join(out) if fits else None


def _words(lines: list[bytes]) -> Iterator[list[str]]:
    for line in lines:
        yield _COMMENT.split(line, maxsplit=1)[0].decode("latin-1").split()


def _scales(movement: Movement, degrees: bool) -> dict[str, FloatArray]:
    """What each segment's channels, whose angles are degrees, are multiplied by in the file."""
    turn = 1.0 if degrees else np.pi / 180.0
    return {
        segment.name: np.array([turn if dof in TURNS else 1.0 for dof in segment.dofs])
        for segment in movement.skeleton.segments
        if segment.name in movement.channels and segment.dofs
    }


def _says(cells: list[str], values: FloatArray) -> bool:
    """Whether a line has these values already."""
    try:
        there = np.array([float(cell) for cell in cells])
    except ValueError:
        return False
    return len(there) == len(values) and bool(np.allclose(there, values, rtol=_SAME, atol=_SAME))


def _said(line: bytes, name: str, values: FloatArray) -> bytes:
    """The line with other values; its comment and ending stay."""
    numbers = " ".join(format(value, _NOT_MORE_DIGITS) for value in values.tolist())
    ending = line[len(line.rstrip(b"\r\n")) :]
    comment = _COMMENT.search(line.rstrip())
    told = b" " + line.rstrip()[comment.start() :] if comment else b""
    return f"{name} {numbers}".encode("latin-1") + told + ending
