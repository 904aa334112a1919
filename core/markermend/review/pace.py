"""The operator's own measure: artifacts decided, seconds each, minutes a take.

Only time in which the operator does something counts. Who looks at a screen for a while before
the next key is at work; who has not touched anything for longer than that is not there.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass

from markermend.artifact import Artifact, Status

IDLE_AFTER_S = 30.0


class Stopwatch:
    """Time spent on a review.

    Parameters
    ----------
    clock : seconds that only grow
    idle_after_s : a pause longer than this is not counted at all

    Attributes
    ----------
    spent_s : seconds of work so far
    """

    def __init__(
        self, clock: Callable[[], float] = time.monotonic, idle_after_s: float = IDLE_AFTER_S
    ) -> None:
        self.spent_s = 0.0
        self._clock = clock
        self._idle_after_s = idle_after_s
        self._touched: float | None = None

    def touch(self) -> float:
        """Say that the operator did something now; returns the seconds of work so far."""
        now = self._clock()
        if self._touched is not None and now - self._touched <= self._idle_after_s:
            self.spent_s += now - self._touched
        self._touched = now
        return self.spent_s


@dataclass(frozen=True)
class Pace:
    """How a review goes.

    Attributes
    ----------
    decided, total : artifacts that are asked about
    spent_s : seconds of work
    decided_in_all : those decided before the frames that matter were chosen, too: time went to them
    """

    decided: int
    total: int
    spent_s: float
    decided_in_all: int

    @property
    def seconds_each(self) -> float | None:
        """Seconds an artifact, or None while none is decided."""
        return self.spent_s / self.decided_in_all if self.decided_in_all else None

    @property
    def minutes(self) -> float:
        """Minutes spent on the take."""
        return self.spent_s / 60.0

    def to_dict(self) -> dict[str, float | int | None]:
        """Return plain values for ``json.dumps``."""
        return {
            "decided": self.decided,
            "total": self.total,
            "spent_s": round(self.spent_s, 3),
            "seconds_each": None if self.seconds_each is None else round(self.seconds_each, 3),
        }


def pace_of(listed: Collection[Artifact], spent_s: float, everything: Iterable[Artifact]) -> Pace:
    """Count what is decided: accepted, rejected or repaired.

    Parameters
    ----------
    listed : artifacts that are asked about
    spent_s : seconds of work
    everything : all artifacts of the review
    """
    decided, in_all = (
        sum(a.status is not Status.PENDING for a in known) for known in (listed, everything)
    )
    return Pace(decided, len(listed), spent_s, in_all)
