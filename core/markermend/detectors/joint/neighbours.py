"""The markers nearest to each marker, whose motion says whether a jump is real."""

from __future__ import annotations

import numpy as np

from markermend.arrays import IntArray, median_of_seen
from markermend.take import Take

NEAREST = 6
_SAMPLES = 100


def nearest_markers(take: Take, markers: list[int]) -> IntArray:
    """Rank markers by their usual distance.

    Parameters
    ----------
    take : the recording; about a hundred frames of it are looked at
    markers : columns considered, as targets and as neighbours

    Returns
    -------
    (len(markers), k) positions in ``markers`` of the k ≤ 6 nearest others; markers never seen
    together come last
    """
    some = take.positions[:: max(1, take.frames // _SAMPLES)][:, markers]
    count = len(markers)
    apart = np.empty((count, count))
    for i in range(count):
        apart[i] = median_of_seen(np.sqrt(((some - some[:, [i]]) ** 2).sum(axis=2)))
    apart[np.isnan(apart)] = np.inf
    np.fill_diagonal(apart, np.inf)
    k = min(NEAREST, count - 1)
    return np.argsort(apart, axis=1, kind="stable")[:, : max(k, 0)].astype(np.int64)
