"""Put C3D records, parameter sections and headers together."""

from __future__ import annotations

import struct
from collections.abc import Sequence

import numpy as np

from markermend.encoding import utf8
from markermend.errors import ExportError
from markermend.files.c3d_layout import MAGIC
from markermend.files.c3d_numbers import Processor, encode_floats
from markermend.files.c3d_records import BLOCK, text_of
from markermend.files.labels import shown
from markermend.take import Event

MOST_ROWS = MOST_LETTERS = 255
# Name of our own group, where what was done to a file is recorded on request.
GROUP = "MARKERMEND"
TEXT, BYTE, INTEGER, FLOAT = -1, 1, 2, 4


def group_record(number: int, name: str, description: str, processor: Processor) -> bytes:
    """Encode a group's own record."""
    text = description.encode("utf-8")[:255]
    return _record(-number, name, bytes([len(text)]) + text, processor)


def parameter_record(
    number: int,
    name: str,
    kind: int,
    dims: Sequence[int],
    data: bytes,
    processor: Processor,
    *,
    description: bytes = b"",
    locked: bool = False,
) -> bytes:
    """Encode a parameter.

    Parameters
    ----------
    number : of its group
    kind : -1 text, 1 byte, 2 integer, 4 float
    dims : sizes, fastest first, each at most 255
    data : values in the processor's own order
    """
    body = struct.pack("bB", kind, len(dims)) + bytes(dims) + data
    body += bytes([len(description)]) + description
    return _record(number, name, body, processor, locked=locked)


def _record(
    number: int, name: str, body: bytes, processor: Processor, *, locked: bool = False
) -> bytes:
    """Frame a record: name, group, and the way to the next one."""
    letters = name.encode("utf-8")[:127]
    head = struct.pack("bb", -len(letters) if locked else len(letters), number) + letters
    if len(body) + 2 > 0xFFFF:
        raise ExportError(f"The parameter {name} is too large for a C3D file.")
    return head + struct.pack(f"{processor.order}H", len(body) + 2) + body


def text_records(
    number: int, name: str, texts: Sequence[str], processor: Processor, length: int = 0
) -> list[bytes]:
    """Encode texts, in as many parameters as it takes (``LABELS``, ``LABELS2``…), and pad them.

    Raises
    ------
    ExportError
        when one is longer than a C3D file holds
    """
    rows = [text_row(t) for t in texts]
    width = max([length, *(len(r) for r in rows)])
    records = []
    for i in range(0, max(len(rows), 1), MOST_ROWS):
        part = rows[i : i + MOST_ROWS]
        data = b"".join(r.ljust(width) for r in part)
        dims = (width, len(part))
        records.append(parameter_record(number, _continued(name, i), TEXT, dims, data, processor))
    return records


def text_row(text: str) -> bytes:
    """Encode one text.

    Raises
    ------
    ExportError
        when it is longer than a C3D file holds: names that were cut would be others, or the same
    """
    row = utf8(text)
    if len(row) > MOST_LETTERS:
        raise ExportError(
            f"“{shown(text)}” is {len(row)} bytes long and a C3D file holds {MOST_LETTERS}; give it"
            " a shorter name."
        )
    return row


def cut_text(text: str) -> str:
    """As much of a sentence as a C3D file holds, no letter by half."""
    return utf8(text)[:MOST_LETTERS].decode("utf-8", "ignore")


def check_names(labels: Sequence[str]) -> None:
    """Refuse names of points that would be others when they are read.

    Parameters
    ----------
    labels : of all points; blanks at either end, which pad names in a C3D file, may go

    Raises
    ------
    ExportError
        when one is too long or has a character that ends it, or two differ in such blanks only
    """
    seen: dict[str, str] = {}
    for label in labels:
        name = text_of(text_row(label))
        if name != label.strip():
            raise ExportError(
                f"A C3D file cannot hold a point called “{shown(label)}”; rename it first."
            )
        other = seen.setdefault(name, label) if name else label
        if other != label:
            raise ExportError(
                f"“{shown(other)}” and “{shown(label)}” would have one name in a C3D file, which"
                " keeps no blanks at either end; rename one first."
            )


def number_records(
    number: int, name: str, kind: int, values: Sequence[float], processor: Processor, rows: int = 0
) -> list[bytes]:
    """Encode numbers, in as many parameters as it takes; ``rows`` makes a matrix of that height."""
    per = max(rows, 1)
    records = []
    for i in range(0, max(len(values), 1), MOST_ROWS * per):
        part = values[i : i + MOST_ROWS * per]
        dims = (rows, len(part) // rows) if rows else (len(part),)
        data = pack_numbers(part, kind, processor)
        records.append(
            parameter_record(number, _continued(name, i // per), kind, dims, data, processor)
        )
    return records


def scalar_record(number: int, name: str, kind: int, value: float, processor: Processor) -> bytes:
    """Encode one number."""
    return parameter_record(
        number, name, kind, (), pack_numbers([value], kind, processor), processor
    )


def pack_numbers(values: Sequence[float], kind: int, processor: Processor) -> bytes:
    """Encode numbers; integers above 32,767 as the unsigned ones that readers expect."""
    if kind == FLOAT:
        return encode_floats(np.asarray(values, dtype=np.float32), processor).tobytes()
    whole = np.asarray(values, dtype=np.int64) & 0xFFFF
    return whole.astype(f"{processor.order}u2" if kind == INTEGER else "u1").tobytes()


def _continued(name: str, first: int) -> str:
    """Name of a parameter's part that begins at row ``first``."""
    return name if first == 0 else f"{name}{first // MOST_ROWS + 1}"


def event_records(number: int, events: Sequence[Event], processor: Processor) -> list[bytes]:
    """Encode the parameters of an EVENT group."""
    times = [part for e in events for part in divmod(e.time_s, 60.0)]
    return [
        scalar_record(number, "USED", INTEGER, len(events), processor),
        *text_records(number, "CONTEXTS", [e.context for e in events], processor, 16),
        *text_records(number, "LABELS", [e.label for e in events], processor, 32),
        *number_records(number, "TIMES", FLOAT, times, processor, rows=2),
    ]


def section_bytes(records: Sequence[bytes], processor: Processor, name: str) -> bytes:
    """Put records together into a parameter section of whole blocks.

    Raises
    ------
    ExportError
        when they are more than a C3D header can point behind
    """
    body = b"".join(records)
    count = (4 + len(body) + 2 + BLOCK - 1) // BLOCK
    if count > 0xFFFF - 2:
        raise ExportError(f"{name} would have more parameters than a C3D file can hold.")
    head = bytes([1, MAGIC, min(count, 255), int(processor)])
    return (head + body).ljust(count * BLOCK, b"\0")


def header_bytes(
    original: bytes,
    processor: Processor,
    *,
    points: int,
    analog_words: int,
    analog_per_frame: int,
    first_frame: int,
    frames: int,
    scale: float,
    data_block: int,
    rate: float,
) -> bytes:
    """Fill in a header; whatever else the original holds (events, names) stays."""
    order = processor.order
    head = bytearray(original.ljust(BLOCK, b"\0"))
    first = min(first_frame, 0xFFFF)
    last = min(first_frame + frames - 1, 0xFFFF)
    head[0:2] = bytes([2, MAGIC])
    struct.pack_into(f"{order}4H", head, 2, points, analog_words, first, last)
    head[12:16] = encode_floats(np.array([scale], np.float32), processor).tobytes()
    struct.pack_into(f"{order}HH", head, 16, data_block, analog_per_frame)
    head[20:24] = encode_floats(np.array([rate], np.float32), processor).tobytes()
    return bytes(head)
