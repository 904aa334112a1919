"""A moving frame made from the markers around one marker, and what the pose looks like in it."""

from __future__ import annotations

from collections.abc import Sequence

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
# Newton's method for the nearest rotation: most steps, of these scaled ones, and what is left.
STEPS, SCALED, SETTLED = 12, 5, 1e-9
# Places, in a flattened matrix, of the factors of its cofactors.
_NEXT = [
    [3 * ((i + a) % 3) + (j + b) % 3 for i in range(3) for j in range(3)]
    for a, b in ((1, 1), (2, 2), (1, 2), (2, 1))
]


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
    points, weight = points[:, held], weight[held] / weight.sum()
    centre = np.asarray(weight @ points.transpose(1, 0, 2).reshape(len(weight), -1)).reshape(-1, 3)
    around = points - centre[:, None]
    some = around[:: max(1, len(around) // TYPICAL)]
    pose = np.mean(some @ _turn(some, weight, some[len(some) // 2]), axis=0)
    return _turn(around, weight, pose), centre


def _turn(around: FloatArray, weight: FloatArray, pose: FloatArray) -> FloatArray:
    """(frames, 3, 3) rotations that bring a centred cloud nearest to a pose, frame by frame."""
    # Matrix products over all frames at once are several times faster than einsum.
    return nearest_rotations(around.transpose(0, 2, 1) @ (weight[:, None] * pose))


def nearest_rotations(matrices: FloatArray) -> FloatArray:
    """Rotations nearest to matrices, the solutions of orthogonal Procrustes without reflections.

    A matrix of norm 1 plus its cofactors has the same nearest rotation, and no singular value of
    zero where the points lie in a plane. Of that Newton's method for the polar factor (Higham 1986)
    takes a third of the time of singular values, which only those need that do not settle:
    points on a line.

    Parameters
    ----------
    matrices : (n, 3, 3) finite

    Returns
    -------
    (n, 3, 3)
    """
    flat = matrices.reshape(-1, 9).T
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        flat = flat / np.sqrt(np.sum(flat**2, axis=0))
        flat = flat + _cofactors(flat)
        for step in range(STEPS):
            cofactors = _cofactors(flat)
            volume = np.sum(flat[:3] * cofactors[:3], axis=0)
            scale = np.cbrt(np.abs(volume)) if step < SCALED else 1.0
            last, flat = flat, 0.5 * (flat / scale + cofactors * (scale / volume))
            left = np.max(np.abs(flat - last), axis=0)
            if not (left > SETTLED).any():
                break
    rotations = np.ascontiguousarray(flat.T).reshape(-1, 3, 3)
    unsettled = ~((left <= SETTLED) & (volume > 0.0))
    if unsettled.any():
        u, _, vt = np.linalg.svd(matrices[unsettled])
        u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
        rotations[unsettled] = u @ vt
    return rotations


def _cofactors(flat: FloatArray) -> FloatArray:
    """(9, n) cofactors of (9, n) flattened matrices."""
    a, b, c, d = (flat[places] for places in _NEXT)
    return a * b - c * d


def to_frame(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, points, 3) lab positions in the moving frame."""
    return np.asarray(np.einsum("fki,fij->fkj", points - centre[:, None], rotation))


def to_lab(points: FloatArray, rotation: FloatArray, centre: FloatArray) -> FloatArray:
    """(frames, 3) positions in the moving frame, back in the lab."""
    return np.asarray(np.einsum("fj,fij->fi", points, rotation) + centre)
