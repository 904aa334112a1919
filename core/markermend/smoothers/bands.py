"""How far off a smoothed trajectory and its derivatives may be."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from markermend.arrays import FloatArray
from markermend.smoothers.levels import ORDER
from markermend.smoothers.penalised import LOWEST, weight_of

# The reference for stretch ends: frames and cut-off of a stretch solved in full.
_FRAMES, _CUTOFF = 240, 0.05


def deviations(cutoffs: FloatArray, to_end: FloatArray) -> tuple[FloatArray, ...]:
    """Standard deviations of position, velocity and acceleration for noise of one.

    Parameters
    ----------
    cutoffs : (...) halved frequency as share of the frame rate
    to_end : (...) frames to the nearer end of the stretch

    Returns
    -------
    three (...) float64; velocity per frame, acceleration per frame squared

    Notes
    -----
    Away from ends the error of a locally stationary smoother of transfer H has the spectrum
    s·H. Near ends it is larger; by how much depends on the distance in units of the cut-off's
    period, and is read off one short stretch solved in full.
    """
    log_cutoffs, logs = _inside()
    distances, growths = _near_ends()
    at = np.log(np.clip(cutoffs, LOWEST, 0.5))
    along = to_end * cutoffs
    return tuple(
        np.exp(np.interp(at, log_cutoffs, logs[k])) * np.interp(along, distances, growths[k])
        for k in range(3)
    )


@lru_cache(maxsize=1)
def _inside() -> tuple[FloatArray, FloatArray]:
    """(k,) log cut-offs, (3, k) log deviations away from ends."""
    from scipy.integrate import trapezoid

    cutoffs = np.geomspace(LOWEST, 0.5, 80)
    omega = np.geomspace(1e-4, np.pi, 4000)
    chord = (2.0 * np.sin(omega / 2.0)) ** 2
    power = 1.0 / (1.0 + weight_of(cutoffs, ORDER)[:, None] * chord**ORDER)
    kinds = (np.ones_like(omega), np.sin(omega) ** 2, chord**2)
    logs = [0.5 * np.log(trapezoid(power * kind, omega, axis=1) / np.pi) for kind in kinds]
    return np.asarray(np.log(cutoffs), dtype=np.float64), np.array(logs, dtype=np.float64)


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
