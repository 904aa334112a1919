"""Markers over time, shrunk to the columns of a picture without losing what is short."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from markermend.arrays import ByteArray, Float32Array, FloatArray, IntArray
from markermend.artifact import Artifact, Status, columns_of, trusted_samples
from markermend.measures import distance
from markermend.progress import Progress, quiet
from markermend.take import Origin, Take

LEAST_SHARE = 1 / 3
_BLOCK = 65_536
"""Samples counted at a time."""
_MOST = 255
"""What a byte can count."""
KNOT_HZ, LEAST_KNOTS = 30.0, 4000
"""Where the body says a marker is is worked out so often, unless that leaves too few to learn."""


def missing_share(
    origin: ByteArray, columns: int, start: float = 0.0, stop: float | None = None
) -> FloatArray:
    """Share of missing samples behind each column of a picture.

    Parameters
    ----------
    origin : (frames, markers) uint8, see :class:`markermend.take.Origin`
    columns : of the picture
    start, stop : frames it reaches over; by default all

    Returns
    -------
    (markers, columns) float64 in [0, 1]; where a column holds any missing sample, at least a
    third, so that short gaps stay visible
    """
    first, low, high = _bins(len(origin), columns, start, stop)
    last = np.maximum(np.append(first[1:], high - low), first + 1)
    lost = _count_missing(origin[low:high], first, last)
    share = lost / (last - first)[:, None]
    share = np.where(share > 0, np.maximum(share, LEAST_SHARE), 0.0)
    return np.asarray(share.T, dtype=np.float64)


def count_missing(origin: ByteArray) -> IntArray:
    """Number of missing samples of each marker.

    Parameters
    ----------
    origin : (frames, markers) uint8, see :class:`markermend.take.Origin`

    Returns
    -------
    (markers,) int64
    """
    lost = np.asarray(origin == Origin.MISSING).view(np.uint8)
    # As many rows as a byte can count are added up as if each were a long one, many times faster.
    long = len(lost) // _MOST
    whole = lost[: _MOST * long].reshape(_MOST, -1).sum(axis=0, dtype=np.uint8)
    counts = whole.reshape(long, lost.shape[1]).sum(axis=0, dtype=np.int64)
    return np.asarray(counts + lost[_MOST * long :].sum(axis=0, dtype=np.int64))


def _count_missing(origin: ByteArray, first: IntArray, last: IntArray) -> IntArray:
    """(blocks, markers) int64 missing samples of blocks of frames, [first, last) each.

    Some blocks after the other: arrays as long as the take take longer to come by than to fill.
    A block ends where the next one begins, or is of one frame.
    """
    counts = np.empty((len(first), origin.shape[1]), dtype=np.int64)
    step = max(1, _BLOCK * len(first) // max(1, origin.size))
    for i in range(0, len(first), step):
        part = first[i : i + step]
        lost = origin[part[0] : last[min(i + step, len(first)) - 1]] == Origin.MISSING
        counts[i : i + step] = np.add.reduceat(lost, part - part[0], axis=0, dtype=np.uint32)
    return counts


def worst(
    values: Float32Array, columns: int, start: float = 0.0, stop: float | None = None
) -> Float32Array:
    """Largest value behind each column of a picture.

    Parameters
    ----------
    values : (markers, frames) float32; NaN = unknown
    columns : of the picture
    start, stop : frames it reaches over; by default all

    Returns
    -------
    (markers, columns) float32; NaN where nothing is known
    """
    first, low, high = _bins(values.shape[1], columns, start, stop)
    return np.asarray(np.fmax.reduceat(values[:, low:high], first, axis=1))


def damage_share(take: Take, artifacts: Iterable[Artifact]) -> FloatArray:
    """Share of each marker's frames that are damaged.

    Parameters
    ----------
    take : the recording as it stands
    artifacts : those decided count no longer; but what is missing does

    Returns
    -------
    (markers,) float64 in [0, 1]: frames in which the marker is missing or an open artifact names it
    """
    bad = take.origin == Origin.MISSING
    for artifact in artifacts:
        if artifact.status is Status.PENDING:
            bad[artifact.start : artifact.stop, columns_of(take, artifact)] = True
    return np.asarray(bad.sum(axis=0) / max(1, take.frames))


def _bins(frames: int, columns: int, start: float, stop: float | None) -> tuple[IntArray, int, int]:
    """First frame of each column, counted from the first frame that is needed; and the frames."""
    edges = np.linspace(start, frames if stop is None else stop, columns + 1)
    first = np.clip(np.floor(edges[:-1]).astype(np.int64), 0, frames - 1)
    low = int(first[0])
    high = int(np.clip(np.ceil(edges[-1]), first[-1] + 1, frames))
    return first - low, low, high


def body_residuals(
    take: Take,
    artifacts: Iterable[Artifact] = (),
    markers: Iterable[str] | None = None,
    *,
    progress: Progress | None = None,
) -> Float32Array:
    """How far each sample is from where the rest of the body says it should be.

    Parameters
    ----------
    take : the recording
    artifacts : known damage, which nothing is learned from
    markers : those to be worked out; by default all
    progress : told the share of markers done; may raise ``Cancelled``

    Returns
    -------
    (markers asked for, frames) float32, mm; NaN where a sample is missing or cannot be predicted

    Notes
    -----
    The body moves more slowly than cameras record. In long takes its predictions are worked out
    30 times a second and joined by a spline that no jump makes ring (Akima, 1970); every sample is
    measured against them.
    """
    from markermend.predictors.local import predict_local

    report, trusted = progress or quiet, trusted_samples(take, artifacts)
    names = take.labels if markers is None else tuple(markers)
    result = np.empty((len(names), take.frames), dtype=np.float32)
    step = int(np.clip(take.frames // LEAST_KNOTS, 1, max(1, round(take.rate / KNOT_HZ))))
    knots, positions = np.arange(take.frames), take.positions
    if step > 1:
        knots = np.append(knots[:-1:step], take.frames - 1)
        positions, trusted = positions[knots], trusted[knots]
    for row, name in enumerate(names):
        report(row / len(names), f"residual of {name}")
        column = take.index(name)
        predicted = predict_local(positions, column, trusted=trusted)
        if step > 1:
            predicted = _between(knots, predicted, take.frames)
        result[row] = distance(take.positions[:, column], predicted)
    report(1.0, "residuals")
    return result


def _between(knots: IntArray, values: FloatArray, frames: int) -> FloatArray:
    """Values at every frame, from those at the knots; NaN where a knot beside one is unknown."""
    from scipy.interpolate import Akima1DInterpolator

    known, every = ~np.isnan(values[:, 0]), np.arange(frames)
    if known.sum() < 2:
        return np.full((frames, 3), np.nan)
    dense = np.asarray(Akima1DInterpolator(knots[known], values[known])(every))
    dense[np.interp(every, knots, known) < 1] = np.nan
    return dense
