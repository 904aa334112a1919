"""One recording: the container every function takes and returns."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from enum import IntEnum
from functools import cached_property
from numbers import Integral, Real
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from markermend.arrays import BoolArray, ByteArray, Float32Array, FloatArray
from markermend.errors import DataError
from markermend.take_checks import check_samples, checked_labels, checked_missing

if TYPE_CHECKING:
    import pandas
    import xarray

AXES = "xyz"
SKELETON = "skeleton"


class Origin(IntEnum):
    """Where a sample comes from, kept per frame and marker."""

    MISSING = 0
    MEASURED = 1
    FILLED = 2
    EDITED = 3


@dataclass(frozen=True)
class Event:
    """A named moment in the recording (foot strike, foot off…).

    Attributes
    ----------
    label : as written in the file, for example ``"Foot Strike"``
    time_s : seconds on the file's own clock (frame ``f`` is at ``(f - 1) / rate``)
    context : side or subject it belongs to, ``"Left"``, ``"Right"``, ``"General"`` or empty
    """

    label: str
    time_s: float
    context: str = ""


@dataclass(frozen=True)
class Analog:
    """Analog channels recorded beside the markers, in the file's own units.

    Attributes
    ----------
    values : (samples, channels) float32, read-only
    labels, units : one per channel
    rate : samples per second
    """

    values: Float32Array
    labels: tuple[str, ...]
    units: tuple[str, ...]
    rate: float

    def __repr__(self) -> str:
        samples, channels = self.values.shape
        return f"<Analog {channels} channels, {samples} samples at {self.rate:g} Hz>"


@dataclass(frozen=True)
class Points:
    """Points of the file that are not markers: angles, forces, moments, powers, scalars, models.

    Attributes
    ----------
    values : (frames, points, 3) float64 in the file's own units, NaN where absent
    labels : one per point
    kinds : one per point, for example ``"angle"``, ``"force"``, ``"moment"``, ``"power"``,
        ``"scalar"``, ``"modelled"``
    columns : position of each point in the file's own point list
    units : by kind, for people; no entry where the file tells none
    """

    values: FloatArray
    labels: tuple[str, ...]
    kinds: tuple[str, ...]
    columns: tuple[int, ...]
    units: Mapping[str, str] = field(default_factory=dict)

    def __repr__(self) -> str:
        counts = Counter(self.kinds)
        return f"<Points {', '.join(f'{n} {kind}' for kind, n in counts.items())}>"


@dataclass(frozen=True)
class Source:
    """The file a take was read from, and what is needed to patch it on export.

    Attributes
    ----------
    path : absolute path
    format : ``"c3d"``, ``"trc"``, ``"csv"``, ``"skeleton"``…
    size, mtime_ns : of the file when it was read, to notice later changes
    columns : position of each marker in the file's own point list, -1 for one added since
    scale_mm : millimetres per file unit
    layout : the format's own description of the file (for C3D a ``C3dLayout``, for a skeleton
        recording the ``Pose``)
    """

    path: Path
    format: str
    size: int
    mtime_ns: int
    columns: tuple[int, ...] = ()
    scale_mm: float = 1.0
    layout: object | None = None


@dataclass(frozen=True, eq=False)
class Take:
    """One optical recording, immutable.

    Attributes
    ----------
    positions : (frames, markers, 3) float64, mm, C order; NaN in all three coordinates where the
        marker was not seen. The array is handed over and becomes read-only; what has another type
        or order, or is a part of another array, is copied
    labels : one per marker, unique, kept as a tuple; a prefix ``Subject:`` names the body it
        belongs to
    rate : frames per second
    first_frame : the file's number of index 0 (C3D counts from 1)
    residuals : (frames, markers) float32 in mm, or None; the file's own reconstruction residual,
        NaN where the marker was not seen
    cameras : (frames, markers) uint8 number of cameras that saw the marker, or None
    origin : (frames, markers) uint8, see :class:`Origin`; worked out from NaN when not given
    events, analog, points : what else the file holds
    source : the file it came from, or None
    warnings : one sentence for each oddity met while reading
    read_only : the file is damaged; it may be looked at but not exported over
    info : what else the file tells, name to text (system, manufacturer, how missing is coded…)

    Raises
    ------
    DataError
        when shapes, labels, rate or first frame do not fit together, also those of origin,
        residuals and cameras, and for positions that are infinite or no numbers
    """

    positions: FloatArray
    labels: tuple[str, ...]
    rate: float
    first_frame: int = 1
    residuals: Float32Array | None = None
    cameras: ByteArray | None = None
    origin: ByteArray = field(default_factory=lambda: np.empty((0, 0), dtype=np.uint8))
    events: tuple[Event, ...] = ()
    analog: Analog | None = None
    points: Points | None = None
    source: Source | None = None
    warnings: tuple[str, ...] = ()
    read_only: bool = False
    info: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))

    def __post_init__(self) -> None:
        try:
            positions = np.ascontiguousarray(self.positions, dtype=np.float64)
        except (TypeError, ValueError):
            raise DataError("Positions must be numbers, (frames, markers, 3).") from None
        if isinstance(positions.base, np.ndarray) and positions.base.flags.writeable:
            # A part of a larger array could still be written to by way of that.
            positions = positions.copy()
        if positions.ndim != 3 or positions.shape[2] != 3:
            raise DataError(f"Positions must be (frames, markers, 3), not {positions.shape}.")
        labels = checked_labels(self.labels, positions.shape[1])
        if not (isinstance(self.rate, Real) and np.isfinite(self.rate) and self.rate > 0):
            raise DataError(f"The frame rate must be positive, not {self.rate}.")
        missing = checked_missing(positions)
        if not isinstance(self.first_frame, Integral):
            raise DataError(f"The first frame is a whole number, not {self.first_frame!r}.")
        origin = self.origin
        if origin is None or np.size(origin) == 0:
            # Not missing is 1, which is Origin.MEASURED.
            origin = (~missing).astype(np.uint8)
        for name, array in (
            ("Origin", origin),
            ("Residuals", self.residuals),
            ("Cameras", self.cameras),
        ):
            if array is not None:
                check_samples(name, array, positions.shape[:2])
                array.flags.writeable = False
        positions.flags.writeable = False
        object.__setattr__(self, "positions", positions)
        object.__setattr__(self, "labels", labels)
        object.__setattr__(self, "origin", origin)

    def __reduce__(self) -> tuple[Any, ...]:
        # A read-only mapping cannot be pickled, and takes go to worker processes.
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        return _take_from, (values | {"info": dict(self.info)},)

    @property
    def frames(self) -> int:
        """Number of frames."""
        return int(self.positions.shape[0])

    @property
    def markers(self) -> int:
        """Number of markers."""
        return int(self.positions.shape[1])

    @property
    def skeleton(self) -> bool:
        """Whether its markers are the joints of a skeleton recording."""
        return self.source is not None and self.source.format == SKELETON

    @property
    def duration_s(self) -> float:
        """Length in seconds."""
        return self.frames / self.rate

    @cached_property
    def present(self) -> BoolArray:
        """(frames, markers) bool, read-only: the marker has a position in that frame."""
        present = ~np.isnan(self.positions[:, :, 0])
        present.flags.writeable = False
        return present

    @cached_property
    def _column(self) -> dict[str, int]:
        return {label: i for i, label in enumerate(self.labels)}

    def index(self, label: str) -> int:
        """Column of a marker.

        Raises
        ------
        DataError
            when the take has no marker of that name
        """
        try:
            return self._column[label]
        except (KeyError, TypeError):
            raise DataError(self._no_marker(label)) from None

    def _no_marker(self, label: str) -> str:
        """Say that there is no such marker, and which one may be meant."""
        from difflib import get_close_matches

        who = "The take" if self.source is None else self.source.path.name
        near = get_close_matches(str(label).casefold(), [s.casefold() for s in self.labels], 1)
        meant = next((s for s in self.labels if [s.casefold()] == near), None)
        hint = f"is “{meant}” meant?" if meant else "“markermend info” lists its markers."
        return f"{who} has no marker called “{label}”; {hint}"

    def __contains__(self, label: str) -> bool:
        return label in self._column

    def __repr__(self) -> str:
        seen = f", {self.present.mean():.1%} seen" if self.present.size else ""
        name = f"“{self.source.path.name}”: " if self.source else ""
        return (
            f"<Take {name}{self.frames} frames at {self.rate:g} Hz ({self.duration_s:.1f} s), "
            f"{self.markers} markers{seen}>"
        )

    def to_xarray(
        self, layout: Literal["movement", "pyomeca"] = "movement"
    ) -> xarray.Dataset | xarray.DataArray:
        """Lay the take out as a labelled array; see :func:`markermend.exchange.to_xarray`."""
        from markermend.exchange import to_xarray

        return to_xarray(self, layout)

    @classmethod
    def from_xarray(cls, data: xarray.Dataset | xarray.DataArray) -> Take:
        """Make a take of a labelled array; see :func:`markermend.exchange.from_xarray`."""
        from markermend.exchange import from_xarray

        return from_xarray(data)

    def to_dataframe(
        self, layout: Literal["wide", "long", "kineticstoolkit"] = "wide"
    ) -> pandas.DataFrame:
        """Lay the take out as a table; see :func:`markermend.exchange.to_dataframe`."""
        from markermend.exchange import to_dataframe

        return to_dataframe(self, layout)

    @cached_property
    def named(self) -> tuple[int, ...]:
        """Columns of the markers that have a name; unlabelled trajectories have none."""
        return tuple(i for i, label in enumerate(self.labels) if not is_unlabelled(label))

    def subject(self, label: str) -> str:
        """Body a marker belongs to: the part before the colon, or empty."""
        return label.rpartition(":")[0]

    @property
    def subjects(self) -> tuple[str, ...]:
        """Bodies in the take, in order of first marker; unlabelled markers have none."""
        seen = dict.fromkeys(self.subject(s) for s in self.labels if not is_unlabelled(s))
        return tuple(seen)

    def frame_number(self, index: int) -> int:
        """The number people read for a frame index: ``first_frame + index``."""
        return self.first_frame + index

    def frame_numbers(self, start: int, stop: int) -> tuple[int, int]:
        """The numbers people read for the first and the last frame of a half-open interval."""
        return self.frame_number(start), self.frame_number(stop - 1)

    def frame_at(self, event: Event) -> float:
        """Frame index at which an event happened, not rounded; it may lie outside the take."""
        return event.time_s * self.rate + 1 - self.first_frame

    def with_positions(self, positions: FloatArray, origin: ByteArray) -> Take:
        """Return the same recording with other samples; everything else is kept."""
        return replace(self, positions=positions, origin=origin)

    def renamed(self, names: Mapping[str, str]) -> Take:
        """Return the same recording with other marker names, new by old; it costs nothing.

        Raises
        ------
        DataError
            when there is no such marker, a name is empty, or two points would have the same
        """
        for label in names:
            self.index(label)
        labels = tuple(names.get(label, label) for label in self.labels)
        others = self.points.labels if self.points is not None else ()
        for new in names.values():
            if not new.strip():
                raise DataError("A name cannot be empty.")
            if labels.count(new) + others.count(new) > 1:
                raise DataError(f"There is a “{new}” already; choose another name.")
        view = object.__new__(type(self))
        view.__dict__.update(self.__dict__, labels=labels)
        view.__dict__.pop("_column", None)
        return view

    def viewing(self, positions: FloatArray, origin: ByteArray) -> Take:
        """Return the same recording over other arrays that are known to be valid.

        Nothing is checked or copied, so that it costs nothing on the longest take; a session,
        whose edits keep its samples valid, looks at its working copy in this way.

        Parameters
        ----------
        positions : (frames, markers, 3) float64, mm, read-only
        origin : (frames, markers) uint8, read-only
        """
        # Not copy.copy, which would go through pickling and check every sample again.
        view = object.__new__(type(self))
        view.__dict__.update(self.__dict__, positions=positions, origin=origin)
        view.__dict__.pop("present", None)
        return view


def _take_from(values: dict[str, Any]) -> Take:
    """Make a take that was pickled."""
    return Take(**(values | {"info": MappingProxyType(values["info"])}))


def is_unlabelled(label: str) -> bool:
    """Whether a trajectory has no name of its own (``*12``, ``Unlabeled 3``, ``U_7``…)."""
    name = label.rpartition(":")[2].strip().lower()
    stem = name.lstrip("*").replace(" ", "").replace("_", "")
    if not name or name.startswith("*"):
        return True
    for word in ("unlabeled", "unlabelled", "unnamed", "uname", "u"):
        if stem.startswith(word) and stem[len(word) :].isdigit():
            return True
    return stem in {"unlabeled", "unlabelled", "unnamed"}
