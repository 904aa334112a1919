"""Trajectories as the filters want them: no holes, and known which samples may be judged."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import binary_erosion

from markermend.arrays import BoolArray, FloatArray
from markermend.predictors.bridging import bridge
from markermend.take import Take

# The last frames before a gap and the first after it are what the cameras were about to lose;
# judged together with the bridge across the gap they would be flagged for the gap's own sake.
EDGE_FRAMES = 2
# Statistics of a channel with fewer judged samples than this say nothing.
LEAST_SAMPLES = 30
# Smallest threshold for sudden changes when findings are confirmed: on a marker that rests, three
# times its own spread is a fraction of a millimetre.
LEAST_MM = 1.5


def channels(take: Take, markers: slice | list[int]) -> tuple[FloatArray, BoolArray]:
    """Coordinates of some markers side by side, bridged, and where they were seen.

    Returns
    -------
    signal : (frames, 3 × markers) mm, x, y, z of the first marker first; without NaN
    seen : (frames, 3 × markers) bool
    """
    signal = take.positions[:, markers].reshape(take.frames, -1)
    seen = ~np.isnan(signal)
    return bridge(signal, seen), seen


def judged(seen: BoolArray) -> BoolArray:
    """Differentials that may be judged: both samples seen, and no gap within two frames.

    Parameters
    ----------
    seen : (frames, channels) bool

    Returns
    -------
    (frames, channels) bool; the first frame, which has no differential, is false
    """
    inner = binary_erosion(seen, np.ones((2 * EDGE_FRAMES + 1, 1), dtype=bool), border_value=1)
    valid = np.zeros_like(seen)
    valid[1:] = inner[1:] & inner[:-1]
    valid[:, valid.sum(axis=0) < LEAST_SAMPLES] = False
    return valid


def spread(signal: FloatArray, valid: BoolArray) -> FloatArray:
    """Standard deviation of each channel over its valid samples; 0 where there are none.

    Parameters
    ----------
    signal, valid : (frames, channels)

    Returns
    -------
    (channels,)
    """
    count = np.maximum(valid.sum(axis=0), 1)
    mean = np.where(valid, signal, 0.0).sum(axis=0) / count
    square = np.where(valid, (signal - mean) ** 2, 0.0).sum(axis=0) / count
    return np.asarray(np.sqrt(square))


def thresholds(k: float, signal: FloatArray, valid: BoolArray, *, confirm: bool) -> FloatArray:
    """``k`` times the standard deviation, for each channel.

    Parameters
    ----------
    k : multiple
    signal, valid : (frames, channels)
    confirm : each channel by itself and at least 1.5 mm, instead of the spread of all channels
        together

    Returns
    -------
    (channels,) in the signal's unit
    """
    own = spread(signal, valid)
    if confirm:
        return np.maximum(k * own, LEAST_MM)
    together = spread(signal.reshape(-1, 1), valid.reshape(-1, 1))
    return np.full(len(own), k * together[0])
