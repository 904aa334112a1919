"""Where the rest of the body says a marker is: worked out on a thread, for who asks."""

from __future__ import annotations

import time
from collections.abc import Iterable
from functools import partial

from PySide6.QtCore import QObject, QTimer, Signal

from markermend.arrays import FloatArray
from markermend.artifact import distrusted
from markermend.progress import Progress
from markermend.review.session import Session
from markermend.review.standing import still_doubted
from markermend_app.background.jobs import Lane, Work

SETTLED_MS = 400
MOST_PATIENCE_MS = 1500


class Predictions(QObject):
    """Predicted trajectories of a take's markers.

    What the operator waits for goes first: beside two workers the window waits, too.

    When samples or the artifacts that nothing is learned from change, those asked for are worked
    out anew; what is known stays to be seen until then.

    Signals
    -------
    changed() : one more is there, or they are to be asked for again

    Parameters
    ----------
    first : the jobs that predictions give way to
    """

    changed = Signal()

    def __init__(self, first: Lane, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._first = first
        self.known: dict[str, FloatArray] = {}
        self._fresh: set[str] = set()
        self._wanted: tuple[str, ...] = ()
        self._asked: str | None = None
        self._took_s = 0.0
        self._session: Session | None = None
        self._rests_on: dict[str, frozenset[tuple[int, int]]] = {}
        self._moved = False
        self._lane: Lane | None = None
        # Decisions come one after the other; the last one is worked out.
        self._settle = QTimer(self)
        self._settle.setSingleShot(True)
        self._settle.setInterval(SETTLED_MS)
        self._settle.timeout.connect(self._outdate)
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.timeout.connect(self._begin)

    def want(self, session: Session, markers: Iterable[str]) -> None:
        """Work these markers out, and no others any more, unless they are there or under way.

        Who walks from artifact to artifact would be followed by work on markers passed by: where
        one takes long, it begins when nothing else was wanted for as long as the last one took.
        """
        shown = tuple(markers)
        if self._lane is not None and self._asked not in (None, *shown):
            self._lane.cancel()
            # Nobody goes on after one that was stopped.
            self._wanted, self._asked = (), None
        before = {*self._wanted, self._asked}
        self._wanted = tuple(m for m in shown if m not in self._fresh and m != self._asked)
        if self._wanted and not self._fresh and self._asked is None:
            self._session, self._rests_on = session, _doubts(session)
        if not before.issuperset(self._wanted):
            self._pause.start(min(MOST_PATIENCE_MS, round(1000 * self._took_s)))

    def _begin(self) -> None:
        """Have the first of those wanted worked out."""
        session = self._session
        if session is None or self._asked is not None or not self._wanted:
            return
        if self._lane is None:
            self._lane = Lane("prediction", self, behind=self._first)
        self._asked, *rest = self._wanted
        self._wanted = tuple(rest)
        self._lane.submit(
            "Predict",
            _work(session, self._asked),
            partial(self._came, self._asked),
            partial(self._failed, self._asked),
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
        if self._moved or _doubts(session) != self._rests_on:
            self._let_go()

    def _let_go(self) -> None:
        """Take nothing for up to date, and nothing that is under way."""
        if self._lane is not None:
            self._lane.cancel()
        self._settle.stop()
        self._pause.stop()
        self._moved = False
        self._fresh.clear()
        self._wanted, self._asked = (), None
        self.changed.emit()

    def _failed(self, name: str, _: Exception) -> None:
        """Let a prediction that could not be made be asked for again."""
        if name == self._asked:
            self._go_on()

    def close(self) -> None:
        """End the worker."""
        if self._lane is not None:
            self._lane.close()

    def _came(self, name: str, made: tuple[FloatArray, float]) -> None:
        """Keep a prediction that is still wanted."""
        if name == self._asked:
            self.known[name], self._took_s = made
            self._fresh.add(name)
            self._go_on()
            self.changed.emit()

    def _go_on(self) -> None:
        """Begin the next one, unless the operator is on the way."""
        self._asked = None
        if not self._pause.isActive():
            self._begin()


def _doubts(session: Session) -> dict[str, frozenset[tuple[int, int]]]:
    """Which samples nothing is learned from now."""
    return distrusted(still_doubted(session.artifacts, session.notes))


def _work(session: Session, name: str) -> Work:
    """The engine's part, as a job: the prediction and the seconds that it took."""
    take, artifacts = session.take, still_doubted(session.artifacts, session.notes)

    def run(progress: Progress) -> tuple[FloatArray, float]:
        from markermend.artifact import trusted_samples
        from markermend.predictors.local import predict_local

        progress(0.0, f"Predicting {name}")
        # Of this thread alone: it may rest while others go first.
        began = time.thread_time()
        trusted = trusted_samples(take, artifacts)
        found = predict_local(take.positions, take.index(name), trusted=trusted)
        return found, time.thread_time() - began

    return run
