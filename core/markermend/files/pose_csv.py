"""Read and write skeleton recordings as comma-separated values, one row a frame and joint.

The columns are ``frame`` (from 0), ``time`` in seconds, ``joint``, ``parent`` (empty for the root),
``x``, ``y``, ``z`` in mm, the rotation ``qx``, ``qy``, ``qz``, ``qw`` and ``confidence``. A joint
that was not seen is at 0, 0, 0 with rotation 0, 0, 0, 1 and confidence 0. What was read from such a
table and not changed since is written to the last digit, what was computed to a micrometre. Where
the file that was read has all of these columns, its rows that are not changed are written as there.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from math import isfinite
from pathlib import Path
from typing import IO

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import FileFormatError
from markermend.files.pose_csv_patch import patched
from markermend.files.text import number, read_lines
from markermend.poses.nuitrack import PARENT_OF, usual_name
from markermend.poses.pose import Pose
from markermend.progress import Progress, quiet

COLUMNS = ("frame", "time", "joint", "parent", "x", "y", "z", "qx", "qy", "qz", "qw", "confidence")
_NUMBERS = COLUMNS[4:]
_SENSOR_RATE = 30.0
_SAME = 1e-9
_FRAMES_A_REPORT = 256
_OTHER_NAMES = {
    "name": "joint",
    "jointname": "joint",
    "timestamp": "time",
    "times": "time",
    "positionx": "x",
    "positiony": "y",
    "positionz": "z",
    "posx": "x",
    "posy": "y",
    "posz": "z",
    "rotationx": "qx",
    "rotationy": "qy",
    "rotationz": "qz",
    "rotationw": "qw",
    "quatx": "qx",
    "quaty": "qy",
    "quatz": "qz",
    "quatw": "qw",
}


@dataclass(frozen=True)
class Table:
    """Numbers as a file has them.

    Attributes
    ----------
    written : (frames, joints, 8) position, rotation and confidence; NaN where it has none
    read : the same as the recording holds it, with rotations of length 1
    file : that they are from, where it has every column and its own times hold
    at : place of each known column there
    """

    written: FloatArray
    read: FloatArray
    file: Path | None = None
    at: Mapping[str, int] = field(default_factory=dict)


def read_pose_csv(path: Path, *, rate: float | None, progress: Progress | None = None) -> Pose:
    """Read joints.

    Parameters
    ----------
    path : the file; its first line names the columns, in any order. Rotations, confidence, time
        and, for joints with usual names, parents may be absent.
    rate : poses per second, where the file has no times (30)
    progress : told the share of rows read

    Raises
    ------
    FileFormatError
        when a column is missing, a row is damaged, or there is no row
    """
    lines = [line for line in read_lines(path) if line.strip() and not line.startswith("#")]
    if len(lines) < 2:
        raise FileFormatError(f"{path.name} is cut short: no pose follows its header.")
    delimiter = max(",;\t", key=lines[0].count)
    rows = list(csv.reader(lines, delimiter=delimiter))
    at = columns_of(rows[0], path.name)
    body, warnings = _whole_rows(rows[1:], len(rows[0]), path.name)
    joints = tuple(dict.fromkeys(row[at["joint"]].strip() for row in body))
    frame, count = _frames(body, at, len(joints), path.name)
    values = np.full((count, len(joints), len(_NUMBERS)), np.nan)
    place, report = {joint: i for i, joint in enumerate(joints)}, progress or quiet
    cells = [(i, at[name]) for i, name in enumerate(_NUMBERS) if name in at]
    for n, row in enumerate(body):
        if n % (_FRAMES_A_REPORT * len(joints)) == 0:
            report(n / len(body), "Reading poses")
        mine = values[frame[n], place[row[at["joint"]].strip()]]
        for i, column in cells:
            mine[i] = number(row[column])
    parents = parents_of(body, at, joints, path.name)
    hertz, guess = _rate(body, at, frame, rate)
    confidence = values[..., 7] if "confidence" in at else np.ones(values.shape[:2])
    zero = (values[..., :3] == 0).all(axis=2) & (np.asarray(parents) >= 0)
    confidence = np.where(zero, 0.0, confidence)
    pose = Pose(
        values[..., :3],
        values[..., 3:7],
        joints,
        parents,
        hertz,
        confidence,
        warnings=(*warnings, *guess),
    )
    own = path if rate is None and set(COLUMNS) <= set(at) else None
    return replace(pose, source=Table(values, _numbers_of(pose), own, at))


def write_pose_csv(pose: Pose, file: IO[bytes], progress: Progress) -> None:
    """Write joints.

    Parameters
    ----------
    pose : the recording
    file : written from its beginning
    progress : told the share of poses written
    """
    names = [quoted(joint) for joint in pose.joints]
    above = [names[parent] if parent >= 0 else "" for parent in pose.parents]
    values, table = _numbers_of(pose), pose.source
    written = np.full(values.shape, np.nan)
    if isinstance(table, Table) and table.read.shape == values.shape:
        # A rotation that is made as long as 1 once more is the same.
        same = np.abs(values - table.read) <= _SAME
        content = _over_its_file(pose, table, values, ~same, progress)
        if content is not None:
            file.write(content)
            return
        written = np.where(same, table.written, np.nan)
        values = np.where(np.isfinite(written), written, values)
    file.write((",".join(COLUMNS) + "\n").encode())
    for frame in range(pose.frames):
        if frame % _FRAMES_A_REPORT == 0:
            progress(frame / pose.frames, "Writing poses")
        lines = rows_of(frame, frame / pose.rate, names, above, values[frame])
        for joint in np.flatnonzero(np.isfinite(written[frame]).any(axis=1)):
            lines[joint] = _exactly(lines[joint], written[frame, joint])
        file.write("".join(lines).encode())


def _over_its_file(
    pose: Pose, table: Table, values: FloatArray, changed: BoolArray, progress: Progress
) -> bytes | None:
    """What was read, with what is changed; None where that cannot be."""
    if table.file is None:
        return None
    return patched(
        table.file, pose.joints, table.written, values, changed, table.at, _NUMBERS, progress
    )


def rows_of(
    frame: int, time: float, names: list[str], above: list[str], values: FloatArray
) -> list[str]:
    """Lines of one pose, of (joints, 8) numbers."""
    return [
        f"{frame},{time:.6f},{name},{parent},{x:.3f},{y:.3f},{z:.3f},"
        f"{a:.6f},{b:.6f},{c:.6f},{w:.6f},{sure:.3g}\n"
        for name, parent, (x, y, z, a, b, c, w, sure) in zip(
            names, above, values.tolist(), strict=True
        )
    ]


def _exactly(line: str, written: FloatArray) -> str:
    """Write out what a row has lost of the numbers as they were; NaN where there was none."""
    front, *cells = line.rstrip("\n").rsplit(",", len(_NUMBERS))
    for i, value in enumerate(written.tolist()):
        if isfinite(value) and float(cells[i]) != value:
            cells[i] = repr(value)
    return ",".join((front, *cells)) + "\n"


def _numbers_of(pose: Pose) -> FloatArray:
    """(frames, joints, 8) what is written of a recording; nothing is NaN."""
    places = np.nan_to_num(pose.positions)
    turns = np.where(np.isnan(pose.rotations), (0.0, 0.0, 0.0, 1.0), pose.rotations)
    return np.concatenate([places, turns, pose.confidence[..., None]], axis=2)


def names_joints(head: bytes) -> bool:
    """Whether the first bytes of a file are the header of such a table."""
    lines = head.decode("utf-8-sig", errors="replace").splitlines()
    first = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    try:
        columns_of(first.split(max(",;\t", key=first.count)), "")
    except FileFormatError:
        return False
    return True


def columns_of(head: list[str], name: str) -> dict[str, int]:
    """Place of each known column in a header.

    Parameters
    ----------
    head : its cells
    name : of the file, for what is wrong with it

    Raises
    ------
    FileFormatError
        when a column is missing that every table of joints has
    """
    plain = [re.sub(r"[^a-z]", "", re.sub(r"[\[(].*", "", cell.lower())) for cell in head]
    at = {_OTHER_NAMES.get(cell, cell): i for i, cell in enumerate(plain)}
    missing = [column for column in ("frame", "joint", "x", "y", "z") if column not in at]
    if missing:
        raise FileFormatError(
            f"{name} is no table of joints: it lacks the column “{missing[0]}”; it should have"
            f" {', '.join(COLUMNS)}."
        )
    return at


def _whole_rows(rows: list[list[str]], width: int, name: str) -> tuple[list[list[str]], list[str]]:
    """Rows that have all their cells; a last one that is cut short is left out, and said."""
    if len(rows[-1]) < width:
        rows = rows[:-1]
        short = next((i for i, row in enumerate(rows) if len(row) < width), None)
        if rows and short is None:
            return rows, ["The file is cut short; its last row was left out."]
    for i, row in enumerate(rows):
        if len(row) < width:
            raise FileFormatError(
                f"{name} is damaged: row {i + 2} has {len(row)} cells, the header {width}."
            )
    if not rows:
        raise FileFormatError(f"{name} holds no whole row.")
    return rows, []


def _frames(
    body: list[list[str]], at: dict[str, int], joints: int, name: str
) -> tuple[list[int], int]:
    """Frame of each row, from 0, and how many there are."""
    column = at["frame"]
    try:
        stated = [int(float(row[column])) for row in body]
    except (ValueError, OverflowError) as error:
        raise FileFormatError(f"{name} is damaged: a frame is no number ({error}).") from error
    first, last = min(stated), max(stated)
    # One stray number must not ask for a terabyte.
    if (last - first + 1) * joints > 100 * len(body) + 1000:
        raise FileFormatError(
            f"{name} is damaged: its frames go from {first} to {last}, with {len(body)} rows."
        )
    return [frame - first for frame in stated], last - first + 1


def parents_of(
    body: list[list[str]], at: dict[str, int], joints: tuple[str, ...], name: str
) -> tuple[int, ...]:
    """Index of each joint's parent, by the file or by the joints' usual names.

    Parameters
    ----------
    body : rows
    at : place of each known column
    joints : their names
    name : of the file, for what is wrong with it

    Returns
    -------
    (joints,) index of the parent, -1 for a root

    Raises
    ------
    FileFormatError
        when there is no such column and a name is not usual, or a parent is no joint
    """
    if "parent" in at:
        above = {row[at["joint"]].strip(): row[at["parent"]].strip() for row in body}
    else:
        usual = {usual_name(joint): joint for joint in joints}
        unknown = [joint for joint in joints if usual_name(joint) not in PARENT_OF]
        if unknown:
            raise FileFormatError(
                f"{name} does not say what “{unknown[0]}” hangs on; add a column “parent”."
            )
        above = {joint: usual.get(PARENT_OF[usual_name(joint)], "") for joint in joints}
    lost = [parent for parent in above.values() if parent and parent not in joints]
    if lost:
        raise FileFormatError(f"{name} is damaged: the parent “{lost[0]}” is no joint of it.")
    return tuple(joints.index(above[joint]) if above[joint] else -1 for joint in joints)


def _rate(
    body: list[list[str]], at: dict[str, int], frame: list[int], stated: float | None
) -> tuple[float, Iterable[str]]:
    """Poses per second, and a sentence where it was guessed."""
    if stated is not None:
        return stated, ()
    if "time" in at:
        times = np.array([number(row[at["time"]]) for row in body])
        frames = np.array(frame)
        known = np.isfinite(times)
        if np.unique(frames[known]).size > 1:
            slope = float(np.polyfit(frames[known], times[known], 1)[0])
            if slope > 0:
                return float(np.round(1.0 / slope, 4)), ()
    return _SENSOR_RATE, [f"The file tells no rate; {_SENSOR_RATE:g} Hz was assumed."]


def quoted(name: str) -> str:
    """A name as a cell."""
    return '"' + name.replace('"', '""') + '"' if re.search(r'[",\n]', name) else name
