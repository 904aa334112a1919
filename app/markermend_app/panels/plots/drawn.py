"""What the rows draw of the shown markers, kept while nothing of it changes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

from markermend.arrays import ByteArray, FloatArray
from markermend.review.edits import Change
from markermend.review.session import Session
from markermend_app.columns import column_of
from markermend_app.panels.plots.quantity import Way, way_of
from markermend_app.panels.plots.row import Shown


class Drawn:
    """Gives the same object for a marker as long as it looks the same, so that rows can tell."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[str | None, FloatArray | None, Shown]] = {}
        self._written: frozenset[int] = frozenset()
        self._touched: dict[str, set[tuple[int, int]]] = defaultdict(set)

    def forget(self, session: Session | None) -> None:
        """Start over with another take."""
        self._known.clear()
        self._touched.clear()
        self._written = frozenset(() if session is None else session.state.written)

    def note(self, change: Change) -> None:
        """Let go of markers whose samples changed, and of those measured to them."""
        names = set(change.markers)
        for name in names:
            self._touched[name].add((change.start, change.stop))
        for name in [n for n, k in self._known.items() if n in names or k[0] in names]:
            del self._known[name]

    def keep(self, names: Iterable[str]) -> None:
        """Let go of all but these markers."""
        self._known = {name: self._known[name] for name in names}

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
            read = column_of(original, column)
            if column not in session.state.written:
                # What was not repaired need not be worked out twice.
                way = way_of(take, name, read[0], partner, predicted)
                return way, way, read[1]
            before = way_of(original, name, read[0], partner, predicted)
            positions, origin = self._as_it_stands(session, name, read)
            return way_of(take, name, positions, partner, predicted, read[0]), before, origin

        shown = Shown(take.frames, gather)
        self._known[name] = partner, predicted, shown
        return shown

    def _as_it_stands(
        self, session: Session, name: str, read: tuple[FloatArray, ByteArray]
    ) -> tuple[FloatArray, ByteArray]:
        """What was read of a marker, with what was written to it since."""
        take, column, touched = session.take, session.take.index(name), self._touched[name]
        if column in self._written or sum(b - a for a, b in touched) > take.frames:
            return column_of(take, column)
        positions, origin = read[0].copy(order="K"), read[1].copy()
        for start, stop in touched:
            positions[start:stop] = take.positions[start:stop, column]
            origin[start:stop] = take.origin[start:stop, column]
        return positions, origin
