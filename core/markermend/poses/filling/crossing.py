"""Gaps of a few frames, many and alike, filled all at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.filling.bridging import around
from markermend.poses.filling.covariance import Moments
from markermend.poses.filling.gaps import Gap

# Added to variances before they are inverted.
_RIDGE = 1e-6


def cross_short(
    base: FloatArray,
    variance: FloatArray,
    known: BoolArray,
    gaps: Iterable[Gap],
    moments: Moments,
    rate: float,
    cross: Callable[[int], FloatArray],
) -> None:
    """Let short gaps of ``base``, crossed by time, stray as the others tell, in place.

    Parameters
    ----------
    base : (frames, channels) without NaN, the gaps bridged
    variance : (frames, channels) expected squared errors
    known : (frames, channels) bool
    gaps : the short ones, with as many frames at either side as a bridge stands on
    moments : of the channels
    rate : frames per second
    cross : length of a gap to (length, 2 · SIDE) weights of the frames at its sides

    Notes
    -----
    One inverse serves all: with precisions P the unknown given the known is -P_uu⁻¹ P_uk k, of
    covariance P_uu⁻¹, and few channels are unknown at a time.
    """
    for length in sorted({gap.stop - gap.start for gap in gaps}):
        some = [g for g in gaps if g.stop - g.start == length]
        covariance = moments.within_s(length / rate)
        precision = np.linalg.inv(covariance + _RIDGE * np.eye(len(covariance)))
        starts = np.array([gap.start for gap in some], dtype=int)[:, None]
        inside = starts + np.arange(length)
        hidden: BoolArray = np.any(~known[inside], axis=1)
        bridges = np.einsum("ls,gsc->glc", cross(length), base[starts + around(0, length)])
        told = np.where(hidden[:, None], 0.0, base[inside] - bridges) @ precision
        ranks, sizes = hidden.cumsum(axis=1) - 1, np.array([len(gap.channels) for gap in some])
        last = ranks[:, -1]
        for rank, size in sorted(set(zip(last.tolist(), sizes.tolist(), strict=True))):
            alike = np.flatnonzero((last == rank) & (sizes == size))
            unknown = np.nonzero(hidden[alike])[1].reshape(-1, rank + 1)
            channels = np.array([some[n].channels for n in alike.tolist()])
            own = np.arange(len(alike))[:, None], ranks[alike[:, None], channels], np.arange(size)
            asked = np.zeros((len(alike), rank + 1, size))
            asked[own] = 1.0
            left = np.linalg.solve(precision[unknown[:, :, None], unknown[:, None]], asked)
            strays = np.take_along_axis(told[alike], unknown[:, None], axis=2) @ left
            part = inside[alike][:, :, None], channels[:, None]
            base[part] = np.take_along_axis(bridges[alike], channels[:, None], axis=2) - strays
            variance[part] = left[own][:, None]
