"""Read and write skeleton recordings as comma-separated values, one row a frame and joint.

The columns are ``frame``, ``time`` in seconds, ``joint``, ``parent`` (empty for the root), ``x``,
``y``, ``z`` in mm, or another unit that stands behind them, as in ``x (m)``, the rotation ``qx``,
``qy``, ``qz``, ``qw`` and ``confidence``. A joint that was not seen is at 0, 0, 0 with rotation
0, 0, 0, 1 and confidence 0, and where the file tells no confidence, 0, 0, 0 means that alone; one
that was seen there is a nanometre off. One that was seen, but not how it is turned, has rotation
0, 0, 0, 0.
What was read from such a table and not changed since is written to the last digit, what was
computed to a micrometre. Where the file that was read has what tells of a joint and how sure it is,
its rows that are not changed are written as there; those that it lacks come between them.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from math import isfinite
from pathlib import Path
from typing import IO

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import FileFormatError
from markermend.files.body_size import unit_of_body
from markermend.files.plausible import FARTHEST, read_as_missing
from markermend.files.pose_clock import Clock, by_times, with_gaps_by_times
from markermend.files.pose_csv_patch import Part, patched
from markermend.files.pose_rows import (
    COLUMNS,
    NUMBERS,
    UNKNOWN_UNIT,
    Header,
    header_of,
    measured,
    says_nothing,
    whole_rows,
    wild,
)
from markermend.files.pose_table import frames_of, parents_of, step_of, surest, twice
from markermend.files.text import read_lines
from markermend.poses.faults.vanishing import vanished
from markermend.poses.normal import bone_lengths
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN
from markermend.progress import Progress, quiet
from markermend.rates import rate_of

_SAME = 1e-9
_FRAMES_A_REPORT = 256
_NEAR_ZERO_MM = 1e-6
# Bones of bodies are longer, mm.
_LEAST_BONE = 1.0
_TURNLESS = "No column tells how joints are turned, as qx, qy, qz and qw would."


@dataclass(frozen=True)
class Table:
    """Numbers as a file has them.

    Attributes
    ----------
    written : (frames, joints, 8) position, rotation and confidence; NaN where it has none
    read : the same as the recording holds it, with rotations of length 1
    file : that they are from
    header : of that file
    clock : what its times tell, or what is assumed without
    """

    written: FloatArray
    read: FloatArray
    file: Path
    header: Header
    clock: Clock


def read_pose_csv(
    path: Path,
    *,
    rate: float | None,
    unit_mm: float | None = None,
    progress: Progress | None = None,
) -> Pose:
    """Read joints.

    Parameters
    ----------
    path : the file; its first line names the columns, in any order. Rotations, confidence, time
        and, for joints with usual names, parents may be absent.
    rate : poses per second, instead of those that its times tell (30 without times)
    unit_mm : millimetres in the unit of length, where the columns tell none
    progress : told the share of rows read

    Raises
    ------
    FileFormatError
        when a column is missing, a row is damaged, there is no row, nothing has such a rate, or the
        columns tell another unit
    """
    lines = [
        (number, line) for number, line in enumerate(read_lines(path), 1) if not says_nothing(line)
    ]
    if len(lines) < 2:
        raise FileFormatError(f"{path.name} is cut short: no pose follows its header.")
    header = header_of(lines[0][1], path.name, lines[0][0])
    body, warnings = whole_rows(lines[1:], header)
    if not header.unit_known:
        warnings.append(UNKNOWN_UNIT)
    if header.others and "qw" not in header.at:
        warnings.append(_TURNLESS)
    names = [header.joint(row, number) for number, row in body]
    joints = tuple(dict.fromkeys(names))
    header, frame, count = frames_of(body, header, len(joints))
    if header.step > 1:
        warnings.append(
            f"Frames are numbered {header.first}, {header.stated(header.first + 1)} and so on; they"
            " were read as following one another."
        )
    warnings += twice(body, frame, names, header)
    times = [header.time(row) for _, row in body]
    frame, gaps = with_gaps_by_times(times, frame, header)
    warnings += gaps
    values = np.full((max(count, max(frame) + 1), len(joints), len(NUMBERS)), np.nan)
    place, report = {joint: i for i, joint in enumerate(joints)}, progress or quiet
    for n, (number, row) in enumerate(body):
        if n % (_FRAMES_A_REPORT * len(joints)) == 0:
            report(n / len(body), "Reading poses")
        values[frame[n], place[names[n]]] = header.values(row, number)
    header = replace(header, sure=surest(values[..., -1]))
    if header.sure != 1.0:
        values[..., -1] = np.minimum(values[..., -1] / header.sure, 1.0)
    parents = parents_of([row for _, row in body], header.at, joints, path.name)
    if not header.unit_told:
        scale, unit = (unit_mm, "") if unit_mm else _unit(values[..., :3], parents, joints)
        if scale != 1.0:
            header, values[..., :3] = header.in_units_of(scale), scale * values[..., :3]
            if unit:
                warnings.append(
                    f"The file tells no unit of length; by the size of things {unit} were assumed."
                )
    elif unit_mm not in (None, *header.scales):
        raise FileFormatError(
            f"The columns of {path.name} tell their unit of length; leave out the other."
        )
    far = int(wild(values).sum())
    # What has no place is not seen, and is not written as seen either.
    values[~measured(values)] = np.nan
    told = by_times(times, frame, header)
    # Times that tell another rate are not believed.
    clock = told if rate in (None, told.rate) else Clock(rate)
    hertz = rate_of(clock.rate, path.name)
    confidence = values[..., 7] if "confidence" in header.at else np.ones(values.shape[:2])
    told_seen = "confidence" in header.at
    confidence = np.where(_nowhere(values, parents, joints, told=told_seen), 0.0, confidence)
    pose = Pose(
        values[..., :3],
        values[..., 3:7],
        joints,
        parents,
        hertz,
        confidence,
        warnings=(*warnings, *clock.oddities, *read_as_missing(far)),
        first_frame=header.first,
        first_time=clock.begins,
    )
    return replace(pose, source=Table(values, _numbers_of(pose), path, header, told))


def too_short(places: FloatArray, parents: tuple[int, ...]) -> bool:
    """Whether bones between places (frames, joints, 3) are no body's in mm, as those in metres."""
    lengths = _lengths(places, parents)
    return bool((lengths > 0).any() and np.nanmean(lengths) < _LEAST_BONE)


def _lengths(places: FloatArray, parents: tuple[int, ...]) -> FloatArray:
    """(joints,) usual lengths of bones between places (frames, joints, 3)."""
    there = (np.abs(places) <= FARTHEST).all(axis=2) & (places != 0).any(axis=2)
    return bone_lengths(np.where(there[..., None], places, np.nan), parents)


def _unit(
    places: FloatArray, parents: tuple[int, ...], joints: tuple[str, ...]
) -> tuple[float, str]:
    """Millimetres in the unit of places (frames, joints, 3), and its name, by their size."""
    told = unit_of_body(_lengths(places, parents), parents, joints)
    if told is None and too_short(places, parents):
        return 1000.0, "metres"
    return told or (1.0, "millimetres")


def _nowhere(
    values: FloatArray, parents: tuple[int, ...], joints: tuple[str, ...], *, told: bool
) -> BoolArray:
    """(frames, joints) bool, whether numbers (frames, joints, 8) put a joint where none is.

    Where no confidence is ``told``, nothing else than 0, 0, 0 says that a joint was not seen.
    """
    places = values[..., :3]
    if not told:
        return np.asarray((places == 0).all(axis=2) & (np.asarray(parents) >= 0))
    places = np.where(values[..., 7:] > 0, places, np.nan)
    return vanished(places, parents, joints)


def write_pose_csv(pose: Pose, file: IO[bytes], progress: Progress) -> tuple[str, ...]:
    """Write joints.

    Parameters
    ----------
    pose : the recording
    file : written from its beginning
    progress : told the share of poses written

    Returns
    -------
    Columns of the table that was read which are in this one no more, since it was written anew
    """
    names = [quoted(joint) for joint in pose.joints]
    above = [names[parent] if parent >= 0 else "" for parent in pose.parents]
    values, table = _numbers_of(pose), pose.source
    written = np.full(values.shape, np.nan)
    if isinstance(table, Table) and table.read.shape == values.shape:
        # A rotation that is made as long as 1 once more is the same.
        same = np.abs(values - table.read) <= _SAME
        # What a file says of a joint that was not seen is no part of where it is now.
        same &= (values[..., 7:] > 0) == (table.read[..., 7:] > 0)
        content = _over_its_file(pose, table, values, ~same, progress)
        if content is not None:
            file.write(content)
            return ()
        written = np.where(same, table.written, np.nan)
        values = np.where(np.isfinite(written), written, values)
    short = too_short(pose.positions, pose.parents)
    odd = _unit(pose.positions, pose.parents, pose.joints)[0] != 1.0
    # What is seen at 0, 0, 0 is written so near to it that it is not taken for unseen.
    rounded = np.concatenate([values[..., :3].round(6 if short else 3), values[..., 3:]], axis=2)
    there = _nowhere(rounded, pose.parents, pose.joints, told=True)
    written[there, 0] = _NEAR_ZERO_MM
    head = [f"{name} (mm)" if odd and name in ("x", "y", "z") else name for name in COLUMNS]
    file.write((",".join(head) + "\n").encode())
    first, step = _numbering(pose)
    for frame in range(pose.frames):
        if frame % _FRAMES_A_REPORT == 0:
            progress(frame / pose.frames, "Writing poses")
        time = pose.first_time + frame / pose.rate
        lines = rows_of(first + step * frame, time, names, above, values[frame], fine=short)
        for joint in np.flatnonzero(np.isfinite(written[frame]).any(axis=1)):
            lines[joint] = _exactly(lines[joint], written[frame, joint])
        file.write("".join(lines).encode())
    return table.header.others if isinstance(table, Table) else ()


def _numbering(pose: Pose) -> tuple[int, int]:
    """The number of the first pose, and from one to the next: as in the file that was read."""
    if not isinstance(pose.source, Table):
        return pose.first_frame, 1
    header = pose.source.header
    enough = step_of(range(0, pose.frames * header.step, header.step)) == header.step
    return header.stated(pose.first_frame), header.step if enough else 1


def _over_its_file(
    pose: Pose, table: Table, values: FloatArray, changed: BoolArray, progress: Progress
) -> bytes | None:
    """What was read, with what is changed; None where that cannot be."""
    header, mm = table.header, table.header.scales[0]
    if not header.unit_told and _unit(pose.positions / mm, pose.parents, pose.joints)[0] != mm:
        # A body of such a size would be taken to be in another unit.
        return None
    if surest(pose.confidence * header.sure) != header.sure:
        # What is left of levels would be taken for shares.
        return None
    times = None
    if pose.rate != table.clock.rate:
        times = pose.first_time + np.arange(pose.frames) / pose.rate
        times /= table.clock.second
    part = Part(pose.joints, pose.parents, pose.first_frame, table.written, values, changed, times)
    return patched(table.file, header, part, progress)


def rows_of(
    frame: int,
    time: float,
    names: list[str],
    above: list[str],
    values: FloatArray,
    *,
    fine: bool = False,
) -> list[str]:
    """Lines of one pose, of (joints, 8) numbers, to a nanometre where they shall be fine."""
    digits = 6 if fine else 3
    return [
        f"{frame},{time:.6f},{name},{parent},{x:.{digits}f},{y:.{digits}f},{z:.{digits}f},"
        f"{a:.6f},{b:.6f},{c:.6f},{w:.6f},{sure:.3g}\n"
        for name, parent, (x, y, z, a, b, c, w, sure) in zip(
            names, above, values.tolist(), strict=True
        )
    ]


def _exactly(line: str, written: FloatArray) -> str:
    """Write out what a row has lost of the numbers as they were; NaN where there was none."""
    front, *cells = line.rstrip("\n").rsplit(",", len(NUMBERS))
    for i, value in enumerate(written.tolist()):
        if isfinite(value) and float(cells[i]) != value:
            cells[i] = repr(value)
    return ",".join((front, *cells)) + "\n"


def _numbers_of(pose: Pose) -> FloatArray:
    """(frames, joints, 8) what is written of a recording; nothing is NaN."""
    places = np.nan_to_num(pose.positions)
    turned = ~np.isnan(pose.rotations)
    unturned = np.where(pose.seen[..., None], 0.0, NO_TURN)
    turns = np.where(turned, pose.rotations, unturned)
    return np.concatenate([places, turns, pose.confidence[..., None]], axis=2)


def quoted(name: str) -> str:
    """A name as a cell."""
    return '"' + name.replace('"', '""') + '"' if re.search(r'[",\n]', name) else name
