"""Rows of a table of joints, checked one by one, of files and of streams alike."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, replace
from math import isfinite, nan

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import FileFormatError
from markermend.files.plausible import FARTHEST
from markermend.files.units import unit_mm, unit_s

COLUMNS = ("frame", "time", "joint", "parent", "x", "y", "z", "qx", "qy", "qz", "qw", "confidence")
NUMBERS = COLUMNS[4:]
_ROTATION = COLUMNS[7:11]
_WITH_UNIT = ("time", "x", "y", "z")
_DELIMITERS = ",;\t"
_BLANKS = _DELIMITERS + " \r\n"
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
    # As Goncalves and others (2024) call them.
    **{f"t{axis}": axis for axis in "xyz"},
    **{f"r{axis}": f"q{axis}" for axis in "xyzw"},
    "rotationx": "qx",
    "rotationy": "qy",
    "rotationz": "qz",
    "rotationw": "qw",
    "quatx": "qx",
    "quaty": "qy",
    "quatz": "qz",
    "quatw": "qw",
    "rotx": "qx",
    "roty": "qy",
    "rotz": "qz",
    "rotw": "qw",
    "orientationx": "qx",
    "orientationy": "qy",
    "orientationz": "qz",
    "orientationw": "qw",
    "trackingstate": "confidence",
    "confidencelevel": "confidence",
    "visibility": "confidence",
}
# Blank cells, and what spreadsheets and compilers write for no number.
_BLANK = frozenset(("", "na", "n/a", "null", "none", "-", "nan", "-nan", "nan(ind)", "-nan(ind)"))
_BLANK |= {"#n/a", "#num!", "#value!", "#div/0!", "#null!", "1.#qnan", "1.#ind", "-1.#ind"}
# As the programs of Kinects write it, the Azure's behind ``K4ABT_JOINT_CONFIDENCE_``.
_TRACKED = {"tracked": 1.0, "inferred": 0.5, "nottracked": 0.0}
_TRACKED |= {"none": 0.0, "low": 0.5, "medium": 1.0, "high": 1.0}
_MOST_FRAMES = 2.0**53
_MILLIMETRES = (1.0, 1.0, 1.0)
UNKNOWN_UNIT = "The columns tell no unit of length that is known; millimetres were assumed."


@dataclass(frozen=True)
class Header:
    """The first line of a table.

    Attributes
    ----------
    name : of the file, for what is wrong with it
    at : place of each known column
    width : number of columns
    delimiter : between cells
    scales : mm in the units of x, y and z
    unit_known : those that the line tells are
    unit_told : the line tells any
    second : seconds in the unit of time, where the line tells
    others_at : names of columns that are not known, and their places
    first, step : number of the file's first frame, and from one to the next
    sure : confidence that means seen for sure, with the file's numbers
    """

    name: str
    at: dict[str, int]
    width: int
    delimiter: str
    scales: tuple[float, ...] = _MILLIMETRES
    unit_known: bool = True
    unit_told: bool = True
    second: float | None = None
    others_at: tuple[tuple[str, int], ...] = ()
    first: int = 0
    step: int = 1
    sure: float = 1.0

    @property
    def others(self) -> tuple[str, ...]:
        """Names of columns that are not known."""
        return tuple(name for name, _ in self.others_at)

    def in_units_of(self, mm: float) -> Header:
        """The same in another unit, where a line tells none."""
        return replace(self, scales=(mm,) * 3)

    def cells(self, line: str, number: int) -> list[str]:
        """Cells of a line; fewer than there are columns where it is cut short.

        Raises
        ------
        FileFormatError
            when a quote stays open, or more cells say something than there are columns
        """
        row = cells_of(line, self.delimiter, self.name, number)
        if len(row) > self.width and any(cell.strip() for cell in row[self.width :]):
            raise FileFormatError(
                f"{self.name} is damaged: line {number} has {len(row)} cells, the header"
                f" {self.width}."
            )
        return row

    def frame(self, row: list[str], number: int) -> int:
        """Number of the frame that a row belongs to, as if they were counted one by one.

        Raises
        ------
        FileFormatError
            when it is no whole number, or of no frame in steps from the first
        """
        cell = row[self.at["frame"]]
        value = plain(cell, self.delimiter)
        if not isfinite(value) or value != int(value) or abs(value) > _MOST_FRAMES:
            raise FileFormatError(
                f"{self.name} is damaged: “{cell[:40]}” in line {number} is no frame number."
            )
        steps, rest = divmod(int(value) - self.first, self.step)
        if rest:
            raise FileFormatError(
                f"{self.name} is damaged: “{cell[:40]}” in line {number} is no frame number."
            )
        return self.first + steps

    def stated(self, frame: int) -> int:
        """Number that the file gives to a frame counted one by one."""
        return self.first + (frame - self.first) * self.step

    def joint(self, row: list[str], number: int) -> str:
        """Name of the joint that a row is about.

        Raises
        ------
        FileFormatError
            when it has none
        """
        name = row[self.at["joint"]].strip()
        if not name:
            raise FileFormatError(f"{self.name} is damaged: line {number} names no joint.")
        return name

    def time(self, row: list[str]) -> float:
        """Seconds; NaN where the row has none, or not as a number."""
        return plain(row[self.at["time"]], self.delimiter) if "time" in self.at else nan

    def values(self, row: list[str], number: int) -> list[float]:
        """Position in mm, rotation and confidence of a row; NaN where it has none.

        Raises
        ------
        FileFormatError
            when a cell says something that is no number
        """
        found = [nan] * len(NUMBERS)
        for i, column in enumerate(NUMBERS):
            if column not in self.at:
                continue
            cell = row[self.at[column]]
            try:
                found[i] = float(cell)
            except ValueError:
                found[i] = plain(cell, self.delimiter)
                if found[i] == found[i] or is_blank(cell):
                    continue
                word = letters_of(cell).removeprefix("kabtjointconfidence")
                if column != "confidence" or word not in _TRACKED:
                    raise FileFormatError(
                        f"{self.name} is damaged: line {number} says “{cell[:40]}” where {column}"
                        " should be a number."
                    ) from None
                found[i] = _TRACKED[word]
        if self.sure != 1.0:
            found[-1] = min(found[-1] / self.sure, 1.0)
        if self.scales != _MILLIMETRES:
            found[:3] = [value * mm for value, mm in zip(found, self.scales, strict=False)]
        return found


def is_blank(cell: str) -> bool:
    """Whether a cell says nothing, or that there is nothing."""
    return cell.strip().lower() in _BLANK


def cells_of(line: str, delimiter: str, name: str, number: int = 1) -> list[str]:
    """Cells of a line.

    Raises
    ------
    FileFormatError
        when a quote stays open, or a cell is endless
    """
    if '"' not in line:
        return line.split(delimiter)
    if line.count('"') % 2:
        raise FileFormatError(
            f'{name} is damaged: line {number} opens a quote (") that it does not close.'
        )
    try:
        return next(csv.reader([line], delimiter=delimiter))
    except csv.Error as error:
        raise FileFormatError(
            f"{name} is damaged: line {number} does not read as cells of a table."
        ) from error


def header_of(line: str, name: str, number: int = 1) -> Header:
    """Read the line that names the columns, which stand in any order, and their units of length.

    Parameters
    ----------
    line : the first that says something
    name : of the file, for what is wrong with it
    number : of the line

    Raises
    ------
    FileFormatError
        when a column is missing that every table of joints has
    """
    delimiter = max(_DELIMITERS, key=line.count)
    head = cells_of(line, delimiter, name, number)
    told = [_column(cell) for cell in head]
    names = [column for column, _ in told]
    twice = next((axis for axis in "xyz" if names.count(axis) > 1), None)
    if twice is not None:
        raise FileFormatError(
            f"{name} has two columns “{twice}”, of which one may tell how joints are turned; call"
            f" that q{twice}."
        )
    at: dict[str, int] = {}
    for i, column in enumerate(names):
        known = _known_as(column)
        if known == column or known not in at:
            at[known] = i
    if any(part not in at for part in _ROTATION):
        # Without all four they are no quaternion, as angles are not.
        at = {column: i for column, i in at.items() if column not in _ROTATION}
    missing = [column for column in ("frame", "joint", "x", "y", "z") if column not in at]
    if missing:
        raise FileFormatError(
            f"{name} is no table of joints: it lacks the column “{missing[0]}”; it should have"
            f" {', '.join(COLUMNS)}."
        )
    units = [told[at[axis]][1] for axis in "xyz"]
    scales = [unit_mm(unit) if unit else 1.0 for unit in units]
    places = {at[column] for column in COLUMNS if column in at}
    return Header(
        name,
        at,
        len(head),
        delimiter,
        tuple(1.0 if mm is None else mm for mm in scales),
        None not in scales,
        any(units),
        unit_s(told[at["time"]][1]) if "time" in at else None,
        tuple((cell.strip(), i) for i, cell in enumerate(head) if i not in places),
    )


def _column(cell: str) -> tuple[str, str]:
    """Letters of a column's name, and the unit behind it: ``x (m)``, ``time [ms]``, ``time_us``."""
    bracket = re.search(r"[\[(]\s*(\w*)", cell)
    if bracket:
        return letters_of(cell[: bracket.start()]), bracket[1]
    front, _, unit = cell.strip().rpartition("_")
    column = letters_of(front)
    known = unit_s if _known_as(column) == "time" else unit_mm
    if _known_as(column) in _WITH_UNIT and known(unit) is not None:
        return column, unit
    return letters_of(cell), ""


def _known_as(column: str) -> str:
    """The usual name of a column."""
    return _OTHER_NAMES.get(column, column)


def names_joints(head: bytes) -> bool:
    """Whether the first bytes of a file are the header of such a table, if one that lacks frames.

    What it lacks is told when it is read.
    """
    lines = head.decode("utf-8-sig", errors="replace").splitlines()
    line = next((line for line in lines if not says_nothing(line)), "")
    try:
        cells = cells_of(line, max(_DELIMITERS, key=line.count), "")
    except FileFormatError:
        return False
    return {"joint", "x", "y", "z"} <= {_known_as(_column(cell)[0]) for cell in cells}


def letters_of(name: str) -> str:
    """The letters of a name, small."""
    return re.sub(r"[^a-z]", "", name.lower())


def whole_rows(
    lines: list[tuple[int, str]], header: Header
) -> tuple[list[tuple[int, list[str]]], list[str]]:
    """Rows that have all their cells; a last one that is cut short is left out, and said.

    Parameters
    ----------
    lines : number and text of each that says something, but for the header
    header : of these

    Raises
    ------
    FileFormatError
        when another is cut short, or there is none
    """
    rows, warnings = list[tuple[int, list[str]]](), list[str]()
    for number, line in lines:
        last = number == lines[-1][0]
        row = [] if last and line.count('"') % 2 else header.cells(line, number)
        if len(row) >= header.width:
            rows.append((number, row))
        elif last:
            warnings.append("The file is cut short; its last row was left out.")
        else:
            raise FileFormatError(
                f"{header.name} is damaged: line {number} has {len(row)} cells, the header"
                f" {header.width}."
            )
    if not rows:
        raise FileFormatError(f"{header.name} holds no whole row.")
    return rows, warnings


def says_nothing(line: str) -> bool:
    """Whether a line is blank, has blank cells only, is a comment, or tells Excel the delimiter."""
    return not line.strip(_BLANKS) or line.startswith(("#", "sep="))


def measured(values: FloatArray) -> BoolArray:
    """(...) bool, whether numbers (..., 8) of rows are a place, and of a room."""
    there = np.isfinite(values[..., :3]).all(axis=-1)
    return np.asarray(there & ~wild(values))


def wild(values: FloatArray) -> BoolArray:
    """(...) bool, whether numbers (..., 8) of rows are farther out than any room."""
    return np.asarray((np.abs(values) > FARTHEST).any(axis=-1))


def plain(cell: str, delimiter: str) -> float:
    """Value of a cell, with a decimal comma where commas do not stand between cells; else NaN."""
    try:
        return float(cell)
    except ValueError:
        pass
    try:
        return nan if delimiter == "," else float(cell.replace(",", "."))
    except ValueError:
        return nan
