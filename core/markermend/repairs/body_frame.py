"""A moving frame made from the markers around one marker, and what the pose looks like in it."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.take import Take, is_unlabelled

# Distances are compared on every 4th frame: they change slowly.
STRIDE = 4
# A reference that would cost more than this share of the frames to learn from is passed over.
LOSS = 0.2


def rank_references(take: Take, seen: BoolArray, marker: int, during: slice) -> IntArray:
    """Order the markers that may tell where one marker is, best first.

    Candidates are named markers of the same subject that are seen all through the interval;
    they are ranked by the spread of their distance to the marker (median absolute deviation).

    Parameters
    ----------
    take : the recording
    seen : (frames, markers) bool, samples that may be believed in all three coordinates
    marker : column of the marker
    during : the interval in which references must be seen

    Returns
    -------
    (k,) columns, possibly none
    """
    subject = take.subject(take.labels[marker])
    usable: BoolArray = np.all(seen[during], axis=0)
    usable[marker] = False
    for column, label in enumerate(take.labels):
        if usable[column] and (is_unlabelled(label) or take.subject(label) != subject):
            usable[column] = False
    columns = np.flatnonzero(usable)
    sparse = take.positions[::STRIDE]
    both = seen[::STRIDE, columns] & seen[::STRIDE, marker, None]
    distance = np.linalg.norm(sparse[:, columns] - sparse[:, marker, None], axis=2)
    distance[~both] = np.nan
    often = both.sum(axis=0) >= 3
    columns, distance = columns[often], distance[:, often]
    spread = np.nanmedian(np.abs(distance - np.nanmedian(distance, axis=0)), axis=0)
    order = np.argsort(spread, kind="stable")
    return np.asarray(columns[order], dtype=np.int64)


def pick_references(ranked: IntArray, seen: BoolArray, marker: int, count: int) -> IntArray:
    """Take the best references that are seen together often enough to learn from.

    Parameters
    ----------
    ranked : columns, best first
    seen : (frames, markers) bool
    marker : column of the marker they are to predict
    count : how many at most

    Returns
    -------
    (k,) columns, best first; k may be less than `count`
    """
    picked: list[int] = []
    rows = seen[:, marker]
    for column in ranked:
        with_it = rows & seen[:, column]
        if with_it.sum() >= (1 - LOSS) * rows.sum():
            picked.append(int(column))
            rows = with_it
        if len(picked) == count:
            break
    return np.array(picked, dtype=np.int64)


def align(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Find the frame that moves with a cloud of points, by orthogonal Procrustes.

    Parameters
    ----------
    points : (frames, points, 3), mm, nothing missing

    Returns
    -------
    rotation : (frames, 3, 3); ``(p - centre) @ rotation`` is a point in the moving frame
    centre : (frames, 3), mm
    """
    centre = points.mean(axis=1)
    spread = points - centre[:, None]
    pose = spread[len(spread) // 2]
    for _ in range(2):
        u, _, vt = np.linalg.svd(np.einsum("fki,kj->fij", spread, pose))
        u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
        rotation = u @ vt
        pose = np.einsum("fki,fij->kj", spread, rotation) / len(spread)
    return rotation, centre


def to_frame(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, points, 3) lab positions in the moving frame."""
    return np.asarray(np.einsum("fki,fij->fkj", points - centre[:, None], rotation))


def to_lab(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, 3) positions in the moving frame, back in the lab."""
    return np.asarray(np.einsum("fj,fij->fi", points, rotation) + centre)


def describe_pose(points: FloatArray, components: int = 8) -> tuple[FloatArray, FloatArray]:
    """Describe the pose of the references for a regression.

    Parameters
    ----------
    points : (frames, points, 3) in the moving frame, mm
    components : principal components whose products are taken

    Returns
    -------
    linear : (frames, 3 * points) coordinates, standardised
    products : (frames, k) pairwise products of the first principal components, standardised
    """
    coordinates = points.reshape(len(points), -1)
    coordinates = coordinates - coordinates.mean(axis=0)
    _, axes = np.linalg.eigh(coordinates.T @ coordinates)
    main = coordinates @ axes[:, ::-1][:, :components]
    main = np.clip(main / (main.std(axis=0) + 1e-9), -4.0, 4.0)
    one, other = np.triu_indices(main.shape[1])
    products = main[:, one] * main[:, other]
    products = products - products.mean(axis=0)
    products = products / (products.std(axis=0) + 1e-9)
    return coordinates / (coordinates.std(axis=0) + 1e-6), products
