"""What the readers of text files share."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import FileFormatError

# Beyond it neighbouring frame numbers are one float64.
_LARGEST_NUMBER = 2.0**53
MISSING_ROWS = "Rows are missing (places: {0}); those that are there were read one after the other."


def read_lines(path: Path) -> list[str]:
    """Lines of a text file without their endings, whatever these are.

    Raises
    ------
    FileFormatError
        when the file is not text
    """
    raw = path.read_bytes()
    if b"\0" in raw:
        raise FileFormatError(f"{path.name} is not a text file.")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def number(cell: str) -> float:
    """Value of a cell; NaN where it is blank or no number."""
    try:
        return float(cell)
    except ValueError:
        return math.nan


def numbers(cells: list[str], out: FloatArray) -> int:
    """Fill a row from its cells, NaN where they end or are blank; count those that are no number.

    A cell that reads ``NaN`` in any spelling, or has blanks around it, is a number.
    """
    cells = cells[: len(out)]
    out[len(cells) :] = np.nan
    try:
        out[: len(cells)] = [float(cell) for cell in cells]
    except ValueError:
        out[: len(cells)] = [number(cell) for cell in cells]
        return sum(1 for cell in cells if cell.strip() and not _is_number(cell))
    return 0


def missing_rows(*columns: FloatArray) -> int:
    """Between how many rows of a table others are missing, by the first column that tells.

    Parameters
    ----------
    columns : (rows,) frame numbers, times…, which grow evenly where nothing is missing; NaN where
        there is no number

    Returns
    -------
    number of rows that follow the one before too late, or lie before it; 0 where nothing tells,
    as times that were rounded to more than a frame
    """
    for column in columns:
        if len(column) < 2 or not (np.abs(column) < _LARGEST_NUMBER).all():
            continue
        steps = np.diff(column)
        if (steps == 0).mean() > 0.1:
            continue
        usual = np.median(steps)
        if usual > 0:
            return int(np.count_nonzero((steps > 1.5 * usual) | (steps < 0)))
    return 0


def check_width(rows: int, columns: int, size: int, name: str) -> None:
    """Refuse a table whose header claims more cells than its file has room for.

    Parameters
    ----------
    rows, columns : of the table
    size : of the file in bytes
    name : of the file

    Raises
    ------
    FileFormatError
        when each cell would have less than a quarter of a byte
    """
    # Cells that are blank to a row's end may be left out, so some rows are shorter than others.
    if rows * columns > 4 * size + (1 << 16):
        raise FileFormatError(
            f"{name} is damaged: its header tells of {columns} columns, its rows have far fewer."
        )


def _is_number(cell: str) -> bool:
    """Whether a cell can be read as a number."""
    try:
        float(cell)
    except ValueError:
        return False
    return True


def mark_missing(positions: FloatArray) -> int:
    """Make samples missing, in place, that are incomplete, infinite or exactly zero.

    Parameters
    ----------
    positions : (frames, markers, 3) float64

    Returns
    -------
    number of samples that were exactly (0, 0, 0)
    """
    zero = (positions == 0).all(axis=2)
    positions[zero | ~np.isfinite(positions).all(axis=2)] = np.nan
    return int(np.count_nonzero(zero))
