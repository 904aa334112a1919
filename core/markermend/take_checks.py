"""What a take must be made of: refused in a sentence where it is not."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import DataError


def checked_labels(labels: Iterable[str], markers: int) -> tuple[str, ...]:
    """Labels as a tuple; raises DataError where they are not one text a marker."""
    names = tuple(labels) if isinstance(labels, Iterable) and not isinstance(labels, str) else None
    if names is None or not all(isinstance(name, str) for name in names):
        raise DataError("Marker labels must be texts, one per marker.")
    if len(names) != markers:
        raise DataError(f"There are {markers} trajectories but {len(names)} labels.")
    if len(set(names)) != len(names):
        raise DataError("Marker labels must be unique.")
    return names


def checked_missing(positions: FloatArray) -> BoolArray:
    """(frames, markers) where positions are missing; raises DataError where they are half there."""
    # Axis by axis, since reducing over an axis of three is ten times slower.
    absent = ~np.isfinite(positions)
    missing: BoolArray = absent[:, :, 0]
    if any((absent[:, :, axis] != missing).any() for axis in (1, 2)):
        raise DataError("A missing sample must be NaN in all three coordinates.")
    if not np.isnan(positions[missing]).all():
        raise DataError("Positions must be finite, or NaN where a marker was not seen.")
    return missing


def check_samples(name: str, array: object, shape: tuple[int, int]) -> None:
    """Raise DataError where something kept per frame and marker is no array of that shape."""
    if not isinstance(array, np.ndarray) or array.shape != shape:
        found = array.shape if isinstance(array, np.ndarray) else type(array).__name__
        raise DataError(f"{name} must be an array of {shape}, not {found}.")
