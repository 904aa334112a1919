"""Which points of a curve are drawn: as many as can be told apart, and certain stretches only."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs

Place = tuple[float, float, float]
"""First and last frame in view, and over how many pixels."""


def thinned_values(values: FloatArray, step: float, place: Place) -> tuple[FloatArray, FloatArray]:
    """What can be told apart of one value a step: the least and greatest of each pixel.

    Parameters
    ----------
    values : (n,) float64, NaN = missing; a pixel in which one is missing is a hole
    step : frames from one value to the next
    place : what is in view

    Returns
    -------
    x, y : (m,) frames and values, with one more on either side of what is in view
    """
    low, high, pixels = place[0] / step, place[1] / step, place[2]
    first = min(max(0, math.floor(low)), len(values))
    last = max(first, min(len(values), math.ceil(high) + 1))
    many = int((high - low) / pixels)
    if many <= 1:
        return step * np.arange(first, last, dtype=np.float64), values[first:last]
    # Groups that begin at multiples of their size do not flicker while the view is moved.
    first -= first % many
    last = min(len(values), last + -last % many)
    whole = (last - first) // many
    groups = values[first : first + whole * many].reshape(whole, many)
    rest = values[first + whole * many : last]
    y = np.empty(2 * (whole + (len(rest) > 0)))
    y[: 2 * whole : 2], y[1 : 2 * whole : 2] = groups.max(axis=1), groups.min(axis=1)
    if len(rest):
        y[-2:] = rest.max(), rest.min()
    x: FloatArray = np.repeat(first + many * (np.arange(len(y) // 2) + 0.5), 2)
    return step * x, y


def thinned_points(x: FloatArray, y: FloatArray, place: Place) -> tuple[FloatArray, FloatArray]:
    """What can be told apart of values at any frames: the least and greatest of each pixel.

    Parameters
    ----------
    x, y : (n,) frames that rise, and values; a NaN between stretches that lie apart
    place : what is in view

    Returns
    -------
    x, y : (m,) frames and values, a NaN in y between stretches that lie more than a pixel apart;
        with one more on either side of what is in view
    """
    low, high, pixels = place
    view = slice(max(0, bisect_left(x, low) - 1), bisect_right(x, high) + 1)
    x, y = x[view], y[view]
    if len(x) <= 2 * pixels:
        return x, y
    there = np.isfinite(y)
    x, y = x[there], y[there]
    many = max(1.0, (high - low) / pixels)
    group = np.floor(x / many)
    starts = np.flatnonzero(np.diff(group, prepend=-np.inf))
    group = group[starts]
    thin_x = np.repeat(many * (group + 0.5), 2)
    thin_y = np.empty(len(thin_x))
    thin_y[::2] = np.maximum.reduceat(y, starts)
    thin_y[1::2] = np.minimum.reduceat(y, starts)
    holes = 2 * (np.flatnonzero(np.diff(group) > 1) + 1)
    return np.insert(thin_x, holes, thin_x[holes - 1]), np.insert(thin_y, holes, np.nan)


def pieces(values: FloatArray, mask: BoolArray, join: int = 1) -> tuple[FloatArray, FloatArray]:
    """Take the masked stretches of a curve, apart from each other.

    Parameters
    ----------
    values : (frames,) float64, NaN = missing
    mask : (frames,) bool, the samples wanted
    join : samples on either side that are drawn along, so that a stretch meets its surroundings

    Returns
    -------
    x, y : frame indices and values, a NaN in y between two stretches
    """
    wanted = mask.copy()
    for step in range(1, join + 1):
        wanted[:-step] |= mask[step:]
        wanted[step:] |= mask[:-step]
    index = np.flatnonzero(wanted)
    breaks = np.flatnonzero(np.diff(index) > 1) + 1
    x = np.insert(index.astype(np.float64), breaks, index[breaks - 1] + 0.5)
    y = np.insert(values[index], breaks, np.nan)
    return x, y


def lone_samples(values: FloatArray) -> BoolArray:
    """(frames,) bool: samples with a hole on either side, which a line would not show."""
    mask = np.zeros(len(values), dtype=bool)
    found = runs(np.isfinite(values))
    mask[found[found[:, 1] - found[:, 0] == 1, 0]] = True
    return mask
