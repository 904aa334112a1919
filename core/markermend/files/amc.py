"""Read and write Acclaim movements (AMC)."""

from __future__ import annotations

from pathlib import Path
from typing import IO

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import FileFormatError
from markermend.files.amc_patch import patched
from markermend.files.asf import words_of
from markermend.files.text import read_lines
from markermend.poses.skeleton import TURNS, Movement, Skeleton
from markermend.progress import Progress

_POSES_A_REPORT = 1024


def find_skeleton(path: Path) -> Path:
    """Skeleton of a movement: of the same name, of its subject (``01`` of ``01_05``), or the only.

    Raises
    ------
    FileFormatError
        when the folder has none that fits
    """
    there = [p for p in sorted(path.parent.iterdir()) if p.suffix.lower() == ".asf"]
    by_name = {p.stem.lower(): p for p in there}
    stem = path.stem.lower()
    for name in (stem, stem.rpartition("_")[0], stem.partition("_")[0]):
        if name in by_name:
            return by_name[name]
    if len(there) == 1:
        return there[0]
    raise FileFormatError(
        f"{path.name} needs its skeleton: put the ASF file beside it, named"
        f" {path.stem.partition('_')[0]}.asf, or say which it is."
    )


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
    degrees, rate, body = _head(path, skeleton.degrees)
    if not body:
        raise FileFormatError(f"{path.name} is cut short: no pose follows its header.")
    alike = _read_alike(body, skeleton)
    if alike is not None:
        channels, frames, warnings = alike, len(next(iter(alike.values()))), list[str]()
    else:
        channels, frames, warnings = _read_lines(path, skeleton)
    if not degrees:
        dofs = {segment.name: segment.dofs for segment in skeleton.segments}
        for name, values in channels.items():
            turns = [i for i, dof in enumerate(dofs[name]) if dof in TURNS]
            values[:, turns] = np.degrees(values[:, turns])
    left_out = [s.name for s in skeleton.segments if s.dofs and s.name not in channels]
    if left_out:
        warnings.append(f"Segments without movement, left as at rest: {', '.join(left_out)}.")
    return Movement(skeleton, channels, frames, path), rate, warnings


def _head(path: Path, degrees: bool) -> tuple[bool, float | None, list[str]]:
    """Unit of angles, rate, and the lines from the first pose on."""
    lines = read_lines(path)
    rate = None
    for i, line in enumerate(lines):
        word = line.strip().upper()
        if word.startswith(":RADIANS"):
            degrees = False
        elif word.startswith(":DEGREES"):
            degrees = True
        elif word.startswith(":SAMPLES-PER-SECOND"):
            rate = _positive(word.split()[-1])
        elif word.isdigit():
            return degrees, rate, lines[i:]
    return degrees, rate, []


def _positive(word: str) -> float | None:
    try:
        value = float(word)
    except ValueError:
        return None
    return value if 0 < value < 1e6 else None


def _read_alike(body: list[str], skeleton: Skeleton) -> dict[str, FloatArray] | None:
    """Read poses that all have the same lines, at once; None where they do not, or look odd."""
    first = next((i for i, line in enumerate(body[1:], 1) if line.strip().isdigit()), len(body))
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
    return channels


def _read_lines(path: Path, skeleton: Skeleton) -> tuple[dict[str, FloatArray], int, list[str]]:
    """Read line by line what may lack segments, hold comments, or be damaged."""
    dofs = {segment.name: segment.dofs for segment in skeleton.segments}
    poses: list[dict[str, list[float]]] = []
    unknown: dict[str, None] = {}
    lines = [(n, w) for n, w in words_of(path) if not w[0].startswith(":")]
    whole = True
    for number, (name, *cells) in lines:
        if name.isdigit() and not cells:
            poses.append({})
        elif name not in dofs:
            unknown[name] = None
        elif poses:
            values = _finite(cells)
            whole = len(values) == len(dofs[name])
            if not whole and number != lines[-1][0]:
                raise FileFormatError(
                    f"{path.name} is damaged: line {number} should give {name} {len(dofs[name])}"
                    f" numbers, but reads “{' '.join(cells)[:40]}”."
                )
            poses[-1][name] = values
    warnings = []
    if unknown:
        warnings.append(f"Segments the skeleton does not have were left out: {', '.join(unknown)}.")
    if not whole or (len(poses) > 1 and len(poses[-1]) < len(poses[-2])):
        poses.pop()
        warnings.append("The file is cut short; its last pose was left out.")
    if not any(poses):
        raise FileFormatError(f"{path.name} holds no pose of this skeleton.")
    channels: dict[str, FloatArray] = {}
    for name in dofs:
        if any(name in pose for pose in poses):
            blank = [np.nan] * len(dofs[name])
            channels[name] = np.array([pose.get(name, blank) for pose in poses])
    return channels, len(poses), warnings


def _finite(cells: list[str]) -> list[float]:
    """Values of cells; none at all where one is no finite number."""
    try:
        values = [float(cell) for cell in cells]
    except ValueError:
        return []
    return values if np.isfinite(values).all() else []


def write_amc(movement: Movement, file: IO[bytes], progress: Progress) -> None:
    """Write a movement: over the file it was read from, else in degrees.

    Parameters
    ----------
    movement : skeleton and channels; segments are left out of poses where they are NaN
    file : written from its beginning
    progress : told the share of poses written
    """
    content = patched(movement.file, movement, progress) if movement.file is not None else None
    if content is not None:
        file.write(content)
        return
    file.write(b":FULLY-SPECIFIED\n:DEGREES\n")
    names = [s.name for s in movement.skeleton.segments if s.name in movement.channels and s.dofs]
    for pose in range(movement.frames):
        if pose % _POSES_A_REPORT == 0:
            progress(pose / movement.frames, "Writing poses")
        lines = [str(pose + 1)]
        for name in names:
            values = movement.channels[name][pose]
            if np.isfinite(values).all():
                lines.append(" ".join([name, *(f"{value:.9g}" for value in values.tolist())]))
        file.write(("\n".join(lines) + "\n").encode())
