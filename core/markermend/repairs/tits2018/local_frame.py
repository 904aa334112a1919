"""Three references span a coordinate system in which the marker hardly moves (eq. 1, 4 to 11)."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray, IntArray

# With fewer frames than this in which nothing is missing, incomplete frames are used too.
ENOUGH_COMPLETE = 300


def rank_by_spread(positions: FloatArray, marker: int) -> tuple[IntArray, FloatArray]:
    """Order the other markers by the standard deviation of their distance to one (eq. 1).

    Parameters
    ----------
    positions : (frames, markers, 3), NaN where not trusted
    marker : column

    Returns
    -------
    columns : (markers - 1,) best first; those never seen together with the marker are left out
    spread : (markers,) mm by column, infinite for the marker itself and those left out
    """
    complete = ~np.isnan(positions[:, :, 0]).any(axis=1)
    usable = positions[complete] if complete.sum() > ENOUGH_COMPLETE else positions
    distance = np.linalg.norm(usable - usable[:, marker, None], axis=2)
    together = ~np.isnan(distance)
    count = np.maximum(together.sum(axis=0), 1)
    mean = np.where(together, distance, 0.0).sum(axis=0) / count
    square = np.where(together, (distance - mean) ** 2, 0.0).sum(axis=0)
    spread = np.sqrt(square / np.maximum(count - 1, 1))
    spread[together.sum(axis=0) < 2] = np.inf
    spread[marker] = np.inf
    order = np.argsort(spread, kind="stable")
    return order[np.isfinite(spread[order])], spread


def local_axes(one: FloatArray, two: FloatArray, three: FloatArray) -> FloatArray:
    """Orthonormal vectors of three references, frame by frame (eq. 4 to 6, as the code has them).

    Parameters
    ----------
    one, two, three : (frames, 3) mm

    Returns
    -------
    (frames, 3, 3); columns: towards the second, normal to the plane, and in the plane
    """
    along = _unit(two - one)
    normal = _unit(np.cross(along, three - one))
    return np.stack([along, normal, np.cross(normal, along)], axis=2)


def _unit(vectors: FloatArray) -> FloatArray:
    """Vectors of length one; a vector of no length stays nought."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.where(length > 0, length, 1.0))


def into(axes: FloatArray, origin: FloatArray, points: FloatArray) -> FloatArray:
    """Lab positions in the local system (eq. 7, 8).

    Parameters
    ----------
    axes : (frames, 3, 3), a unit vector a column
    origin, points : (frames, 3), mm; NaN where missing, and so is what comes of it

    Returns
    -------
    (frames, 3), mm
    """
    return np.asarray(np.einsum("fi,fij->fj", points - origin, axes))


def out_of(axes: FloatArray, origin: FloatArray, points: FloatArray) -> FloatArray:
    """Local positions in the lab (eq. 9, 10); parameters and result are those of :func:`into`."""
    return np.asarray(np.einsum("fj,fij->fi", points, axes) + origin)


def describe(one: FloatArray, two: FloatArray, three: FloatArray, axes: FloatArray) -> FloatArray:
    """The three coordinates of the references that are not nought, (frames, 3) (eq. 11)."""
    third = into(axes, one, three)
    return np.stack([np.linalg.norm(two - one, axis=1), third[:, 0], third[:, 2]], axis=1)
