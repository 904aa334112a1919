"""What a plot can show of a marker: coordinates, and what is worked out of them or read beside."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import ByteArray, FloatArray
from markermend.measures import acceleration, distance, speed
from markermend.patch import Patch
from markermend.take import AXES, Origin, Take


@dataclass(frozen=True, eq=False)
class Way:
    """A marker's trajectory, and what there is beside it.

    Attributes
    ----------
    positions : (n, 3) mm, NaN = missing
    rate : Hz
    residuals, cameras : give (n,) as the file has them, which few rows show; or None
    other, predicted, source : (n, 3) mm, another marker, the body's prediction, and the samples
        before any repair; or None
    """

    positions: FloatArray
    rate: float
    residuals: Callable[[], FloatArray] | None = None
    cameras: Callable[[], FloatArray] | None = None
    other: FloatArray | None = None
    predicted: FloatArray | None = None
    source: FloatArray | None = None

    def patched(self, patch: Patch, margin: int) -> tuple[Way, int]:
        """The frames of a patch and some on either side, with the patch in them; and the first."""
        low = max(0, patch.start - margin)
        part = slice(low, patch.stop + margin)
        positions = self.positions[part].copy()
        for i, axis in enumerate(patch.axes):
            positions[patch.start - low : patch.stop - low, AXES.index(axis)] = patch.values[:, i]
        other = None if self.other is None else self.other[part]
        predicted = None if self.predicted is None else self.predicted[part]
        source = None if self.source is None else self.source[part]
        near = replace(self, positions=positions, other=other, predicted=predicted, source=source)
        return near, low


def way_of(
    take: Take,
    marker: str,
    positions: FloatArray,
    partner: str | None = None,
    predicted: FloatArray | None = None,
    source: FloatArray | None = None,
) -> Way:
    """A marker's way in a take.

    Parameters
    ----------
    take : the recording
    marker : its label
    positions : (frames, 3) mm, its samples, each axis without a break in memory: every row reads
        them several times
    partner : the marker that distances are measured to
    predicted : (frames, 3) mm, where the body says the marker is
    source : (frames, 3) mm, the samples before any repair; by default the way's own
    """
    column = take.index(marker)
    residuals = None if take.residuals is None else partial(_as_floats, take.residuals[:, column])
    cameras = None
    if take.cameras is not None:
        cameras = partial(_counted, take.cameras[:, column], take.origin[:, column])
    other = None if partner is None else take.positions[:, take.index(partner)]
    source = positions if source is None else source
    return Way(positions, take.rate, residuals, cameras, other, predicted, source)


def _as_floats(values: NDArray[Any]) -> FloatArray:
    """Values as the plots draw them."""
    return values.astype(np.float64)


def _counted(cameras: NDArray[Any], origin: ByteArray) -> FloatArray:
    """Cameras of each sample; a count of one that was not seen says nothing."""
    return np.where(origin != Origin.MISSING, cameras.astype(np.float64), np.nan)


@dataclass(frozen=True, eq=False)
class Quantity:
    """Something that a row of the plots can show.

    Attributes
    ----------
    name : unique, also in the settings
    title, unit : beside the axis
    meaning : what it is, for menus
    of : (n,) values along a way, or None while they cannot be told
    axes : axes whose artifacts and repairs show in it
    least : range of values shown at least
    least_at : lower end of the values, or None when there is none
    reach : frames on either side that a value depends on; -1 where a repair changes nothing
    places : decimals read out
    whole : whether all values are to be seen, since zero is usual and the others are looked for
    """

    name: str
    title: str
    unit: str
    meaning: str
    of: Callable[[Way], FloatArray | None]
    axes: str = AXES
    least: float = 8.0
    least_at: float | None = 0.0
    reach: int = 0
    places: int = 1
    whole: bool = False


def _axis(column: int) -> Callable[[Way], FloatArray]:
    """One coordinate."""
    return lambda way: np.ascontiguousarray(way.positions[:, column])


def _apart(other: Callable[[Way], FloatArray | None]) -> Callable[[Way], FloatArray | None]:
    """Distance to another way, once that is known."""

    def of(way: Way) -> FloatArray | None:
        there = other(way)
        return None if there is None else distance(way.positions, there)

    return of


_ALL = (
    *(
        Quantity(a, a.upper(), "mm", f"{a.upper()} coordinate", _axis(i), a, least_at=None)
        for i, a in enumerate(AXES)
    ),
    Quantity(
        "speed",
        "Speed",
        "m/s",
        "Speed",
        lambda w: speed(w.positions, w.rate),
        least=0.05,
        reach=1,
        places=3,
    ),
    Quantity(
        "acceleration",
        "Accel.",
        "m/s²",
        "Acceleration",
        lambda w: acceleration(w.positions, w.rate),
        least=1.0,
        reach=1,
        places=2,
    ),
    Quantity(
        "distance",
        "Distance",
        "mm",
        "Distance to another marker",
        _apart(lambda w: w.other),
        least_at=None,
    ),
    Quantity(
        "residual",
        "Off body",
        "mm",
        "Distance to the body's prediction",
        _apart(lambda w: w.predicted),
        least=4.0,
        places=2,
    ),
    Quantity(
        "difference",
        "Moved",
        "mm",
        "Difference to the samples before repair",
        _apart(lambda w: w.source),
        least=1.0,
        places=2,
        whole=True,
    ),
    Quantity(
        "file_residual",
        "Residual",
        "mm",
        "Residual in the file",
        lambda w: None if w.residuals is None else w.residuals(),
        least=0.5,
        reach=-1,
        places=2,
    ),
    Quantity(
        "cameras",
        "Cameras",
        "",
        "Number of cameras in the file",
        lambda w: None if w.cameras is None else w.cameras(),
        least=4.0,
        reach=-1,
        places=0,
    ),
)
QUANTITIES: Mapping[str, Quantity] = MappingProxyType({q.name: q for q in _ALL})
COORDINATES = tuple(AXES)


def can_show(take: Take | None, name: str) -> bool:
    """Whether a take holds what a quantity needs."""
    if take is None:
        return True
    if not take.markers:
        return False
    if name == "file_residual":
        return take.residuals is not None
    # Some systems write the word for cameras and leave it empty.
    return name != "cameras" or (take.cameras is not None and bool(take.cameras.any()))
