"""Read and write Acclaim movements (AMC)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import IO

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.errors import ExportError, FileFormatError
from markermend.files.amc_patch import (
    USUAL_RATE,
    frames_of,
    is_number,
    patched,
    rate_line,
    starts_pose,
    tells_degrees,
    tells_rate,
)
from markermend.files.amc_skeleton import saying
from markermend.files.asf import bare, words_of
from markermend.files.plausible import FARTHEST, read_as_missing
from markermend.files.text import read_lines
from markermend.poses.skeleton import TURNS, Movement, Skeleton
from markermend.progress import Progress
from markermend.rates import rate_of

_POSES_A_REPORT = 1024
_MOST_NAMED = 8
_LONGEST_NAME = 40
# Channels by segment, number of poses, number of the first, and a sentence for each oddity.
_Read = tuple[dict[str, FloatArray], int, int, list[str]]


def read_amc(path: Path, skeleton: Skeleton) -> tuple[Movement, float | None, list[str]]:
    """Read a movement.

    Parameters
    ----------
    path : the file
    skeleton : whose segments and degrees of freedom its lines follow

    Returns
    -------
    movement, poses per second where the file tells, and a sentence for each oddity

    Raises
    ------
    FileFormatError
        when the file is damaged: not enough numbers for a segment, or no pose at all
    """
    degrees, rate, body = _head(path, skeleton)
    if not body:
        raise FileFormatError(f"{path.name} is cut short: no pose follows its header.")
    alike = _read_alike(body, skeleton)
    channels, frames, first, warnings = alike or _read_lines(path, skeleton)
    if not degrees:
        dofs = {segment.name: segment.dofs for segment in skeleton.segments}
        for name, values in channels.items():
            turns = [i for i, dof in enumerate(dofs[name]) if dof in TURNS]
            values[:, turns] = np.degrees(values[:, turns])
    warnings += read_as_missing(_leave_out_wild(channels, skeleton))
    left_out = [s.name for s in skeleton.segments if s.dofs and s.name not in channels]
    if left_out:
        warnings.append(f"Segments without movement, left as at rest: {', '.join(left_out)}.")
    return Movement(skeleton, channels, frames, path, first), rate, warnings


def _head(path: Path, skeleton: Skeleton) -> tuple[bool, float | None, list[str]]:
    """Unit of angles, rate, and the lines from the first pose on."""
    lines = read_lines(path)
    rate, degrees = None, skeleton.degrees
    for i, line in enumerate(map(bare, lines)):
        told, hertz = tells_degrees(line), tells_rate(line)
        if told is not None:
            degrees = told
        elif hertz is not None:
            rate = rate_of(hertz, path.name)
        elif _begins(line.split()[:1], skeleton):
            return degrees, rate, lines[i:]
    return degrees, rate, []


def _begins(words: list[str], skeleton: Skeleton) -> bool:
    """Whether poses begin in a line that begins so: by a number or, where that lacks, a segment."""
    return bool(words) and (is_number(words[0]) or words[0] in skeleton.names)


def _read_alike(body: list[str], skeleton: Skeleton) -> _Read | None:
    """Read poses that all have the same lines, at once; None where they do not, or look odd."""
    if not is_number(body[0].strip()):
        return None
    first = next((i for i, line in enumerate(body[1:], 1) if is_number(line.strip())), len(body))
    words = [line.split() for line in body[1:first]]
    dofs = {segment.name: segment.dofs for segment in skeleton.segments}
    if any(not w or len(w) != 1 + len(dofs.get(w[0], ())) or w[0] not in dofs for w in words):
        return None
    if not words or len({w[0] for w in words}) != len(words):
        return None
    flat = " ".join(body).split()
    width = 1 + sum(len(w) for w in words)
    if len(flat) % width:
        return None
    table = np.array(flat, dtype=object).reshape(-1, width)
    if not all(map(is_number, table[:, 0])) or len(_jumps(table[:, 0].tolist())):
        return None
    place, channels = 1, dict[str, FloatArray]()
    for name, *values in words:
        if (table[:, place] != name).any():
            return None
        try:
            numbers = table[:, place + 1 : place + 1 + len(values)].astype(np.float64)
        except ValueError:
            return None
        if not np.isfinite(numbers).all():
            return None
        channels[name] = numbers
        place += 1 + len(values)
    return channels, len(table), int(table[0, 0]), []


def _read_lines(path: Path, skeleton: Skeleton) -> _Read:
    """Read line by line what may lack segments, hold comments, or be damaged."""
    dofs = {segment.name: segment.dofs for segment in skeleton.segments}
    lines = [(n, w) for n, w in words_of(path) if not w[0].startswith(":")]
    stopped = bool(read_lines(path)[-1].strip())
    if stopped and lines[-1][1][0] not in dofs and _begins_name(lines[-1][1][0], dofs):
        lines.pop()
        stopped = False
    poses, starts, warnings = _poses_of(path.name, lines, dofs)
    short = bool(poses) and lines[-1][1][0] in dofs.keys() - poses[-1].keys()
    if short or (len(poses) > 1 and _cut_short(list(poses[-1]), list(poses[-2]))):
        if stopped and lines[-1][1][0] in list(poses[-1])[-1:]:
            # Of its last number digits may be missing.
            poses[-1].popitem()
        if poses[-1]:
            warnings.append("The file is cut short; what its last pose lacks was read as missing.")
        else:
            poses.pop()
            starts.pop()
            warnings.append("The file is cut short; its last pose was left out.")
    if not any(poses):
        raise FileFormatError(f"{path.name} holds no pose of this skeleton.")
    poses = _with_gaps(poses, starts, warnings)
    channels: dict[str, FloatArray] = {}
    for name in dofs:
        if any(name in pose for pose in poses):
            blank = [np.nan] * len(dofs[name])
            channels[name] = np.array([pose.get(name, blank) for pose in poses])
    return channels, len(poses), int(starts[0][0]), warnings


def _with_gaps(
    poses: list[dict[str, list[float]]], starts: list[tuple[str, int]], warnings: list[str]
) -> list[dict[str, list[float]]]:
    """Poses, and empty ones for those that numbers leave out; what is odd about these is said."""
    numbers = [int(start) for start, _ in starts]
    jumps, frames = _jumps([start for start, _ in starts]), frames_of(numbers)
    if not len(jumps):
        return poses
    missing = frames[-1] + 1 - len(poses)
    at = int(np.flatnonzero(np.diff(frames) != 1)[0]) if missing else int(jumps[0])
    between = f"from {numbers[at]} to {numbers[at + 1]} in line {starts[at + 1][1]}"
    if not missing:
        warnings.append(f"Frame numbers go {between}; poses were read one after the other.")
        return poses
    warnings.append(
        f"Frame numbers leave out {missing} poses, {between} for one; they were read as gaps."
    )
    there = dict(zip(frames, poses, strict=True))
    return [there.get(frame, {}) for frame in range(frames[-1] + 1)]


def _begins_name(word: str, dofs: Mapping[str, tuple[str, ...]]) -> bool:
    """Whether a line that ends behind a word may end within a segment's name."""
    return any(name.startswith(word) for name in dofs)


def _cut_short(last: list[str], before: list[str]) -> bool:
    """Whether segments of a pose are a beginning of those of the pose before it, and no more."""
    return last == before[: len(last)] != before


def _poses_of(
    file: str, lines: list[tuple[int, list[str]]], dofs: Mapping[str, tuple[str, ...]]
) -> tuple[list[dict[str, list[float]]], list[tuple[str, int]], list[str]]:
    """Values of each pose by segment, its number with its line, and a sentence for each oddity."""
    poses: list[dict[str, list[float]]] = []
    starts: list[tuple[str, int]] = []
    unknown: dict[str, None] = {}
    unnumbered: list[int] = []
    for number, (name, *cells) in lines:
        if name not in dofs and name.isdecimal():
            _check_number(file, number, name, cells)
        if starts_pose(name, dofs):
            poses.append({})
            starts.append((name, number))
        elif name not in dofs:
            unknown[name[:_LONGEST_NAME]] = None
        else:
            if not poses:
                after = next((int(w[0]) for _, w in lines if starts_pose(w[0], dofs)), 2)
                poses.append({})
                unnumbered.append(number)
                starts.append((str(after - 1), number))
            values = _finite(cells)
            if len(values) != len(dofs[name]):
                if number == lines[-1][0]:
                    break
                raise FileFormatError(
                    f"{file} is damaged: line {number} should give {name} {len(dofs[name])}"
                    f" numbers, but reads “{' '.join(cells)[:40]}”."
                )
            if name in poses[-1]:
                whole = 1 < len(poses[-1]) == len(poses[0])
                if not whole or name != next(iter(poses[-1])):
                    raise FileFormatError(
                        f"{file} is damaged: line {number} tells of {name} a second time in one"
                        " pose."
                    )
                poses.append({})
                unnumbered.append(number)
                starts.append((str(int(starts[-1][0]) + 1), number))
            poses[-1][name] = values
    warnings = []
    if unknown:
        warnings.append(f"Segments the skeleton does not have were left out: {', '.join(unknown)}.")
    if unnumbered:
        warnings.append(
            f"No number stands before {len(unnumbered)} poses, in line {unnumbered[0]} for one;"
            " they were read all the same."
        )
    return poses, starts, warnings


def _check_number(file: str, number: int, word: str, cells: list[str]) -> None:
    """Refuse what stands where a pose should begin, and begins none."""
    if not is_number(word):
        raise FileFormatError(
            f"{file} is damaged: line {number} begins with “{word[:_LONGEST_NAME]}”, which is the"
            " number of no pose."
        )
    if cells and len(_finite(cells)) == len(cells):
        raise FileFormatError(
            f"{file} is damaged: line {number} has only numbers; it should begin with the"
            " name of a segment, or be the number of a pose."
        )


def _jumps(numbers: list[str]) -> IntArray:
    """Which numbers of poses another follows than the next."""
    return np.flatnonzero(np.diff(np.array([float(number) for number in numbers])) != 1)


def _leave_out_wild(channels: dict[str, FloatArray], skeleton: Skeleton) -> int:
    """Make NaN, in place, what is no movement of a body; how many segments in poses that were."""
    count = 0
    for segment in skeleton.segments:
        if segment.name in channels:
            scales = [1.0 if dof in TURNS else skeleton.scale_mm for dof in segment.dofs]
            wild = (np.abs(channels[segment.name]) * scales > FARTHEST).any(axis=1)
            channels[segment.name][wild] = np.nan
            count += int(wild.sum())
    return count


def _finite(cells: list[str]) -> list[float]:
    """Values of cells; none at all where one is no finite number."""
    try:
        values = [float(cell) for cell in cells]
    except ValueError:
        return []
    return values if np.isfinite(values).all() else []


def write_amc(
    movement: Movement,
    file: IO[bytes],
    progress: Progress,
    target: Path,
    *,
    rate: float = USUAL_RATE,
) -> None:
    """Write a movement: over the file it was read from, else in degrees.

    Parameters
    ----------
    movement : skeleton and channels; segments are left out of poses where they are NaN
    file : written from its beginning
    progress : told the share of poses written
    target : what the file will be called, by which its skeleton is looked for
    rate : poses per second, told where that is not what a file without a rate has

    Raises
    ------
    ExportError
        when a segment is never seen: without a line it would come back at rest
    """
    _check_seen(movement)
    own = movement.file
    content = None if own is None else patched(own, movement, progress, rate=rate)
    if content is not None:
        file.write(saying(content, target, movement.skeleton.file))
        return
    channels = movement.channels or _at_rest(movement)
    file.write(saying(b":FULLY-SPECIFIED\n:DEGREES\n", target, movement.skeleton.file))
    if rate != USUAL_RATE:
        file.write(rate_line(rate) + b"\n")
    names = [s.name for s in movement.skeleton.segments if s.name in channels and s.dofs]
    for pose in range(movement.frames):
        if pose % _POSES_A_REPORT == 0:
            progress(pose / movement.frames, "Writing poses")
        lines = [str(movement.first + pose)]
        for name in names:
            values = channels[name][pose]
            if np.isfinite(values).all():
                lines.append(" ".join([name, *(f"{value:.9g}" for value in values.tolist())]))
        file.write(("\n".join(lines) + "\n").encode())


def _check_seen(movement: Movement) -> None:
    """Refuse what would show a segment at rest that these poses have nothing of."""
    channels = movement.channels
    never = [name for name, values in channels.items() if np.isnan(values).any(axis=1).all()]
    if never:
        more = len(never) - _MOST_NAMED
        names = ", ".join(never[:_MOST_NAMED]) + (f" (+ {more})" if more > 0 else "")
        raise ExportError(
            f"An AMC cannot say that a segment is never seen, and would show {names} at rest."
            " Write more frames, repair these gaps first, or write a CSV."
        )


def _at_rest(movement: Movement) -> dict[str, FloatArray]:
    """Channels of a skeleton that does not move; a file without any could not be read back."""
    return {s.name: np.zeros((movement.frames, len(s.dofs))) for s in movement.skeleton.segments}
