"""From groups to a tree, and to the lines that make a body visible."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray
from markermend.mesh.grouping import rigidity_cost
from markermend.mesh.pairs import Pairs

Members = list[list[int]]
NEAREST_DRAWN = 2


def attachment_cost(pairs: Pairs) -> FloatArray:
    """Cost of joining two markers of different groups: inconstant distance, incoherent motion."""
    return rigidity_cost(pairs) * (2.0 - pairs.coherence)


def grow_tree(cost: FloatArray, members: Members) -> tuple[list[int], list[int | None]]:
    """Hang the groups of one body onto each other.

    Parameters
    ----------
    cost : (markers, markers) attachment cost
    members : markers of each group

    Returns
    -------
    Order of the groups, parents before children, and the parent of each group (None for the
    root), both as positions in `members`. The tree is the cheapest that joins all; its root is
    the group from which the markers of all others are the fewest groups away.
    """
    groups = len(members)
    to_group = np.stack([cost[:, own].mean(axis=1) for own in members], axis=1)
    between = np.stack([to_group[own].min(axis=0) for own in members])
    edges = spanning_tree(np.minimum(between, between.T))
    neighbours: list[list[int]] = [[] for _ in range(groups)]
    for a, b in edges:
        neighbours[a].append(b)
        neighbours[b].append(a)
    sizes = [len(m) for m in members]
    walks = [_walk(neighbours, root) for root in range(groups)]
    burden = [sum(depth[g] * sizes[g] for g in range(groups)) for _, _, depth in walks]
    order, parent, _ = walks[int(np.argmin(burden))]
    return order, parent


def _walk(neighbours: list[list[int]], root: int) -> tuple[list[int], list[int | None], list[int]]:
    """Visit a tree from a root: order, parents and depths."""
    parent: list[int | None] = [None] * len(neighbours)
    depth = [0] * len(neighbours)
    order = [root]
    for g in order:
        for child in sorted(neighbours[g]):
            if child != parent[g]:
                parent[child], depth[child] = g, depth[g] + 1
                order.append(child)
    return order, parent, depth


def parent_marker(cost: FloatArray, parent: list[int], child: list[int]) -> int:
    """The marker of the parent group that is cheapest to attach the whole child group to.

    Parameters
    ----------
    cost : (markers, markers) float64, what it costs to attach one to another
    parent, child : columns of the markers of the two groups
    """
    return parent[int(cost[np.ix_(parent, child)].mean(axis=1).argmin())]


def spanning_tree(cost: FloatArray) -> list[tuple[int, int]]:
    """Edges of the cheapest tree over all nodes of a full graph (Prim's algorithm)."""
    nodes = len(cost)
    if nodes < 2:
        return []
    nearest = np.zeros(nodes, dtype=np.int64)
    best = cost[0].astype(float).copy()
    best[0] = np.inf
    outside = np.ones(nodes, dtype=bool)
    outside[0] = False
    edges = []
    for _ in range(nodes - 1):
        new = int(np.where(outside, best, np.inf).argmin())
        edges.append((int(nearest[new]), new))
        outside[new] = False
        closer = outside & (cost[new] < best)
        best[closer], nearest[closer] = cost[new][closer], new
    return edges


def group_links(cost: FloatArray, members: list[int]) -> set[tuple[int, int]]:
    """Lines within one group: its cheapest tree and each marker's two nearest neighbours."""
    own = cost[np.ix_(members, members)].copy()
    links = {_pair(members[a], members[b]) for a, b in spanning_tree(own)}
    np.fill_diagonal(own, np.inf)
    for a, row in enumerate(own):
        for b in np.argsort(row, kind="stable")[: min(NEAREST_DRAWN, len(members) - 1)]:
            links.add(_pair(members[a], members[int(b)]))
    return links


def joint_link(cost: FloatArray, parent: int, child: list[int]) -> tuple[int, int]:
    """Line from a parent marker to the marker of the child group that is cheapest to attach.

    Parameters
    ----------
    cost : (markers, markers) float64, what it costs to attach one to another
    parent : column of the parent marker
    child : columns of the markers of the child group
    """
    return _pair(parent, child[int(cost[parent, child].argmin())])


def _pair(a: int, b: int) -> tuple[int, int]:
    """Two markers in order."""
    return (a, b) if a < b else (b, a)
