"""Candidates for slow changes: where a shape of the bank stands out of a whitened residual."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.ndimage import maximum_filter1d

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.detectors.joint.bank import KINDS, bank, local_level, scores
from markermend.detectors.joint.measures import FEATURES, measure, refine
from markermend.detectors.joint.views import BODY, look

LEAST = 4.8
APART = 15


@dataclass(frozen=True, eq=False)
class Candidates:
    """Possible slow changes of one marker.

    Attributes
    ----------
    axis, start, stop : (n,) int64, where
    size_mm : (n,) signed fitted height
    features : (n, k) see :data:`markermend.detectors.joint.measures.FEATURES`
    """

    axis: IntArray
    start: IntArray
    stop: IntArray
    size_mm: FloatArray
    features: FloatArray

    def __len__(self) -> int:
        return len(self.axis)


def scan(
    positions: FloatArray,
    marker: int,
    known: BoolArray,
    trusted: BoolArray,
    spreads: FloatArray,
) -> Candidates:
    """Look for slow changes of one marker.

    Parameters
    ----------
    positions : (frames, markers, 3) mm; NaN only where the target is not ``known``
    marker : column
    known : (frames, 3) bool, samples of the target that are measured and not damaged
    trusted : (frames, markers) bool, samples that may be learned from
    spreads : (markers, markers) from :func:`markermend.predictors.cross_fit.distance_spreads`

    Returns
    -------
    Candidates; none where the body says nothing about the marker
    """
    views = look(positions, marker, known, trusted, spreads)
    if views is None:
        return nothing()
    kinds, lengths = (np.array(v) for v in zip(*bank()[1], strict=True))
    which = np.array([list(KINDS).index(str(kind)) for kind in kinds])
    # The bank has its kinds one after another: slices of scores, which need not be copied.
    borders = np.searchsorted(which, np.arange(len(KINDS) + 1))
    each = [slice(a, b) for a, b in pairwise(borders)]
    found = []
    for axis in range(3):
        score = np.abs(
            scores(views.error[BODY, axis], views.weight[BODY, axis], views.habit[BODY, axis])
        )
        levels = np.stack([local_level(score[:, one]) for one in each])
        for one, level in zip(each, levels, strict=True):
            score[:, one] /= level[:, None]
        best = score.argmax(axis=1)
        height = score[np.arange(len(score)), best]
        at = np.flatnonzero((height >= LEAST) & (height == maximum_filter1d(height, 2 * APART + 1)))
        level = levels[which[best[at]], at]
        found.append((np.full(len(at), axis), at, best[at], level))
    axes, start, template, level = (np.concatenate(v) for v in zip(*found, strict=True))
    if not len(axes):
        return nothing()
    kind = kinds[template]
    start, length, shapes = refine(views, axes, start, kind, lengths[template])
    size, features = measure(views, axes, start, length, kind, shapes, level)
    return Candidates(axes, start, start + length, size, features)


def nothing() -> Candidates:
    """No candidates."""
    none = np.zeros(0, dtype=np.int64)
    return Candidates(none, none, none, np.zeros(0), np.zeros((0, len(FEATURES))))
