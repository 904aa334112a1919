"""Write a table of joints over the file it came from: rows that do not change stay as they are."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.files.text import number
from markermend.progress import Progress

_BYTE_ORDER_MARK = "\ufeff"
_ROWS_A_REPORT = 4096
_WRITTEN = ("{:.3f}",) * 3 + ("{:.6f}",) * 4 + ("{:.3g}",)


def patched(
    path: Path,
    joints: Sequence[str],
    there: FloatArray,
    values: FloatArray,
    changed: BoolArray,
    at: Mapping[str, int],
    numbers: Sequence[str],
    progress: Progress,
) -> bytes | None:
    """A table's file with other numbers where these are to be others.

    Comments, further columns, endings of lines and every cell that is not changed stay the same
    bytes.

    Parameters
    ----------
    path : the file, as it was when it was read
    joints : names of the columns of what follows
    there : (frames, joints, numbers) what the file says, NaN where it has no number
    values : (frames, joints, numbers) what it shall say
    changed : (frames, joints, numbers) bool, where that is something else
    at : place of each column in the file, with all of the ``numbers``
    numbers : names of the columns that hold the last axis
    progress : told the share of rows written; may raise to stop

    Returns
    -------
    The file's content; None where the file is not there any more, says something else now, or has
    not the rows that are needed
    """
    try:
        raw = path.read_bytes()
    except OSError:
        return None
    code = _encoding(raw)
    lines = [line.decode(code) for line in raw.splitlines(keepends=True)]
    is_row = [bool(line.strip()) and not line.startswith("#") for line in lines]
    places = [i for i, row in enumerate(is_row) if row]
    delimiter = max(",;\t", key=lines[places[0]].count)
    rows = {i: _cells(lines[i], delimiter) for i in places[1:]}
    if any(len(row) <= max(at.values()) for row in rows.values()):
        return None
    index = {joint: i for i, joint in enumerate(joints)}
    try:
        frames = [int(float(row[at["frame"]])) for row in rows.values()]
        columns = [index[row[at["joint"]].strip()] for row in rows.values()]
    except (ValueError, KeyError, OverflowError):
        return None
    first, missed = min(frames), np.asarray(changed.any(axis=2))
    if max(frames) - first >= len(values):
        return None
    for n, ((i, row), frame, column) in enumerate(zip(rows.items(), frames, columns, strict=True)):
        if n % _ROWS_A_REPORT == 0:
            progress(n / len(rows), "Writing poses")
        here = frame - first, column
        read = [number(row[at[name]]) for name in numbers]
        if not np.array_equal(read, there[here], equal_nan=True):
            return None
        if not missed[here]:
            continue
        missed[here] = False
        for k in np.flatnonzero(changed[here]).tolist():
            row[at[numbers[k]]] = _WRITTEN[k].format(values[here][k])
        lines[i] = delimiter.join(_cell(c, delimiter) for c in row) + _ending(lines[i])
    return None if missed.any() else "".join(lines).encode(code)


def _encoding(raw: bytes) -> str:
    """How a text's letters are written, as its reader takes them."""
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        return "latin-1"
    return "utf-8"


def _cells(line: str, delimiter: str) -> list[str]:
    """Cells of a row, with blanks as they are."""
    bare = line.rstrip("\r\n")
    return next(csv.reader([bare], delimiter=delimiter)) if '"' in bare else bare.split(delimiter)


def _cell(text: str, delimiter: str) -> str:
    """A cell, in quotes where it needs them."""
    return '"' + text.replace('"', '""') + '"' if '"' in text or delimiter in text else text


def _ending(line: str) -> str:
    """How a line ends."""
    return line[len(line.rstrip("\r\n")) :]
