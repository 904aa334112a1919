"""Rewrite the parameters of a C3D file: those that must change, and no other byte."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping, Sequence
from typing import Protocol

from markermend.encoding import utf8
from markermend.files.c3d_build import (
    FLOAT,
    GROUP,
    INTEGER,
    MOST_ROWS,
    TEXT,
    check_names,
    cut_text,
    event_records,
    group_record,
    pack_numbers,
    parameter_record,
    text_row,
)
from markermend.files.c3d_events import read_events
from markermend.files.c3d_layout import C3dLayout
from markermend.files.c3d_records import BLOCK, Record, text_of
from markermend.files.labels import unique_labels
from markermend.take import Take

_PER_EVENT = ("USED", "LABELS", "CONTEXTS", "TIMES")


class Selection(Protocol):
    """Which points of the source stay, and which are new."""

    @property
    def kept(self) -> tuple[int, ...]:
        """Columns of the source that stay, ascending."""

    @property
    def places(self) -> tuple[int, ...]:
        """Column of each marker of the take in the new file."""

    @property
    def added(self) -> tuple[str, ...]:
        """Labels of the points behind the kept ones."""


def rewrite_parameters(
    take: Take,
    selection: Selection,
    layout: C3dLayout,
    target: C3dLayout,
    notes: Mapping[str, Sequence[str]],
) -> list[bytes]:
    """Encode the parameters of a restructured file.

    Parameters
    ----------
    take : the recording
    selection : which points stay, and which are new
    layout : the source
    target : the new file
    notes : texts to append to parameters of the MARKERMEND group

    Returns
    -------
    records in the source's order, new ones at the end
    """
    sheet = _Sheet(layout)
    _set_counts(sheet, layout, target)
    _set_labels(sheet, take, selection)
    if take.events != read_events(layout):
        _set_events(sheet, take)
    for name, lines in notes.items():
        # A list of changes grows with every export; which version wrote last is one line.
        earlier = [] if name == "VERSION" else sheet.rows(GROUP, name)
        rows = [*earlier, *(utf8(cut_text(line)) for line in lines)]
        sheet.set_rows(GROUP, name, rows)
    return sheet.finish()


def _set_counts(sheet: _Sheet, layout: C3dLayout, target: C3dLayout) -> None:
    """Bring the numbers that describe the frames up to date."""
    if target.points != layout.points:
        sheet.set_number("POINT", "USED", target.points)
    if target.data != layout.data:
        sheet.set_number("POINT", "DATA_START", target.data // BLOCK + 1)
        rotations = layout.count("ROTATION", "DATA_START")
        moved = (target.data - layout.data) // BLOCK
        sheet.set_number("ROTATION", "DATA_START", rotations + moved)
    if target.storage is not layout.storage:
        sheet.set_number("POINT", "SCALE", -layout.residual_scale)
    if (target.first_frame, target.frames) != (layout.first_frame, layout.declared):
        sheet.set_number("POINT", "FRAMES", target.frames)
        sheet.set_number("POINT", "LONG_FRAMES", target.frames)
        last = target.first_frame + target.frames - 1
        ends = {"ACTUAL_START_FIELD": target.first_frame, "ACTUAL_END_FIELD": last}
        for name, number in ends.items():
            if last > 0xFFFF and not sheet.has("TRIAL", name):
                # The header has no room for such numbers.
                sheet.add_long("TRIAL", name, number)
            sheet.set_number("TRIAL", name, number)


def _set_labels(sheet: _Sheet, take: Take, selection: Selection) -> None:
    """Rename and select labels and descriptions; what stays keeps its very bytes."""
    layout = sheet.layout
    read, _ = unique_labels(layout.strings("POINT", "LABELS"), layout.points)
    wanted = [read[column] for column in selection.kept] + list(selection.added)
    for place, label in zip(selection.places, take.labels, strict=True):
        wanted[place] = label
    check_names(wanted)
    stated = sheet.rows("POINT", "LABELS")
    columns = [*selection.kept, *(-1 for _ in selection.added)]
    rows = []
    for place, (column, label) in enumerate(zip(columns, wanted, strict=True)):
        own = stated[column] if 0 <= column < len(stated) else b""
        # A nameless point is called after its place, so it needs a name where that changes.
        same = column >= 0 and label == read[column] and (own.strip(b" \0") or place == column)
        rows.append(own if same else text_row(label))
    # Where names repeat, the numbers that reading gives them may have shifted.
    again, _ = unique_labels([text_of(row) for row in rows], len(rows))
    for place, (got, label) in enumerate(zip(again, wanted, strict=True)):
        if got != label:
            rows[place] = text_row(label)
    whole = columns == list(range(layout.points))
    if whole:
        rows += stated[layout.points :]
    if rows != stated and any(rows):
        sheet.set_rows("POINT", "LABELS", rows)
    described = sheet.rows("POINT", "DESCRIPTIONS")
    if described and not whole:
        sheet.set_rows(
            "POINT",
            "DESCRIPTIONS",
            [described[c] if 0 <= c < len(described) else b"" for c in columns],
        )


def _set_events(sheet: _Sheet, take: Take) -> None:
    """Replace the events; what else the group holds for each event no longer fits and goes."""
    old = sheet.layout.count("EVENT", "USED")
    for record in sheet.layout.records:
        per_event = bool(record.dims) and record.dims[-1] == old and old > 0
        if record.group == "EVENT" and (record.name.startswith(_PER_EVENT) or per_event):
            sheet.remove(record)
    number = sheet.group("EVENT")
    for raw in event_records(number, take.events, sheet.layout.processor):
        sheet.append(raw)


class _Sheet:
    """Parameters of a file while they are being rewritten."""

    def __init__(self, layout: C3dLayout) -> None:
        self.layout = layout
        self.order = layout.processor.order
        self._raw: list[bytes] = [record.raw for record in layout.records]
        self._fresh: list[bytes] = []
        self._groups = {r.group: r.number for r in layout.records if not r.name}

    def rows(self, group: str, name: str) -> list[bytes]:
        """Rows of a text parameter and of its continuations, as they stand."""
        found: list[bytes] = []
        for _, record in self._chain(group, name):
            width = record.dims[0] if record.dims else len(record.data)
            found += [record.data[i : i + width] for i in range(0, len(record.data), width or 1)]
        return found

    def set_number(self, group: str, name: str, value: float) -> None:
        """Set a number where the file has it, in its own type; pairs of words hold large ones."""
        for place, record in self._named(group, name):
            if record.kind == FLOAT:
                data = pack_numbers([value], FLOAT, self.layout.processor)
            elif record.kind == INTEGER and len(record.data) >= 4 and group == "TRIAL":
                words = [int(value) & 0xFFFF, int(value) >> 16]
                data = pack_numbers(words, INTEGER, self.layout.processor)
            elif record.kind == INTEGER:
                data = pack_numbers([min(value, 0xFFFF)], INTEGER, self.layout.processor)
            else:
                continue
            if len(record.data) >= len(data):
                rest = record.data[len(data) :]
                self._raw[place] = self._encoded(record, record.dims, data + rest)

    def has(self, group: str, name: str) -> bool:
        """Whether there is such a parameter."""
        return any(True for _ in self._named(group, name))

    def add_long(self, group: str, name: str, value: int) -> None:
        """Add a number too large for one word, as a pair of words."""
        processor = self.layout.processor
        data = pack_numbers([value & 0xFFFF, value >> 16], INTEGER, processor)
        self.append(parameter_record(self.group(group), name, INTEGER, (2,), data, processor))

    def set_rows(self, group: str, name: str, rows: Sequence[bytes]) -> None:
        """Set a text parameter, in as many continuations as it takes."""
        chain = list(self._chain(group, name))
        width = max([r.dims[0] for _, r in chain if r.dims] + [len(row) for row in rows] + [1])
        for part in range(max(-(-len(rows) // MOST_ROWS), len(chain), 1)):
            some = rows[part * MOST_ROWS : (part + 1) * MOST_ROWS]
            data = b"".join(row.ljust(width) for row in some)
            if part < len(chain):
                place, record = chain[part]
                flat = len(record.dims) == 1 and len(some) == 1
                dims = (width,) if flat else (width, len(some))
                self._raw[place] = self._encoded(record, dims, data) if some else b""
            else:
                title = name if part == 0 else f"{name}{part + 1}"
                number, processor = self.group(group), self.layout.processor
                dims = (width, len(some))
                self.append(parameter_record(number, title, TEXT, dims, data, processor))

    def group(self, name: str) -> int:
        """Number of a group, made if there is none."""
        if name not in self._groups:
            used = {r.number for r in self.layout.records} | set(self._groups.values())
            number = next(n for n in range(1, 128) if n not in used)
            self._groups[name] = number
            self.append(group_record(number, name, "", self.layout.processor))
        return self._groups[name]

    def remove(self, record: Record) -> None:
        """Leave a parameter out."""
        self._raw[self.layout.records.index(record)] = b""

    def append(self, raw: bytes) -> None:
        """Put a record at the end."""
        self._fresh.append(raw)

    def finish(self) -> list[bytes]:
        """Return all records, each but the last pointing at the next."""
        whole = [raw for raw in (*self._raw, *self._fresh) if raw]
        return [self._linked(raw) for raw in whole[:-1]] + whole[-1:]

    def _named(self, group: str, name: str) -> Iterator[tuple[int, Record]]:
        """Every parameter of that name, twins too, with its place."""
        for place, record in enumerate(self.layout.records):
            if (record.group, record.name) == (group, name):
                yield place, record

    def _chain(self, group: str, name: str) -> Iterator[tuple[int, Record]]:
        """First text parameter of that name, then its continuations, with their places."""
        number = 1
        while True:
            title = name if number == 1 else f"{name}{number}"
            found = next(self._named(group, title), None)
            if found is None or found[1].kind != TEXT:
                return
            yield found
            number += 1

    def _encoded(self, record: Record, dims: Sequence[int], data: bytes) -> bytes:
        """Encode a record anew with its own name, lock and description."""
        length = abs(struct.unpack_from("b", record.raw)[0])
        body = struct.pack("bB", record.kind, len(dims)) + bytes(dims) + data
        body += bytes([len(record.description)]) + record.description
        return record.raw[: 2 + length] + struct.pack(f"{self.order}H", len(body) + 2) + body

    def _linked(self, raw: bytes) -> bytes:
        """Make a record point at its end, where the last one of a file points nowhere."""
        at = 2 + abs(struct.unpack_from("b", raw)[0])
        return raw[:at] + struct.pack(f"{self.order}H", len(raw) - at) + raw[at + 2 :]
