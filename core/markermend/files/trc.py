"""Read and write TRC, the marker files of OpenSim and of Motion Analysis.

Five lines of header, tabs between columns, a row a frame: number, time, and x, y, z of each
marker. The dialects differ in blank or ``NaN`` cells for missing markers, in trailing tabs, in
spaces around numbers and in line endings; all are read.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path
from types import MappingProxyType
from typing import IO

import numpy as np

from markermend.encoding import utf8
from markermend.errors import ExportError, FileFormatError
from markermend.files.labels import check_kept, unique_labels
from markermend.files.text import (
    check_width,
    frames_of_rows,
    lines_of,
    mark_missing,
    number,
    numbers,
    read_lines,
)
from markermend.files.units import unit_mm
from markermend.progress import Progress, quiet
from markermend.take import Source, Take

SIGNATURE = b"PathFileType"
_ROWS_A_REPORT = 4096


def read_trc(path: Path, *, progress: Progress | None = None) -> Take:
    """Read a TRC file.

    Parameters
    ----------
    path : the file
    progress : told the share of frames read

    Returns
    -------
    Take
        positions in mm; a sample is missing where a cell is blank or not a number, all three are
        zero, or frame numbers tell that a row is missing. ``read_only`` is set when the header
        tells of more frames.

    Raises
    ------
    FileFormatError
        when the header is incomplete, or no row follows it
    """
    status, lines = os.stat(path), read_lines(path)
    report, warnings = progress or quiet, []
    header = _header(lines, path.name)
    labels, repeated = _labels(lines[3], header, path.name)
    if repeated:
        warnings.append(f"Labels that occur more than once were numbered: {', '.join(repeated)}.")
    # The row under the labels (X1, Y1…) may be missing; numbers tell where the frames begin.
    rows = [line for line in lines[4:] if line.strip() and _begins_with_number(line)]
    if not rows:
        raise FileFormatError(f"{path.name} is cut short: no frame follows its header.")
    check_width(len(rows), 3 * len(labels), status.st_size, path.name)
    values = np.empty((len(rows), 3 * len(labels)))
    strange, start = 0, number(_cells(rows[0])[0])
    counted = np.empty(len(rows))
    for i, row in enumerate(rows):
        if i % _ROWS_A_REPORT == 0:
            report(i / len(rows), "Reading frames")
        cells = _cells(row)
        counted[i] = number(cells[0])
        strange += numbers(cells[2:], values[i])
    if strange:
        warnings.append(f"{strange} cells that are no numbers were read as missing.")
    frames, _ = frames_of_rows(len(rows), counted, warnings=warnings)
    positions = np.full((frames[-1] + 1, len(labels), 3), np.nan)
    positions[frames] = values.reshape(len(rows), len(labels), 3)
    zeros = mark_missing(positions)
    if zeros:
        warnings.append(f"{zeros} samples at exactly (0, 0, 0) were read as missing.")
    scale = unit_mm(header.get("Units", ""))
    if scale is None:
        scale = 1.0
        warnings.append("The file tells no unit of length that is known; millimetres were assumed.")
    positions *= scale
    declared = number(header.get("NumFrames", ""))
    cut = np.isfinite(declared) and declared > len(positions)
    if cut:
        warnings.append(
            f"The file is cut short: it says that it has {int(declared)} frames, {len(positions)}"
            " are present."
        )
    return Take(
        positions=positions,
        labels=labels,
        rate=_rate(header, rows, len(positions), warnings),
        first_frame=int(start) if np.isfinite(start) else 1,
        source=Source(path.absolute(), "trc", status.st_size, status.st_mtime_ns, scale_mm=scale),
        warnings=tuple(warnings),
        read_only=bool(cut),
        info=MappingProxyType({"units": header.get("Units", ""), "storage": "text"}),
    )


def write_trc(
    take: Take, file: IO[bytes], progress: Progress, *, name: str, before: int = 0
) -> None:
    """Write the markers of a take as TRC; a missing sample is three blank cells.

    Parameters
    ----------
    take : the recording; a take read from TRC keeps its unit, any other is written in mm
    file : written from its beginning
    progress : told the share of frames written
    name : what the file calls itself

    Raises
    ------
    ExportError
        when there are no markers, or the name of one would not come back when the file is read
    """
    if not take.markers:
        raise ExportError("A TRC holds nothing but markers, and this take has none.")
    check_kept(take.labels, _names_read, "TRC")
    source = take.source
    kept = source is not None and source.format == "trc"
    unit = take.info.get("units", "") if kept and unit_mm(take.info.get("units", "")) else "mm"
    scale = unit_mm(unit) or 1.0
    # A micrometre's thousandth, in whatever unit.
    digits = 6 + round(float(np.log10(scale)))
    rate, count = f"{take.rate:.10g}", take.markers
    head = [
        # A file's name may hold what separates lines and cells here.
        "PathFileType\t4\t(X/Y/Z)\t" + re.sub(r"[\t\r\n]", " ", name),
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame"
        "\tOrigNumFrames",
        f"{rate}\t{rate}\t{take.frames}\t{count}\t{unit}\t{rate}\t{take.first_frame}\t{take.frames}",
        _names_line(take.labels),
        "\t\t" + "\t".join(f"{axis}{i}" for i in range(1, count + 1) for axis in "XYZ"),
        "",
        "",
    ]
    file.write(utf8("\n".join(head)))
    for frame in range(take.frames):
        if frame % _ROWS_A_REPORT == 0:
            progress(frame / take.frames, "Writing frames")
        row = (take.positions[frame].reshape(-1) / scale).tolist()
        cells = "\t".join("" if v != v else f"{v:.{digits}f}" for v in row)
        time = f"{(before + frame) / take.rate:.9g}"
        file.write(f"{take.frame_number(frame)}\t{time}\t{cells}\n".encode())


def _names_line(labels: Sequence[str]) -> str:
    """The header's fourth line: each name stands over the first of its three columns."""
    return "Frame#\tTime\t" + "\t\t\t".join(labels) + "\t\t"


def _names_read(labels: Sequence[str]) -> tuple[str, ...]:
    """Names that are read from the line written for these."""
    line = lines_of(utf8(_names_line(labels)), "")[0]
    return _labels(line, {"NumMarkers": str(len(labels))}, "")[0]


def _header(lines: list[str], name: str) -> dict[str, str]:
    """Names and values of the second and third line."""
    if len(lines) < 5 or not lines[0].startswith(SIGNATURE.decode()):
        raise FileFormatError(
            f"{name} is cut short: a TRC file begins with five lines of header; look for another"
            " copy of it."
        )
    keys = [cell.strip() for cell in lines[1].split("\t") if cell.strip()]
    values = [cell.strip() for cell in lines[2].split("\t") if cell.strip()]
    return dict(zip(keys, values, strict=False))


def _labels(
    line: str, header: dict[str, str], name: str
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Names of the markers; the header's count decides where names are missing."""
    cells = [cell.strip() for cell in line.split("\t")]
    stated = [cell for cell in cells if cell and cell.lower() not in ("frame#", "time")]
    count = number(header.get("NumMarkers", ""))
    most = len(line) + 2
    if not np.isfinite(count) or not 0 < count <= most:
        count = len(stated)
    if not count:
        raise FileFormatError(f"{name} names no marker in its fourth line.")
    if len(stated) < count and len(cells) >= 3 * count:
        stated = cells[2::3]
    return unique_labels(stated, int(count))


def _cells(line: str) -> list[str]:
    """Cells of a row: between tabs, or between blanks where there are none."""
    return line.split("\t") if "\t" in line else line.split()


def _begins_with_number(line: str) -> bool:
    """Whether the first cell of a line is a number."""
    return bool(np.isfinite(number(_cells(line)[0])))


def _rate(header: dict[str, str], rows: list[str], frames: int, warnings: list[str]) -> float:
    """Frames per second: the header's, else the one that the times of so many frames tell."""
    for key in ("DataRate", "CameraRate", "OrigDataRate"):
        rate = number(header.get(key, ""))
        if np.isfinite(rate) and rate > 0:
            return rate
    if len(rows) > 1:
        first, last = (number((*_cells(row), "", "")[1]) for row in (rows[0], rows[-1]))
        if np.isfinite(last - first) and last > first:
            warnings.append("The file does not tell its frame rate; its times were used.")
            return round((frames - 1) / (last - first), 6)
    warnings.append("The file does not tell its frame rate; 100 Hz was assumed.")
    return 100.0
