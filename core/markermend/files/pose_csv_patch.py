"""Write a table of joints over the file it came from: rows that do not change stay as they are."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, isfinite, log10
from pathlib import Path

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.errors import FileFormatError
from markermend.files.pose_rows import NUMBERS, Header, measured, says_nothing, whole_rows
from markermend.files.pose_table import step_of
from markermend.progress import Progress

_ROWS_A_REPORT = 4096
# Digits behind the point of a place in mm, and of a rotation.
_PLACE, _TURN = 3, 6
_ROTATION = slice(3, 7)
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"


@dataclass(frozen=True, eq=False)
class Part:
    """What a file shall say from some frame on.

    Attributes
    ----------
    joints, parents : names, and the index of each one's parent, -1 for a root
    first : the file's number of frame 0 of what follows
    there : (frames, joints, 8) what the file says in mm, NaN where it has no number
    values : (frames, joints, 8) what it shall say
    changed : (frames, joints, 8) bool, where that is something else
    times : (frames,) seconds, where they are not those of the file
    """

    joints: tuple[str, ...]
    parents: tuple[int, ...]
    first: int
    there: FloatArray
    values: FloatArray
    changed: BoolArray
    times: FloatArray | None = None


def patched(path: Path, header: Header, part: Part, progress: Progress) -> bytes | None:
    """A table's file with other numbers where these are to be others.

    Comments, further columns, endings of lines and every row that is not changed stay the same
    bytes; of one that is changed so do the cells that are not, but for quotes that they do not
    need. Rows of other frames go. A row that the file lacks comes behind that of the joint before
    it; its cells in further columns are empty.

    Parameters
    ----------
    path : the file, as it was when it was read
    header : its first line
    part : what it shall say
    progress : told the share of rows written; may raise to stop

    Returns
    -------
    The file's content; None where the file is not there any more, says something else now, or has
    not the columns that are needed
    """
    try:
        raw = path.read_bytes()
    except OSError:
        return None
    mark = _BYTE_ORDER_MARK if raw.startswith(_BYTE_ORDER_MARK) else b""
    raw = raw.removeprefix(mark)
    code = _encoding(raw)
    lines = [line.decode(code) for line in raw.splitlines(keepends=True)]
    places = [i for i, line in enumerate(lines) if not says_nothing(line)][1:]
    index = {joint: n for n, joint in enumerate(part.joints)}
    try:
        body, _ = whole_rows([(i + 1, lines[i].rstrip("\r\n")) for i in places], header)
        frames = np.array([header.frame(row, n) for n, row in body]) - part.first
        columns = np.array([index[header.joint(row, n)] for n, row in body])
        numbers = _numbers(body, header, progress)
    except (FileFormatError, KeyError):
        return None
    said = measured(numbers)
    # What has no place is not to be told as seen.
    anew = ~said & (numbers[:, -1] > 0)
    numbers[~said] = np.nan
    within = (frames >= 0) & (frames < len(part.values))
    here = frames[within], columns[within]
    if not np.array_equal(numbers[within], part.there[here], equal_nan=True):
        return None
    changed = part.changed.copy()
    changed[here] |= anew[within, None]
    at = np.full(changed.shape[:2], -1)
    at[here] = np.array([n - 1 for n, _ in body])[within]
    missing = changed.any(axis=2) & (at < 0)
    bare = _bare(missing | (at >= 0), header.step)
    if not _tells_steps(missing | bare | (at >= 0), header.step):
        # Of two poses no steps are told.
        return None
    if not _has_columns_for(header, part, changed, unseen=bool(bare.any())):
        return None
    rows = _Rows(header, part, body, frames)
    # A row may stand twice.
    wanted = np.zeros(len(body), dtype=bool)
    wanted[within] = changed[here].any(axis=1) | (part.times is not None)
    for n in np.flatnonzero(wanted).tolist():
        if n % _ROWS_A_REPORT == 0:
            progress(0.5 + 0.5 * n / len(body), "Writing poses")
        number, row = body[n]
        told = rows.changed(row, frames[n], columns[n], changed[frames[n], columns[n]])
        lines[number - 1] = told + _ending(lines[number - 1])
    kept = {number - 1 for (number, _), stays in zip(body, within.tolist(), strict=True) if stays}
    for i in set(places) - kept:
        lines[i] = ""
    head = next(i for i, line in enumerate(lines) if not says_nothing(line))
    _insert(lines, rows, at, missing | bare, head)
    return mark + "".join(lines).encode(code)


def _numbers(body: list[tuple[int, list[str]]], header: Header, progress: Progress) -> FloatArray:
    """(rows, 8) numbers of rows."""
    values = np.empty((len(body), len(NUMBERS)))
    for n, (number, row) in enumerate(body):
        if n % _ROWS_A_REPORT == 0:
            progress(0.5 * n / len(body), "Writing poses")
        values[n] = header.values(row, number)
    return values


def _bare(there: BoolArray, step: int) -> BoolArray:
    """Rows (frames, joints) that a part of a table needs besides those ``there``.

    Without them it would not have all of its frames, or joints in their order, or its frames would
    be taken to follow one another in other steps than those of the file.
    """
    bare = np.zeros(there.shape, dtype=bool)
    if not (there.any(axis=0).all() and there[0].any()):
        bare[0] = ~there[0]
    bare[-1, 0] |= not (there | bare)[-1].any()
    if not _tells_steps(there | bare, step):
        bare[:, 0] |= ~(there | bare).any(axis=1)
    return bare


def _tells_steps(there: BoolArray, step: int) -> bool:
    """Whether rows (frames, joints) that are ``there`` are of frames in steps as the file's."""
    numbers = step * np.flatnonzero(there.any(axis=1))
    return len(there) < 2 or step_of(numbers.tolist()) == step


def _has_columns_for(header: Header, part: Part, changed: BoolArray, *, unseen: bool) -> bool:
    """Whether a file can say what is changed; without rotations it need not say that none is."""
    if (part.times is not None and "time" not in header.at) or (
        unseen and "confidence" not in header.at
    ):
        return False
    lacks = [k for k, name in enumerate(NUMBERS) if name not in header.at]
    turns = part.values[..., _ROTATION]
    unturned = (turns == 0).all(axis=2) | (turns == (0.0, 0.0, 0.0, 1.0)).all(axis=2)
    none = lacks == [*range(*_ROTATION.indices(len(NUMBERS)))] and bool(unturned.all())
    return none or not changed[..., lacks].any()


class _Rows:
    """How rows are written in a file."""

    def __init__(
        self, header: Header, part: Part, body: list[tuple[int, list[str]]], frames: IntArray
    ) -> None:
        self.header, self.part = header, part
        self.in_frame = dict(zip(frames.tolist(), (row for _, row in body), strict=True))
        known = [(n, header.time(row)) for n, row in self.in_frame.items()]
        self.times = sorted((n, time) for n, time in known if isfinite(time))
        cells = (row[i] for _, row in body for name, i in header.at.items() if name in NUMBERS)
        self.comma = header.delimiter != "," and any("," in cell for cell in cells)

    def changed(self, row: list[str], frame: int, joint: int, which: BoolArray) -> str:
        """A row, without its ending, that has the new numbers."""
        row = list(row)
        if self.part.times is not None:
            row[self.header.at["time"]] = self._time(frame)
        for k in np.flatnonzero(which).tolist():
            if NUMBERS[k] in self.header.at:
                row[self.header.at[NUMBERS[k]]] = self._number(k, self.part.values[frame, joint, k])
        return self._joined(row)

    def new(self, frame: int, joint: int) -> str:
        """A row, without its ending, of a joint that has none in a frame."""
        part, beside = self.part, self.in_frame.get(frame)
        parent = part.parents[joint]
        cells = {
            "frame": str(self.header.stated(part.first + frame))
            if beside is None
            else beside[self.header.at["frame"]],
            "time": self._time(frame),
            "joint": part.joints[joint],
            "parent": part.joints[parent] if parent >= 0 else "",
        }
        cells |= {
            name: self._number(k, part.values[frame, joint, k]) for k, name in enumerate(NUMBERS)
        }
        row = [""] * self.header.width
        for name, i in self.header.at.items():
            row[i] = cells.get(name, "")
        return self._joined(row)

    def _time(self, frame: int) -> str:
        """Time of a frame: another than it was, of a row beside, or between those of others."""
        if self.part.times is not None:
            return self._written(f"{self.part.times[frame]:.6f}")
        if frame in self.in_frame:
            return self._cell(self.in_frame[frame], "time")
        if len(self.times) < 2:
            return ""
        time = np.interp(frame, *np.array(self.times).T)
        # With as many digits as others.
        near = self._cell(self.in_frame[self.times[0][0]], "time").replace(",", ".")
        return self._written(f"{time:.{len(near.partition('.')[2])}f}")

    def _cell(self, row: list[str], name: str) -> str:
        """A cell of a row; blank where the file has no such column."""
        return row[self.header.at[name]] if name in self.header.at else ""

    def _number(self, k: int, value: float) -> str:
        """A number in the file's own unit."""
        if NUMBERS[k] == "confidence":
            return self._written(f"{value * self.header.sure:.3g}")
        if k < len(self.header.scales):
            scale = self.header.scales[k]
            digits = _PLACE + max(0, ceil(log10(scale)))
            return self._written(f"{value / scale:.{digits}f}")
        return self._written(f"{value:.{_TURN}f}")

    def _written(self, number: str) -> str:
        """A number, with a decimal comma where the file has these."""
        return number.replace(".", ",") if self.comma else number

    def _joined(self, row: list[str]) -> str:
        """Cells side by side, in quotes where they need them."""
        between = self.header.delimiter
        return between.join(
            '"' + cell.replace('"', '""') + '"' if '"' in cell or between in cell else cell
            for cell in row
        )


def _insert(lines: list[str], rows: _Rows, at: IntArray, missing: BoolArray, head: int) -> None:
    """Add rows to lines, in place, where rows ``at`` (frames, joints) lines, else -1, are missing.

    Each comes behind the header, in line ``head``, and the row of a joint before it, so that joints
    are read in the same order.
    """
    behind: dict[int, list[str]] = {}
    for frame, joint in np.argwhere(missing).tolist():
        before, there = at[frame, :joint], at[frame][at[frame] >= 0]
        if (before >= 0).any():
            place = int(before[before >= 0][-1])
        elif there.size:
            place = int(there.min()) - 1
        else:
            place = int(at[:frame].max(initial=head))
        behind.setdefault(place, []).append(rows.new(frame, joint))
    ending = next((_ending(line) for line in lines if _ending(line)), "\n")
    for place in sorted(behind, reverse=True):
        if lines[place] and not _ending(lines[place]):
            lines[place] += ending
        lines[place + 1 : place + 1] = [row + ending for row in behind[place]]


def _encoding(raw: bytes) -> str:
    """How a text's letters are written, as its reader takes them."""
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        return "latin-1"
    return "utf-8"


def _ending(line: str) -> str:
    """How a line ends."""
    return line[len(line.rstrip("\r\n")) :]
