"""Write an Acclaim movement over the file it came from: what it does not change stays as it is."""

from __future__ import annotations

import re
from collections.abc import Collection, Container, Sequence
from itertools import pairwise
from math import isfinite, pi
from pathlib import Path

import numpy as np

from markermend.arrays import FloatArray
from markermend.files.pose_table import step_of
from markermend.poses.skeleton import TURNS, Movement
from markermend.progress import Progress

_COMMENT = re.compile(rb"#|//|;")
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_RATE = ":SAMPLES-PER-SECOND"
USUAL_RATE = 120.0
"""Poses per second of a movement that does not tell."""
# More are no count of poses, and from some on no number to Python.
_MOST_DIGITS = 15
_SAME = 1e-9
_POSES_A_REPORT = 256
_MOST_FRAMES_A_POSE = 10


def is_number(word: str) -> bool:
    """Whether a word can be the number of a pose."""
    return word.isascii() and word.isdigit() and len(word) <= _MOST_DIGITS


def starts_pose(word: str, segments: Container[str]) -> bool:
    """Whether a line begins with the number of a pose; what stands behind it is a comment."""
    return is_number(word) and word not in segments


def frames_of(numbers: Sequence[int]) -> list[int]:
    """Which frames poses are, from 0: numbers that are left out are frames of which there is none.

    One after the other where numbers go in steps, do not grow, or leave out so many that one went
    astray.
    """
    since = [number - numbers[0] for number in numbers]
    one_by_one = list(range(len(numbers)))
    if any(after <= before for before, after in pairwise(since)):
        return one_by_one
    step = step_of(since)
    frames = [number // step for number in since]
    return frames if frames[-1] < _MOST_FRAMES_A_POSE * len(frames) else one_by_one


def tells_degrees(line: str) -> bool | None:
    """Whether a line of the header says that angles are in degrees; None where it says nothing."""
    word = "".join(line.split()).upper()
    return True if word.startswith(":DEGREES") else False if word.startswith(":RADIANS") else None


def tells_rate(line: str) -> float | None:
    """Poses per second by a line of the header; None where it says nothing of them above 0."""
    words = line.upper().split()
    if not words or not words[0].startswith(_RATE):
        return None
    try:
        value = float(words[-1])
    except ValueError:
        return None
    return value if value > 0 else None


def rate_line(rate: float) -> bytes:
    """The line of the header that tells a rate."""
    return f"{_RATE} {rate:.9g}".encode()


def patched(
    path: Path, movement: Movement, progress: Progress, *, rate: float = USUAL_RATE
) -> bytes | None:
    """A movement's file with other numbers where the movement is another.

    Header, comments, order of segments, endings of lines and every number that is not changed stay
    the same bytes. A segment that a pose leaves out gets a line where other poses have it. A part
    has the header too, and the comments before and after its poses.

    Parameters
    ----------
    path : the file, as it was when the movement was read
    movement : of the same poses, or some of them; where a segment is NaN its line goes
    progress : told the share of poses written; may raise to stop
    rate : poses per second, which the header tells where it told others, or none and these are not
        the usual

    Returns
    -------
    The file's content; None where the file is not there any more or has other poses
    """
    try:
        raw = path.read_bytes()
    except OSError:
        return None
    mark = _BYTE_ORDER_MARK if raw.startswith(_BYTE_ORDER_MARK) else b""
    lines = raw.removeprefix(mark).splitlines(keepends=True)
    told = _in_file(movement, degrees=movement.skeleton.degrees)
    head, poses = _poses(_without_cut_name(lines, told), told)
    for line in head:
        degrees = tells_degrees(" ".join(_words(line)))
        if degrees is not None:
            told = _in_file(movement, degrees=degrees)
    whole = movement.before + movement.frames + movement.after
    if not poses:
        return None
    poses = _with_gaps(poses)
    # Of a file that is cut short a last pose without any segment was left out.
    if len(poses) not in (whole, whole + 1):
        return None
    usual, out = _usual_order(poses, told), [mark, *_with_rate(head, rate, _ending(lines[0]))]
    if movement.before:
        out += _behind_pose(poses[movement.before - 1])
    for pose, block in enumerate(poses[movement.before : movement.before + movement.frames]):
        if pose % _POSES_A_REPORT == 0:
            progress(pose / movement.frames, "Writing poses")
        values = {name: rows[pose] for name, rows in told.items() if all(map(isfinite, rows[pose]))}
        # What was not there, and has not been filled, is left out again.
        out += _patched_pose(block, values, told, usual) if values or len(block) > 1 else []
    return b"".join(out)


def _with_rate(head: list[bytes], rate: float, ending: bytes) -> list[bytes]:
    """Lines of a header that tells this rate."""
    told = [tells_rate(" ".join(_words(line))) for line in head]
    there = [i for i, hertz in enumerate(told) if hertz is not None]
    # Where it is told twice the last holds.
    if ((told[there[-1]] if there else None) or USUAL_RATE) == rate:
        return head
    if there:
        old = head[there[-1]]
        return [*head[: there[-1]], rate_line(rate) + _behind(old), *head[there[-1] + 1 :]]
    last = max((i for i, line in enumerate(head) if line.lstrip().startswith(b":")), default=-1)
    return [*head[: last + 1], rate_line(rate) + ending, *head[last + 1 :]]


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


def _without_cut_name(lines: list[bytes], told: Collection[str]) -> list[bytes]:
    """Lines without a last one that ends within the name of a segment."""
    name = b"".join(lines[-1:]).decode("latin-1").strip()
    cut = bool(name) and name not in told and any(other.startswith(name) for other in told)
    return lines[:-1] if cut and not lines[-1].endswith((b"\r", b"\n")) else lines


def _with_gaps(poses: list[list[bytes]]) -> list[list[bytes]]:
    """Lines of each pose, and only a number for those that are left out."""
    numbers = [int(_words(block[0])[0]) for block in poses]
    frames = frames_of(numbers)
    step = (numbers[-1] - numbers[0]) // frames[-1] if frames[-1] else 1
    out = [
        [str(numbers[0] + step * frame).encode() + _ending(poses[0][0])]
        for frame in range(frames[-1] + 1)
    ]
    for frame, block in zip(frames, poses, strict=True):
        out[frame] = block
    return out


def _behind_pose(block: list[bytes]) -> list[bytes]:
    """Lines behind a pose's last that say nothing of it: comments on what follows."""
    last = max(i for i, line in enumerate(block) if _words(line))
    return block[last + 1 :]


def _words(line: bytes) -> list[str]:
    """Words of a line, without its comment."""
    return _COMMENT.split(line, maxsplit=1)[0].decode("latin-1").split()


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
    ending = _ending(block[0])
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
    """The line with other values."""
    return " ".join([name, *(f"{v:.9g}" for v in values)]).encode("latin-1") + _behind(line)


def _behind(line: bytes) -> bytes:
    """Comment and ending of a line."""
    comment = _COMMENT.search(line.rstrip())
    also = b" " + line.rstrip()[comment.start() :] if comment else b""
    return also + line[len(line.rstrip(b"\r\n")) :]


def _ending(line: bytes) -> bytes:
    """How a line ends; as on most systems where it does not."""
    return line[len(line.rstrip(b"\r\n")) :] or b"\n"
