"""What is wrong with a trajectory, where, and how sure we are."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from enum import StrEnum
from numbers import Integral
from typing import Any

import numpy as np

from markermend.arrays import BoolArray
from markermend.errors import DataError
from markermend.take import AXES, Take

PAIRED = " ↔ "
"""Between the names of markers that change places."""

# Repairs of a mix-up that change both sides; where nothing repaired it, it is of both, too.
_OF_ALL = (None, "", "swap", "skeleton")


class Kind(StrEnum):
    """Class of an artifact, named as in skurowski2022, section 2.1."""

    GAP = "gap"
    PEAK = "peak"
    NOISE = "noise"
    STEP = "step"
    SLOW = "slow"


class Status(StrEnum):
    """What the operator decided about an artifact."""

    PENDING = "pending"
    ACCEPTED = "accepted"
    REJECTED = "rejected"
    REPAIRED = "repaired"


@dataclass(frozen=True)
class Artifact:
    """One damaged interval of one marker.

    Attributes
    ----------
    marker : label
    axes : the axes that are wrong, a non-empty part of ``"xyz"`` in that order
    start, stop : half-open interval of 0-based frame indices
    kind : class of the artifact, or its name
    confidence : in [0, 1], share of such flags that are real
    amplitude_mm : size of the deviation; NaN where it has none (a gap)
    why : the evidence in one sentence
    counterpart : for a swap, the marker under whose name its own samples are
    further_counterparts : for a swap of three or more, the markers after ``counterpart``, each
        under the name of the next; those of the last are under ``marker``
    status : what the operator decided, or its name
    note : what the operator wrote about it
    id : stable name; made from marker, axes, interval and kind when empty, kept by edits

    Raises
    ------
    DataError
        when the interval is empty or not one of whole frames, the axes are not a part of
        ``"xyz"``, the confidence is not within [0, 1], there is no such class or decision, or
        there are further counterparts without a first
    """

    marker: str
    axes: str
    start: int
    stop: int
    kind: Kind
    confidence: float = 1.0
    amplitude_mm: float = math.nan
    why: str = ""
    counterpart: str | None = None
    status: Status = Status.PENDING
    id: str = ""
    note: str = ""
    further_counterparts: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not self.axes or "".join(a for a in AXES if a in self.axes) != self.axes:
            raise DataError(f"Axes must be a part of “xyz” in that order, not “{self.axes}”.")
        whole = isinstance(self.start, Integral) and isinstance(self.stop, Integral)
        if not (whole and 0 <= self.start < self.stop):
            raise DataError(f"An artifact cannot reach from frame {self.start} to {self.stop}.")
        if not 0.0 <= self.confidence <= 1.0:
            raise DataError(f"A confidence is between 0 and 1, not {self.confidence}.")
        try:
            object.__setattr__(self, "kind", Kind(self.kind))
            object.__setattr__(self, "status", Status(self.status))
        except ValueError as error:
            raise DataError(f"An artifact cannot be of this class or status: {error}.") from None
        if math.isnan(self.amplitude_mm):
            # One and the same, so that artifacts without one are equal.
            object.__setattr__(self, "amplitude_mm", math.nan)
        if self.further_counterparts and self.counterpart is None:
            raise DataError(f"A swap of {self.marker} with further markers needs a counterpart.")
        if not self.id:
            key = f"{self.marker}|{self.axes}|{self.start}|{self.stop}|{self.kind}"
            object.__setattr__(self, "id", hashlib.sha1(key.encode()).hexdigest()[:12])

    def __reduce__(self) -> tuple[Any, ...]:
        return Artifact, tuple(getattr(self, f.name) for f in fields(self))

    def __repr__(self) -> str:
        size = "" if math.isnan(self.amplitude_mm) else f", {self.amplitude_mm:.1f} mm"
        others = self.markers[1:]
        other = f" with {' and '.join(others)}" if others else ""
        return (
            f"<{self.kind} {self.marker}.{self.axes}{other} [{self.start}, {self.stop}){size}, "
            f"{self.confidence:.0%} sure, {self.status}>"
        )

    @property
    def markers(self) -> tuple[str, ...]:
        """The marker, and for a swap its counterparts after it."""
        first = () if self.counterpart is None else (self.counterpart,)
        return (self.marker, *first, *self.further_counterparts)

    def concerns(self, markers: Iterable[str]) -> bool:
        """Whether it is of one of these markers, be it as a counterpart."""
        return not set(self.markers).isdisjoint(markers)

    @property
    def length(self) -> int:
        """Number of frames."""
        return self.stop - self.start

    def with_status(self, status: Status) -> Artifact:
        """Return the same artifact with another decision."""
        return replace(self, status=status)

    def overlaps(self, start: int, stop: int) -> bool:
        """Whether any frame of ``[start, stop)`` lies in the artifact."""
        return self.start < stop and start < self.stop


def axis_columns(axes: str) -> list[int]:
    """Columns of the named axes: ``"xz"`` gives ``[0, 2]``."""
    return [AXES.index(a) for a in axes]


def in_order(artifacts: Iterable[Artifact]) -> tuple[Artifact, ...]:
    """Sort by start, then marker, axes and kind; the id settles what is left."""
    return tuple(sorted(artifacts, key=lambda a: (a.start, a.marker, a.axes, a.kind, a.stop, a.id)))


def within(artifacts: Iterable[Artifact], frames: tuple[int, int]) -> tuple[Artifact, ...]:
    """Those that reach into an interval of frames, which is half-open, in the order given."""
    return tuple(a for a in artifacts if a.overlaps(*frames))


def repair_in_words(take: Take, artifact: Artifact, method: str) -> str:
    """One line that says what was repaired and how, with the file's frame numbers."""
    first, last = take.frame_number(artifact.start), take.frame_number(artifact.stop - 1)
    how = f" by {method}" if method else ""
    return f"{artifact.kind.value} {artifact.marker} {artifact.axes} frames {first}-{last}{how}"


def columns_of(take: Take, artifact: Artifact) -> list[int]:
    """Columns of an artifact's marker and, for a swap, of its counterparts that the take has."""
    others = [take.index(marker) for marker in artifact.markers[1:] if marker in take]
    return [take.index(artifact.marker), *others]


def damage_mask(take: Take, artifacts: Iterable[Artifact]) -> BoolArray:
    """Mark the samples that artifacts cover, those of a swap on all of its markers.

    Parameters
    ----------
    take : the recording the artifacts belong to
    artifacts : those with status rejected are passed over, since they are false alarms

    Returns
    -------
    (frames, markers, 3) bool
    """
    mask = np.zeros(take.positions.shape, dtype=bool)
    mark_damage(mask, take, artifacts, True)
    return mask


def mark_damage(mask: BoolArray, take: Take, artifacts: Iterable[Artifact], value: bool) -> None:
    """Write a value into a mask, in place, where artifacts cover samples; see `damage_mask`.

    Parameters
    ----------
    mask : (frames, markers, 3) bool, writable
    take, artifacts : as for :func:`damage_mask`
    value : what is written
    """
    for a in artifacts:
        if a.status is not Status.REJECTED:
            for column in columns_of(take, a):
                mask[a.start : a.stop, column, axis_columns(a.axes)] = value


def distrusted(artifacts: Iterable[Artifact]) -> dict[str, frozenset[tuple[int, int]]]:
    """Intervals by marker that nothing is learned from: those of all artifacts not rejected."""
    found: dict[str, set[tuple[int, int]]] = {}
    for a in artifacts:
        if a.status is not Status.REJECTED:
            for marker in a.markers:
                found.setdefault(marker, set()).add((a.start, a.stop))
    return {marker: frozenset(spans) for marker, spans in found.items()}


def trusted_samples(take: Take, artifacts: Iterable[Artifact]) -> BoolArray:
    """(frames, markers) bool: samples that are there and that no artifact names.

    Parameters
    ----------
    take : the recording
    artifacts : known damage; rejected ones are false alarms and count as sound
    """
    trusted = take.present.copy()
    for a in artifacts:
        if a.status is not Status.REJECTED:
            trusted[a.start : a.stop, columns_of(take, a)] = False
    return trusted


def changed_markers(artifact: Artifact, method: str | None) -> tuple[str, ...]:
    """Name the markers a repair is about: of a mix-up all, unless it was repaired on one alone.

    An exchange changes both sides, and so does restoring a skeleton.

    Parameters
    ----------
    artifact : of any class
    method : that repaired it, None or empty where nothing did
    """
    return artifact.markers if method in _OF_ALL else (artifact.marker,)
