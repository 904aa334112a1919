"""The rows of the review queue: in which order keys walk, and what they decide at once."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property


class Rows:
    """Ids of artifacts, row by row.

    Parameters
    ----------
    events : what is decided at once, the artifact that stands for the row first
    """

    def __init__(self, events: Sequence[Sequence[str]] = ()) -> None:
        self.ids = tuple(event[0] for event in events)
        self._events = events

    @cached_property
    def _event_of(self) -> dict[str, Sequence[str]]:
        return {i: event for event in self._events for i in event}

    def __contains__(self, artifact_id: str) -> bool:
        return artifact_id in self._event_of

    def together(self, artifact_id: str) -> tuple[str, ...]:
        """What is decided with an artifact, which comes first itself."""
        return tuple(dict.fromkeys([artifact_id, *self._event_of.get(artifact_id, ())]))

    def row_of(self, artifact_id: str | None) -> str | None:
        """Id of the artifact that stands for the row of this one; of one not listed its own."""
        return next(iter(self._event_of.get(artifact_id or "", ())), artifact_id)

    def beside(self, artifact_id: str | None, by: int) -> str | None:
        """The row so many further on; from what is not listed the first, or the last."""
        row = self.row_of(artifact_id)
        ends = 0 if by > 0 else len(self.ids) - 1
        i = self.ids.index(row) + by if row in self.ids else ends
        return self.ids[i] if 0 <= i < len(self.ids) else None
