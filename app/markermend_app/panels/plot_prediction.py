"""Where the rest of the body says a marker is: worked out on a thread, for who asks."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from PySide6.QtCore import QObject, Signal

from markermend.arrays import FloatArray
from markermend.progress import Progress
from markermend.session import Session
from markermend_app.jobs import Lane, Work


class Predictions(QObject):
    """Predicted trajectories of a take's markers.

    Signals
    -------
    changed() : one more is there, or they were forgotten
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.known: dict[str, FloatArray] = {}
        self._asked: set[str] = set()
        self._lane: Lane | None = None

    def want(self, session: Session, markers: Iterable[str]) -> None:
        """Work these markers out unless they are there or under way."""
        if self._lane is None:
            self._lane = Lane("prediction", self)
        for name in markers:
            if name not in self.known and name not in self._asked:
                self._asked.add(name)
                self._lane.submit(
                    "Predict",
                    _work(session, name),
                    partial(self._came, name),
                    partial(self._failed, name),
                )

    def _failed(self, name: str, _: Exception) -> None:
        """Let a prediction that could not be made be asked for again."""
        self._asked.discard(name)

    def forget(self) -> None:
        """Let all go: the samples they rest on have changed."""
        if self._lane is not None:
            self._lane.cancel()
        self.known.clear()
        self._asked.clear()
        self.changed.emit()

    def close(self) -> None:
        """End the worker."""
        if self._lane is not None:
            self._lane.close()

    def _came(self, name: str, found: FloatArray) -> None:
        """Keep a prediction that is still wanted."""
        if name in self._asked:
            self._asked.discard(name)
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
