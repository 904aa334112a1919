"""The edges of the region of interest in the overview, to be dragged."""

from __future__ import annotations

import math

from PySide6.QtCore import QPointF

from markermend_app.document import Document
from markermend_app.panels.overview.places import Places

_REACH_PX = 4.0


class RegionEdges:
    """Which edge is held, and where it would be put.

    Attributes
    ----------
    region : the region as it is shown, half-open; None for the whole take
    """

    def __init__(self, document: Document) -> None:
        self._document = document
        self._held: int | None = None
        self._dragged: tuple[int, int] | None = None
        # What is held is an edge of what was there then.
        document.opened.connect(self.forget)
        document.artifacts_changed.connect(self.forget)

    def forget(self) -> None:
        """Leave the region as it is, wherever an edge was dragged."""
        self._held = self._dragged = None

    @property
    def region(self) -> tuple[int, int] | None:
        """What is shown: the region with the edge where the hand has it."""
        session = self._document.session
        return self._dragged or (None if session is None else session.region)

    @property
    def held(self) -> bool:
        """Whether an edge is dragged."""
        return self._held is not None

    def near(self, places: Places, at: QPointF) -> int | None:
        """The edge under the mouse: 0 where the region begins, 1 where it ends."""
        area = places.area
        if self.region is None or not self._document.editable:
            return None
        if not area.top() <= at.y() <= area.bottom():
            return None
        xs = [places.x(edge) for edge in self.region]
        away = [abs(x - at.x()) if area.left() <= x <= area.right() else math.inf for x in xs]
        nearest = int(away[1] < away[0])
        return nearest if away[nearest] <= _REACH_PX else None

    def take(self, places: Places, at: QPointF) -> bool:
        """Take hold of an edge; whether there is one."""
        self._held = self.near(places, at)
        return self.held

    def drag(self, places: Places, x: float) -> None:
        """Put the edge held between the frames nearest to the mouse; one frame is left at least."""
        region, session = self.region, self._document.session
        if self._held is None or region is None or session is None:
            return
        at, (start, stop) = round(places.frame(x)), region
        if self._held == 0:
            wanted = (min(max(at, 0), stop - 1), stop)
        else:
            wanted = (start, max(min(at, session.original.frames), start + 1))
        if self._dragged is not None or wanted != region:
            self._dragged = wanted

    def drop(self) -> tuple[int, int] | None:
        """Let go; the region that was dragged, None where none was."""
        dragged, self._dragged, self._held = self._dragged, None, None
        return dragged
