"""From relations between markers to rigid groups."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.mesh.pairs import Pairs

# A millimetre of changing distance weighs as much as a centimetre of distance: near markers are
# more likely on the same bone, and where nothing moves nearness is all there is.
NEARNESS = 0.1
# Width of a group as a share of the body's, for a body whose distances vary by TYPICAL_MOTION of
# themselves. Vigorous takes shake the soft tissue more, so the limit follows, less than in
# proportion. Values found on a dozen recordings of people who stand, walk, roll and break-dance,
# under nine marker sets.
WIDTH = 0.05
TYPICAL_MOTION, LEAST_MOTION, MOTION_EXPONENT = 0.2, 0.05, 0.5
# Skin and cameras move markers by millimetres on a hand as on a whole body.
LEAST_LIMIT_MM = 15.0
# A body is one rigid thing when its distances vary by less than this share of how its lines swing
# in space; a thing of few markers also when they vary by less than this share of its size.
RIGID_TO_TURNING, RIGID_TO_SIZE, FEW_MARKERS = 0.15, 0.01, 8
# A marker alone joins a group up to this many times the limit away.
LONER_REACH = 2.0
# A marker changes its group for one that is this much nearer.
CLEARLY_NEARER = 0.8


def rigidity_cost(pairs: Pairs) -> FloatArray:
    """Cost, in mm, of two markers being on one rigid body: spread and a tenth of distance."""
    return pairs.spread + NEARNESS * pairs.distance


def group_markers(pairs: Pairs) -> IntArray:
    """Split the markers of one body into rigid groups.

    Parameters
    ----------
    pairs : relations of n markers

    Returns
    -------
    (n,) int64: number of each marker's group, from 0 in order of the group's first marker

    Notes
    -----
    Complete linkage, so that any two markers of a group keep their distance, cut at a limit that
    scales with the body's size and liveliness; then markers alone join their neighbours, and
    markers that fit another group clearly better move there.
    """
    from scipy.cluster.hierarchy import fcluster, linkage

    markers = len(pairs.distance)
    if markers < 2:
        return np.zeros(markers, dtype=np.int64)
    upper = np.triu_indices(markers, 1)
    cost = rigidity_cost(pairs)
    if _is_one_thing(pairs, upper):
        return np.zeros(markers, dtype=np.int64)
    limit = _limit(pairs.distance[upper], pairs.spread[upper])
    label = fcluster(linkage(cost[upper], "complete"), limit, "distance").astype(np.int64) - 1
    return _in_order(_settle(cost, label, limit))


def _is_one_thing(pairs: Pairs, upper: tuple[IntArray, ...]) -> bool:
    """Whether the whole body is rigid, as a prop or a cluster on one segment is."""
    width = float(np.quantile(pairs.spread[upper], 0.9))
    if len(pairs.distance) <= FEW_MARKERS:
        return width < max(
            RIGID_TO_TURNING * pairs.turning,
            RIGID_TO_SIZE * float(np.quantile(pairs.distance[upper], 0.9)),
        )
    return width < RIGID_TO_TURNING * pairs.turning


def _limit(distance: FloatArray, spread: FloatArray) -> float:
    """Largest cost between two markers of a group."""
    size = np.quantile(distance, 0.9)
    motion = max(np.median(spread) / max(np.median(distance), 1e-9), LEAST_MOTION)
    return max(float(WIDTH * size * (motion / TYPICAL_MOTION) ** MOTION_EXPONENT), LEAST_LIMIT_MM)


def _settle(cost: FloatArray, label: IntArray, limit: float) -> IntArray:
    """Move markers, the surest first, to the group they are nearest to on average."""
    label = label.copy()
    each = np.arange(len(label))
    for _ in each:
        member = (label[:, None] == np.arange(label.max() + 1)).astype(float)
        others = member.sum(axis=0) - member
        mean = np.where(others > 0, cost @ member / np.maximum(others, 1), np.inf)
        mean[:, member.sum(axis=0) == 0] = np.inf
        now, best = mean[each, label], mean.argmin(axis=1)
        there = mean[each, best]
        alone = np.isinf(now)
        moves = np.where(alone, there < LONER_REACH * limit, there < CLEARLY_NEARER * now)
        if not moves.any():
            break
        marker = int(np.where(moves, there, np.inf).argmin())
        label[marker] = best[marker]
    return label


def _in_order(label: IntArray) -> IntArray:
    """Number groups by their first marker."""
    _, first, number = np.unique(label, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[number].astype(np.int64)
