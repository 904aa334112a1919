"""The smallest change to a take: new values for some axes of one marker over one interval."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from markermend.arrays import ByteArray, FloatArray
from markermend.artifact import axis_columns
from markermend.errors import DataError
from markermend.take import AXES, Origin, Take


@dataclass(frozen=True, eq=False)
class Patch:
    """New values for one marker.

    Attributes
    ----------
    marker : label
    axes : the axes replaced, a part of ``"xyz"``
    start, stop : half-open interval of 0-based frame indices
    values : (stop - start, len(axes)) float64, mm; NaN makes the sample missing, then all
        three axes must be named
    origin : (stop - start,) uint8 or None; None lets the change decide (a missing sample that
        gets a value is filled, a measured one is edited)
    """

    marker: str
    axes: str
    start: int
    stop: int
    values: FloatArray
    origin: ByteArray | None = None

    def __post_init__(self) -> None:
        expected = (self.stop - self.start, len(self.axes))
        if self.values.shape != expected:
            raise DataError(f"A patch of {expected} got values of {self.values.shape}.")


def apply_patch(positions: FloatArray, origin: ByteArray, column: int, patch: Patch) -> Patch:
    """Write a patch into working arrays, in place, and return the patch that undoes it.

    Parameters
    ----------
    positions : (frames, markers, 3) float64, mm, writable
    origin : (frames, markers) uint8, writable
    column : the marker's column
    patch : what to write

    Raises
    ------
    DataError
        when it would leave a sample with some coordinates missing and others not
    """
    rows = slice(patch.start, patch.stop)
    axes = axis_columns(patch.axes)
    before = positions[rows, column].copy()
    was = origin[rows, column].copy()
    whole = patch.axes == AXES
    if whole:
        after = np.ascontiguousarray(patch.values, dtype=np.float64)
    else:
        after = before.copy()
        after[:, axes] = patch.values
    absent = np.isnan(after)
    if (absent[:, :1] != absent[:, 1:]).any():
        raise DataError(
            f"Changing only axis “{patch.axes}” of {patch.marker} would leave samples half missing."
        )
    now = patch.origin
    if now is None:
        now = was.copy()
        # Comparing bits, so that a value "replaced by itself" stays measured.
        changed = (after.view(np.int64) != before.view(np.int64)).any(axis=1)
        filled = (was == Origin.MISSING) | (was == Origin.FILLED)
        now[changed & filled] = Origin.FILLED
        now[changed & ~filled] = Origin.EDITED
        now[absent[:, 0]] = Origin.MISSING
    positions[rows, column] = after
    origin[rows, column] = now
    known = before if whole else before[:, axes]
    return Patch(patch.marker, patch.axes, patch.start, patch.stop, known, was)


def write_patches(
    positions: FloatArray, first: int, columns: Mapping[str, int], patches: Iterable[Patch]
) -> None:
    """Write patches into a part of a take, in place, as far as they reach into it.

    Parameters
    ----------
    positions : (frames, markers, 3) float64, mm, writable
    first : frame of the take with which it begins
    columns : where its markers stand, by label; patches of others are passed over
    patches : in the order in which they are written
    """
    last = first + len(positions)
    for patch in patches:
        start, stop = max(patch.start, first), min(patch.stop, last)
        if patch.marker in columns and start < stop:
            rows, axes = slice(start - first, stop - first), axis_columns(patch.axes)
            values = patch.values[start - patch.start : stop - patch.start]
            positions[rows, columns[patch.marker], axes] = values


def patched(take: Take, patches: Iterable[Patch]) -> Take:
    """Apply patches in order.

    Parameters
    ----------
    take : unchanged
    patches : those of repairs, for example

    Returns
    -------
    Take
        a new one, in which replaced samples are filled (where they were missing) or edited

    Raises
    ------
    DataError
        when a patch is of a marker that the take does not have, or reaches beyond its end
    """
    positions, origin = take.positions.copy(), take.origin.copy()
    for patch in patches:
        apply_patch(positions, origin, take.index(patch.marker), patch)
    return take.with_positions(positions, origin)
