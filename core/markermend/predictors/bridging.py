"""Bridge unknown samples, for filters and predictors that need a value in every frame."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator

from markermend.arrays import BoolArray, FloatArray


def bridge(signal: FloatArray, known: BoolArray) -> FloatArray:
    """Interpolate unknown samples, channel by channel.

    Parameters
    ----------
    signal : (frames, channels); values where ``known`` is false are ignored and may be NaN
    known : (frames, channels) bool

    Returns
    -------
    (frames, channels) without NaN. Inside, monotone cubic (PCHIP); before the first and after
    the last known sample the nearest one is held; a channel with none is 0.
    """
    filled = np.where(known, signal, 0.0)
    frames = np.arange(len(signal))
    for channel in np.flatnonzero(~known.all(axis=0)):
        at = frames[known[:, channel]]
        if len(at) == 0:
            continue
        holes = frames[~known[:, channel]]
        values = signal[at, channel]
        if len(at) == 1:
            filled[holes, channel] = values[0]
            continue
        inside = np.clip(holes, at[0], at[-1])
        filled[holes, channel] = PchipInterpolator(at, values)(inside)
    return filled
