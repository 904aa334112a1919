"""What differs between two recordings: samples, parameters, bytes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path

import numpy as np

from markermend.arrays import BoolArray, runs
from markermend.errors import FileFormatError
from markermend.files import read
from markermend.files.c3d_layout import C3dLayout
from markermend.files.c3d_records import Record, record_numbers, record_strings
from markermend.files.diff_lines import LineDifferences, differing_lines
from markermend.progress import Progress, part
from markermend.take import AXES, Take

_CHUNK = 1 << 22
_MOST_RUNS = 10_000
_MOST_VALUES = 6
_TEXT = (".trc", ".csv", ".amc", ".bvh")


@dataclass(frozen=True)
class SampleDifference:
    """Frames in which a marker that both files have is not at the same place.

    Attributes
    ----------
    marker : label, that of the first file where it has another one in the second
    axes : those that differ, a part of ``"xyz"``
    start, stop : half-open interval of frame numbers as the files count them
    change : ``"moved"``, ``"filled"`` (missing in the first) or ``"removed"`` (in the second)
    largest_mm : greatest distance on one axis; 0 where a sample is missing
    """

    marker: str
    axes: str
    start: int
    stop: int
    change: str
    largest_mm: float


@dataclass(frozen=True)
class ParameterDifference:
    """A parameter that is not the same; text None means that a file does not have it.

    Attributes
    ----------
    name : ``GROUP:PARAMETER``, or a name of our own for what is no parameter (``labels``)
    before, after : its values as text
    """

    name: str
    before: str | None
    after: str | None


@dataclass(frozen=True)
class ByteDifference:
    """A run of bytes that differ.

    Attributes
    ----------
    start, stop : half-open interval of places in the file
    part : ``"header"``, ``"parameters"``, ``"frames"``, ``"rest"``; ``"file"`` if it is not C3D
    """

    start: int
    stop: int
    part: str


@dataclass(frozen=True)
class Comparison:
    """All that differs between two files.

    Attributes
    ----------
    a, b : the files
    renamed : labels in the first and in the second file, of markers that are the same but for it
    samples, parameters, bytes : what differs; of byte runs the first 10,000 are listed, and none
        between files of different formats
    differing_bytes : how many bytes differ in the length that both have
    sizes : of the two files
    bytes_cut : whether there are more runs of bytes than are listed
    lines : what differs line by line, of two files of text of one format that have as many lines;
        runs of bytes are not listed then
    """

    a: Path
    b: Path
    renamed: tuple[tuple[str, str], ...]
    samples: tuple[SampleDifference, ...]
    parameters: tuple[ParameterDifference, ...]
    bytes: tuple[ByteDifference, ...]
    differing_bytes: int
    sizes: tuple[int, int]
    bytes_cut: bool = False
    lines: LineDifferences | None = None

    @property
    def identical(self) -> bool:
        """Whether the files are the same, byte for byte."""
        return not self.differing_bytes and self.sizes[0] == self.sizes[1]


def compare(
    a: str | PathLike[str], b: str | PathLike[str], *, progress: Progress | None = None
) -> Comparison:
    """Find out what differs between two recordings.

    Parameters
    ----------
    a, b : files of any kind that can be read; parameters are compared between C3D files
    progress : told the share done

    Returns
    -------
    Comparison
        samples are compared for markers and frame numbers that both files have, of two skeleton
        recordings that are as long frame by frame whatever they count from; a marker whose
        name only one file has is taken for one of the other file if they are at the same place in
        most of the frames in which either is seen

    Raises
    ------
    FileFormatError
        when one of them cannot be read
    """
    first, second = Path(a), Path(b)
    one = read(first, progress=part(progress, 0.0, 0.4))
    two = read(second, progress=part(progress, 0.4, 0.8))
    layouts = [take.source.layout if take.source is not None else None for take in (one, two)]
    paired = two
    if one.skeleton and two.skeleton and one.frames == two.frames:
        # An AMC counts its frames from 1, tables of joints and BVH from 0.
        paired = replace(two, first_frame=one.first_frame)
    renamed = _renamed(one, paired)
    parameters = list(_facts(one, two, renamed))
    if isinstance(layouts[0], C3dLayout) and isinstance(layouts[1], C3dLayout):
        parameters += _parameters(layouts[0], layouts[1])
    report = part(progress, 0.8, 1.0)
    report(0.0, "Comparing bytes")
    differing, found, cut = _bytes(first, second, layouts[0])
    lines = None
    if _format(one) == _format(two) and first.suffix.lower() in _TEXT:
        lines = differing_lines(first, second)
    if _format(one) != _format(two) or lines is not None:
        found, cut = (), False
    sizes = (first.stat().st_size, second.stat().st_size)
    samples = tuple(_samples(one, paired, renamed))
    return Comparison(
        first,
        second,
        tuple(renamed.items()),
        samples,
        tuple(parameters),
        found,
        differing,
        sizes,
        cut,
        lines,
    )


def _format(take: Take) -> tuple[str, str]:
    """What kind of file a take was read from; of skeleton recordings the ending tells which."""
    if take.source is None:
        return "", ""
    return take.source.format, take.source.path.suffix.lower() if take.skeleton else ""


def _shared(one: Take, two: Take) -> tuple[int, int, list[slice]]:
    """First frame number that both have, the one after the last, and their rows in each."""
    start = max(one.first_frame, two.first_frame)
    stop = max(start, min(one.first_frame + one.frames, two.first_frame + two.frames))
    return start, stop, [slice(start - t.first_frame, stop - t.first_frame) for t in (one, two)]


def _renamed(one: Take, two: Take) -> dict[str, str]:
    """Labels of the second take by those of the first, of markers that only changed their name."""
    _, _, rows = _shared(one, two)
    found: dict[str, str] = {}
    gained = [s for s in two.labels if s not in one]
    for old in (s for s in one.labels if s not in two):
        before = one.positions[rows[0], one.index(old)]
        for new in gained:
            after = two.positions[rows[1], two.index(new)]
            seen = ~np.isnan(before[:, 0]) | ~np.isnan(after[:, 0])
            if 2 * int((before == after).all(axis=1).sum()) > max(1, int(seen.sum())):
                found[old] = new
                gained.remove(new)
                break
    return found


def _samples(one: Take, two: Take, renamed: Mapping[str, str]) -> Iterator[SampleDifference]:
    """Intervals in which markers of both takes differ, marker by marker."""
    start, stop, rows = _shared(one, two)
    if start >= stop:
        return
    for label in one.labels:
        other = renamed.get(label, label)
        if other not in two:
            continue
        before = one.positions[rows[0], one.index(label)]
        after = two.positions[rows[1], two.index(other)]
        gone, absent = np.isnan(before[:, 0]), np.isnan(after[:, 0])
        moved = ~gone & ~absent & (before != after).any(axis=1)
        changes: tuple[tuple[str, BoolArray], ...] = (
            ("moved", moved),
            ("filled", gone & ~absent),
            ("removed", ~gone & absent),
        )
        for change, mask in changes:
            for a, b in runs(mask).tolist():
                step = np.abs(after[a:b] - before[a:b])
                axes = AXES
                if change == "moved":
                    axes = "".join(AXES[i] for i in np.flatnonzero((step > 0).any(axis=0)))
                largest = float(step.max()) if change == "moved" else 0.0
                yield SampleDifference(label, axes, start + a, start + b, change, largest)


def _facts(one: Take, two: Take, renamed: Mapping[str, str]) -> Iterator[ParameterDifference]:
    """What the takes themselves tell: labels, frames, rate, events, analog channels."""
    lost = [s for s in one.labels if s not in two and s not in renamed]
    gained = [s for s in two.labels if s not in one and s not in renamed.values()]
    if lost or gained:
        yield ParameterDifference("markers", ", ".join(lost) or None, ", ".join(gained) or None)
    for name, a, b in (
        ("frames", _frames(one), _frames(two)),
        ("rate", f"{one.rate:g} Hz", f"{two.rate:g} Hz"),
        ("events", _events(one), _events(two)),
        ("analog", _analog(one), _analog(two)),
    ):
        if a != b:
            yield ParameterDifference(name, a, b)
    same_shape = one.analog is not None and two.analog is not None
    if same_shape and one.analog is not None and two.analog is not None:
        values = one.analog.values, two.analog.values
        if values[0].shape == values[1].shape and not np.array_equal(*values, equal_nan=True):
            number = int(np.count_nonzero(values[0] != values[1]))
            yield ParameterDifference("analog samples", None, f"{number} differ")


def _frames(take: Take) -> str:
    """Numbers of the first and the last frame."""
    return f"{take.first_frame}–{take.frame_number(take.frames - 1)}"


def _events(take: Take) -> str:
    """Events in one line."""
    return ", ".join(f"{e.context} {e.label} {e.time_s:.3f} s".strip() for e in take.events)


def _analog(take: Take) -> str | None:
    """Channels in one line."""
    if take.analog is None:
        return None
    return f"{len(take.analog.labels)} channels at {take.analog.rate:g} Hz"


def _parameters(one: C3dLayout, two: C3dLayout) -> Iterator[ParameterDifference]:
    """Parameters whose type, sizes, values, description or lock differ."""
    first, second = ({_name(r): r for r in reversed(x.records)} for x in (one, two))
    for name in dict.fromkeys((*map(_name, one.records), *map(_name, two.records))):
        a, b = first.get(name), second.get(name)
        if a is not None and b is not None and _content(a, one) == _content(b, two):
            continue
        before = None if a is None else _text(a, one)
        after = None if b is None else _text(b, two)
        if before == after and a is not None and b is not None:
            before, after = (f"{before} {_nature(r)}" for r in (a, b))
        yield ParameterDifference(name, before, after)


def _name(record: Record) -> str:
    """``GROUP:PARAMETER``, or the group alone."""
    return f"{record.group}:{record.name}" if record.name else record.group


def _content(record: Record, layout: C3dLayout) -> tuple[object, ...]:
    """What makes two parameters the same, whatever the processor."""
    values = (
        record.data
        if record.kind in (-1, 1)
        else record_numbers(record, layout.processor).tobytes()
    )
    return record.kind, record.dims, values, record.description, record.locked


def _nature(record: Record) -> str:
    """Type, sizes and lock of a parameter."""
    return f"(type {record.kind}, sizes {record.dims}{', locked' if record.locked else ''})"


def _text(record: Record, layout: C3dLayout) -> str:
    """Values of a parameter in one short line."""
    if not record.name:
        return "group"
    values: Sequence[object] = record_strings(record) or [
        f"{v:g}" for v in record_numbers(record, layout.processor)
    ]
    shown = ", ".join(str(v) for v in values[:_MOST_VALUES])
    return shown + (f"… ({len(values)})" if len(values) > _MOST_VALUES else "")


def _bytes(a: Path, b: Path, layout: object) -> tuple[int, tuple[ByteDifference, ...], bool]:
    """Count the bytes that differ in the length both have, and list their first runs.

    Returns
    -------
    how many bytes, their runs, and whether there are more of these
    """
    found: list[ByteDifference] = []
    total = at = 0
    borders = _borders(layout)
    try:
        with a.open("rb") as one, b.open("rb") as two:
            while True:
                left, right = one.read(_CHUNK), two.read(_CHUNK)
                length = min(len(left), len(right))
                if not length:
                    break
                differs = np.frombuffer(left, np.uint8, length) != np.frombuffer(
                    right, np.uint8, length
                )
                total += int(np.count_nonzero(differs))
                # One more than are listed tells that the list is not whole.
                if len(found) <= _MOST_RUNS:
                    for start, stop in runs(differs)[: _MOST_RUNS + 1 - len(found)].tolist():
                        found += _split(at + start, at + stop, borders)
                at += length
    except OSError as error:
        raise FileFormatError(f"The files could not be compared: {error.strerror}.") from error
    return total, tuple(found[:_MOST_RUNS]), len(found) > _MOST_RUNS


def _borders(layout: object) -> tuple[tuple[int, str], ...]:
    """Where the parts of a file begin."""
    if not isinstance(layout, C3dLayout):
        return ((0, "file"),)
    end = layout.data + layout.frames * layout.stride
    return ((0, "header"), (512, "parameters"), (layout.data, "frames"), (end, "rest"))


def _split(start: int, stop: int, borders: Sequence[tuple[int, str]]) -> list[ByteDifference]:
    """Cut a run at the borders of the file's parts."""
    ends = [place for place, _ in borders[1:]] + [stop]
    pieces = []
    for (begin, name), end in zip(borders, ends, strict=True):
        a, b = max(start, begin), min(stop, max(end, begin))
        if a < b:
            pieces.append(ByteDifference(a, b, name))
    return pieces
