"""How far every sample is from where its body says it should be, for the overview: on a thread."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal

from markermend.arrays import Float32Array
from markermend.artifact import Artifact, distrusted
from markermend.progress import Progress
from markermend.review.edits import Change
from markermend.review.session import Session
from markermend.review.standing import still_doubted
from markermend.take import is_unlabelled
from markermend_app.background.jobs import Lane


class Residuals(QObject):
    """Residuals of a take's named markers, worked out once and kept up with the edits.

    An edit or a decision makes the residuals of its own markers anew; those of their neighbours
    change little by it and stay. When artifacts of several markers come or go, as after
    detection, all are made anew: what they learned from was damaged.

    Parameters
    ----------
    first : the jobs that residuals give way to; detection above all, after which they would have
        to be made anew

    Signals
    -------
    changed() : some came, or they are farther under way
    """

    changed = Signal()

    def __init__(self, first: Lane | None = None, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._first = first
        if first is not None:
            first.finished.connect(self._let_in)
        # A take is painted before the jobs on it are queued.
        self._begin = QTimer(self)
        self._begin.setSingleShot(True)
        self._begin.setInterval(0)
        self._begin.timeout.connect(self._work)
        self.values: Float32Array | None = None
        self.share: float | None = None
        self._waits = False
        self._session: Session | None = None
        self._stale: set[str] = set()
        self._artifacts: tuple[Artifact, ...] = ()
        self._doubted: dict[str, frozenset[tuple[int, int]]] = {}
        self._lane: Lane | None = None

    def want(self, session: Session) -> None:
        """Work out what is not there yet; ``values`` is (markers, frames) mm once something is."""
        if session is not self._session:
            self.forget()
            self._session, self._artifacts = session, session.artifacts
            self._doubted = distrusted(still_doubted(session.artifacts, session.notes))
            self._stale = _named(session.original.labels)
        if session.artifacts is not self._artifacts:
            before, now = self._doubted, distrusted(still_doubted(session.artifacts, session.notes))
            differ = {m for m in before.keys() | now.keys() if before.get(m) != now.get(m)}
            self._stale |= _named(differ if len(differ) < 2 else session.original.labels)
            self._artifacts, self._doubted = session.artifacts, now
        if self._stale and self.share is None:
            self._begin.start()

    def _let_in(self) -> None:
        """Have what waits asked for again, now that a job is done that came first."""
        if self._waits:
            self._waits = False
            self.changed.emit()

    def _work(self) -> None:
        """Begin, unless others come first."""
        session = self._session
        if session is None or not self._stale or self.share is not None:
            return
        if self._first is not None and self._first.busy:
            self._waits = True
            return
        if self._lane is None:
            self._lane = Lane("residuals", self)
            self._lane.progressed.connect(self._progressed)
        markers = tuple(s for s in session.original.labels if s in self._stale)
        # Samples that change under the work make their markers stale again.
        self.share, self._stale = 0.0, set()
        take, artifacts = session.take, still_doubted(session.artifacts, session.notes)

        def work(progress: Progress) -> Float32Array:
            from markermend.heat import body_residuals

            return body_residuals(take, artifacts, markers, progress=progress)

        came, failed = partial(self._came, markers), partial(self._failed, markers)
        self._lane.submit("Residuals", work, came, failed)

    def note(self, change: Change) -> None:
        """Samples changed."""
        if self._session is not None:
            self._stale |= _named(change.markers)

    def forget(self) -> None:
        """Let everything go."""
        if self._lane is not None:
            self._lane.cancel()
        self._session, self.values, self.share = None, None, None
        self._stale, self._artifacts = set(), ()

    def close(self) -> None:
        """End the worker."""
        if self._lane is not None:
            self._lane.close()

    def _progressed(self, share: float, _: str) -> None:
        """Tell how far the work is."""
        if self.share is not None:
            self.share = share
            self.changed.emit()

    def _came(self, markers: tuple[str, ...], found: Float32Array) -> None:
        """Keep what was worked out."""
        if self._session is None:
            return
        take = self._session.original
        if self.values is None:
            self.values = np.full((take.markers, take.frames), np.nan, dtype=np.float32)
        self.values[[take.index(m) for m in markers]] = found
        self.share = None
        self.changed.emit()

    def _failed(self, markers: tuple[str, ...], _: Exception) -> None:
        """Leave it at what is there; asking again tries again."""
        self._stale |= set(markers)
        self.share = None
        self.changed.emit()


def _named(labels: Iterable[str]) -> set[str]:
    """Those of a body."""
    return {s for s in labels if not is_unlabelled(s)}
