"""The edges of the region of interest in the overview, to be dragged."""

from __future__ import annotations

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

    @property
    def region(self) -> tuple[int, int] | None:
        """What is shown: the region with the edge where the hand has it."""
        session = self._document.session
        return self._dragged or (None if session is None else session.region)

    @property
    def held(self) -> bool:
        """Whether an edge is dragged."""
        return self._held is not None

    def near(self, places: Places, x: float) -> int | None:
        """The edge under the mouse: 0 where the region begins, 1 where it ends."""
        if self.region is None or not self._document.editable:
            return None
        away = [abs(places.x(edge) - x) for edge in self.region]
        nearest = int(away[1] < away[0])
        return nearest if away[nearest] <= _REACH_PX else None

    def take(self, places: Places, x: float) -> bool:
        """Take hold of an edge; whether there is one."""
        self._held = self.near(places, x)
        return self.held

    def drag(self, places: Places, x: float) -> None:
        """Put the edge held between the frames nearest to the mouse; one frame is left at least."""
        region, session = self.region, self._document.session
        if self._held is None or region is None or session is None:
            return
        at, (start, stop) = round(places.frame(x)), region
        if self._held == 0:
            self._dragged = (min(max(at, 0), stop - 1), stop)
        else:
            self._dragged = (start, max(min(at, session.original.frames), start + 1))

    def drop(self) -> tuple[int, int] | None:
        """Let go; the region that was dragged, None where none was."""
        dragged, self._dragged, self._held = self._dragged, None, None
        return dragged
