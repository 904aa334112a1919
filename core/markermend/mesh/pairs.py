"""What two markers tell about being on one bone: distance, its spread, coherence of motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray, IntArray

SAMPLED_FRAMES = 400
# A tenth of the frames may be damaged on either side without a trace in the spread.
QUANTILES = (0.1, 0.5, 0.9)
# One frame in twelve of the sampled ones, at least, for a distance to be believed.
COMMON_SHARE = 1 / 12


@dataclass(frozen=True)
class Pairs:
    """Relations between all markers of one body; every matrix is symmetric (markers, markers).

    Attributes
    ----------
    distance : median distance, mm
    spread : width of the middle 80 % of the distance, mm; 0 on the diagonal
    coherence : correlation of the velocities in [-1, 1], 0 where unknown
    turning : how far the line between two markers swings in space, mm, median over all pairs
    """

    distance: FloatArray
    spread: FloatArray
    coherence: FloatArray
    turning: float


def measure_pairs(positions: FloatArray, rate: float) -> Pairs:
    """Measure distance, its spread and coherence of motion for every two markers.

    Parameters
    ----------
    positions : (frames, markers, 3) float64, mm; NaN = missing. Some hundred frames, evenly
        chosen, are looked at
    rate : frames per second

    Returns
    -------
    Pairs, without NaN: what two markers that are never seen together would have is bounded by
    the shortest way over a third one

    Notes
    -----
    The rigid segments of a functional body mesh keep their inter-marker distances (Skurowski and
    Pawlyta 2021, section 2.2); gradient coherence is the second criterion for a parent marker
    (Skurowski and Pawlyta 2022, section 3.3.2).
    """
    frames = positions.shape[0]
    chosen = np.unique(np.linspace(0, frames - 1, min(frames, SAMPLED_FRAMES)).round().astype(int))
    sample = positions[chosen]
    distance, spread = _distances(sample)
    coherence = _coherence(positions, chosen, rate)
    return Pairs(distance, spread, coherence, _turning(sample[::4]))


def _distances(sample: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Median and spread of each distance over the sampled frames."""
    frames, markers = sample.shape[:2]
    i, j = np.triu_indices(markers, 1)
    apart = np.sqrt(((sample[:, i] - sample[:, j]) ** 2).sum(axis=2))
    apart.sort(axis=0)  # NaN goes last
    common = np.isfinite(apart).sum(axis=0)
    at = np.round(np.multiply.outer(QUANTILES, np.maximum(common - 1, 0))).astype(int)
    low, middle, high = np.take_along_axis(apart, at, axis=0)
    known = common >= max(1, COMMON_SHARE * frames)
    return (
        _close(_square(np.where(known, middle, np.inf), markers)),
        _close(_square(np.where(known, high - low, np.inf), markers)),
    )


def _turning(sample: FloatArray) -> float:
    """Median over pairs of the median swing of the vector between two markers."""
    i, j = np.triu_indices(sample.shape[1], 1)
    vector = sample[:, i] - sample[:, j]
    vector = vector[:, np.isfinite(vector[:, :, 0]).any(axis=0)]
    if vector.size == 0:
        return 0.0
    swing = np.sqrt(((vector - np.nanmedian(vector, axis=0)) ** 2).sum(axis=2))
    return float(np.median(np.nanmedian(swing, axis=0)))


def _square(values: FloatArray, markers: int) -> FloatArray:
    """Symmetric matrix with zero diagonal from its upper triangle, row by row."""
    matrix = np.zeros((markers, markers))
    matrix[np.triu_indices(markers, 1)] = values
    return matrix + matrix.T


def _close(matrix: FloatArray) -> FloatArray:
    """Replace unknown (infinite) entries by the shortest way over one other marker."""
    unknown = np.argwhere(np.isinf(matrix))
    closed = matrix.copy()
    for i, j in unknown:
        closed[i, j] = (matrix[i] + matrix[j]).min()
    finite = closed[np.isfinite(closed)]
    return np.where(np.isfinite(closed), closed, 2 * finite.max(initial=1.0))


def _coherence(positions: FloatArray, chosen: IntArray, rate: float) -> FloatArray:
    """Correlation of the velocities, each limited so that a spike does not rule."""
    reach = max(1, round(0.05 * rate))
    ahead = np.minimum(chosen + reach, positions.shape[0] - 1)
    velocity = positions[ahead] - positions[np.maximum(chosen - reach, 0)]
    speed = np.sqrt((velocity**2).sum(axis=2))
    seen = np.isfinite(speed)
    if not seen.any():
        return np.zeros((positions.shape[1],) * 2)
    limit = np.quantile(speed[seen], 0.9)
    velocity = np.where(seen[:, :, None], velocity, 0.0)
    velocity *= (limit / np.maximum(np.where(seen, speed, 0.0), max(limit, 1e-9)))[:, :, None]
    products = np.einsum("tik,tjk->ij", velocity, velocity, optimize=True)
    energy = (velocity**2).sum(axis=2).T @ seen.astype(float)
    scale = np.sqrt(energy * energy.T)
    coherence: FloatArray = np.divide(products, scale, out=np.zeros_like(products), where=scale > 0)
    return coherence
