"""A moving frame made from the markers around one marker, and what the pose looks like in it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, deviation_of_seen
from markermend.rotations import nearest_flat
from markermend.take import Take

# Distances are compared on every 4th frame: they change slowly. In long takes so many are enough.
STRIDE, COMPARED = 4, 4000
# A reference that would cost more than this share of the frames to learn from is passed over; the
# second holds where there are fewer than three otherwise.
LOSS, MOST_LOSS = 0.2, 0.8
# Spreads below this make no difference to what holds the frame.
RIGID_MM = 1.0
# Frames from which the typical pose of a cloud is taken.
TYPICAL = 100


def rank_references(
    take: Take, seen: BoolArray, marker: int, during: slice
) -> tuple[IntArray, FloatArray]:
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
    columns : (k,) best first, possibly none
    spread : (k,) median absolute deviation of their distance, mm
    """
    subject = take.subject(take.labels[marker])
    same = [c for c in take.named if take.subject(take.labels[c]) == subject]
    named = np.array(same, dtype=np.int64)
    usable = named[np.all(seen[during, named], axis=0)]
    columns = usable[usable != marker]
    every = slice(None, None, max(STRIDE, take.frames // COMPARED))
    both = (seen[every, columns] & seen[every, marker, None]).T
    often = both.sum(axis=1) >= 3
    columns, both = columns[often], both[often]
    some = np.ascontiguousarray(take.positions[every])
    # Axis by axis and along frames: arithmetic on three numbers in a row is many times slower.
    distance = np.zeros(both.shape)
    for axis in range(3):
        way = some[:, :, axis].T[columns]
        way -= some[:, marker, axis]
        way *= way
        distance += way
    np.sqrt(distance, out=distance)
    distance[~both] = np.nan
    spread = deviation_of_seen(distance)
    order = np.argsort(spread, kind="stable")
    return np.asarray(columns[order], dtype=np.int64), spread[order]


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
    (k,) places in `ranked`, in order; k may be less than `count`
    """
    for loss in (LOSS, MOST_LOSS):
        picked: list[int] = []
        rows = seen[:, marker]
        left = np.count_nonzero(rows)
        for place, column in enumerate(ranked):
            if len(picked) == count:
                break
            with_it = rows & seen[:, column]
            common = np.count_nonzero(with_it)
            if common >= (1 - loss) * left:
                picked.append(place)
                rows, left = with_it, common
        if len(picked) >= 3:
            break
    return np.array(picked, dtype=np.int64)


def holding(spread: FloatArray) -> FloatArray:
    """Weights that let the markers rigid to one marker hold its frame alone.

    They fall with the fourth power of the spread; where none is rigid the nearest share in it.

    Parameters
    ----------
    spread : (points,) of each point's distance to the marker, mm
    """
    return np.asarray(1.0 / (spread**2 + RIGID_MM**2) ** 2)


def alike(spread: FloatArray, holders: Sequence[int]) -> FloatArray:
    """Weights that let some points hold a frame alike, and no other."""
    return np.asarray(np.isin(np.arange(len(spread)), holders), dtype=np.float64)


def align(points: FloatArray, weight: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Find the frame that moves with a cloud of points, by weighted orthogonal Procrustes.

    Parameters
    ----------
    points : (frames, points, 3), mm, nothing missing
    weight : (points,) how much each point holds the frame; at least three above zero

    Returns
    -------
    rotation : (frames, 3, 3); ``(p - centre) @ rotation`` is a point in the moving frame
    centre : (frames, 3), mm
    """
    held = weight > 0
    rotation, centre = align_each(points[:, held].transpose(1, 2, 0), weight[None, held])
    return rotation[0].transpose(2, 0, 1), centre[0].T


def align_each(points: FloatArray, weights: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Find the frames that move with a cloud of points, each held by weights of its own.

    Frames come last here: over many numbers in a row arithmetic is several times faster.

    Parameters
    ----------
    points : (points, 3, frames), mm, nothing missing
    weights : (views, points) how much each point holds each frame; at least three above zero

    Returns
    -------
    rotation : (views, 3, 3, frames) from the laboratory into the moving frame, as of :func:`align`
    centre : (views, 3, frames), mm
    """
    count, _, frames = points.shape
    weights = weights / weights.sum(axis=1, keepdims=True)
    flat = np.ascontiguousarray(points).reshape(count, -1)
    centre = (weights @ flat).reshape(len(weights), 3, frames)
    some = np.ascontiguousarray(points[:, :, :: max(1, frames // TYPICAL)])
    one = np.broadcast_to(some[:, :, some.shape[2] // 2], (len(weights), count, 3))
    turned = _turn(some, weights, one).transpose(0, 2, 1, 3).reshape(3 * len(weights), -1)
    typical = (turned @ some.reshape(count, -1).T / some.shape[2]).reshape(-1, 3, count)
    return _turn(points, weights, typical.transpose(0, 2, 1)), centre


def _turn(points: FloatArray, weights: FloatArray, poses: FloatArray) -> FloatArray:
    """(views, 3, 3, frames) rotations that bring a cloud nearest to (views, points, 3) poses."""
    views, count = weights.shape
    # Where the pose is centred, it makes no difference where the cloud is.
    centred = poses - (weights[:, None] @ poses)
    held = (weights[:, :, None] * centred).transpose(0, 2, 1).reshape(3 * views, count)
    products = (held @ points.reshape(count, -1)).reshape(views, 3, 3, -1)
    matrices = products.transpose(2, 1, 0, 3).reshape(9, -1)
    return nearest_flat(matrices).reshape(3, 3, views, -1).transpose(2, 0, 1, 3)


def to_frame(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, points, 3) lab positions in the moving frame."""
    return np.asarray(np.einsum("fki,fij->fkj", points - centre[:, None], rotation))


def to_frames(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(points, 3, frames) lab positions as of :func:`align_each`, (views, points, 3, frames)."""
    # Several times as fast as einsum.
    seen = points[:, 0, None] * rotation[:, None, 0]
    for axis in (1, 2):
        seen += points[:, axis, None] * rotation[:, None, axis]
    seen -= np.einsum("vif,vijf->vjf", centre, rotation)[:, None]
    return np.asarray(seen)


def to_lab(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, 3) positions in the moving frame, back in the lab."""
    return np.asarray(np.einsum("fj,fij->fi", points, rotation) + centre)
