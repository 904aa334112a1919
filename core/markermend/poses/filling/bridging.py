"""Cross gaps by what stands on their sides: the part that time alone tells."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.linalg import solveh_banded

from markermend.arrays import BoolArray, FloatArray, IntArray, free_starts, runs

SIDE = 2
"""Known frames on each side that a bridge stands on."""

_ORDER = 2
# Stretches that are known on which a bridge is tried, about.
_TRIED = 40


@lru_cache(maxsize=4096)
def bridge(length: int) -> FloatArray:
    """Weights of the frames beside a gap for each frame within it.

    Half of the way between the straight line from side to side, which stays calm in long gaps, and
    the curve of least second differences, which follows the movement into short ones.

    Parameters
    ----------
    length : of the gap, in frames

    Returns
    -------
    (length, 2 · SIDE) float64; the columns are the two frames before and the two after
    """
    differences = np.diff(np.eye(length + 2 * SIDE), 2, axis=0)
    inside = differences[:, SIDE : SIDE + length]
    outside = np.delete(differences, np.s_[SIDE : SIDE + length], axis=1)
    curve = -np.linalg.lstsq(inside, outside, rcond=None)[0]
    return np.asarray(0.5 * curve + 0.5 * straight(length))


@lru_cache(maxsize=4096)
def straight(length: int) -> FloatArray:
    """Weights as :func:`bridge` has them, of the straight line from side to side."""
    share = np.arange(1, length + 1) / (length + 1)
    weights = np.zeros((length, 2 * SIDE))
    weights[:, SIDE - 1], weights[:, SIDE] = 1.0 - share, share
    return weights


def around(start: int, stop: int) -> IntArray:
    """Frames a bridge over ``[start, stop)`` stands on."""
    return np.asarray(np.r_[start - SIDE : start, stop : stop + SIDE])


def known_alike(known: BoolArray) -> list[list[int]]:
    """Channels that are known in the same frames, together; by the first of each."""
    alike: dict[bytes, list[int]] = {}
    for channel, column in enumerate(known.T):
        alike.setdefault(column.tobytes(), []).append(channel)
    return list(alike.values())


def bridged(values: FloatArray, known: BoolArray) -> FloatArray:
    """Cross every gap of a recording, halfway between line and curve.

    Parameters
    ----------
    values : (frames, channels); what stands where nothing is known does not matter
    known : (frames, channels) bool, true somewhere in every channel

    Returns
    -------
    (frames, channels). Before the first and after the last known value that value holds.
    """
    out = np.where(known, values, 0.0)
    for group in known_alike(known):
        seen = known[:, group[0]]
        there, missing = np.flatnonzero(seen), np.flatnonzero(~seen)
        if not len(missing):
            continue
        after = np.searchsorted(there, missing)
        sides = there[[np.maximum(after - 1, 0), np.minimum(after, len(there) - 1)]]
        share = (missing - sides[0]) / np.maximum(sides[1] - sides[0], 1)
        before, then = values[sides[:, :, None], group]
        out[missing[:, None], group] = before + share[:, None] * (then - before)
        inner = slice(int(there[0]), int(there[-1]) + 1)
        unknown = missing[(missing > inner.start) & (missing < inner.stop)]
        if len(unknown) and inner.stop - inner.start > 2 * _ORDER:
            bend = _towards_curve(out[inner, group], unknown - inner.start)
            out[unknown[:, None], group] += 0.5 * bend
    return out


def time_variance(base: FloatArray, known: BoolArray, rate: float) -> FloatArray:
    """Expected squared error of bridges over short gaps, from how far single frames stray."""
    variance = np.zeros_like(base)
    if len(base) > 2:
        bend = base[1:-1] - 0.5 * (base[:-2] + base[2:])
        both = known[:-2] & known[1:-1] & known[2:]
        spread = np.sum(np.where(both, bend, 0.0) ** 2, axis=0) / np.maximum(both.sum(axis=0), 1)
        variance += np.where(known, 0.0, spread)
    return variance


def arch(length: int) -> FloatArray:
    """(length,) how the variance swells from the sides of a gap to its middle, 1 on average."""
    share = np.arange(1, length + 1) / (length + 1)
    arch = share * (1.0 - share)
    return np.asarray(arch / arch.mean())


def bridging_error(path: FloatArray, known: BoolArray) -> FloatArray:
    """How far :func:`bridged` may be off, by what it misses where the path is known.

    Parameters
    ----------
    path : (frames, n) of one point; anything where not known
    known : (frames,) bool

    Returns
    -------
    (frames,) root mean square distance, 0 where known; NaN where nothing is known. Where no stretch
    is known that is as long as a gap, shorter ones are tried, and what they miss grows by the
    square of the length, as what is missed of a movement at constant acceleration does, up to the
    way that is made from the nearer side. Where none is known to be tried, it is the way made in a
    gap's time.
    """
    error = np.zeros(len(path))
    if not known.any():
        return np.full(len(path), np.nan)
    longest = max(int(np.max(np.diff(runs(known), axis=1))) - 2 * SIDE, 1)
    missed: dict[int, FloatArray] = {}
    for start, stop in runs(~known).tolist():
        count = stop - start
        if start == 0 or stop == len(path):
            held = _held_error(path, known, count)
            error[start:stop] = held[::-1] if start == 0 else held
            continue
        if count not in missed:
            missed[count] = _missed(path, known, count, min(count, longest))
        error[start:stop] = missed[count]
    return error


def _missed(path: FloatArray, known: BoolArray, count: int, length: int) -> FloatArray:
    """(count,) what bridges over a gap of so many frames miss, tried on some that are as long."""
    starts = free_starts(known, length, SIDE)
    if not len(starts):
        return _held_error(path, known, count)
    starts = starts[:: max(len(starts) // _TRIED, 1)]
    inside = path[starts[:, None] + np.arange(length)]
    told = np.einsum("ls,nsc->nlc", bridge(length), path[starts[:, None] + around(0, length)])
    off = np.sqrt(np.mean(np.sum((inside - told) ** 2, axis=2), axis=0))
    error = np.interp(np.linspace(0, length - 1, count), np.arange(length), off)
    if count > length:
        steps = np.diff(path, axis=0)[known[1:] & known[:-1]]
        nearer = np.minimum(np.arange(count) + 1, np.arange(count, 0, -1))
        way = float(np.sqrt(np.mean(np.sum(steps**2, axis=1)))) * nearer
        error = np.minimum(error * (count / length) ** 2, way)
    return np.asarray(error)


def _held_error(path: FloatArray, known: BoolArray, count: int) -> FloatArray:
    """(count,) root mean square way made in 1, 2, … frames; NaN where only one is known."""
    apart = np.diff(np.flatnonzero(known))
    if not len(apart):
        return np.full(count, np.nan)
    lags, off = [0], [0.0]
    some = np.linspace(1, 2 * count, min(2 * count, _TRIED)).astype(int)
    for lag in np.unique([*some, apart.min()]).tolist():
        both = known[lag:] & known[:-lag]
        if both.any():
            way = (path[lag:] - path[:-lag])[both]
            lags.append(lag)
            off.append(float(np.sqrt(np.mean(np.sum(way**2, axis=1)))))
    return np.interp(np.arange(1, count + 1), lags, off)


def _towards_curve(line: FloatArray, unknown: IntArray) -> FloatArray:
    """(unknown, channels) from the lines over gaps to the curves of least second differences."""
    frames, count = len(line), len(unknown)
    stencil = np.diff(np.eye(_ORDER + 1), _ORDER, axis=0)[0]
    valid = frames - _ORDER
    diagonals = np.zeros((_ORDER + 1, frames))
    for lag in range(_ORDER + 1):
        for k in range(_ORDER + 1 - lag):
            diagonals[lag, k : k + valid] += stencil[k] * stencil[k + lag]
    steps = np.diff(line, _ORDER, axis=0)
    slope = np.zeros_like(line)
    for k in range(_ORDER + 1):
        slope[k : k + valid] += stencil[k] * steps
    band = np.zeros((_ORDER + 1, count))
    band[0] = diagonals[0, unknown]
    for off in range(1, min(_ORDER, count - 1) + 1):
        apart = unknown[off:] - unknown[:-off]
        for lag in range(off, _ORDER + 1):
            near = np.flatnonzero(apart == lag)
            band[off, near] = diagonals[lag, unknown[near]]
    return np.asarray(solveh_banded(band, -slope[unknown], lower=True))
