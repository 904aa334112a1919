"""A moving frame made from the markers around one marker, and what the pose looks like in it."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.take import Take, is_unlabelled

# Distances are compared on every 4th frame: they change slowly.
STRIDE = 4
# A reference that would cost more than this share of the frames to learn from is passed over; the
# second holds where there are fewer than three otherwise.
LOSS, MOST_LOSS = 0.2, 0.8
# Spreads below these make no difference: to what holds the frame, and to what describes the pose.
RIGID_MM, NEAR_MM = 1.0, 3.0


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
    sparse = take.positions[::STRIDE]
    both = seen[::STRIDE, columns] & seen[::STRIDE, marker, None]
    distance = np.linalg.norm(sparse[:, columns] - sparse[:, marker, None], axis=2)
    distance[~both] = np.nan
    often = both.sum(axis=0) >= 3
    columns, distance = columns[often], distance[:, often]
    spread = np.nanmedian(np.abs(distance - np.nanmedian(distance, axis=0)), axis=0)
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


def align(points: FloatArray, spread: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Find the frame that moves with a cloud of points, by weighted orthogonal Procrustes.

    A point's weight falls with the fourth power of its spread: points that are rigid to the
    marker hold the frame alone, and where there are none all the nearest share in it.

    Parameters
    ----------
    points : (frames, points, 3), mm, nothing missing
    spread : (points,) of each point's distance to the marker, mm

    Returns
    -------
    rotation : (frames, 3, 3); ``(p - centre) @ rotation`` is a point in the moving frame
    centre : (frames, 3), mm
    """
    weight = 1.0 / (spread**2 + RIGID_MM**2) ** 2
    weight = weight / weight.sum()
    centre = np.einsum("fki,k->fi", points, weight)
    around = points - centre[:, None]
    pose = around[len(around) // 2]
    for _ in range(2):
        # Matrix products over all frames at once are several times faster than einsum.
        u, _, vt = np.linalg.svd(around.transpose(0, 2, 1) @ (weight[:, None] * pose))
        u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
        rotation = u @ vt
        pose = np.mean(around @ rotation, axis=0)
    return rotation, centre


def to_frame(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, points, 3) lab positions in the moving frame."""
    return np.asarray(np.einsum("fki,fij->fkj", points - centre[:, None], rotation))


def to_lab(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, 3) positions in the moving frame, back in the lab."""
    return np.asarray(np.einsum("fj,fij->fi", points, rotation) + centre)


def describe_pose(points: FloatArray, spread: FloatArray) -> FloatArray:
    """Describe the pose of the references: where each is, the nearest weighing most.

    Parameters
    ----------
    points : (frames, points, 3) in the moving frame, mm
    spread : (points,) of each point's distance to the marker, mm

    Returns
    -------
    (frames, 3 * points) standardised coordinates times a weight that falls with the spread; their
    mean square is 1
    """
    coordinates = points.reshape(len(points), -1)
    coordinates = coordinates - coordinates.mean(axis=0)
    coordinates /= coordinates.std(axis=0) + 1e-6
    weight = 1.0 / (spread + NEAR_MM)
    weight /= np.sqrt(np.mean(weight**2))
    return np.asarray(coordinates * np.repeat(weight, 3))
