"""What a functional body mesh is: groups of markers, and the forest they form."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property


@dataclass(frozen=True)
class Group:
    """Markers that keep their distances to each other: one body segment.

    Attributes
    ----------
    name : for people, made from its markers' names
    subject : body it belongs to, empty when labels have no prefix
    markers : columns in the take
    parent : index of the parent group in :attr:`Mesh.groups`, or None for a root
    parent_marker : column of the one marker of the parent group that keeps the most constant
        distance to this group and moves most like it; None for a root
    """

    name: str
    subject: str
    markers: tuple[int, ...]
    parent: int | None = None
    parent_marker: int | None = None


@dataclass(frozen=True)
class Mesh:
    """Groups of a take as a forest, one tree a subject.

    Attributes
    ----------
    labels : marker labels the columns refer to
    groups : parents before children
    links : (marker, marker) pairs that keep their distance, to be drawn as the body's segments
    """

    labels: tuple[str, ...]
    groups: tuple[Group, ...]
    links: tuple[tuple[int, int], ...] = ()

    def __repr__(self) -> str:
        sizes = ", ".join(f"{g.name} ({len(g.markers)})" for g in self.groups)
        return f"<Mesh of {len(self.labels)} markers in {len(self.groups)} groups: {sizes}>"

    @cached_property
    def _group_of(self) -> dict[int, int]:
        return {m: g for g, group in enumerate(self.groups) for m in group.markers}

    def group_of(self, marker: int) -> int | None:
        """Index of the group a marker belongs to, or None (unlabelled, rarely seen)."""
        return self._group_of.get(marker)

    def siblings(self, marker: int) -> tuple[int, ...]:
        """Other markers of the same group."""
        g = self.group_of(marker)
        return () if g is None else tuple(m for m in self.groups[g].markers if m != marker)

    def parent_marker(self, marker: int) -> int | None:
        """The marker of the parent group that stands for it in predictions."""
        g = self.group_of(marker)
        return None if g is None else self.groups[g].parent_marker

    def children(self, group: int) -> tuple[int, ...]:
        """Indices of the groups whose parent is this one."""
        return tuple(i for i, g in enumerate(self.groups) if g.parent == group)
