"""Follow joints that come line by line, and give each pose back clean as soon as it is there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import isfinite

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import FileFormatError
from markermend.files.pose_csv import parents_of, quoted, rows_of, too_short
from markermend.files.pose_rows import (
    COLUMNS,
    NUMBERS,
    UNKNOWN_UNIT,
    Header,
    header_of,
    measured,
    says_nothing,
)
from markermend.poses.live import Live
from markermend.poses.pose import Pose
from markermend.poses.prior import NOT_FITTING, Prior, shipped_prior
from markermend.poses.quaternion import NO_TURN
from markermend.poses.restore import INFERRED

_STREAM = "The stream"
_Row = tuple[int, list[str]]


def follow(
    lines: Iterable[str],
    write: Callable[[str], None],
    *,
    rate: float,
    prior: Prior | None,
    warn: Callable[[str], None] = lambda sentence: None,
) -> int:
    """Clean a stream in the format of :mod:`markermend.files.pose_csv`.

    Parameters
    ----------
    lines : a header, then one row a frame and joint, the joints of a frame together
    write : called with the header, then with the rows of each pose, once its last joint has come;
        which joints there are, the first frame tells, so the first pose waits for the second
    rate : poses per second
    prior : how bodies move
    warn : told, in a sentence, what is not used of the stream or of the prior

    Returns
    -------
    number of poses

    Raises
    ------
    FileFormatError
        when there is no header, or a row is damaged
    """
    telling = ((n, line) for n, line in enumerate(lines, 1) if not says_nothing(line))
    number, first_line = next(telling, (0, ""))
    if not number:
        raise FileFormatError(f"{_STREAM} is empty; it should begin with a line of column names.")
    header = header_of(first_line.rstrip("\r\n"), _STREAM, number)
    if not header.unit_known:
        warn(UNKNOWN_UNIT)
    write(",".join(COLUMNS) + "\n")
    joints: tuple[str, ...] = ()
    live: Live | None = None
    parents: tuple[int, ...] = ()
    count, time, fine = 0, -1.0 / rate, False
    for rows in _poses(telling, header, warn):
        if not joints:
            joints, parents = _body(rows, header)
        values = _values(rows, header, joints, parents)
        # Metres that are not said to be go out as they came in.
        fine = fine or (not count and too_short(values[None, :, :3], parents))
        places, turns, sure = values[:, :3], values[:, 3:7], values[:, 7]
        if live is None and (sure > 0).all():
            live = Live(Pose(places[None], turns[None], joints, parents, rate), prior)
            if prior is not None and prior is not shipped_prior() and not live.by_prior:
                warn(NOT_FITTING)
        if live is not None:
            places, turns = live(places, turns, sure > 0)
            sure = np.where(sure > 0, sure, INFERRED)
        number, row = rows[0]
        told = header.time(row)
        time = told * (header.second or 1.0) if isfinite(told) else time + 1.0 / rate
        names = [quoted(joint) for joint in joints]
        above = [names[parent] if parent >= 0 else "" for parent in parents]
        unturned = np.where((sure > 0)[:, None], 0.0, NO_TURN)
        turns = np.where(np.isnan(turns), unturned, turns)
        values = np.column_stack([places, turns, sure])
        write("".join(rows_of(header.frame(row, number), time, names, above, values, fine=fine)))
        count += 1
    if count and live is None:
        warn("No pose of the stream had every joint of its first one, so nothing was filled.")
    return count


def _body(rows: list[_Row], header: Header) -> tuple[tuple[str, ...], tuple[int, ...]]:
    """Joints and parents as the first pose tells them."""
    joints = tuple(dict.fromkeys(header.joint(row, number) for number, row in rows))
    for number, row in rows:
        parent = row[header.at["parent"]].strip() if "parent" in header.at else ""
        if parent and parent not in joints:
            raise FileFormatError(
                f"{_STREAM} is damaged: line {number} hangs “{header.joint(row, number)}” on"
                f" “{parent}”, which its first pose does not have; that must name every joint."
            )
    return joints, parents_of([row for _, row in rows], header.at, joints, _STREAM)


def _poses(
    lines: Iterator[tuple[int, str]], header: Header, warn: Callable[[str], None]
) -> Iterator[list[_Row]]:
    """Rows of one frame at a time, as soon as it has every joint of the first one."""
    waiting: dict[str, _Row] = {}
    joints, strangers = frozenset[str](), set[str]()
    given: int | None = None
    now: int | None = None
    for number, line in lines:
        text = line.rstrip("\r\n")
        row = header.cells(text, number)
        if len(row) < header.width:
            if not line.endswith("\n") and next(lines, None) is None:
                # Whoever wrote it was stopped.
                warn("The stream is cut short; its last row was left out.")
                break
            raise FileFormatError(
                f"{_STREAM} is damaged: line {number}, “{text[:40]}”, lacks cells."
            )
        frame, joint = header.frame(row, number), header.joint(row, number)
        if waiting and frame != now:
            joints = joints or frozenset(waiting)
            yield list(waiting.values())
            waiting = {}
        if joints and joint not in joints:
            if joint not in strangers:
                warn(f"The stream's first pose has no joint “{joint}”; its rows are left out.")
            strangers.add(joint)
            continue
        if frame == given:
            continue
        now = frame
        if waiting.setdefault(joint, (number, row))[1] != row:
            raise FileFormatError(
                f"{_STREAM} is damaged: lines {waiting[joint][0]} and {number} both tell of"
                f" “{joint}” in one frame, and differ."
            )
        if len(waiting) == len(joints):
            yield list(waiting.values())
            waiting, given = {}, frame
    if waiting:
        yield list(waiting.values())


def _values(
    rows: list[_Row], header: Header, joints: tuple[str, ...], parents: tuple[int, ...]
) -> FloatArray:
    """(joints, 8) of one pose: position, rotation, confidence 0 where it was not seen.

    Rotations are NaN where the stream has none.
    """
    values = np.full((len(joints), len(NUMBERS)), np.nan)
    place = {joint: i for i, joint in enumerate(joints)}
    for number, row in rows:
        i = place.get(row[header.at["joint"]].strip())
        if i is not None:
            values[i] = header.values(row, number)
            if "confidence" not in header.at:
                values[i, 7] = 1.0
    unseen = ~measured(values) | ~(values[:, 7] > 0)
    unseen |= (values[:, :3] == 0).all(axis=1) & (np.array(parents) >= 0)
    values[~np.isfinite(values[:, 3:7]).all(axis=1), 3:7] = np.nan
    values[unseen] = (*(0.0,) * 3, *(np.nan,) * 4, 0.0)
    return values
