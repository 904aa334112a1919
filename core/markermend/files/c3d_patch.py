"""Export a C3D take by copying its source and overwriting only the samples that changed.

A missing sample that gets a value gets the residual word 0: no residual, no camera, the usual sign
for "reconstructed, not measured". A sample that becomes missing gets -1 and zeros. In files whose
residuals mean nothing the residual words stay as they are.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO

import numpy as np

from markermend.arrays import BoolArray, ByteArray, FloatArray, IntArray
from markermend.errors import ExportError, RangeError
from markermend.files.c3d import name_points
from markermend.files.c3d_events import read_events
from markermend.files.c3d_layout import C3dLayout, Storage
from markermend.files.c3d_numbers import encode_floats
from markermend.files.c3d_samples import (
    Plan,
    blocks,
    decode_positions,
    far_away,
    quads_of,
    too_far,
    words_of,
)
from markermend.progress import Progress
from markermend.take import Source, Take

_LARGEST_STEP = 32767
_COPY_BYTES = 1 << 22


def patchable(take: Take) -> bool:
    """Whether a take differs from its C3D source in nothing but samples."""
    source = take.source
    if source is None or not isinstance(source.layout, C3dLayout):
        return False
    layout = source.layout
    labels, kinds = name_points(layout)
    columns = tuple(i for i, kind in enumerate(kinds) if not kind)
    others = tuple(i for i, kind in enumerate(kinds) if kind)
    return (
        source.columns == columns
        and (take.points.columns if take.points is not None else ()) == others
        and take.labels == tuple(labels[i] for i in columns)
        and take.frames == layout.frames
        and take.first_frame == layout.first_frame
        and take.rate == layout.rate
        and take.events == read_events(layout)
    )


def copy_patched(take: Take, file: IO[bytes], progress: Progress) -> IntArray:
    """Write a take's source with the changed samples in their place.

    Parameters
    ----------
    take : one for which :func:`patchable` holds
    file : written from its beginning
    progress : told the share of frames written

    Returns
    -------
    (markers,) int64: samples of each marker that were written

    Raises
    ------
    ExportError
        when the source is gone or changed since it was read, or a value does not fit its format
    """
    source = take.source
    assert source is not None
    layout = source.layout
    assert isinstance(layout, C3dLayout)
    plan = Plan(layout, source.columns, source.scale_mm)
    written = np.zeros(take.markers, dtype=np.int64)
    with open_unchanged(source) as original:
        original.seek(0)
        copy_bytes(original, file, layout.data)
        scratch = np.empty((0, len(plan.columns), 3))
        for start, stop, raw in blocks(original, layout):
            progress(start / layout.frames, "Writing frames")
            if len(scratch) < stop - start:
                scratch = np.empty((stop - start, len(plan.columns), 3))
            before, after = scratch[: stop - start], take.positions[start:stop]
            decode_positions(quads_of(words_of(raw, layout), layout), plan, before)
            # NaN has one bit pattern here, so equal bits are the quick way to "nothing changed".
            rows = np.flatnonzero((before.view(np.int64) != after.view(np.int64)).any(axis=(1, 2)))
            if len(rows):
                part = raw[rows]
                written += patch_rows(part, before[rows], after[rows], plan, take, start + rows)
                raw[rows] = part
            file.write(raw.reshape(-1).data)
        copy_bytes(original, file, source.size - layout.data - layout.frames * layout.stride)
        check_unchanged(source, os.fstat(original.fileno()))
    return written


@contextmanager
def open_unchanged(source: Source) -> Iterator[IO[bytes]]:
    """Open a take's source if it is still the file that was read.

    Raises
    ------
    ExportError
        when it cannot be opened, or has changed since
    """
    try:
        opened = source.path.open("rb", buffering=0)
    except OSError as error:
        raise ExportError(
            f"{source.path.name}, which the take was read from, cannot be opened any more:"
            f" {(error.strerror or str(error)).lower()}."
        ) from error
    with opened as file:
        check_unchanged(source, os.fstat(file.fileno()))
        yield file


def check_unchanged(source: Source, status: os.stat_result) -> None:
    """Refuse a source whose size or time are not those it was read with.

    Raises
    ------
    ExportError
        when they are not
    """
    if (status.st_size, status.st_mtime_ns) != (source.size, source.mtime_ns):
        raise ExportError(
            f"{source.path.name} has changed on disk since it was read; open it again before"
            " exporting."
        )


def copy_bytes(original: IO[bytes], file: IO[bytes], count: int) -> None:
    """Copy bytes as they are, from where the original stands.

    Raises
    ------
    ExportError
        when it has fewer than ``count`` left
    """
    while count > 0:
        part = original.read(min(count, _COPY_BYTES))
        if not part:
            raise ExportError("The source became shorter while it was copied; open it again.")
        file.write(part)
        count -= len(part)


def patch_rows(
    raw: ByteArray,
    before: FloatArray,
    after: FloatArray,
    plan: Plan,
    take: Take,
    frames: IntArray,
) -> IntArray:
    """Overwrite the words of some frames where their positions differ from those wanted.

    Parameters
    ----------
    raw : (frames, stride) uint8 as stored, written
    before : (frames, markers, 3) float64, the positions it holds, in mm
    after : the positions it shall hold
    plan : which points these are, and their scale
    take, frames : name markers and frames in messages

    Returns
    -------
    (markers,) int64: samples written of each marker

    Raises
    ------
    ExportError
        when a value does not fit the file's numbers
    """
    layout = plan.layout
    was, now = ~np.isnan(before[..., 0]), ~np.isnan(after[..., 0])
    with np.errstate(invalid="ignore"):
        differs = before != after
    differs &= (was & now)[..., None]
    appears, vanishes = now & ~was, was & ~now
    differs |= (appears | vanishes)[..., None]
    frame, marker, axis = np.nonzero(differs)
    if not len(frame):
        return np.zeros(take.markers, dtype=np.int64)
    values = np.where(now[..., None], after, 0.0)[frame, marker, axis] / plan.scale_mm
    cells = raw.reshape(-1, int(layout.storage))
    columns = np.array(plan.columns)
    each = 4 * layout.points + layout.analog_words
    places = frame * each + 4 * columns[marker] + axis
    _check_fits(values, layout, take, frames[frame], marker, plan.scale_mm)
    cells[places] = _encode(values, layout)
    if layout.residuals_hold:
        for mask, word in ((appears, 0.0), (vanishes, -1.0)):
            frame, marker = np.nonzero(mask)
            cells[frame * each + 4 * columns[marker] + 3] = _encode(
                np.full(len(frame), word), layout
            )
    return np.asarray(_any_axis(differs).sum(axis=0), dtype=np.int64)


def _any_axis(mask: BoolArray) -> BoolArray:
    """Whether any of the three axes is marked."""
    joined: BoolArray = mask[..., 0] | mask[..., 1] | mask[..., 2]
    return joined


def _encode(words: FloatArray, layout: C3dLayout) -> ByteArray:
    """Turn words into their bytes: (n, bytes of a word) uint8."""
    if layout.storage is Storage.INTEGER:
        stored = np.rint(words).astype(f"{layout.processor.order}i2")
        return stored.view(np.uint8).reshape(-1, 2)
    return encode_floats(words.astype(np.float32), layout.processor).reshape(-1, 4)


def _check_fits(
    words: FloatArray,
    layout: C3dLayout,
    take: Take,
    frames: np.ndarray[tuple[int], np.dtype[np.intp]],
    markers: np.ndarray[tuple[int], np.dtype[np.intp]],
    scale_mm: float,
) -> None:
    """Refuse values that the file's numbers cannot hold."""
    far = too_far(words * scale_mm)
    if far.any():
        at = int(np.argmax(far))
        raise far_away(
            take.labels[markers[at]],
            take.frame_number(int(frames[at])),
            float(words[at] * scale_mm),
        )
    if layout.storage is Storage.INTEGER:
        bad = ~(np.abs(np.rint(words)) <= _LARGEST_STEP)
        limit = f"16-bit integers of {scale_mm:.3g} mm, ±{_LARGEST_STEP * scale_mm:.0f} mm"
    else:
        bad = ~(np.abs(words) < 1e38)
        limit = "32-bit floats"
    if bad.any():
        at = int(np.argmax(bad))
        kind = RangeError if layout.storage is Storage.INTEGER else ExportError
        raise kind(
            f"{take.labels[markers[at]]} at frame {take.frame_number(int(frames[at]))} is at"
            f" {words[at] * scale_mm:.0f} mm, more than this file can hold ({limit}); export it as"
            " a new file with floats."
        )
