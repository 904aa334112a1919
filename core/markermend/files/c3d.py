"""Read C3D files: every processor and storage, odd and damaged ones as far as they go."""

from __future__ import annotations

import os
import struct
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import ByteArray, Float32Array, FloatArray
from markermend.files.c3d_events import read_events
from markermend.files.c3d_layout import C3dLayout, Storage, parse_layout
from markermend.files.c3d_points import kinds_of, units_of
from markermend.files.c3d_samples import (
    Plan,
    blocks,
    decode_positions,
    decode_residuals,
    invalid,
    quads_of,
    words_of,
)
from markermend.files.labels import unique_labels
from markermend.files.units import unit_mm
from markermend.progress import Progress, quiet
from markermend.take import Analog, Points, Source, Take

# Without a unit: no capture volume is smaller than this in mm, none larger in metres.
_LARGEST_METRES = 50.0
_HEAD = 1 << 18


def read_c3d(path: Path, *, progress: Progress | None = None) -> Take:
    """Read a C3D file.

    Parameters
    ----------
    path : the file
    progress : told the share of frames read

    Returns
    -------
    Take
        positions in mm. A sample is missing where its residual word is negative, where all three
        coordinates are zero, not finite, or beyond 100 km. Points that the file lists as angles,
        forces and the like are in ``points``. ``read_only`` is set when the file is cut short.

    Raises
    ------
    FileFormatError
        when the file is empty, not C3D, or holds no frame
    """
    with path.open("rb", buffering=0) as file:
        status = os.fstat(file.fileno())
        layout = parse_layout(read_head(file, status.st_size), status.st_size, path.name)
        contents = _read_contents(file, layout, progress or quiet)
    layout = contents.plan.layout
    labels, kinds = name_points(layout)
    source = Source(
        path=path.absolute(),
        format="c3d",
        size=status.st_size,
        mtime_ns=status.st_mtime_ns,
        columns=contents.plan.columns,
        scale_mm=contents.plan.scale_mm,
        layout=layout,
    )
    others = tuple(i for i, kind in enumerate(kinds) if kind)
    return Take(
        positions=contents.positions,
        labels=tuple(labels[i] for i in contents.plan.columns),
        rate=layout.rate,
        first_frame=layout.first_frame,
        residuals=contents.residuals,
        cameras=contents.cameras,
        events=read_events(layout),
        analog=contents.analog,
        points=Points(
            values=contents.others,
            labels=tuple(labels[i] for i in others),
            kinds=tuple(kinds[i] for i in others),
            columns=others,
            units=units_of(lambda name: layout.strings("POINT", name), kinds),
        )
        if others
        else None,
        source=source,
        warnings=layout.warnings + tuple(contents.oddities),
        read_only=layout.truncated,
        info=MappingProxyType(_info(layout, contents)),
    )


def read_head(file: IO[bytes], size: int) -> bytes:
    """Read as much of a file's beginning as its header and parameters may need."""
    head = file.read(min(size, _HEAD))
    if len(head) >= 18:
        block = max(struct.unpack_from(f"{order}H", head, 16)[0] for order in "<>")
        while len(head) < min(size, 512 * block):
            more = file.read(min(size, 512 * block) - len(head))
            if not more:
                break
            head += more
    return head


def name_points(layout: C3dLayout) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Label and kind of every point of a file; an empty kind is a marker."""
    labels, _ = unique_labels(layout.strings("POINT", "LABELS"), layout.points)
    return labels, kinds_of(lambda name: layout.strings("POINT", name), labels)


@dataclass
class _Contents:
    """What the frames of a file hold."""

    plan: Plan
    positions: FloatArray
    others: FloatArray
    residuals: Float32Array | None
    cameras: ByteArray | None
    analog: Analog | None
    oddities: list[str]
    missing: int = 0
    unsigned: int = 0
    by_zero: int = 0
    nowhere: int = 0


def _read_contents(file: IO[bytes], layout: C3dLayout, progress: Progress) -> _Contents:
    """Decode all frames; a second time where the residuals turn out to mean nothing."""
    _, kinds = name_points(layout)
    oddities: list[str] = []
    _, repeated = unique_labels(layout.strings("POINT", "LABELS"), layout.points)
    if repeated:
        some = ", ".join(repeated[:4]) + ("…" if len(repeated) > 4 else "")
        oddities.append(f"Labels that occur more than once were numbered: {some}.")
    columns = tuple(i for i, kind in enumerate(kinds) if not kind)
    scale_mm = _unit(file, layout, oddities) * layout.scale
    plan = Plan(layout, columns, scale_mm)
    contents, seen, placed = _decode(file, plan, oddities, progress)
    if placed and not seen:
        oddities.append(
            "The file marks every sample as invalid, yet has coordinates; they were read as valid."
        )
        plan = replace(plan, layout=replace(layout, residuals_hold=False))
        contents, _, _ = _decode(file, plan, oddities, progress)
        contents.residuals = contents.cameras = None
    if contents.unsigned:
        oddities.append(
            f"{contents.unsigned} samples have the residual word 65535, which is -1 without its"
            " sign; they were read as missing."
        )
    if contents.by_zero:
        oddities.append(
            f"{contents.by_zero} samples at exactly (0, 0, 0) with a valid residual were read as"
            " missing."
        )
    if contents.nowhere:
        oddities.append(
            f"{contents.nowhere} samples whose coordinates are no numbers, or farther out than any"
            " room, were read as missing."
        )
    return contents


def _decode(
    file: IO[bytes], plan: Plan, oddities: list[str], progress: Progress
) -> tuple[_Contents, bool, bool]:
    """Decode all frames, and tell whether any sample counts as seen, and any has coordinates."""
    layout = plan.layout
    frames, markers = layout.frames, len(plan.columns)
    others = np.setdiff1d(np.arange(layout.points), plan.columns)
    contents = _Contents(
        plan=plan,
        positions=np.empty((frames, markers, 3)),
        others=np.empty((frames, len(others), 3)),
        residuals=np.empty((frames, markers), dtype=np.float32),
        cameras=np.empty((frames, markers), dtype=np.uint8),
        analog=None,
        oddities=oddities,
    )
    assert contents.residuals is not None
    assert contents.cameras is not None
    channels = _Channels.of(layout) if layout.channels else None
    seen = placed = False
    for start, stop, raw in blocks(file, layout):
        progress(start / frames, "Reading frames")
        words = words_of(raw, layout)
        quads = quads_of(words, layout)
        missing, stored = decode_positions(quads, plan, contents.positions[start:stop])
        residuals, cameras = decode_residuals(
            stored[..., 3], plan.scale_mm / layout.scale * layout.residual_scale
        )
        contents.missing += int(np.count_nonzero(missing))
        residuals[missing] = np.nan
        cameras[missing] = 0
        with np.errstate(over="ignore"):
            contents.residuals[start:stop] = residuals
        contents.cameras[start:stop] = cameras
        if layout.residuals_hold:
            marked = invalid(stored[..., 3])
            unmarked = stored[missing & ~marked][:, :3]
            by_zero = int(np.count_nonzero((unmarked == 0).all(axis=1)))
            contents.by_zero += by_zero
            contents.nowhere += len(unmarked) - by_zero
            contents.unsigned += int(np.count_nonzero(marked & (stored[..., 3] > 0)))
        seen = seen or not missing.all()
        placed = placed or bool((stored[..., :3] < 0).any() or (stored[..., :3] > 0).any())
        if len(others):
            seen |= _decode_others(quads[:, others], layout, contents.others[start:stop])
        if channels is not None:
            channels.decode(words[:, 4 * layout.points :], start, stop)
    if channels is not None:
        contents.analog = channels.finish()
    contents.others.flags.writeable = False
    return contents, seen, placed


def _decode_others(stored: NDArray[Any], layout: C3dLayout, out: FloatArray) -> bool:
    """Decode points that are not markers, in the file's units; tell whether any is there."""
    with np.errstate(invalid="ignore"):
        np.multiply(stored[..., :3], layout.scale, out=out, dtype=np.float64)
    missing = ~np.isfinite(out).all(axis=2)
    if layout.residuals_hold:
        missing |= invalid(stored[..., 3])
    out[missing] = np.nan
    return not missing.all()


@dataclass
class _Channels:
    """Analog channels on their way from stored words to units."""

    layout: C3dLayout
    values: Float32Array
    offsets: FloatArray
    scales: FloatArray
    unsigned: bool

    @staticmethod
    def of(layout: C3dLayout) -> _Channels:
        """Prepare scales and offsets; what the file does not tell is 1 and 0."""
        count = layout.channels
        unsigned = layout.analog_unsigned
        general = layout.number("ANALOG", "GEN_SCALE", 1.0)
        offsets = _filled(layout.numbers("ANALOG", "OFFSET", unsigned=unsigned), count, 0.0)
        scales = _filled(layout.numbers("ANALOG", "SCALE"), count, 1.0)
        samples = layout.frames * layout.analog_per_frame
        values = np.empty((samples, count), dtype=np.float32)
        scales = scales * (general if np.isfinite(general) else 1.0)
        return _Channels(layout, values, offsets, scales, unsigned)

    def decode(self, words: NDArray[Any], start: int, stop: int) -> None:
        """Decode the analog words of some frames."""
        if self.unsigned and self.layout.storage is Storage.INTEGER:
            words = words.view(words.dtype.str.replace("i2", "u2"))
        each = self.layout.analog_per_frame
        part = words.reshape(-1, len(self.scales))
        with np.errstate(over="ignore", invalid="ignore"):
            self.values[start * each : stop * each] = (part - self.offsets) * self.scales

    def finish(self) -> Analog:
        """Return the channels with their names."""
        count = len(self.scales)
        self.values.flags.writeable = False
        units = self.layout.strings("ANALOG", "UNITS")
        return Analog(
            values=self.values,
            labels=unique_labels(self.layout.strings("ANALOG", "LABELS"), count)[0],
            units=tuple(units[i] if i < len(units) else "" for i in range(count)),
            rate=self.layout.rate * self.layout.analog_per_frame,
        )


def _filled(stated: FloatArray, count: int, default: float) -> FloatArray:
    """Cut or lengthen to ``count`` values; what is not finite is the default."""
    values = np.full(count, default)
    n = min(count, len(stated))
    values[:n] = np.where(np.isfinite(stated[:n]), stated[:n], default)
    return values


def _unit(file: IO[bytes], layout: C3dLayout, oddities: list[str]) -> float:
    """Millimetres of the file's unit; guessed from the size of things where it is not told."""
    name = layout.text("POINT", "UNITS")
    known = unit_mm(name)
    if known is not None or not layout.points:
        return known or 1.0
    told = f"an unknown unit of length (“{name}”)" if name else "no unit of length"
    for _, _, raw in blocks(file, layout):
        quads = quads_of(words_of(raw, layout), layout)
        with np.errstate(invalid="ignore"):
            xyz = np.abs(quads[..., :3] * layout.scale)
        sizes = xyz[(xyz > 0) & (xyz < 1e6)]
        if len(sizes):
            metres = float(np.percentile(sizes, 95)) < _LARGEST_METRES
            guess = "metres" if metres else "millimetres"
            oddities.append(f"The file tells {told}; by the size of things {guess} were assumed.")
            return 1000.0 if metres else 1.0
    oddities.append(f"The file tells {told}; millimetres were assumed.")
    return 1.0


def _info(layout: C3dLayout, contents: _Contents) -> dict[str, str]:
    """What else the file tells."""
    missing, coding = contents.missing, []
    if not layout.residuals_hold or contents.residuals is None:
        coding.append("far-off coordinates or (0, 0, 0); residuals mean nothing")
    else:
        negative = missing - contents.by_zero - contents.nowhere - contents.unsigned
        if negative:
            coding.append(f"negative residual ({negative} samples)")
        if contents.unsigned:
            coding.append(f"residual word 65535, read as -1 ({contents.unsigned} samples)")
        if contents.by_zero:
            coding.append(f"(0, 0, 0) with a valid residual ({contents.by_zero} samples)")
        if contents.nowhere:
            coding.append(f"no place in a room ({contents.nowhere} samples)")
    named = {
        "manufacturer": ("MANUFACTURER", "COMPANY"),
        "software": ("MANUFACTURER", "SOFTWARE"),
        "version": ("MANUFACTURER", "VERSION_LABEL"),
        "x_screen": ("POINT", "X_SCREEN"),
        "y_screen": ("POINT", "Y_SCREEN"),
        "subject": ("SUBJECTS", "NAMES"),
    }
    told = {key: layout.text(*where) for key, where in named.items()}
    info = {
        "processor": {84: "Intel", 85: "DEC", 86: "MIPS"}[int(layout.processor)],
        "storage": "16-bit integers" if layout.storage is Storage.INTEGER else "32-bit floats",
        "units": layout.text("POINT", "UNITS"),
        "missing_samples": "; ".join(coding) if missing else "none",
        "force_plates": str(layout.count("FORCE_PLATFORM", "USED")),
    }
    if layout.storage is Storage.INTEGER:
        info["step_mm"] = f"{contents.plan.scale_mm:.6g}"
    return info | {key: text for key, text in told.items() if text}
