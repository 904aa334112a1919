"""How far something reaches: a marker, the group it moves with, the whole take."""

from __future__ import annotations

from dataclasses import dataclass

from markermend.artifact import Artifact
from markermend_app.document import Document
from markermend_app.telling import told_group
from markermend_app.words import tr


@dataclass(frozen=True)
class Scope:
    """Where something is done.

    Attributes
    ----------
    text : for people
    markers : labels, or None for the whole take
    start, stop : half-open interval of frames; to the take's end when stop is None
    """

    text: str
    markers: frozenset[str] | None
    start: int = 0
    stop: int | None = None

    def reaches(self, artifact: Artifact) -> bool:
        """Whether it has a part of an artifact."""
        mine = self.markers is None or not self.markers.isdisjoint(artifact.markers)
        before_its_end = self.stop is None or artifact.start < self.stop
        return mine and before_its_end and self.start < artifact.stop


def scopes(document: Document, marker: str) -> tuple[Scope, ...]:
    """Marker, group and take; those that are there, narrowest first."""
    session, mesh = document.session, document.mesh
    alone = Scope(tr("On {0}").format(marker), frozenset({marker}))
    take = Scope(tr("In the whole take"), None)
    if session is None or mesh is None:
        return alone, take
    group = mesh.group_of(session.original.index(marker))
    if group is None or len(mesh.groups[group].markers) < 2:
        return alone, take
    names = frozenset(session.original.labels[i] for i in mesh.groups[group].markers)
    return (
        alone,
        Scope(tr("In the group {0}").format(told_group(mesh.groups[group].name)), names),
        take,
    )
