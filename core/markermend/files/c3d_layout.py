"""Where everything lies in a C3D file: header, parameters, and the block of samples.

A C3D file (C3D user guide, c3d.org) is a header of 512 bytes, a section of typed parameters in
groups, and one record a frame: four words a point (x, y, z, residual and cameras) and the analog
samples. Three kinds of processor order the bytes of its numbers, and samples are 16-bit integers
or 32-bit floats. Nothing in the file is believed before it is checked against the file's size.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import cached_property

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import FileFormatError
from markermend.files.c3d_numbers import Processor, decode_floats
from markermend.files.c3d_records import (
    BLOCK,
    Record,
    record_numbers,
    record_strings,
    walk_records,
)

MAGIC = 0x50
MOST_HEADER_FRAMES = 0xFFFF


class Storage(IntEnum):
    """Bytes of one sample word."""

    INTEGER = 2
    FLOAT = 4


@dataclass(frozen=True)
class C3dLayout:
    """What a C3D file says of itself, checked against its size.

    Attributes
    ----------
    size : of the file in bytes
    header : its first 512 bytes
    processor, storage : how numbers are stored
    section, section_end : bytes of the parameter section
    section_head : its first four bytes
    records : groups and parameters in the file's order
    data : offset of the first frame
    points : points in a frame
    analog_words : analog samples in a frame, all channels together
    channels : analog channels
    frames : frames that are present
    declared : frames that the file says it has
    first_frame : number of the first frame
    rate : frames per second
    scale : file units of one integer step (1 for floats); residual_scale the same for residuals
    residuals_hold : false where the file marks every sample invalid though it has coordinates
    warnings : one sentence for each oddity
    """

    size: int
    header: bytes = field(repr=False)
    processor: Processor
    storage: Storage
    section: int
    section_end: int
    section_head: bytes
    records: tuple[Record, ...] = field(repr=False)
    data: int
    points: int
    analog_words: int
    channels: int
    frames: int
    declared: int
    first_frame: int
    rate: float
    scale: float
    residual_scale: float
    residuals_hold: bool = True
    warnings: tuple[str, ...] = ()

    @property
    def stride(self) -> int:
        """Bytes of one frame."""
        return (4 * self.points + self.analog_words) * int(self.storage)

    @property
    def truncated(self) -> bool:
        """Fewer frames are present than the file says."""
        return self.frames < self.declared

    @property
    def analog_per_frame(self) -> int:
        """Analog samples of each channel in a frame."""
        return self.analog_words // self.channels if self.channels else 0

    @property
    def analog_unsigned(self) -> bool:
        """Whether integer analog samples run from 0 to 65,535."""
        if self.text("ANALOG", "FORMAT").upper() == "UNSIGNED":
            return True
        # Producers that forget the format still give themselves away by their offset.
        return bool((self.numbers("ANALOG", "OFFSET") == -32768).any())

    @cached_property
    def _by_name(self) -> dict[tuple[str, str], Record]:
        found: dict[tuple[str, str], Record] = {}
        for record in self.records:
            if record.name:
                found.setdefault((record.group, record.name), record)
        return found

    def find(self, group: str, name: str) -> Record | None:
        """Return a parameter, the first of that name, or None."""
        return self._by_name.get((group, name))

    def numbers(self, group: str, name: str, *, unsigned: bool = False) -> FloatArray:
        """Values of a parameter and of its continuations (``SCALE2``, ``SCALE3``…), flat.

        Parameters
        ----------
        unsigned : read 16-bit integers as 0 to 65,535

        Returns
        -------
        (n,) float64; empty where there is no such parameter, or it is text
        """
        parts = [
            record_numbers(r, self.processor, unsigned=unsigned) for r in self._chain(group, name)
        ]
        return np.concatenate(parts) if parts else np.empty(0)

    def number(
        self, group: str, name: str, default: float = 0.0, *, unsigned: bool = False
    ) -> float:
        """First value of a parameter, or the default where it has none."""
        record = self.find(group, name)
        if record is None:
            return default
        values = record_numbers(record, self.processor, unsigned=unsigned)
        return float(values[0]) if len(values) else default

    def count(self, group: str, name: str, default: int = 0) -> int:
        """First value of a parameter as a number of things, or the default where it is none."""
        value = self.number(group, name, default, unsigned=True)
        return int(value) if math.isfinite(value) and value >= 0 else default

    def strings(self, group: str, name: str) -> tuple[str, ...]:
        """Texts of a parameter and of its continuations (``LABELS2``…), without trailing blanks."""
        return tuple(s for r in self._chain(group, name) for s in record_strings(r))

    def text(self, group: str, name: str) -> str:
        """First text of a parameter, or empty."""
        found = self.strings(group, name)
        return found[0] if found else ""

    def _chain(self, group: str, name: str) -> Iterator[Record]:
        record, n = self.find(group, name), 1
        while record is not None:
            yield record
            n += 1
            record = self.find(group, f"{name}{n}")


def parse_layout(raw: bytes, size: int, name: str) -> C3dLayout:
    """Describe a C3D file.

    Parameters
    ----------
    raw : the file's beginning, up to its first frame or further
    size : of the whole file in bytes
    name : what to call the file in messages

    Returns
    -------
    C3dLayout

    Raises
    ------
    FileFormatError
        when the file is empty, not C3D, or holds no frame that can be read
    """
    if size == 0:
        raise FileFormatError(f"{name} is empty; look for another copy of it.")
    if len(raw) < BLOCK or raw[1] != MAGIC:
        raise FileFormatError(f"{name} is not a C3D file; its first bytes are not a C3D header.")
    warnings: list[str] = []
    section = (raw[0] - 1) * BLOCK
    if not BLOCK <= section <= len(raw) - 4:
        raise FileFormatError(
            f"{name} is damaged: its header puts the parameters at byte {section}, where there"
            " are none; look for another copy of it."
        )
    processor = _processor(raw[section + 3], raw, warnings)
    records, end = walk_records(raw, section, processor, warnings)
    draft = C3dLayout(
        size=size,
        header=bytes(raw[:BLOCK]),
        processor=processor,
        storage=Storage.FLOAT,
        section=section,
        section_end=end,
        section_head=bytes(raw[section : section + 4]),
        records=records,
        data=0,
        points=0,
        analog_words=0,
        channels=0,
        frames=0,
        declared=0,
        first_frame=1,
        rate=0.0,
        scale=1.0,
        residual_scale=1.0,
    )
    return _measured(draft, name, warnings)


def _processor(code: int, raw: bytes, warnings: list[str]) -> Processor:
    """Read the kind of processor; where it is unknown, take the one that makes sense."""
    try:
        return Processor(code)
    except ValueError:
        # In the wrong order first and last frame are far apart, or the wrong way round.
        little, big = ((last - first) % (1 << 16) for first, last in _spans(raw))
        chosen = Processor.MIPS if big < little else Processor.INTEL
        warnings.append(f"The kind of processor ({code}) is unknown; read as {chosen.name}.")
        return chosen


def _spans(raw: bytes) -> list[tuple[int, int]]:
    """First and last frame by the header, read in both orders of bytes."""
    return [struct.unpack_from(f"{order}HH", raw, 6) for order in "<>"]


def _measured(draft: C3dLayout, name: str, warnings: list[str]) -> C3dLayout:
    """Add where the frames lie, choosing among the file's claims the ones that fit its size."""
    say = warnings.append
    first, last = struct.unpack_from(f"{draft.processor.order}HH", draft.header, 6)
    (per_frame,) = struct.unpack_from(f"{draft.processor.order}H", draft.header, 18)
    data = _data_start(draft, name, warnings)
    scale = _point_scale(draft, warnings)
    storage = Storage.FLOAT if scale < 0 else Storage.INTEGER
    channels = draft.count("ANALOG", "USED")
    room = draft.size - data
    points, analog, start, declared = _counts(draft, room, storage, per_frame * channels, warnings)
    if declared != last - first + 1 and last != MOST_HEADER_FRAMES:
        say(f"The header counts {max(last - first + 1, 0)} frames; {declared} were read.")
    stride = (4 * points + analog) * int(storage)
    # Frames of nothing cost no bytes, so the file's size does not bound them.
    frames = min(declared, room // stride if stride else MOST_HEADER_FRAMES)
    if declared <= 0:
        raise FileFormatError(f"{name} holds no frame: by its header it ends before it begins.")
    if not frames:
        raise FileFormatError(
            f"{name} holds no whole frame: its header tells of {points} points and {analog} analog"
            f" samples, {stride} bytes a frame, but only {room} bytes follow; look for another copy"
            " of it."
        )
    if frames < declared:
        say(f"The file is cut short: it says that it has {declared} frames, {frames} are present.")
    return replace(
        draft,
        storage=storage,
        data=data,
        points=points,
        analog_words=analog,
        channels=_channels(channels, analog, per_frame, warnings),
        frames=frames,
        declared=declared,
        first_frame=start,
        rate=_rate(draft, _header_float(draft, 20), warnings),
        scale=1.0 if storage is Storage.FLOAT else scale,
        residual_scale=abs(scale),
        warnings=tuple(warnings),
    )


def _data_start(draft: C3dLayout, name: str, warnings: list[str]) -> int:
    """Byte at which the frames begin."""
    (block,) = struct.unpack_from(f"{draft.processor.order}H", draft.header, 16)
    data = (block - 1) * BLOCK
    if not BLOCK <= data <= draft.size:
        data = (draft.count("POINT", "DATA_START") - 1) * BLOCK
        warnings.append(
            "The header does not say where the frames begin; POINT:DATA_START was used."
        )
    if not BLOCK <= data <= draft.size:
        raise FileFormatError(
            f"{name} is damaged: its frames would begin beyond its end, at byte {max(data, 0)} of"
            f" {draft.size}; look for another copy of it."
        )
    return int(data)


def _point_scale(draft: C3dLayout, warnings: list[str]) -> float:
    """Scale of points and residuals; below 0 where samples are floats."""
    scale = _header_float(draft, 12)
    if not (math.isfinite(scale) and scale != 0):
        scale = draft.number("POINT", "SCALE", -1.0)
        warnings.append("The header has no scale; POINT:SCALE was used.")
    return scale if math.isfinite(scale) and scale != 0 else -1.0


def _counts(
    draft: C3dLayout, room: int, storage: Storage, analog_used: int, warnings: list[str]
) -> tuple[int, int, int, int]:
    """Points, analog samples a frame, first frame and frames: the claims that fit the size.

    Parameters
    ----------
    draft : what is known of the file
    room : bytes from the first frame to the file's end
    storage : of each number
    analog_used : analog samples a frame by the parameters
    warnings : grows where the header is not believed
    """
    header_points, header_analog, first, last = struct.unpack_from(
        f"{draft.processor.order}4H", draft.header, 2
    )
    used = min(draft.count("POINT", "USED", header_points), MOST_HEADER_FRAMES)
    claims = [
        (points, analog, start, frames)
        for points in dict.fromkeys((header_points, used))
        for analog in dict.fromkeys((header_analog, analog_used))
        for start, frames in _frame_claims(draft, first, last)
    ]
    fitting = [
        c for c in claims if 0 <= room - (4 * c[0] + c[1]) * int(storage) * c[3] <= 2 * BLOCK
    ]
    points, analog, start, declared = (fitting or claims)[0]
    if (points, analog) != (header_points, header_analog):
        warnings.append(
            f"The header's counts do not fit the file's size; {points} points and {analog} analog"
            " samples a frame were read."
        )
    return points, analog, start, declared


def _header_float(draft: C3dLayout, at: int) -> float:
    """Read a float of the header."""
    raw = np.frombuffer(draft.header, np.uint8, 4, at)
    return float(decode_floats(raw, draft.processor)[0])


def _frame_claims(draft: C3dLayout, first: int, last: int) -> list[tuple[int, int]]:
    """Pairs of first frame and number of frames the file states, the likeliest first."""
    claims = [(first, last - first + 1)]
    start, end = (
        draft.numbers("TRIAL", name, unsigned=True)
        for name in ("ACTUAL_START_FIELD", "ACTUAL_END_FIELD")
    )
    # Sixteen bits do not hold the frames of a long take: these two are pairs of 16-bit words.
    longer: list[tuple[int, int]] = []
    if len(start) and len(end) and np.isfinite((*start[:2], *end[:2])).all():
        a, b = (int(w[0]) + 65536 * int(w[1] if len(w) > 1 else 0) for w in (start, end))
        longer.append((a, b - a + 1))
    for name in ("LONG_FRAMES", "FRAMES"):
        stated = draft.number("POINT", name, unsigned=True)
        if math.isfinite(stated) and 0 < stated < 2**31:
            longer.append((first, int(stated)))
    if last == MOST_HEADER_FRAMES or last < first:
        return [c for c in longer if c[1] > 0] + claims
    return claims + longer


def _channels(used: int, analog: int, per_frame: int, warnings: list[str]) -> int:
    """Number of analog channels that the samples of a frame are divided among."""
    if not analog:
        return 0
    if used > 0 and analog % used == 0:
        return used
    if per_frame > 0 and analog % per_frame == 0:
        return analog // per_frame
    warnings.append(f"{analog} analog samples a frame do not divide into {used} channels.")
    return analog


def _rate(draft: C3dLayout, header_rate: float, warnings: list[str]) -> float:
    """Frames per second: the parameter, the header, or 100 where neither says."""
    stated = draft.number("POINT", "RATE", header_rate)
    for rate in (stated, header_rate):
        if math.isfinite(rate) and rate > 0:
            return rate
    warnings.append("The file does not tell its frame rate; 100 Hz was assumed.")
    return 100.0
