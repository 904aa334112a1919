"""How much a trajectory jitters by itself: the yardstick of all sudden shapes."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from markermend.arrays import BoolArray, FloatArray, median_of_seen
from markermend.detectors.baselines import MAD_OF_NORMAL

# Long enough that half a second of damage in it does not count (81 frames blind a detector to
# heavy noise of 50, 401 do not), short enough to follow from rest to a jump.
BLOCK_S, BLOCKS = 0.42, 9


def jitter(change: FloatArray, valid: BoolArray, rate: float) -> FloatArray:
    """Robust local standard deviation along frames.

    Parameters
    ----------
    change : (frames, channels) high-passed signal
    valid : (frames, channels) bool, samples that count
    rate : frames per second

    Returns
    -------
    (frames, channels): the median over nine blocks of 0.42 s of each block's median magnitude,
    over 0.6745, interpolated between blocks. Channels without a valid sample have 0.
    """
    frames = len(change)
    count = max(1, round(frames / max(BLOCK_S * rate, 1.0)))
    edges = np.linspace(0, frames, count + 1).astype(int)
    size = np.where(valid, np.abs(change), np.nan) if not valid.all() else np.abs(change)
    blocks = np.stack([median_of_seen(size[a:b]) for a, b in pairwise(edges)])
    half = min(BLOCKS // 2, (count - 1) // 2)
    around = np.pad(blocks, ((half, half), (0, 0)), mode="reflect") if half else blocks
    level = median_of_seen(np.moveaxis(sliding_window_view(around, 2 * half + 1, axis=0), -1, 0))
    whole = median_of_seen(blocks)
    level = np.where(np.isnan(level), np.nan_to_num(whole), level) / MAD_OF_NORMAL
    centre = 0.5 * (edges[:-1] + edges[1:])
    left = np.clip(np.searchsorted(centre, np.arange(frames)) - 1, 0, max(count - 2, 0))
    if count == 1:
        return np.repeat(level, frames, axis=0)
    share = np.clip((np.arange(frames) - centre[left]) / (centre[left + 1] - centre[left]), 0, 1)
    return np.asarray(level[left] * (1 - share)[:, None] + level[left + 1] * share[:, None])
