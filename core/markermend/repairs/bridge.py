"""A smooth bridge across an interval, for what a prediction leaves open on both of its sides.

What is left is a Gaussian process of time (rasmussen2006, 2.2) around the straight line that
joins the two sides. It meets value and velocity at both borders and soon forgets the velocity, so
that it never overshoots far; its variance says how far off the bridge may be.
"""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, free_starts

# Scales of the two Matérn 3/2 covariances, and how far on either side the bridge looks.
SCALES_S = (0.13, 0.67)
CONTEXT_S = 0.5
# Sizes of the process and of the measurement's noise among which the likelihood chooses.
SIZES_MM = np.geomspace(0.02, 2000.0, 40)
NOISES_MM = np.array([0.02, 0.05, 0.1, 0.2, 0.5, 1.0])
# Known stretches that are hidden to see how far off a bridge is.
TRIALS = 6
# Length of a 90 % ball in standard deviations of one coordinate, in three dimensions.
BALL_90 = 2.5003


def context_of(seen: BoolArray, start: int, stop: int, rate: float) -> IntArray:
    """Frames beside an interval on which a bridge across it rests.

    Parameters
    ----------
    seen : (frames,) bool, samples that may be believed
    start, stop : the interval
    rate : frames per second

    Returns
    -------
    (k,) frames within 0.5 s of the interval, outside of it, in order; possibly none
    """
    reach = max(2, round(CONTEXT_S * rate))
    first, last = max(0, start - reach), min(len(seen), stop + reach)
    around = first + np.flatnonzero(seen[first:last])
    return np.asarray(around[(around < start) | (around >= stop)], dtype=np.int64)


def bridge(
    frames: IntArray, values: FloatArray, start: int, stop: int, rate: float
) -> tuple[FloatArray, FloatArray]:
    """Continue values known beside an interval smoothly through it.

    Parameters
    ----------
    frames : (k,) frames outside the interval, k at least 1
    values : (k, 3) mm, known there
    start, stop : the interval
    rate : frames per second

    Returns
    -------
    mean : (stop - start, 3) mm; with one side only it goes back to that side's mean
    deviation : (stop - start, 3) standard deviation, mm
    """
    wanted = np.arange(start, stop)
    line, trend = _line(frames, values, start, wanted)
    eigenvalues, vectors = np.linalg.eigh(_covariance(frames, frames, rate))
    eigenvalues = np.maximum(eigenvalues, 0.0)
    across = _covariance(wanted, frames, rate) @ vectors
    turned = vectors.T @ (values - line)
    mean, deviation = trend.copy(), np.empty_like(trend)
    for axis in range(3):
        size, noise = _likeliest(eigenvalues, turned[:, axis])
        total = size * eigenvalues + noise
        mean[:, axis] += size * across @ (turned[:, axis] / total)
        explained = np.sum(across**2 / total, axis=1)
        deviation[:, axis] = np.sqrt(np.maximum(size - size**2 * explained, noise))
    return mean, deviation


def bridge_within(
    values: FloatArray, known: BoolArray, start: int, stop: int, rate: float
) -> tuple[FloatArray, FloatArray]:
    """Bridge an interval of a signal, with a deviation measured on the rest of it.

    Parameters
    ----------
    values : (frames, 3) mm; anything where not known
    known : (frames,) bool, true somewhere within 0.5 s of the interval and nowhere in it
    start, stop : the interval
    rate : frames per second

    Returns
    -------
    mean : (stop - start, 3) mm
    deviation : (stop - start, 3) mm, scaled so that a 90 % ball held nine in ten frames of up to
        six stretches of the same length that were hidden in turn; as :func:`bridge` gives it where
        there is none
    """
    frames = context_of(known, start, stop, rate)
    mean, deviation = bridge(frames, values[frames], start, stop, rate)
    ratios = []
    for first in _stretches(known, stop - start):
        last = first + stop - start
        around = context_of(known, first, last, rate)
        if not (frames < start).any():
            around = around[around >= last]
        if not (frames >= stop).any():
            around = around[around < first]
        if len(around):
            guess, size = bridge(around, values[around], first, last, rate)
            miss = np.linalg.norm(guess - values[first:last], axis=1)
            ratios.append(miss / np.sqrt(np.mean(size**2, axis=1)))
    if ratios:
        deviation = deviation * float(np.quantile(np.concatenate(ratios), 0.9)) / BALL_90
    return mean, deviation


def _stretches(known: BoolArray, length: int) -> IntArray:
    """Starts of stretches of a length that are known throughout, spread evenly over the take."""
    starts = free_starts(known, length, 0)
    if len(starts) == 0:
        return starts
    places = np.linspace(0, len(starts) - 1, TRIALS + 2)[1:-1]
    return np.unique(starts[places.astype(int)])


def _line(
    frames: IntArray, values: FloatArray, start: int, wanted: IntArray
) -> tuple[FloatArray, FloatArray]:
    """The line through the middle of both sides, at the known and at the wanted frames."""
    before = frames < start
    middle = values.mean(axis=0)
    if before.all() or not before.any():
        return np.broadcast_to(middle, values.shape), np.tile(middle, (len(wanted), 1))
    left, right = frames[before].mean(), frames[~before].mean()
    slope = (values[~before].mean(axis=0) - values[before].mean(axis=0)) / (right - left)
    origin = values[before].mean(axis=0)
    return (
        origin + (frames[:, None] - left) * slope,
        np.asarray(origin + (wanted[:, None] - left) * slope),
    )


def _covariance(one: IntArray, two: IntArray, rate: float) -> FloatArray:
    """(one, two) covariance of a process of size 1."""
    passed = np.abs(one[:, None] - two[None, :]) * (np.sqrt(3.0) / rate)
    parts = [(1.0 + passed / s) * np.exp(-passed / s) for s in SCALES_S]
    return np.asarray(sum(parts) / len(parts))


def _likeliest(eigenvalues: FloatArray, turned: FloatArray) -> tuple[float, float]:
    """Variances of process and noise under which the known values are most likely, mm²."""
    sizes, noises = SIZES_MM[:, None, None] ** 2, NOISES_MM[:, None] ** 2
    total = sizes * eigenvalues + noises
    cost = np.sum(np.log(total) + turned**2 / total, axis=2)
    i, j = np.unravel_index(np.argmin(cost), cost.shape)
    return float(SIZES_MM[i] ** 2), float(NOISES_MM[j] ** 2)
