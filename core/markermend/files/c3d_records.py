"""The parameters of a C3D file: named groups of typed values, each a record of its own."""

from __future__ import annotations

import math
import struct
from collections import Counter
from dataclasses import dataclass, field, replace

import numpy as np

from markermend.arrays import FloatArray
from markermend.files.c3d_numbers import Processor, decode_floats

BLOCK = 512
UNREADABLE = 99


@dataclass(frozen=True)
class Record:
    """One group or parameter as it stands in the file.

    Attributes
    ----------
    group : name of the group it belongs to, upper case
    name : name of the parameter, upper case; empty for the group's own record
    number : the group's number in the file
    locked : the producer asked for it not to be changed
    kind : -1 text, 1 byte, 2 integer, 4 float; 0 for a group's own record, ``UNREADABLE`` for a
        parameter whose values do not fit its place
    dims : sizes, fastest first; for text the first is the length of each string
    data : the values' bytes, in the file's own byte order
    description : as it stands
    offset : of the record's first byte in the file
    raw : the whole record up to the next one, byte for byte
    """

    group: str
    name: str
    number: int
    locked: bool
    kind: int
    dims: tuple[int, ...]
    data: bytes
    description: bytes
    offset: int
    raw: bytes = field(repr=False)


def text_of(raw: bytes) -> str:
    """Decode text of unknown encoding and drop trailing blanks and NULs."""
    raw = raw.split(b"\0", 1)[0].rstrip()
    try:
        return raw.decode("utf-8").strip()
    except UnicodeDecodeError:
        return raw.decode("latin-1").strip()


def record_strings(record: Record) -> list[str]:
    """Texts of a parameter; none if it holds numbers."""
    if record.kind != -1:
        return []
    if not record.dims:
        return [text_of(record.data)]
    length = record.dims[0]
    count = len(record.data) // length if length else 0
    return [text_of(record.data[i * length : (i + 1) * length]) for i in range(count)]


def record_numbers(record: Record, processor: Processor, *, unsigned: bool = False) -> FloatArray:
    """Numbers of a parameter, flat; none if it holds text."""
    order = processor.order
    if record.kind == 4:
        raw = np.frombuffer(record.data, dtype=np.uint8)
        with np.errstate(invalid="ignore"):
            return decode_floats(raw, processor).astype(np.float64)
    if record.kind == 2:
        kind = "u2" if unsigned else "i2"
        return np.frombuffer(record.data, dtype=f"{order}{kind}").astype(np.float64)
    if record.kind == 1:
        return np.frombuffer(record.data, dtype=np.uint8).astype(np.float64)
    return np.empty(0)


def walk_records(
    raw: bytes, section: int, processor: Processor, warnings: list[str]
) -> tuple[tuple[Record, ...], int]:
    """Collect groups and parameters until the section ends or stops making sense.

    Parameters
    ----------
    raw : the file's beginning
    section : byte where the parameter section begins
    processor : how the file stores numbers
    warnings : gets one sentence for each oddity

    Returns
    -------
    records in the file's order, and the byte where the last one ends
    """
    order = processor.order
    first_frame = _first_frame_byte(raw, order)
    stated = section + raw[section + 2] * BLOCK
    limit = first_frame if first_frame > section else min(len(raw), stated)
    found: list[Record] = []
    names: dict[int, str] = {}
    at = section + 4
    while at + 2 <= limit and raw[at] != 0:
        try:
            record, following = _record(raw, at, limit, order)
        except (ValueError, struct.error):
            warnings.append(
                f"The parameter section stops making sense at byte {at}; what follows was left out."
            )
            break
        if record.kind == 0:
            names.setdefault(record.number, record.name)
        elif record.kind == UNREADABLE:
            warnings.append(f"The parameter {record.name} does not fit its place and was not read.")
        found.append(record)
        at = following
    named = tuple(_in_group(r, names) for r in found)
    _warn_of_twins(named, warnings)
    return named, min(at, limit)


def _first_frame_byte(raw: bytes, order: str) -> int:
    """Where the header says the first frame begins, or 0 where that is outside the file."""
    at = int((struct.unpack_from(f"{order}H", raw, 16)[0] - 1) * BLOCK)
    return at if BLOCK <= at <= len(raw) else 0


def _warn_of_twins(records: tuple[Record, ...], warnings: list[str]) -> None:
    """Tell which parameters occur more than once."""
    counts = Counter(f"{r.group}:{r.name}" for r in records if r.name)
    twice = [name for name, n in counts.items() if n > 1]
    if twice:
        some = ", ".join(twice[:3]) + ("…" if len(twice) > 3 else "")
        warnings.append(
            f"Parameters that occur more than once ({len(twice)}: {some}); the first was read."
        )


def _record(raw: bytes, at: int, limit: int, order: str) -> tuple[Record, int]:
    """Read one record and where the next one begins; ValueError where it does not fit."""
    length, number = struct.unpack_from("bb", raw, at)
    name_end = at + 2 + abs(length)
    if number == 0 or name_end + 2 > limit:
        raise ValueError
    name = text_of(raw[at + 2 : name_end]).upper()
    jump = struct.unpack_from(f"{order}H", raw, name_end)[0]
    pointed = name_end + jump if jump > 2 else 0
    kind, data, after = 0, b"", name_end + 2
    dims: tuple[int, ...] = ()
    if number > 0:
        kind, dims, data, after = _values(raw, after, limit)
        if 0 < pointed <= limit and (kind == UNREADABLE or after > pointed):
            # The pointer to the next record holds, so only this one is lost.
            kind, dims, data, after = UNREADABLE, (), b"", pointed
        elif kind == UNREADABLE:
            raise ValueError
    stop = min(after + 1 + raw[after], limit) if after < limit else limit
    # The last record points nowhere, and some producers write the pointer in the wrong order.
    following = pointed if after <= pointed <= limit else stop
    description = bytes(raw[after + 1 : min(stop, following)])
    whole = bytes(raw[at:following])
    record = Record("", name, abs(number), length < 0, kind, dims, data, description, at, whole)
    return record, following


def _values(raw: bytes, at: int, limit: int) -> tuple[int, tuple[int, ...], bytes, int]:
    """Read kind, sizes and bytes of a parameter's values, and where they end."""
    if at + 2 > limit:
        return UNREADABLE, (), b"", at
    kind, rank = struct.unpack_from("bB", raw, at)
    dims = tuple(raw[at + 2 : at + 2 + rank])
    start = at + 2 + rank
    after = start + math.prod(dims) * abs(kind)
    if kind not in (-1, 1, 2, 4) or rank > 7 or after > limit:
        return UNREADABLE, (), b"", at
    return kind, dims, bytes(raw[start:after]), after


def _in_group(record: Record, names: dict[int, str]) -> Record:
    """Name the group a record belongs to."""
    if record.kind == 0:
        return replace(record, group=record.name, name="")
    return replace(record, group=names.get(record.number, f"GROUP {record.number}"))
