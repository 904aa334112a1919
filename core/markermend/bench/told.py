"""What repairs tell of their own error, held against what they miss."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray
from markermend.artifact import axis_columns
from markermend.repairs.registry import Repair
from markermend.take import Take

WITHIN_90 = (1.6449, 1.5174, 1.4434)
"""Bands that hold 90 % of a Gaussian error on one, two and three axes, in root mean squares."""


@dataclass(frozen=True)
class Told:
    """One repair beside the truth.

    Attributes
    ----------
    off_mm : mean distance on the axes repaired
    expected_mm : the same as the repair tells it
    held : share of its frames that its 90 % band holds
    """

    off_mm: float
    expected_mm: float
    held: float


NOTHING_TOLD = Told(math.nan, math.nan, math.nan)


def beside_truth(repairs: Iterable[Repair], truth: Take, counted: BoolArray) -> list[Told]:
    """Hold repairs against the truth.

    Parameters
    ----------
    repairs : those without patches, or that say nothing of their error, are passed over; so are
        swaps, which put measured samples back
    truth : the recording as it was
    counted : (frames, markers, 3) bool; samples that are not, or are missing, are left out
    """
    told = []
    for repair in repairs:
        if len(repair.patches) != 1 or repair.error_mm is None or repair.band_mm is None:
            continue
        (patch,) = repair.patches
        rows, axes = slice(patch.start, patch.stop), axis_columns(patch.axes)
        marker = truth.index(patch.marker)
        off = np.linalg.norm(patch.values - truth.positions[rows, marker][:, axes], axis=1)
        known = counted[rows, marker][:, axes].all(axis=1) & ~np.isnan(off)
        if known.any():
            held = off[known] <= WITHIN_90[len(axes) - 1] * repair.band_mm[known]
            told.append(Told(float(off[known].mean()), repair.error_mm, float(held.mean())))
    return told


def mean_told(told: Sequence[Told]) -> Told:
    """Mean of each, a repair counting as much as another; NaN of none."""
    if not told:
        return NOTHING_TOLD
    means = np.mean([(t.off_mm, t.expected_mm, t.held) for t in told], axis=0)
    return Told(*means.tolist())
