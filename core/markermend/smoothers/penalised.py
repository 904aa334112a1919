"""Penalised differences: the banded solver, and the likelihood of their weight.

A trajectory x of which the d-th difference is white with variance q, seen in white noise of
variance s, is estimated by minimising Σ (y − x)² / s + Σ (Δᵈx)² / q (Whittaker 1923, Henderson
1924). The ratio λ = s/q says how much is smoothed; here it is named by the frequency that is
halved. s and q may change along the take.
"""

from __future__ import annotations

from math import comb

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import FloatArray

LOWEST = 0.003
"""Lowest frequency, as share of the rate, that float64 can still halve with order 4."""


def difference_weights(order: int) -> FloatArray:
    """(order + 1,) coefficients of the difference, as :func:`numpy.diff` takes it."""
    return np.array([(-1.0) ** (order - k) * comb(order, k) for k in range(order + 1)])


def weight_of(cutoff: NDArray[np.float64] | float, order: int) -> FloatArray:
    """Ratio λ of noise to motion variance at which a frequency is halved.

    Parameters
    ----------
    cutoff : share of the frame rate, above 0 and up to 0.5
    order : of the difference
    """
    return np.asarray((2.0 * np.sin(np.pi * np.asarray(cutoff))) ** (-2.0 * order))


def solve(values: FloatArray, noise: FloatArray, motion: FloatArray, order: int) -> FloatArray:
    """Minimise Σ (y − x)² / s + Σ (Δᵈx)² / q.

    Parameters
    ----------
    values : (n,) y, without NaN, n > order
    noise : (n,) s, above 0
    motion : (n − order,) q, above 0
    order : d

    Returns
    -------
    (n,) x

    Notes
    -----
    Solved in the dual form x = y − S Dᵀu with (Q + D S Dᵀ) u = D y. The usual form
    (S⁻¹ + Dᵀ Q⁻¹ D) x = S⁻¹ y loses all digits in slow motion, since there it adds huge numbers
    times the coordinate itself; here only differences of y enter.
    """
    from scipy.linalg import solveh_banded

    m = len(values) - order
    c = difference_weights(order)
    band = np.zeros((order + 1, m))
    for lag in range(min(order, m - 1) + 1):
        row = band[order - lag, lag:]
        for k in range(order + 1 - lag):
            row += c[k] * c[k + lag] * noise[lag + k : k + m]
    band[order] += motion
    u = solveh_banded(band, np.diff(values, order), overwrite_ab=True, check_finite=False)
    result = values.copy()
    for k in range(order + 1):
        result[k : k + m] -= noise[k : k + m] * c[k] * u
    return result


def innovations_filter(weight: float, order: int) -> tuple[FloatArray, float]:
    """Recursion that whitens the d-th difference, and the variance it leaves.

    Parameters
    ----------
    weight : λ
    order : d

    Returns
    -------
    coefficients θ of θ(B) e = Δᵈy, and the variance of e as multiple of the noise's

    Notes
    -----
    1/λ + (1 − z)ᵈ(1 − 1/z)ᵈ is factored in closed form: (1 − z)(1 − 1/z) = (−1/λ)^(1/d) has one
    root inside the unit circle for each of the d complex roots.
    """
    turn = np.exp(1j * np.pi * (2 * np.arange(order) + 1) / order)
    half = 1.0 - weight ** (-1.0 / order) * turn / 2.0
    root = half - np.sqrt(half * half - 1.0)
    root = np.where(np.abs(root) > 1.0, 1.0 / root, root)
    theta = np.real(np.poly(root))
    spread = (4.0**order + 1.0 / weight) / np.real(np.prod(1.0 + root)) ** 2
    return np.asarray(theta, dtype=np.float64), float(spread)


def innovations(differences: FloatArray, weight: float, order: int) -> tuple[FloatArray, float]:
    """One-step prediction errors, were the motion's and noise's ratio λ.

    Parameters
    ----------
    differences : (channels, n) Δᵈy
    weight : λ
    order : d

    Returns
    -------
    (channels, n) errors, and their variance as multiple of the noise's
    """
    from scipy.signal import lfilter

    theta, spread = innovations_filter(weight, order)
    return np.asarray(lfilter([1.0], theta, differences, axis=1), dtype=np.float64), spread


def likeliest_cutoff(values: FloatArray, rate: float, order: int) -> tuple[FloatArray, FloatArray]:
    """Halved frequency and noise of greatest likelihood, one of each for the whole stretch.

    Parameters
    ----------
    values : (n, channels) float64, without NaN, n > 2 · order
    rate : frames per second
    order : d

    Returns
    -------
    (channels,) cut-off in Hz and (channels,) standard deviation of the noise

    Notes
    -----
    The noise is profiled out; the peak is refined by a parabola over log frequency.
    """
    grid = np.geomspace(max(0.3, LOWEST * rate), 0.4 * rate, 40)
    differences = np.ascontiguousarray(np.diff(values, order, axis=0).T)
    n = differences.shape[1]
    likelihood = np.empty((len(grid), len(differences)))
    noise = np.empty_like(likelihood)
    for k, cutoff in enumerate(grid):
        e, spread = innovations(differences, float(weight_of(cutoff / rate, order)), order)
        power = np.maximum(np.mean(e * e, axis=1), 1e-24)
        noise[k] = np.sqrt(power / spread)
        likelihood[k] = -0.5 * n * np.log(power)
    best = np.clip(likelihood.argmax(axis=0), 1, len(grid) - 2)
    channel = np.arange(len(differences))
    left, top, right = (likelihood[best + shift, channel] for shift in (-1, 0, 1))
    bend = left - 2.0 * top + right
    shift = np.clip(0.5 * (left - right) / np.where(bend < 0, bend, -1.0), -1.0, 1.0)
    step = np.log(grid[1] / grid[0])
    return grid[best] * np.exp(step * shift), noise[best, channel]
