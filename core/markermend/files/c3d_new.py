"""Write a C3D file for a take that has no C3D source: simulated, or read from TRC or CSV."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import IO

import numpy as np

import markermend
from markermend.arrays import BoolArray, Float32Array, FloatArray
from markermend.errors import ExportError
from markermend.files.c3d_build import (
    FLOAT,
    GROUP,
    INTEGER,
    check_names,
    cut_text,
    event_records,
    group_record,
    header_bytes,
    number_records,
    scalar_record,
    section_bytes,
    text_records,
)
from markermend.files.c3d_numbers import Processor
from markermend.files.c3d_records import BLOCK
from markermend.files.c3d_samples import far_away, too_far
from markermend.progress import Progress
from markermend.take import Take

_INTEL = Processor.INTEL
_BLOCK_FRAMES = 2048
_MOST = 0xFFFF
# Numbers of frames are pairs of 16-bit words.
_LAST_FRAME = 0xFFFFFFFF
_LARGEST = float(np.finfo(np.float32).max)
_LISTS = {
    "angle": "ANGLES",
    "force": "FORCES",
    "moment": "MOMENTS",
    "power": "POWERS",
    "scalar": "SCALARS",
    "reaction": "REACTIONS",
}


def write_new(
    take: Take, file: IO[bytes], progress: Progress, *, notes: Mapping[str, Sequence[str]]
) -> None:
    """Write a take as a C3D file of its own: Intel order, floats, millimetres.

    Parameters
    ----------
    take : any take; its markers come first, then its other points, then its analog channels
    file : written from its beginning
    progress : told the share of frames written
    notes : texts for the MARKERMEND group, by parameter

    Raises
    ------
    ExportError
        when the take has more points or samples a frame than a C3D file can hold, frame numbers or
        names that it cannot, or coordinates that would be read as missing
    """
    if take.first_frame < 0:
        raise ExportError(
            f"A C3D counts frames from 0, and this take begins with frame {take.first_frame};"
            " write a TRC or CSV."
        )
    if take.frame_number(take.frames - 1) > _LAST_FRAME:
        raise ExportError(
            f"A C3D counts frames up to {_LAST_FRAME:,}, and this take begins with frame"
            f" {take.first_frame:,}; write a TRC or CSV."
        )
    others = take.points.labels if take.points else ()
    points = take.markers + len(others)
    channels, each = _analog_shape(take)
    if points > _MOST or channels * each > _MOST:
        raise ExportError(
            f"{points} points and {channels * each} analog samples a frame are more than a C3D"
            " file can hold (65,535); drop some first."
        )
    check_names((*take.labels, *others))
    residual_scale = _residual_scale(take)
    records = _records(take, (*take.labels, *others), channels, each, residual_scale, 0, notes)
    section = section_bytes(records, _INTEL, "The take")
    data_block = 2 + len(section) // BLOCK
    records = _records(
        take, (*take.labels, *others), channels, each, residual_scale, data_block, notes
    )
    file.write(
        header_bytes(
            b"",
            _INTEL,
            points=points,
            analog_words=channels * each,
            analog_per_frame=each,
            first_frame=take.first_frame,
            frames=take.frames,
            scale=-residual_scale,
            data_block=data_block,
            rate=take.rate,
        )
    )
    file.write(section_bytes(records, _INTEL, "The take"))
    for start in range(0, take.frames, _BLOCK_FRAMES):
        progress(start / take.frames, "Writing frames")
        stop = min(start + _BLOCK_FRAMES, take.frames)
        file.write(_frames(take, start, stop, residual_scale, channels * each).tobytes())


def _frames(take: Take, start: int, stop: int, residual_scale: float, analog: int) -> Float32Array:
    """Encode some frames: (frames, words)."""
    rows, others = stop - start, take.points.values[start:stop] if take.points else None
    points = take.markers + (others.shape[1] if others is not None else 0)
    words = np.zeros((rows, 4 * points + analog), dtype="<f4")
    quads = words[:, : 4 * points].reshape(rows, points, 4)
    values = take.positions[start:stop]
    if others is not None:
        values = np.concatenate([values, others], axis=1)
    _check_near(take, values, start)
    missing: BoolArray = np.asarray(np.isnan(values).any(axis=2))
    quads[..., :3] = np.where(missing[..., None], 0.0, values)
    own = quads[:, : take.markers, 3]
    if take.residuals is not None:
        steps = np.rint(np.nan_to_num(take.residuals[start:stop]) / residual_scale)
        own += np.clip(steps, 0, 255).astype(np.float32)
    if take.cameras is not None:
        # The mask tells which cameras saw the marker; only their number is known here.
        own += 256.0 * ((1 << np.minimum(take.cameras[start:stop], 7).astype(np.int64)) - 1)
    quads[..., 3] = np.where(missing, -1.0, quads[..., 3])
    if analog and take.analog is not None:
        each = analog // len(take.analog.labels)
        block = take.analog.values[start * each : stop * each]
        words[:, 4 * points :] = block.reshape(rows, analog)
    return words


def _check_near(take: Take, values: FloatArray, start: int) -> None:
    """Refuse coordinates that would be read as missing; other points may be of any size."""
    far = too_far(values)
    if take.points is not None:
        far[:, take.markers :] = np.abs(values[:, take.markers :]) > _LARGEST
    if not far.any():
        return
    frame, point, axis = (int(i) for i in np.argwhere(far)[0])
    number, value = take.frame_number(start + frame), float(values[frame, point, axis])
    if point < take.markers or take.points is None:
        raise far_away(take.labels[point], number, value)
    label = take.points.labels[point - take.markers]
    raise ExportError(
        f"{label} at frame {number} is {value:.3g}, more than the floats of a C3D file can hold;"
        " drop it first."
    )


def _analog_shape(take: Take) -> tuple[int, int]:
    """Number of analog channels, and of samples of each in a frame."""
    if take.analog is None or not take.analog.labels or not take.frames:
        return 0, 0
    samples, channels = take.analog.values.shape
    each, rest = divmod(samples, take.frames)
    if rest or not each:
        raise ExportError(
            f"{samples} analog samples do not divide into {take.frames} frames; drop the channels."
        )
    return channels, each


def _residual_scale(take: Take) -> float:
    """Millimetres of one residual step, so that the largest one fits."""
    if take.residuals is None or not take.present.any():
        return 0.1
    return max(float(np.nanmax(take.residuals, initial=0.0)) / 255.0, 0.01)


def _records(
    take: Take,
    labels: tuple[str, ...],
    channels: int,
    each: int,
    residual_scale: float,
    data_block: int,
    notes: Mapping[str, Sequence[str]],
) -> list[bytes]:
    """Encode the parameters."""
    last = take.first_frame + take.frames - 1
    records = [
        *_point_records(take, labels, residual_scale, data_block),
        *_analog_records(take, channels, each),
        group_record(3, "FORCE_PLATFORM", "", _INTEL),
        _one(3, "USED", INTEGER, 0),
        group_record(4, "TRIAL", "", _INTEL),
        *_numbers(4, "ACTUAL_START_FIELD", INTEGER, [take.first_frame, take.first_frame >> 16]),
        *_numbers(4, "ACTUAL_END_FIELD", INTEGER, [last, last >> 16]),
        _one(4, "CAMERA_RATE", FLOAT, take.rate),
        group_record(5, "MANUFACTURER", "", _INTEL),
        *_texts(5, "COMPANY", ("Markermend",)),
        *_texts(5, "SOFTWARE", ("Markermend",)),
        *_texts(5, "VERSION_LABEL", (markermend.__version__,)),
    ]
    if take.events:
        records.append(group_record(6, "EVENT", "", _INTEL))
        records += event_records(6, take.events, _INTEL)
    if notes:
        records.append(group_record(7, GROUP, "", _INTEL))
        for name, lines in notes.items():
            records += _texts(7, name, tuple(map(cut_text, lines)))
    return records


def _point_records(
    take: Take, labels: tuple[str, ...], residual_scale: float, data_block: int
) -> list[bytes]:
    """Encode the parameters of points."""
    records = [
        group_record(1, "POINT", "", _INTEL),
        _one(1, "USED", INTEGER, len(labels)),
        _one(1, "FRAMES", INTEGER, min(take.frames, _MOST)),
        _one(1, "DATA_START", INTEGER, data_block),
        _one(1, "SCALE", FLOAT, -residual_scale),
        _one(1, "RATE", FLOAT, take.rate),
        *_texts(1, "UNITS", ("mm",)),
        *_texts(1, "LABELS", labels, 4),
        *_texts(1, "DESCRIPTIONS", ("",) * len(labels), 1),
    ]
    if take.frames > _MOST:
        records.append(_one(1, "LONG_FRAMES", FLOAT, take.frames))
    for key, name in (("x_screen", "X_SCREEN"), ("y_screen", "Y_SCREEN")):
        if key in take.info:
            records += _texts(1, name, (take.info[key],))
    for name, listed in _type_lists(take).items():
        records += _texts(1, name, listed)
    return records


def _analog_records(take: Take, channels: int, each: int) -> list[bytes]:
    """Encode the parameters of analog channels."""
    records = [
        group_record(2, "ANALOG", "", _INTEL),
        _one(2, "USED", INTEGER, channels),
        _one(2, "RATE", FLOAT, take.rate * each),
        _one(2, "GEN_SCALE", FLOAT, 1.0),
        *_numbers(2, "SCALE", FLOAT, [1.0] * channels),
        *_numbers(2, "OFFSET", INTEGER, [0] * channels),
    ]
    if take.analog is not None and channels:
        records += _texts(2, "LABELS", take.analog.labels)
        records += _texts(2, "DESCRIPTIONS", ("",) * channels, 1)
        records += _texts(2, "UNITS", take.analog.units, 1)
    return records


def _one(group: int, name: str, kind: int, value: float) -> bytes:
    """Encode a single number."""
    return scalar_record(group, name, kind, value, _INTEL)


def _texts(group: int, name: str, values: tuple[str, ...], length: int = 0) -> list[bytes]:
    """Encode texts."""
    return text_records(group, name, values, _INTEL, length)


def _numbers(group: int, name: str, kind: int, values: list[float]) -> list[bytes]:
    """Encode numbers."""
    return number_records(group, name, kind, values, _INTEL)


def _type_lists(take: Take) -> dict[str, tuple[str, ...]]:
    """Labels of the points that are not markers, by the list that tells their kind, and units."""
    found: dict[str, list[str]] = {}
    if take.points is not None:
        for label, kind in zip(take.points.labels, take.points.kinds, strict=True):
            found.setdefault(_LISTS.get(kind, "MODELED_MARKERS"), []).append(label)
        for kind, unit in take.points.units.items():
            if kind != "modelled":
                found[f"{kind.upper()}_UNITS"] = [unit]
    return {name: tuple(labels) for name, labels in found.items()}
