"""How far off a smoothed trajectory and its derivatives may be."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from markermend.arrays import FloatArray
from markermend.smoothers.levels import ORDER, Levels
from markermend.smoothers.penalised import LOWEST, weight_of

# The reference for stretch ends: frames and cut-off of a stretch solved in full.
_FRAMES, _CUTOFF = 240, 0.05
# Recordings' motion falls off beyond the cut-off by some 18 dB an octave, not by the 24 dB of the
# fourth difference: by how much an order less.
_SHALLOWER = 1


def deviations(levels: Levels, rate: float, to_end: FloatArray) -> tuple[FloatArray, ...]:
    """Standard deviations of smoothed position, velocity and acceleration.

    Parameters
    ----------
    levels : what was found along the trajectories
    rate : frames per second
    to_end : (frames, markers, 3) frames to the nearer end of the stretch

    Returns
    -------
    three (frames, markers, 3) float64: mm, mm per frame, mm per frame squared

    Notes
    -----
    Variances are means over all states that the recording leaves possible, since the livelier
    ones are what an acceleration may be off by. In each, the error of a locally stationary
    smoother of transfer H has the spectrum H²·s + (1 − H)²·m, for noise s and motion m. Near ends
    it is larger; by how much depends on the distance in units of the cut-off's period, and is
    read off one short stretch solved in full.
    """
    inside = variances(levels.states_hz / rate)
    distances, growths = _near_ends()
    along = to_end * levels.cutoff_hz / rate
    return tuple(
        np.sqrt(levels.mean_variance(inside[k])) * np.interp(along, distances, growths[k])
        for k in range(3)
    )


def variances(cutoffs: FloatArray) -> FloatArray:
    """Variances away from ends for noise of one.

    Parameters
    ----------
    cutoffs : (k,) halved frequency as share of the frame rate

    Returns
    -------
    (3, k) of position, velocity per frame and acceleration per frame squared
    """
    from scipy.integrate import trapezoid

    omega = np.geomspace(1e-4, np.pi, 4000)
    chord = (2.0 * np.sin(omega / 2.0)) ** 2
    corner = (2.0 * np.sin(np.pi * np.clip(cutoffs, LOWEST, 0.5))) ** 2
    motion = (corner[:, None] / chord) ** ORDER
    kept = motion / (1.0 + motion)
    beyond = np.where(motion < 1.0, (corner[:, None] / chord) ** (ORDER - _SHALLOWER), motion)
    power = kept**2 + (1.0 - kept) ** 2 * beyond
    kinds = (np.ones_like(omega), np.sin(omega) ** 2, chord**2)
    return np.stack([trapezoid(power * kind, omega, axis=1) / np.pi for kind in kinds])


@lru_cache(maxsize=1)
def _near_ends() -> tuple[FloatArray, FloatArray]:
    """(n,) distances in periods of the cut-off, (3, n) growth of the deviations."""
    difference = np.diff(np.eye(_FRAMES), ORDER, axis=0)
    weight = float(weight_of(_CUTOFF, ORDER))
    spread = np.linalg.inv(np.eye(_FRAMES) + weight * difference.T @ difference)
    steps = (np.eye(_FRAMES), velocity(np.eye(_FRAMES)), acceleration(np.eye(_FRAMES)))
    found = [np.sqrt(np.einsum("ij,jk,ik->i", step, spread, step)) for step in steps]
    half = _FRAMES // 2
    growths = np.stack([values[:half] / values[half] for values in found])
    return np.asarray(np.arange(half) * _CUTOFF, dtype=np.float64), growths


def velocity(positions: FloatArray) -> FloatArray:
    """Central difference per frame; of second order at both ends.

    Parameters
    ----------
    positions : (n, ...) float64, n > 2
    """
    return np.asarray(np.gradient(positions, axis=0, edge_order=2))


def acceleration(positions: FloatArray) -> FloatArray:
    """Second difference per frame squared; the ends have their neighbours' value.

    Parameters
    ----------
    positions : (n, ...) float64, n > 2
    """
    result = np.empty_like(positions)
    result[1:-1] = np.diff(positions, 2, axis=0)
    result[0], result[-1] = result[1], result[-2]
    return result
