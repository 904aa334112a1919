"""Infer the mesh of every body in a take."""

from __future__ import annotations

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.mesh.grouping import group_markers, rigidity_cost
from markermend.mesh.model import Group, Mesh
from markermend.mesh.names import name_groups
from markermend.mesh.pairs import measure_pairs
from markermend.mesh.tree import (
    attachment_cost,
    group_links,
    grow_tree,
    joint_link,
    parent_marker,
)
from markermend.progress import Progress, quiet
from markermend.take import Take, is_unlabelled

# Markers seen in a smaller share of their body's frames belong to no group.
LEAST_SEEN = 0.2


def infer_mesh(take: Take, *, progress: Progress | None = None) -> Mesh:
    """Work out which markers form rigid groups, and how the groups hang together.

    Nothing but the take is needed: any subject, any marker set. Each subject (the part of the
    labels before the colon) becomes one tree. Unlabelled markers, and those seen in less than a
    fifth of the frames, get no group. Where nothing moves, nearness alone decides. The result
    depends on the take only: no chance is involved. A skeleton recording tells its tree itself.

    Parameters
    ----------
    take : the recording; gaps and damage on some markers are expected
    progress : told the share of bodies done; may raise ``Cancelled``

    Returns
    -------
    Mesh; without groups where the take has no marker to group

    Notes
    -----
    Functional body mesh of Skurowski and Pawlyta 2021, section 2.2, and 2022, section 3.3.2 and
    Figure 5: rigid groups keep their inter-marker distances, and a parent group is represented
    by the one marker closest in gradient coherence and distance constancy.
    """
    if take.skeleton:
        from markermend.poses.take import skeleton_mesh

        return skeleton_mesh(take)
    report = progress or quiet
    bodies = _bodies(take)
    groups: list[Group] = []
    links: set[tuple[int, int]] = set()
    with threadpool_limits(1):
        for done, (subject, markers) in enumerate(bodies.items()):
            report(done / len(bodies), f"body mesh of {subject}" if subject else "body mesh")
            found, drawn = _infer_body(take, subject, markers, offset=len(groups))
            groups += found
            links |= drawn
    report(1.0, "body mesh")
    return Mesh(take.labels, name_groups(take, groups), tuple(sorted(links)))


def _bodies(take: Take) -> dict[str, list[int]]:
    """Columns of the markers worth grouping, by subject."""
    seen = take.present
    bodies: dict[str, list[int]] = {}
    for column, label in enumerate(take.labels):
        if not is_unlabelled(label):
            bodies.setdefault(take.subject(label), []).append(column)
    kept = {}
    for subject, columns in bodies.items():
        frames = int(seen[:, columns].any(axis=1).sum())
        often = [c for c in columns if 0 < seen[:, c].sum() >= LEAST_SEEN * frames]
        if often:
            kept[subject] = often
    return kept


def _infer_body(
    take: Take, subject: str, markers: list[int], offset: int
) -> tuple[list[Group], set[tuple[int, int]]]:
    """Groups (unnamed, parents first, numbered from an offset) and lines of one body."""
    seen = take.present[:, markers].any(axis=1)
    pairs = measure_pairs(take.positions[seen][:, markers], take.rate)
    rigidity, attachment = rigidity_cost(pairs), attachment_cost(pairs)
    label = group_markers(pairs)
    members = [np.flatnonzero(label == g).tolist() for g in range(label.max() + 1)]
    order, parents = grow_tree(attachment, members)
    place = {g: offset + position for position, g in enumerate(order)}
    groups, links = [], set()
    for g in order:
        own, parent = members[g], parents[g]
        links |= group_links(rigidity, own)
        by = None
        if parent is not None:
            by = parent_marker(attachment, members[parent], own)
            links.add(joint_link(rigidity, by, own))
        groups.append(
            Group(
                name="",
                subject=subject,
                markers=tuple(markers[m] for m in own),
                parent=None if parent is None else place[parent],
                parent_marker=None if by is None else markers[by],
            )
        )
    return groups, {(markers[a], markers[b]) for a, b in links}
