"""Read and write markers as comma-separated values, one row a frame.

The columns are ``frame``, ``time`` in seconds, and ``LABEL.x (mm)``, ``LABEL.y (mm)``,
``LABEL.z (mm)`` for each marker; a missing sample is three blank cells. When reading, frame and
time may be absent, semicolons or tabs may separate, and ``LABEL_X``, ``LABEL:x`` or ``LABEL x`` do
as well.
"""

from __future__ import annotations

import csv
import os
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from types import MappingProxyType
from typing import IO

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.encoding import utf8
from markermend.errors import ExportError, FileFormatError
from markermend.files.labels import check_kept, unique_labels
from markermend.files.text import (
    check_width,
    frames_of_rows,
    lines_of,
    mark_missing,
    numbers,
    read_lines,
)
from markermend.files.units import unit_mm
from markermend.progress import Progress, quiet
from markermend.take import AXES, Source, Take

_ROWS_A_REPORT = 4096
_COLUMN = re.compile(
    r"^(?P<label>.+?)\s*[._:/-]?\s*(?P<axis>[xyzXYZ])\s*(?:[\[(](?P<unit>\w+)[\])])?$"
)
_FRAME = re.compile(r"^frame( ?(#|number|no\.?))?$", re.IGNORECASE)
_TIME = re.compile(r"^time(stamp)?(_s| ?[\[(](s|sec|seconds)[\])])?$", re.IGNORECASE)


def read_csv(path: Path, *, progress: Progress | None = None) -> Take:
    """Read a table of marker positions.

    Parameters
    ----------
    path : the file
    progress : told the share of rows read

    Returns
    -------
    Take
        positions in mm; a sample is missing where a cell is blank or no number, all are zero, or
        frame numbers or times tell that a row is missing

    Raises
    ------
    FileFormatError
        when no marker has all three coordinates, or there is no row
    """
    status = os.stat(path)
    lines = [line for line in read_lines(path) if line.strip() and not line.startswith("#")]
    if not lines:
        raise FileFormatError(f"{path.name} is empty.")
    names, delimiter = _names_in(lines[0])
    stated, columns, unit = _markers(names, path.name)
    labels, repeated = unique_labels(stated, len(stated))
    report, warnings = progress or quiet, []
    again = [name for name, times in Counter(names).items() if name and times > 1]
    if again:
        warnings.append(f"Of columns that stand more than once the first was read: {again[0]}.")
    if repeated:
        warnings.append(f"Labels that occur more than once were numbered: {', '.join(repeated)}.")
    rows = lines[1:]
    if not rows:
        raise FileFormatError(f"{path.name} is cut short: no frame follows its header.")
    # A decimal comma can only stand in a table that something else separates.
    comma = delimiter != "," and any("," in row for row in rows[:100])
    check_width(len(rows), len(names), status.st_size, path.name)
    table, strange = np.empty((len(rows), len(names))), 0
    for i, row in enumerate(rows):
        if i % _ROWS_A_REPORT == 0:
            report(i / len(rows), "Reading rows")
        cells = (row.replace(",", ".") if comma else row).split(delimiter)
        strange += numbers(cells, table[i])
    if strange:
        warnings.append(f"{strange} cells that are no numbers were read as missing.")
    found = (_column(names, pattern) for pattern in (_FRAME, _TIME))
    told = [table[:, at] for at in found if at is not None]
    frames, even = frames_of_rows(len(rows), *told, warnings=warnings)
    positions = np.full((frames[-1] + 1, len(labels), 3), np.nan)
    positions[frames] = table[:, columns].reshape(len(rows), len(labels), 3)
    zeros = mark_missing(positions)
    if zeros:
        warnings.append(f"{zeros} samples at exactly (0, 0, 0) were read as missing.")
    scale = unit_mm(unit)
    if scale is None:
        scale = 1.0
        warnings.append(
            "The columns tell no unit of length that is known; millimetres were assumed."
        )
    positions *= scale
    return Take(
        positions=positions,
        labels=labels,
        rate=_rate(names, table, frames if even else None, warnings),
        first_frame=_first_frame(names, table),
        source=Source(path.absolute(), "csv", status.st_size, status.st_mtime_ns, scale_mm=scale),
        warnings=tuple(warnings),
        info=MappingProxyType({"units": unit, "storage": "text"}),
    )


def write_csv(take: Take, file: IO[bytes], progress: Progress, *, before: int = 0) -> None:
    """Write the markers of a take as a table in mm, to the nanometre.

    Parameters
    ----------
    take : the recording
    file : written from its beginning
    progress : told the share of frames written
    before : frames between time 0 and the first one

    Raises
    ------
    ExportError
        when there are no markers, or the name of one would not come back when the file is read
    """
    if not take.markers:
        raise ExportError("A CSV holds nothing but markers, and this take has none.")
    check_kept(take.labels, _names_read, "CSV")
    file.write(utf8(_names_line(take.labels) + "\n"))
    for frame in range(take.frames):
        if frame % _ROWS_A_REPORT == 0:
            progress(frame / take.frames, "Writing rows")
        row = take.positions[frame].reshape(-1).tolist()
        cells = ",".join("" if v != v else f"{v:.6f}" for v in row)
        time = f"{(before + frame) / take.rate:.9f}"
        file.write(f"{take.frame_number(frame)},{time},{cells}\n".encode())


def _names_line(labels: Sequence[str]) -> str:
    """The first line: the name of every column."""
    quoted = (_quoted(f"{label}.{axis} (mm)") for label in labels for axis in AXES)
    return ",".join(["frame", "time", *quoted])


def _names_read(labels: Sequence[str]) -> list[str]:
    """Names that are read from the line written for these."""
    return _markers(_names_in(lines_of(utf8(_names_line(labels)), "")[0])[0], "")[0]


def _names_in(line: str) -> tuple[list[str], str]:
    """Names of the columns in a table's first line, and what separates them."""
    delimiter = max(",;\t", key=line.count)
    try:
        cells = next(csv.reader([line], delimiter=delimiter))
    except csv.Error as error:
        raise FileFormatError(f"The first line is no list of columns: {error}.") from error
    return [cell.strip() for cell in cells], delimiter


def _quoted(name: str) -> str:
    """Put a name in quotation marks where it needs them."""
    return '"' + name.replace('"', '""') + '"' if set(name) & set(',"\n') else name


def _markers(names: list[str], file: str) -> tuple[list[str], list[int], str]:
    """Labels, the columns of their coordinates in order, and the unit."""
    found: dict[str, dict[str, int]] = {}
    units: list[str] = []
    for place, name in enumerate(names):
        match = _COLUMN.match(name)
        if match is None or _FRAME.match(name) or _TIME.match(name):
            continue
        axes = found.setdefault(match["label"], {})
        axes.setdefault(match["axis"].lower(), place)
        units.append(match["unit"] or "")
    whole = {label: axes for label, axes in found.items() if len(axes) == 3}
    if not whole:
        raise FileFormatError(
            f"{file} has no marker with three coordinates: columns are called like “LASI.x”,"
            " “LASI.y”, “LASI.z”."
        )
    columns = [axes[axis] for axes in whole.values() for axis in AXES]
    return list(whole), columns, next((unit for unit in units if unit), "")


def _column(names: list[str], pattern: re.Pattern[str]) -> int | None:
    """Place of the first column whose name fits."""
    return next((i for i, name in enumerate(names) if pattern.match(name)), None)


def _first_frame(names: list[str], table: FloatArray) -> int:
    """Number of the first row, 1 where the table does not tell."""
    place = _column(names, _FRAME)
    first = table[0, place] if place is not None else 1.0
    return int(first) if np.isfinite(first) else 1


def _rate(
    names: list[str], table: FloatArray, frames: IntArray | None, warnings: list[str]
) -> float:
    """Frames per second by the times, or 100 where there are none; ``frames`` of rows if known."""
    place = _column(names, _TIME)
    if place is not None and len(table) > 1:
        times = table[:, place]
        span, count = (
            (np.median(np.diff(times)), 1) if frames is None else (times[-1] - times[0], frames[-1])
        )
        if np.isfinite(span) and span > 0:
            return float(round(count / span, 5))
    alone = place is not None and len(table) == 1
    lacks = "one row, which tells no rate" if alone else "no times"
    warnings.append(f"The table has {lacks}; 100 Hz was assumed.")
    return 100.0
