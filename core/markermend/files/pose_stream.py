"""Follow joints that come line by line, and give each pose back clean as soon as it is there."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import FileFormatError
from markermend.files.pose_csv import COLUMNS, columns_of, parents_of, quoted, rows_of
from markermend.files.text import number
from markermend.poses.live import Live
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior
from markermend.poses.restore import INFERRED

_STREAM = "The stream"
_NUMBERS = COLUMNS[4:]
_NO_TURN = (0.0, 0.0, 0.0, 1.0)


def follow(
    lines: Iterable[str], write: Callable[[str], None], *, rate: float, prior: Prior | None
) -> int:
    """Clean a stream in the format of :mod:`markermend.files.pose_csv`.

    Parameters
    ----------
    lines : a header, then one row a frame and joint, the joints of a frame together
    write : called with the header, then with the rows of each pose, once its last joint has come;
        which joints there are, the first frame tells, so the first pose waits for the second
    rate : poses per second
    prior : how bodies move

    Returns
    -------
    number of poses

    Raises
    ------
    FileFormatError
        when there is no header, or a row is damaged
    """
    rows = csv.reader(lines)
    head = next(rows, None)
    if head is None:
        raise FileFormatError(f"{_STREAM} is empty; it should begin with a line of column names.")
    at = columns_of(head, _STREAM)
    write(",".join(COLUMNS) + "\n")
    joints: tuple[str, ...] = ()
    live: Live | None = None
    parents: tuple[int, ...] = ()
    count = 0
    for pose_rows in _poses(rows, at, len(head)):
        if not joints:
            joints = tuple(row[at["joint"]].strip() for row in pose_rows)
            parents = parents_of(pose_rows, at, joints, _STREAM)
        values = _values(pose_rows, at, joints, parents)
        places, turns, sure = values[:, :3], values[:, 3:7], values[:, 7]
        if live is None and (sure > 0).all():
            live = Live(Pose(places[None], turns[None], joints, parents, rate), prior)
        if live is not None:
            places, turns = live(places, turns, sure > 0)
            sure = np.where(sure > 0, sure, INFERRED)
        first = pose_rows[0]
        time = number(first[at["time"]]) if "time" in at else count / rate
        names = [quoted(joint) for joint in joints]
        above = [names[parent] if parent >= 0 else "" for parent in parents]
        values = np.column_stack([places, turns, sure])
        write("".join(rows_of(int(float(first[at["frame"]])), time, names, above, values)))
        count += 1
    return count


def _poses(rows: Iterator[list[str]], at: dict[str, int], width: int) -> Iterator[list[list[str]]]:
    """Rows of one frame at a time, as soon as it has as many as the first one."""
    waiting: list[list[str]] = []
    whole, given = 0, ""
    for row in rows:
        if not row:
            continue
        if len(row) < width:
            raise FileFormatError(f"{_STREAM} is damaged: “{','.join(row)[:40]}” lacks cells.")
        frame = row[at["frame"]]
        if not np.isfinite(number(frame)):
            raise FileFormatError(f"{_STREAM} is damaged: “{frame[:40]}” is no frame.")
        if waiting and frame != waiting[0][at["frame"]]:
            whole = whole or len(waiting)
            yield waiting
            waiting = []
        if frame == given:
            continue
        waiting.append(row)
        if len(waiting) == whole:
            yield waiting
            waiting, given = [], frame
    if waiting:
        yield waiting


def _values(
    rows: list[list[str]], at: dict[str, int], joints: tuple[str, ...], parents: tuple[int, ...]
) -> FloatArray:
    """(joints, 8) of one pose: position, rotation, confidence 0 where it was not seen."""
    values = np.zeros((len(joints), len(_NUMBERS)))
    values[:, 3:7] = _NO_TURN
    place = {joint: i for i, joint in enumerate(joints)}
    for row in rows:
        i = place.get(row[at["joint"]].strip())
        if i is not None:
            values[i, 7] = 1.0
            for k, name in enumerate(_NUMBERS):
                if name in at:
                    values[i, k] = number(row[at[name]])
    unseen = ~np.isfinite(values).all(axis=1) | (values[:, 7] <= 0)
    unseen |= (values[:, :3] == 0).all(axis=1) & (np.array(parents) >= 0)
    values[unseen] = (*(0.0,) * 3, *_NO_TURN, 0.0)
    return values
