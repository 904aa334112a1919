"""Write a table of joints over the file it came from: rows that do not change stay as they are."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import FileFormatError
from markermend.files.pose_rows import NUMBERS, Header, says_nothing
from markermend.progress import Progress

_ROWS_A_REPORT = 4096
_WRITTEN = ("{:.3f}",) * 3 + ("{:.6f}",) * 4 + ("{:.3g}",)


def patched(
    path: Path,
    header: Header,
    joints: Sequence[str],
    there: FloatArray,
    values: FloatArray,
    changed: BoolArray,
    progress: Progress,
) -> bytes | None:
    """A table's file with other numbers where these are to be others.

    Comments, further columns, endings of lines and every cell that is not changed stay the same
    bytes.

    Parameters
    ----------
    path : the file, as it was when it was read
    header : its first line, with all columns
    joints : names of the columns of what follows
    there : (frames, joints, numbers) what the file says, NaN where it has no number
    values : (frames, joints, numbers) what it shall say
    changed : (frames, joints, numbers) bool, where that is something else
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
    places = [i for i, line in enumerate(lines) if not says_nothing(line)][1:]
    try:
        rows = {i: header.cells(lines[i].rstrip("\r\n"), i + 1) for i in places}
        if any(len(row) < header.width for row in rows.values()):
            return None
        frames = [header.frame(row, i + 1) for i, row in rows.items()]
        numbers = [header.values(row, i + 1) for i, row in rows.items()]
        index = {joint: n for n, joint in enumerate(joints)}
        columns = [index[header.joint(row, i + 1)] for i, row in rows.items()]
    except (FileFormatError, KeyError):
        return None
    first, missed = min(frames, default=0), np.asarray(changed.any(axis=2))
    if max(frames, default=0) - first >= len(values):
        return None
    for n, ((i, row), frame, column) in enumerate(zip(rows.items(), frames, columns, strict=True)):
        if n % _ROWS_A_REPORT == 0:
            progress(n / len(rows), "Writing poses")
        here = frame - first, column
        if not np.array_equal(numbers[n], there[here], equal_nan=True):
            return None
        missed[here] = False
        # A row may stand twice.
        for k in np.flatnonzero(changed[here]).tolist():
            row[header.at[NUMBERS[k]]] = _WRITTEN[k].format(values[here][k])
        if changed[here].any():
            cells = header.delimiter.join(_cell(cell, header.delimiter) for cell in row)
            lines[i] = cells + _ending(lines[i])
    return None if missed.any() else "".join(lines).encode(code)


def _encoding(raw: bytes) -> str:
    """How a text's letters are written, as its reader takes them."""
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        return "latin-1"
    return "utf-8"


def _cell(text: str, delimiter: str) -> str:
    """A cell, in quotes where it needs them."""
    return '"' + text.replace('"', '""') + '"' if '"' in text or delimiter in text else text


def _ending(line: str) -> str:
    """How a line ends."""
    return line[len(line.rstrip("\r\n")) :]
