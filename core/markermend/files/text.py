"""What the readers of text files share."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.errors import FileFormatError

# Beyond it neighbouring frame numbers are one float64.
_LARGEST_NUMBER = 2.0**53
# A number that went astray must not make a take of millions of empty frames.
_MOST_FRAMES_A_ROW = 10


def read_lines(path: Path) -> list[str]:
    """Lines of a text file without their endings, whatever these are.

    Raises
    ------
    FileFormatError
        when the file is not text
    """
    return lines_of(path.read_bytes(), path.name)


def lines_of(raw: bytes, name: str) -> list[str]:
    """Lines of the contents of a text file, as :func:`read_lines` has them.

    Raises
    ------
    FileFormatError
        when they are not text, or in an encoding of two bytes a letter
    """
    refuse_utf_16(raw, name)
    if b"\0" in raw:
        raise FileFormatError(f"{name} is not a text file.")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def refuse_utf_16(raw: bytes, name: str) -> None:
    """Refuse contents of a file, or their beginning, in two bytes a letter.

    Raises
    ------
    FileFormatError
        when they are
    """
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise FileFormatError(
            f"{name} is text in UTF-16, as PowerShell and Excel write it; save it as UTF-8."
        )


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


def frames_of_rows(rows: int, *columns: FloatArray, warnings: list[str]) -> tuple[IntArray, bool]:
    """Frame that each row of a table belongs to, where rows that are missing leave theirs empty.

    Parameters
    ----------
    rows : how many there are
    columns : (rows,) frame numbers, times…, which grow evenly where nothing is missing; NaN where
        there is no number. The first that tells is believed; times that were rounded to about a
        frame do not tell
    warnings : told what is missing

    Returns
    -------
    (rows,) frames, growing from 0, and whether they follow the column that tells: they do not where
    rows are out of order, or more is missing than a take would be without
    """
    one_by_one = np.arange(rows)
    for column in columns:
        if rows < 2 or not (np.abs(column) < _LARGEST_NUMBER).all():
            continue
        steps = np.diff(column)
        usual = np.median(steps)
        if (steps == 0).mean() > 0.1 or usual <= 0:
            continue
        late = steps - _rounding(column) > 1.5 * usual
        if not late.any() and not (steps < 0).any():
            return one_by_one, True
        apart = np.where(late, np.round(steps / usual), 1.0)
        frames = np.concatenate([[0.0], np.cumsum(apart)])
        if (steps < 0).any() or frames[-1] > _MOST_FRAMES_A_ROW * rows:
            warnings.append(
                "Rows are out of order, or very many are missing (after row"
                f" {int(np.flatnonzero(late | (steps < 0))[0]) + 1}, for one); those that are there"
                " were read one after the other."
            )
            return one_by_one, False
        missing = int(frames[-1]) + 1 - rows
        warnings.append(f"{missing} rows are missing; their frames were read as gaps.")
        return frames.astype(np.int64), True
    return one_by_one, True


def _rounding(column: FloatArray) -> float:
    """How far a step between two rows may be off for the digits its column is written with."""
    if (column == np.round(column)).all():
        return 0.0
    digits = next((d for d in range(1, 9) if np.allclose(column, np.round(column, d), 0, 1e-9)), 9)
    return float(10.0**-digits)


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
