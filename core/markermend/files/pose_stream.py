"""Follow joints that come line by line, and give each pose back clean as soon as it is there."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import isfinite

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import FileFormatError
from markermend.files.pose_clock import SENSOR_RATE
from markermend.files.pose_csv import quoted, rows_of, too_short
from markermend.files.pose_rows import (
    COLUMNS,
    NUMBERS,
    UNKNOWN_UNIT,
    Header,
    header_of,
    measured,
    says_nothing,
)
from markermend.files.pose_stream_pace import PacedLive
from markermend.files.pose_stream_whole import STREAM, Row, WholePoses
from markermend.files.pose_table import parents_of
from markermend.poses.faults.guessing import INFERRED
from markermend.poses.pose import Pose
from markermend.poses.prior import NOT_FITTING, Prior, shipped_prior
from markermend.poses.quaternion import NO_TURN

# When a joint was not seen for so long from the beginning, it is said.
_SAID_S = 3.0
_BEGUN = "They are filled once they were seen."
_NOT_BEGUN = "Nothing is filled before the root joint and a bone are seen."


def follow(
    lines: Iterable[str],
    write: Callable[[str], None],
    *,
    rate: float | None,
    prior: Prior | None,
    warn: Callable[[str], None] = lambda sentence: None,
) -> int:
    """Clean a stream in the format of :mod:`markermend.files.pose_csv`.

    Parameters
    ----------
    lines : a header, then one row a frame and joint, the joints of a frame together
    write : called with the header, then with the rows of each pose, once its last joint has come
        (:class:`markermend.files.pose_stream_whole.WholePoses`); which joints there are, the first
        frame tells, so the first pose waits for the second
    rate : poses per second; None for as many as times of the first poses tell, or else 30
    prior : how bodies move
    warn : told, in a sentence, what is not used of the stream or of the prior, and which joints
        were not seen in the first 3 s

    Returns
    -------
    number of poses

    Raises
    ------
    FileFormatError
        when there is no header, or a row is damaged, or it is in UTF-16
    """
    telling = ((n, line) for n, line in enumerate(lines, 1) if not says_nothing(line))
    header = _header(*next(telling, (0, "")), warn)
    write(",".join(COLUMNS) + "\n")
    joints: tuple[str, ...] = ()
    paced: PacedLive | None = None
    assumed = rate or SENSOR_RATE
    told_fit = prior is None or prior is shipped_prior()
    parents: tuple[int, ...] = ()
    ever, fine = np.zeros(0, dtype=bool), False
    count, time, told_unseen = 0, -1.0 / assumed, False
    poses = WholePoses(header, assumed, warn)
    for rows in poses.of(telling):
        if not joints:
            joints, parents = _body(rows, header)
            ever = np.zeros(len(joints), dtype=bool)
        values = _values(rows, header, joints, parents)
        # Metres that are not said to be go out as they came in.
        fine = fine or (not count and too_short(values[None, :, :3], parents))
        places, turns, sure = values[:, :3], values[:, 3:7], values[:, 7]
        seen = sure > 0
        if paced is None:
            sole = Pose(places[None], turns[None], joints, parents, assumed, sure[None])
            paced = PacedLive(sole, prior, None if rate else header, warn)
        number, row = rows[0]
        frame, told = header.frame(row, number), header.time(row)
        places, turns = paced(frame, told, places, turns, seen)
        live = paced.live
        poses.come_at(paced.rate)
        seen, sure = seen[live.own] & ~live.wrong, sure[live.own]
        sure = np.where(seen | ~live.joined, sure, INFERRED)
        if live.begun and not told_fit:
            told_fit = True
            if not live.by_prior:
                warn(NOT_FITTING)
        time = told * (header.second or 1.0) if isfinite(told) else time + 1.0 / assumed
        names = [quoted(joint) for joint in joints]
        above = [names[parent] if parent >= 0 else "" for parent in parents]
        unturned = np.where((sure > 0)[:, None], 0.0, NO_TURN)
        turns = np.where(np.isnan(turns), unturned, turns)
        values = np.column_stack([places, turns, sure])
        write("".join(rows_of(frame, time, names, above, values, fine=fine)))
        count, ever = count + 1, ever | seen
        if count >= _SAID_S * paced.rate and not told_unseen and not ever.all():
            told_unseen = True
            then = _BEGUN if live.begun else _NOT_BEGUN
            warn(f"Not seen in the first {_SAID_S:g} s: {_names(joints, ~ever)}. {then}")
    if count and not told_unseen and not ever.all():
        warn(f"Never seen, and left so: {_names(joints, ~ever)}.")
    if paced is not None and not paced.live.begun:
        warn("Nothing was filled: no pose of the stream showed the root joint and a bone.")
    return count


def _header(number: int, line: str, warn: Callable[[str], None]) -> Header:
    """What the first line that says something tells; what is not used of it is said."""
    if not number:
        raise FileFormatError(f"{STREAM} is empty; it should begin with a line of column names.")
    if "\0" in line:
        raise FileFormatError(
            f"{STREAM} is text in UTF-16, as PowerShell writes it; let it be UTF-8."
        )
    header = header_of(line.rstrip("\r\n"), STREAM, number)
    if not header.unit_known:
        warn(UNKNOWN_UNIT)
    if header.others:
        warn(f"Of further columns a stream keeps nothing: {', '.join(header.others)}.")
    return header


def _names(joints: tuple[str, ...], those: BoolArray) -> str:
    """Some of the joints, in words."""
    return ", ".join(joint for joint, one in zip(joints, those, strict=True) if one)


def _body(rows: list[Row], header: Header) -> tuple[tuple[str, ...], tuple[int, ...]]:
    """Joints and parents as the first pose tells them."""
    joints = tuple(dict.fromkeys(header.joint(row, number) for number, row in rows))
    for number, row in rows:
        parent = row[header.at["parent"]].strip() if "parent" in header.at else ""
        if parent and parent not in joints:
            raise FileFormatError(
                f"{STREAM} is damaged: line {number} hangs “{header.joint(row, number)}” on"
                f" “{parent}”, which its first pose does not have; that must name every joint."
            )
    return joints, parents_of([row for _, row in rows], header.at, joints, STREAM)


def _values(
    rows: list[Row], header: Header, joints: tuple[str, ...], parents: tuple[int, ...]
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
