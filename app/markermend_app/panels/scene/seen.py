"""What the 3D view knows of a take besides its samples: segments, names, open artifacts, damage."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Kind, Status, axis_columns
from markermend.heat import damage_share
from markermend.measures import Lengths, measure_lengths
from markermend.take import Take, is_unlabelled
from markermend_app.document import Document
from markermend_app.panels.markers.naming import short_names

TRAIL_S = 0.5


class Seen:
    """Worked out when it is asked for, and kept until :meth:`forget`.

    Attributes
    ----------
    links : (n, 2) columns of the markers that a segment joins
    radius : (markers,) mm, how large they are drawn
    names : by label, as short as they can be
    """

    def __init__(self, document: Document) -> None:
        self._document = document
        self.links: IntArray = np.zeros((0, 2), dtype=np.int64)
        self.radius: FloatArray = np.zeros(0)
        self.names: Mapping[str, str] = {}
        self._lengths: Lengths | None = None
        self._damage: FloatArray | None = None
        self._open: tuple[IntArray, tuple[Kind, ...]] | None = None

    def take_over(self, take: Take, radius_mm: float) -> None:
        """Look at another take; unlabelled markers are drawn smaller."""
        small = np.array([is_unlabelled(label) for label in take.labels], dtype=bool)
        self.radius = np.where(small, 0.5 * radius_mm, radius_mm)
        self.names = short_names(take.labels)
        self.link()

    def link(self) -> None:
        """Join the markers that move together, as the mesh says."""
        mesh = self._document.mesh
        pairs = () if mesh is None else mesh.links
        self.links = np.array(pairs, dtype=np.int64).reshape(-1, 2)
        self._lengths = None

    def near(self) -> slice:
        """Frames around the current one that trails show."""
        session, frame = self._document.session, self._document.frame
        reach = 0 if session is None else max(2, round(TRAIL_S * session.original.rate))
        return slice(max(0, frame - reach), frame + reach + 1)

    def forget(self) -> None:
        """Samples or artifacts changed."""
        self._damage, self._open = None, None

    def off(self, now: FloatArray) -> BoolArray:
        """(links,) bool: segments of the wrong length in a frame's (markers, 3) positions."""
        session = self._document.session
        if session is None:
            return np.zeros(len(self.links), dtype=bool)
        if self._lengths is None:
            self._lengths = measure_lengths(session.original.positions, self.links)
        return self._lengths.off(now)

    def damage(self) -> FloatArray:
        """(markers,) share of each marker's frames that are damaged."""
        session = self._document.session
        if session is None:
            return np.zeros(0)
        if self._damage is None:
            self._damage = damage_share(session.take, session.artifacts)
        return self._damage

    def rings(self) -> dict[int, Kind]:
        """Class of the open artifact each marker's column is in, at the current frame."""
        session, frame = self._document.session, self._document.frame
        if session is None:
            return {}
        if self._open is None:
            found, index = session.listed_with(Status.PENDING), session.original.index
            every = [(a, marker) for a in found for marker in a.markers]
            places = [(a.start, a.stop, index(marker)) for a, marker in every]
            table = np.array(places, dtype=np.int64).reshape(-1, 3)
            self._open = table, tuple(a.kind for a, _ in every)
        table, kinds = self._open
        hit = np.flatnonzero((table[:, 0] <= frame) & (frame < table[:, 1]))
        return {int(table[i, 2]): kinds[i] for i in hit.tolist()}

    def ghosts(self) -> list[tuple[int, FloatArray, int]]:
        """Where the previewed repair puts markers: those of a mix-up go to each other's place.

        Returns
        -------
        of each its column, its (frames, 3) way in mm, and the first frame of that way
        """
        artifact, proposal, session = (
            self._document.current,
            self._document.proposal,
            self._document.session,
        )
        if artifact is None or session is None or proposal is None:
            return []
        found = []
        for patch in proposal.patches:
            column = session.original.index(patch.marker)
            way = session.positions[patch.start : patch.stop, column].copy()
            way[:, axis_columns(patch.axes)] = patch.values
            found.append((column, way, patch.start))
        return found
