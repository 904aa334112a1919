"""Bridge unknown samples, for filters and predictors that need a value in every frame."""

from __future__ import annotations

from functools import partial

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, runs

# A spline follows motion across a short hole without a kink that a filter would see; across a
# long one it overshoots.
SPLINE_FRAMES = 24
LEAST_KNOWN = 4


def bridge(signal: FloatArray, known: BoolArray) -> FloatArray:
    """Interpolate unknown samples, channel by channel.

    Parameters
    ----------
    signal : (frames, channels); values where ``known`` is false are ignored and may be NaN
    known : (frames, channels) bool

    Returns
    -------
    (frames, channels) without NaN. Holes of up to 24 frames by cubic spline, longer ones by
    modified Akima interpolation; before the first and after the last known sample the nearest
    one is held, as it is everywhere in a channel with fewer than four; one with none is 0.
    """
    filled = np.where(known, signal, 0.0)
    frames = np.arange(len(signal))
    for channel in np.flatnonzero(~known.all(axis=0)):
        at = frames[known[:, channel]]
        if len(at):
            filled[:, channel] = _bridged(at, signal[at, channel], ~known[:, channel])
    return filled


def _bridged(at: IntArray, values: FloatArray, holes: BoolArray) -> FloatArray:
    """One channel, complete: known values at their frames, holes bridged."""
    # Takes a third of a second to load, in every process of a search.
    from scipy.interpolate import Akima1DInterpolator, CubicSpline

    frames = np.arange(len(holes))
    if len(at) < LEAST_KNOWN:
        return np.asarray(values[np.abs(frames[:, None] - at).argmin(axis=1)])
    whole = np.empty(len(holes))
    whole[at] = values
    lengths = runs(holes)
    short = np.zeros(len(holes), dtype=bool)
    for start, stop in lengths[lengths[:, 1] - lengths[:, 0] <= SPLINE_FRAMES]:
        short[start:stop] = True
    for which, curve in (
        (short, CubicSpline),
        (holes & ~short, partial(Akima1DInterpolator, method="makima")),
    ):
        if which.any():
            whole[which] = curve(at, values)(np.clip(frames[which], at[0], at[-1]))
    return whole
