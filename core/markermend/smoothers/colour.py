"""How far a marker's noise is correlated from frame to frame, and how to undo it."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray
from markermend.smoothers.penalised import difference_weights
from markermend.smoothers.registry import Signals

# High enough to leave little of the motion, low enough to tell colours apart.
_ORDER = 4
_BLOCK_S = 0.5
# Below the first correlation noise is as good as white; more than the second is never undone.
_WHITE, _STRONG = 0.1, 0.6
# From the first on it begins to look like a recording somebody filtered, at the second it does.
_DOUBTFUL, _FILTERED = 0.8, 0.95


def find_colour(signals: Signals) -> FloatArray:
    """Correlation of each marker's noise between neighbouring frames.

    Parameters
    ----------
    signals : trajectories; what is not measured is passed over

    Returns
    -------
    (markers,) float64 in [0, 0.6]; 0 where the noise is white or cannot be seen

    Notes
    -----
    Fourth differences hold noise and little motion. Their correlation at one frame grows with
    that of a first-order autoregressive noise; it is the median over axes and half seconds, so
    that bursts, flaws and fast motion have little say.
    """
    markers = signals.values.shape[1]
    measured = np.where(signals.measured[:, :, None], signals.values, np.nan)
    fourth = np.diff(measured, _ORDER, axis=0)
    length = max(2, round(_BLOCK_S * signals.rate))
    blocks = (len(fourth) - 1) // length
    if blocks < 1:
        return np.zeros(markers)
    used = blocks * length
    shape = (blocks, length, markers, 3)
    power = (fourth[:used] ** 2).reshape(shape).sum(axis=1)
    product = (fourth[:used] * fourth[1 : used + 1]).reshape(shape).sum(axis=1)
    # NaN where a sample is missing or nothing moves.
    known = power > 0
    ratio = np.where(known, product, np.nan) / np.where(known, power, 1.0)
    ratio = np.moveaxis(ratio, 1, 0).reshape(markers, -1)
    some = ~np.isnan(ratio).all(axis=1)
    found = np.zeros(markers)
    colours, seen = _scale()
    found[some] = np.interp(np.nanmedian(ratio[some], axis=1), seen, colours)
    found[found < _WHITE] = 0.0
    believed = np.clip((_FILTERED - found) / (_FILTERED - _DOUBTFUL), 0.0, 1.0)
    return np.asarray(np.minimum(found, _STRONG) * believed)


def whiten(signals: Signals, colour: FloatArray) -> Signals:
    """Filter trajectories so that their noise becomes white and their motion stays.

    Parameters
    ----------
    signals : trajectories
    colour : (markers,) correlation a

    Returns
    -------
    Signals
        (y_t − a y_{t−1}) / (1 − a); the first sample of a stretch is kept
    """
    a = colour[None, :, None]
    values = signals.values.copy()
    last = signals.values[:-1]
    white = (signals.values[1:] - a * last) / (1.0 - a)
    values[1:] = np.where(np.isnan(last) | (a == 0.0), values[1:], white)
    return Signals(values, signals.rate, signals.measured, signals.event_frames)


def _scale() -> tuple[FloatArray, FloatArray]:
    """Colours, and the correlation that differences show for each."""
    weights = difference_weights(_ORDER)
    spread = np.correlate(weights, weights, "full")
    colours = np.linspace(-0.5, 0.95, 60)
    lags = np.arange(-_ORDER, _ORDER + 1)
    same, next_one = (
        np.sum(spread * colours[:, None] ** np.abs(lags + shift), axis=1) for shift in (0, 1)
    )
    return colours, np.asarray(next_one / same)
