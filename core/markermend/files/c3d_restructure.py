"""Write a C3D take whose labels, frames, points or storage are not those of its source.

The source's parameter records are copied byte for byte, and only those that must change are
encoded anew; samples that did not change keep their words, with residuals, cameras and analog
channels.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import IO

import numpy as np

from markermend.arrays import ByteArray, Float32Array, IntArray
from markermend.errors import ExportError
from markermend.files.c3d_events import KEY_AT, read_events
from markermend.files.c3d_layout import C3dLayout, Storage
from markermend.files.c3d_numbers import encode_floats
from markermend.files.c3d_parameters import rewrite_parameters
from markermend.files.c3d_patch import check_unchanged, copy_bytes, open_unchanged, patch_rows
from markermend.files.c3d_records import BLOCK
from markermend.files.c3d_samples import Plan, blocks, decode_positions, quads_of, words_of
from markermend.progress import Progress
from markermend.take import Take


@dataclass(frozen=True)
class Structure:
    """How a restructured file comes from its source.

    Attributes
    ----------
    offset : index of the first frame in the source
    kept : the source's columns that stay, ascending
    places : column of each marker of the take in the new file
    added : labels of the points that are new, in their order behind the kept ones
    """

    offset: int
    kept: tuple[int, ...]
    places: tuple[int, ...]
    added: tuple[str, ...]


def structure_of(take: Take) -> Structure | None:
    """How a take comes from its C3D source; None where it does not, and is a file of its own."""
    source = take.source
    if source is None or not isinstance(source.layout, C3dLayout):
        return None
    layout = source.layout
    offset = take.first_frame - layout.first_frame
    columns = source.columns
    inside = offset >= 0 and offset + take.frames <= layout.frames
    # Damage may put the parameters among the frames; they cannot grow there.
    in_order = layout.section_end <= layout.data
    if not inside or not in_order or len(columns) != take.markers or take.rate != layout.rate:
        return None
    others = take.points.columns if take.points is not None else ()
    kept = sorted([c for c in (*columns, *others) if c >= 0])
    # Where frames held nothing so far, what follows them could not be found any more.
    new_words = not layout.stride and any(column < 0 for column in columns)
    if new_words or len(set(kept)) != len(kept) or (kept and kept[-1] >= layout.points):
        return None
    place = {column: i for i, column in enumerate(kept)}
    places: list[int] = []
    added: list[str] = []
    for column, label in zip(columns, take.labels, strict=True):
        places.append(place[column] if column >= 0 else len(kept) + len(added))
        if column < 0:
            added.append(label)
    return Structure(offset, tuple(kept), tuple(places), tuple(added))


def to_be_floats(take: Take) -> bool:
    """Whether a take's C3D source has integers, so that floats would be another file."""
    layout = take.source.layout if take.source is not None else None
    return isinstance(layout, C3dLayout) and layout.storage is Storage.INTEGER


def copy_restructured(
    take: Take,
    structure: Structure,
    file: IO[bytes],
    progress: Progress,
    *,
    as_float: bool,
    notes: Mapping[str, Sequence[str]],
) -> IntArray:
    """Write a take whose labels, frames, points or storage are not those of its C3D source.

    Parameters
    ----------
    take, structure : the recording, and how it comes from its source
    file : written from its beginning
    progress : told the share of frames written
    as_float : write floats also where the source has integers
    notes : texts for the MARKERMEND group, by parameter; none leaves the group as it is

    Returns
    -------
    (markers,) int64: samples of each marker that are not the source's

    Raises
    ------
    ExportError
        as :func:`markermend.files.c3d_patch.copy_patched`
    """
    source = take.source
    assert source is not None
    layout = source.layout
    assert isinstance(layout, C3dLayout)
    target = _target(take, structure, layout, as_float=as_float)
    if target.frames != layout.frames and layout.count("ROTATION", "USED"):
        raise ExportError(
            f"{source.path.name} holds rotations behind its frames, which do not come along in a"
            " part of them; write all frames, or a TRC or CSV."
        )
    # Of a file that says of no sample that it was seen, reading believes the coordinates.
    unseen = target.frames != layout.frames and not take.present.any()
    with open_unchanged(source) as original:
        original.seek(0)
        ahead = original.read(layout.data)
        behind = ahead[layout.section_end :]
        section, target = _section(take, structure, layout, target, notes, behind)
        file.write(_header(take, layout, target) + ahead[BLOCK : layout.section] + section)
        written = np.zeros(take.markers, dtype=np.int64)
        first, last = structure.offset, structure.offset + take.frames
        plan = Plan(target, structure.places, source.scale_mm / layout.scale * target.scale)
        for start, stop, raw in blocks(original, layout):
            progress(start / layout.frames, "Writing frames")
            a, b = max(start, first), min(stop, last)
            if a >= b:
                continue
            rows = _reshaped(raw[a - start : b - start], layout, target, structure)
            before = np.empty((b - a, take.markers, 3))
            decode_positions(quads_of(words_of(rows, target), target), plan, before)
            after = take.positions[a - first : b - first]
            if target.storage is not layout.storage:
                # Rounding to single precision is no edit.
                after = np.where(np.abs(after - before) <= 2e-7 * np.abs(before), before, after)
            if unseen:
                _blank(rows, plan)
            written += patch_rows(rows, before, after, plan, take, np.arange(a - first, b - first))
            file.write(rows.reshape(-1).data)
        end = layout.data + layout.frames * layout.stride
        if target.frames == layout.frames and (
            target.stride == layout.stride or layout.size - end > BLOCK
        ):
            original.seek(end)
            copy_bytes(original, file, layout.size - end)
        elif layout.size % BLOCK == 0:
            file.write(b"\0" * (-(target.data + target.frames * target.stride) % BLOCK))
        check_unchanged(source, os.fstat(original.fileno()))
    return written


def _target(take: Take, structure: Structure, layout: C3dLayout, *, as_float: bool) -> C3dLayout:
    """Describe the new file, but for where its frames begin."""
    to_float = as_float and layout.storage is Storage.INTEGER
    return replace(
        layout,
        points=len(structure.kept) + len(structure.added),
        frames=take.frames,
        declared=take.frames,
        first_frame=take.first_frame,
        storage=Storage.FLOAT if to_float else layout.storage,
        scale=1.0 if to_float else layout.scale,
    )


def _reshaped(
    raw: ByteArray, layout: C3dLayout, target: C3dLayout, structure: Structure
) -> ByteArray:
    """Select the words of the points that stay, make room for new ones, and change storage."""
    each = 4 * layout.points
    kept = (4 * np.array(structure.kept, dtype=np.intp)[:, None] + np.arange(4)).reshape(-1)
    rows = len(raw)
    if target.storage is layout.storage:
        cells = raw.reshape(rows, -1, int(layout.storage))
        points, analog = cells[:, kept], cells[:, each:]
        fresh = np.zeros((rows, len(structure.added), 4, int(layout.storage)), dtype=np.uint8)
        fresh[:, :, 3] = _minus_one(target)
    else:
        words = words_of(raw, layout)
        quads = words[:, kept].reshape(rows, -1, 4).astype(np.float32)
        quads[..., :3] *= np.float32(layout.scale)
        samples = words[:, each:]
        if layout.analog_unsigned:
            samples = samples.view(samples.dtype.str.replace("i2", "u2"))
        points = _float_cells(quads.reshape(rows, -1), target)
        analog = _float_cells(samples.astype(np.float32), target)
        fresh = np.zeros((rows, len(structure.added), 4, 4), dtype=np.uint8)
        fresh[:, :, 3] = _minus_one(target)
    size = int(target.storage)
    joined = np.concatenate([points, fresh.reshape(rows, -1, size), analog], axis=1)
    return joined.reshape(rows, -1)


def _blank(rows: ByteArray, plan: Plan) -> None:
    """Put the markers of some frames at 0, as missing samples usually are."""
    layout = plan.layout
    cells = rows.reshape(len(rows), -1, int(layout.storage))
    for axis in range(3):
        cells[:, 4 * np.array(plan.columns, dtype=np.intp) + axis] = 0


def _minus_one(layout: C3dLayout) -> ByteArray:
    """Bytes of the word that marks a sample missing."""
    if layout.storage is Storage.INTEGER:
        return np.full(2, 255, dtype=np.uint8)
    return encode_floats(np.array([-1.0], dtype=np.float32), layout.processor)


def _float_cells(words: Float32Array, layout: C3dLayout) -> ByteArray:
    """Encode floats: (rows, words, 4) uint8."""
    return encode_floats(words.reshape(-1), layout.processor).reshape(*words.shape, 4)


def _section(
    take: Take,
    structure: Structure,
    layout: C3dLayout,
    target: C3dLayout,
    notes: Mapping[str, Sequence[str]],
    behind: bytes,
) -> tuple[bytes, C3dLayout]:
    """Encode the parameter section, and find out where the frames begin behind it."""
    room, own = layout.data - layout.section, layout.section_end - layout.section
    data = layout.data
    for _ in range(2):
        target = replace(target, data=data)
        body = b"".join(rewrite_parameters(take, structure, layout, target, notes))
        # Two zeros end the records, where the next one's name would begin.
        needed = 4 + len(body) + (2 if 4 + len(body) != own else 0)
        length = max(room, -(-needed // BLOCK) * BLOCK)
        data = layout.section + length
    count = layout.section_head[2] if length == room else min(length // BLOCK, 255)
    head = layout.section_head[:2] + bytes([count]) + layout.section_head[3:]
    rest = behind if len(head + body) == own else b""
    return (head + body + rest).ljust(length, b"\0"), replace(target, data=data)


def _header(take: Take, layout: C3dLayout, target: C3dLayout) -> bytes:
    """Change in the source's header what is no longer so."""
    order, head = layout.processor.order, bytearray(layout.header)
    if target.points != layout.points:
        struct.pack_into(f"{order}H", head, 2, target.points)
    if (target.first_frame, target.frames) != (layout.first_frame, layout.declared):
        first = min(target.first_frame, 0xFFFF)
        last = min(target.first_frame + target.frames - 1, 0xFFFF)
        struct.pack_into(f"{order}HH", head, 6, first, last)
    if target.frames != layout.frames:
        # The file's size, by which wrong counts are found out, is another one now.
        struct.pack_into(f"{order}HH", head, 2, target.points, target.analog_words)
    if target.storage is not layout.storage:
        scale = np.array([-layout.residual_scale], dtype=np.float32)
        head[12:16] = encode_floats(scale, layout.processor).tobytes()
    struct.pack_into(f"{order}H", head, 16, target.data // BLOCK + 1)
    if take.events != read_events(layout):
        # All events are in the EVENT group then; two lists could contradict each other.
        head[KEY_AT : KEY_AT + 4] = bytes(4)
    return bytes(head)
