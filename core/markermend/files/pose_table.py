"""What the rows of a table of joints tell together: its frames, and which joint hangs on which."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from math import gcd

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import FileFormatError
from markermend.files.pose_rows import Header, is_blank, letters_of
from markermend.poses.nuitrack import usual_parents

# So many numbers tell whether frames are counted one by one.
_TELL_STEPS = 3
_SURE_LEVEL, _TOP_LEVEL, _PERCENT = 2.0, 3.0, 100.0
# So large a share of what was seen must have the level of what is sure: one stray 2 tells nothing.
_LEAST_SURE = 0.02
# Percents go up to more; networks that tell shares go beyond 1 at times, but not so far.
_LEAST_PERCENT = 10.0
# As columns are called that tell several bodies apart.
_BODIES = frozenset(
    f"{body}{number}"
    for body in ("body", "user", "skeleton", "person", "subject", "player", "actor", "tracking")
    for number in ("", "id", "index", "number", "name")
) | {"id"}
# The parent of a root where parents are told by their number.
_NO_INDEX = "-1"


def frames_of(
    body: list[tuple[int, list[str]]], header: Header, joints: int
) -> tuple[Header, list[int], int]:
    """What frames rows are of.

    Parameters
    ----------
    body : number and cells of each row
    header : of the table
    joints : how many there are

    Returns
    -------
    The header, which now tells how frames are numbered; each row's frame, from 0; and how many
    there are

    Raises
    ------
    FileFormatError
        when a number is none of a frame, or too far off
    """
    stated = [header.frame(row, number) for number, row in body]
    first, last = min(stated), max(stated)
    there = {frame - first for frame in stated}
    step = step_of(there)
    count = (last - first) // step + 1
    # One stray number must not ask for a terabyte.
    if count * joints > 100 * len(body) + 1000:
        raise FileFormatError(
            f"{header.name} is damaged: its frames go from {first} to {last}, with {len(body)}"
            " rows."
        )
    header = replace(header, first=first, step=step)
    return header, [(frame - first) // step for frame in stated], count


def step_of(numbers: Collection[int]) -> int:
    """From one number of a frame to the next, by those of a table, counted from its first.

    Whoever keeps every second or tenth pose leaves the others no number.
    """
    return gcd(*numbers) if len(numbers) >= _TELL_STEPS else 1


def twice(
    body: list[tuple[int, list[str]]], frame: list[int], names: list[str], header: Header
) -> list[str]:
    """A sentence about rows that stand twice.

    Parameters
    ----------
    body : number and cells of each row
    frame, names : of each row
    header : of the table

    Raises
    ------
    FileFormatError
        when two say different things, or are of two bodies
    """
    first: dict[tuple[int, str], int] = {}
    again = []
    for n, key in enumerate(zip(frame, names, strict=True)):
        before = first.setdefault(key, n)
        if before == n:
            continue
        again.append(body[n][0])
        if body[before][1] != body[n][1]:
            for column, i in header.others_at:
                if letters_of(column) in _BODIES and body[before][1][i] != body[n][1][i]:
                    raise FileFormatError(
                        f"{header.name} tells of several bodies (column “{column}”); write one of"
                        " them into a file."
                    )
            raise FileFormatError(
                f"{header.name} is damaged: lines {body[before][0]} and {body[n][0]} both tell of"
                f" “{key[1]}” in one frame, and differ."
            )
    if not again:
        return []
    return [f"{len(again)} rows stand twice, line {again[0]} for one; they were read once."]


def surest(confidence: FloatArray) -> float:
    """Which number means seen for sure: 1, or what levels and percents have instead.

    Parameters
    ----------
    confidence : as a file has it, NaN where it has none; the levels of Kinects are 0, 1 (inferred,
        or low), 2 and, of the Azure, 3
    """
    seen = confidence[(confidence > 0) & np.isfinite(confidence)]
    most = float(seen.max(initial=0.0))
    if 1.0 < most <= _TOP_LEVEL and not (seen % 1.0).any():
        return _SURE_LEVEL if np.mean(seen >= _SURE_LEVEL) >= _LEAST_SURE else 1.0
    # Most of percents are more than 1; most of shares are not, whatever strays among them.
    return _PERCENT if _LEAST_PERCENT < most <= _PERCENT and np.median(seen) > 1.0 else 1.0


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
        for joint, parent in above.items():
            if parent not in joints and (is_blank(parent) or parent == _NO_INDEX):
                above[joint] = ""
    else:
        above = usual_parents(joints)
        unknown = [joint for joint in joints if joint not in above]
        if unknown:
            raise FileFormatError(
                f"{name} does not say what “{unknown[0]}” hangs on; add a column “parent”."
            )
    lost = [parent for parent in above.values() if parent and parent not in joints]
    if lost:
        raise FileFormatError(f"{name} is damaged: the parent “{lost[0]}” is no joint of it.")
    return tuple(joints.index(above[joint]) if above[joint] else -1 for joint in joints)
