"""Where the rest of the body says a marker is: worked out on a thread, for who asks."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from PySide6.QtCore import QObject, QTimer, Signal

from markermend.arrays import FloatArray
from markermend.artifact import distrusted
from markermend.progress import Progress
from markermend.review.session import Session
from markermend_app.background.jobs import Lane, Work

SETTLED_MS = 400


class Predictions(QObject):
    """Predicted trajectories of a take's markers.

    When samples or the artifacts that nothing is learned from change, those asked for are worked
    out anew; what is known stays to be seen until then.

    Signals
    -------
    changed() : one more is there, or they are to be asked for again
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.known: dict[str, FloatArray] = {}
        self._fresh: set[str] = set()
        self._asked: set[str] = set()
        self._session: Session | None = None
        self._rests_on: dict[str, frozenset[tuple[int, int]]] = {}
        self._moved = False
        self._lane: Lane | None = None
        # Decisions come one after the other; the last one is worked out.
        self._settle = QTimer(self)
        self._settle.setSingleShot(True)
        self._settle.setInterval(SETTLED_MS)
        self._settle.timeout.connect(self._outdate)

    def want(self, session: Session, markers: Iterable[str]) -> None:
        """Work these markers out unless they are there or under way."""
        if self._lane is None:
            self._lane = Lane("prediction", self)
        if not self._fresh and not self._asked:
            self._session, self._rests_on = session, distrusted(session.artifacts)
        for name in markers:
            if name not in self._fresh and name not in self._asked:
                self._asked.add(name)
                self._lane.submit(
                    "Predict",
                    _work(session, name),
                    partial(self._came, name),
                    partial(self._failed, name),
                )

    def note(self, *, samples: bool) -> None:
        """Samples changed, or artifacts."""
        if self._session is not None:
            self._moved |= samples
            self._settle.start()

    def forget(self) -> None:
        """Let all go: another take is open."""
        self.known.clear()
        self._session = None
        self._let_go()

    def _outdate(self) -> None:
        """Have those that are asked for again worked out anew, if it makes a difference."""
        session = self._session
        if session is None:
            return
        if self._moved or distrusted(session.artifacts) != self._rests_on:
            self._let_go()

    def _let_go(self) -> None:
        """Take nothing for up to date, and nothing that is under way."""
        if self._lane is not None:
            self._lane.cancel()
        self._settle.stop()
        self._moved = False
        self._fresh.clear()
        self._asked.clear()
        self.changed.emit()

    def _failed(self, name: str, _: Exception) -> None:
        """Let a prediction that could not be made be asked for again."""
        self._asked.discard(name)

    def close(self) -> None:
        """End the worker."""
        if self._lane is not None:
            self._lane.close()

    def _came(self, name: str, found: FloatArray) -> None:
        """Keep a prediction that is still wanted."""
        if name in self._asked:
            self._asked.discard(name)
            self._fresh.add(name)
            self.known[name] = found
            self.changed.emit()


def _work(session: Session, name: str) -> Work:
    """The engine's part, as a job."""
    take, artifacts = session.take, session.artifacts

    def run(progress: Progress) -> FloatArray:
        from markermend.artifact import trusted_samples
        from markermend.predictors.local import predict_local

        progress(0.0, f"Predicting {name}")
        trusted = trusted_samples(take, artifacts)
        return predict_local(take.positions, take.index(name), trusted=trusted)

    return run
