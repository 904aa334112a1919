"""What the rows draw of the shown markers, kept while nothing of it changes."""

from __future__ import annotations

from collections.abc import Iterable
from operator import is_

from markermend.arrays import ByteArray, FloatArray
from markermend.review.session import Session
from markermend.take import Take
from markermend_app.panels.plots.quantity import Way, way_of
from markermend_app.panels.plots.row import Shown


class Drawn:
    """Gives the same object for a marker as long as it looks the same, so that rows can tell."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[str | None, FloatArray | None, Shown]] = {}
        self._sources: dict[str, tuple[Take, str | None, FloatArray | None, Way]] = {}

    def forget(self) -> None:
        """Start over with another take."""
        self._known.clear()
        self._sources.clear()

    def note(self, changed: Iterable[str]) -> None:
        """Let go of markers whose samples changed, and of those measured to them."""
        names = set(changed)
        for name in [n for n, k in self._known.items() if n in names or k[0] in names]:
            del self._known[name]

    def keep(self, names: Iterable[str]) -> None:
        """Let go of all but these markers."""
        kept = tuple(names)
        self._known = {name: self._known[name] for name in kept}
        self._sources = {name: s for name, s in self._sources.items() if name in kept}

    def of(
        self, session: Session, name: str, partner: str | None, predicted: FloatArray | None
    ) -> Shown:
        """A marker as it stands.

        Parameters
        ----------
        session : the review
        name : the marker's label
        partner : the marker that distances are measured to, or None
        predicted : (frames, 3) mm, where the body says the marker is, or None
        """
        known = self._known.get(name)
        if known is not None and known[0] == partner and known[1] is predicted:
            return known[2]
        take, original, column = session.take, session.original, session.take.index(name)

        def gather() -> tuple[Way, Way, ByteArray]:
            origin = take.origin[:, column].copy()
            if column not in session.state.written:
                # What was not repaired need not be worked out twice.
                way = way_of(take, name, partner, predicted)
                return way, way, origin
            before = self._source(original, name, partner, predicted)
            return way_of(take, name, partner, predicted, before.positions), before, origin

        shown = Shown(take.frames, gather)
        self._known[name] = partner, predicted, shown
        return shown

    def _source(
        self, original: Take, name: str, partner: str | None, predicted: FloatArray | None
    ) -> Way:
        """A marker as it was in the file; whatever is done to it, that stays."""
        known = self._sources.get(name)
        asked = original, partner, predicted
        if known is None or not all(map(is_, known[:3], asked)):
            known = self._sources[name] = (*asked, way_of(original, name, partner, predicted))
        return known[3]
