"""What the rows draw of the shown markers, kept while nothing of it changes."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from functools import cached_property

from markermend.arrays import ByteArray, FloatArray
from markermend.review.session import Session
from markermend.take import Take
from markermend_app.columns import column_of
from markermend_app.panels.plots.quantity import Way, way_of


class Shown:
    """A marker as the plots draw it, gathered when it is first drawn: many markers take long.

    Parameters
    ----------
    frames : of the take
    gather : gives ``now``, ``before``, ``origin`` and ``origin_before``
    """

    def __init__(
        self, frames: int, gather: Callable[[], tuple[Way, Way, ByteArray, ByteArray]]
    ) -> None:
        self.frames, self._gather = frames, gather

    @cached_property
    def _gathered(self) -> tuple[Way, Way, ByteArray, ByteArray]:
        return self._gather()

    @property
    def now(self) -> Way:
        """Its way as it stands."""
        return self._gathered[0]

    @property
    def before(self) -> Way:
        """Its way as it was in the file; the same object where both agree."""
        return self._gathered[1]

    @property
    def origin(self) -> ByteArray:
        """(frames,) uint8, see :class:`markermend.take.Origin`."""
        return self._gathered[2]

    @property
    def origin_before(self) -> ByteArray:
        """(frames,) uint8, the same in the file."""
        return self._gathered[3]


class Drawn:
    """Gives the same object for a marker as long as it looks the same, so that rows can tell."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[str | None, FloatArray | None, Shown]] = {}

    def forget(self) -> None:
        """Start over with another take."""
        self._known.clear()

    def note(self, changed: Iterable[str]) -> None:
        """Let go of markers whose samples changed, and of those measured to them."""
        names = set(changed)
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

        def gather() -> tuple[Way, Way, ByteArray, ByteArray]:
            read, written = column_of(original, column), session.state.written.get(column)
            if written is None:
                # What was not repaired need not be worked out twice.
                way = way_of(take, name, read[0], partner, predicted)
                return way, way, read[1], read[1]
            before = way_of(original, name, read[0], partner, predicted)
            positions, origin = _as_it_stands(take, column, read, written)
            now = way_of(take, name, positions, partner, predicted, read[0])
            return now, before, origin, read[1]

        shown = Shown(take.frames, gather)
        self._known[name] = partner, predicted, shown
        return shown


def _as_it_stands(
    take: Take,
    column: int,
    read: tuple[FloatArray, ByteArray],
    written: Collection[tuple[int, int]],
) -> tuple[FloatArray, ByteArray]:
    """What was read of a marker, with the frames that were written to since."""
    if sum(stop - start for start, stop in written) > take.frames:
        return column_of(take, column)
    positions, origin = read[0].copy(order="K"), read[1].copy()
    for start, stop in written:
        positions[start:stop] = take.positions[start:stop, column]
        origin[start:stop] = take.origin[start:stop, column]
    return positions, origin
