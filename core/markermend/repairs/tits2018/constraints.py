"""What recovered trajectories are held to: continuity in time and usual distances."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray

# At least this probability remains, so that no frame is without any candidate.
LEAST_WEIGHT = 1e-200
# Densities are estimated from at most this many distances.
DENSITY_SAMPLES = 500
# Outer shares of the distances that count as unusual, and how often all three are enforced.
UNUSUAL, ROUNDS = 0.01, 5


def join(values: FloatArray, before: FloatArray | None, after: FloatArray | None) -> FloatArray:
    """Add a straight ramp that closes the steps at both borders (eq. 16 to 19).

    Parameters
    ----------
    values : (frames + 2, 3) predicted, the frame before and the one after included
    before, after : (3,) what was measured there; None at the take's ends, where the result is
        shifted by the step at the other border

    Returns
    -------
    (frames + 2, 3)
    """
    first = None if before is None else values[0] - before
    last = None if after is None else values[-1] - after
    if first is None and last is None:
        return values
    first = last if first is None else first
    last = first if last is None else last
    assert first is not None
    assert last is not None
    ramp = np.linspace(0.0, 1.0, len(values))[:, None]
    return np.asarray(values - (first + ramp * (last - first)))


def density(samples: FloatArray, at: FloatArray) -> FloatArray:
    """Kernel density of distances (eq. 21, 22), with MATLAB's default width.

    The width is Silverman's for a normal density whose deviation is the median absolute one.

    Parameters
    ----------
    samples : (n,) distances in mm that were seen, without NaN
    at : (k,) distances to judge

    Returns
    -------
    (k,) probability density per mm
    """
    if len(samples) > DENSITY_SAMPLES:
        places = np.linspace(0, len(samples) - 1, DENSITY_SAMPLES).astype(int)
        samples = samples[places]
    deviation = np.median(np.abs(samples - np.median(samples))) / 0.6745
    if deviation <= 0:
        deviation = np.ptp(samples) or 1e-3
    width = deviation * (4.0 / (3.0 * len(samples))) ** 0.2
    steps = (at[:, None] - samples[None]) / width
    return np.asarray(np.exp(-0.5 * steps**2).mean(axis=1) / (width * np.sqrt(2.0 * np.pi)))


def weigh(distances: list[FloatArray], usual: list[FloatArray]) -> FloatArray:
    """Weight of a candidate per frame: the product of its distances' densities (eq. 23).

    Parameters
    ----------
    distances : for each reference (frames,) distance of the candidate to it
    usual : for each reference the distances that were seen
    """
    product = np.prod([density(u, d) for u, d in zip(usual, distances, strict=True)], axis=0)
    return np.asarray(np.maximum(product, LEAST_WEIGHT))


def keep_distance(
    values: FloatArray, references: list[FloatArray], usual: list[FloatArray]
) -> FloatArray:
    """Project onto the shells of usual distance around the references (eq. 25 to 27).

    Parameters
    ----------
    values : (frames, 3)
    references : (frames, 3) each, the nearest first; with several the strict form: the furthest
        is enforced first, the nearest last, up to five rounds
    usual : distances seen to each

    Returns
    -------
    (frames, 3)
    """
    limits = [np.quantile(u, [UNUSUAL, 1.0 - UNUSUAL]) for u in usual]
    result = values.copy()
    for _ in range(ROUNDS):
        moved = False
        for reference, (low, high) in reversed(list(zip(references, limits, strict=True))):
            away = result - reference
            distance = np.linalg.norm(away, axis=1)
            wanted = np.clip(distance, low, high)
            outside = (wanted != distance) & (distance > 0)
            result[outside] = (
                reference[outside] + away[outside] * (wanted / distance.clip(1e-12))[outside, None]
            )
            moved |= bool(outside.any())
        if not moved:
            break
    return result
