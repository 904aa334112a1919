"""A moving frame made from the markers around one marker, and what the pose looks like in it."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, median_of_seen
from markermend.take import Take, is_unlabelled

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
    usable: BoolArray = np.all(seen[during], axis=0)
    usable[marker] = False
    for column, label in enumerate(take.labels):
        if usable[column] and (is_unlabelled(label) or take.subject(label) != subject):
            usable[column] = False
    columns = np.flatnonzero(usable)
    every = slice(None, None, max(STRIDE, take.frames // COMPARED))
    sparse = take.positions[every]
    both = seen[every, columns] & seen[every, marker, None]
    distance = np.linalg.norm(sparse[:, columns] - sparse[:, marker, None], axis=2)
    distance[~both] = np.nan
    often = both.sum(axis=0) >= 3
    columns, distance = columns[often], distance[:, often]
    spread = median_of_seen(np.abs(distance - median_of_seen(distance)))
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
        for place, column in enumerate(ranked):
            with_it = rows & seen[:, column]
            if len(picked) < count and with_it.sum() >= (1 - loss) * rows.sum():
                picked.append(place)
                rows = with_it
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


def nearest(spread: FloatArray, count: int) -> FloatArray:
    """Weights that let the first `count` points hold a frame alike, and no other."""
    return np.asarray(np.arange(len(spread)) < count, dtype=np.float64)


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
    points, weight = points[:, held], weight[held] / weight.sum()
    centre = np.asarray(weight @ points.transpose(1, 0, 2).reshape(len(weight), -1)).reshape(-1, 3)
    around = points - centre[:, None]
    some = around[:: max(1, len(around) // TYPICAL)]
    pose = np.mean(some @ _turn(some, weight, some[len(some) // 2]), axis=0)
    return _turn(around, weight, pose), centre


def _turn(around: FloatArray, weight: FloatArray, pose: FloatArray) -> FloatArray:
    """(frames, 3, 3) rotations that bring a centred cloud nearest to a pose, frame by frame."""
    # Matrix products over all frames at once are several times faster than einsum.
    u, _, vt = np.linalg.svd(around.transpose(0, 2, 1) @ (weight[:, None] * pose))
    u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
    return np.asarray(u @ vt)


def to_frame(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, points, 3) lab positions in the moving frame."""
    return np.asarray(np.einsum("fki,fij->fkj", points - centre[:, None], rotation))


def to_lab(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, 3) positions in the moving frame, back in the lab."""
    return np.asarray(np.einsum("fj,fij->fi", points, rotation) + centre)
