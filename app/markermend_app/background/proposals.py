"""Repairs proposed ahead of the operator, made on a worker thread of their own.

A proposal that is there holds while its artifact and the samples of its marker around it are what
they were; changes of other markers, or far away, do not spoil it. What was refused may be possible
once others of the same moment are repaired, so that any change there spoils it. One under way reads
the working samples, so that a change spoils it unless it was told that these samples are not to be
believed, which is so where an artifact that it knows of is repaired.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from markermend.artifact import Artifact, Status
from markermend.errors import Cancelled
from markermend.mesh import Mesh
from markermend.progress import Progress, heeded
from markermend.review.edits import Change
from markermend.review.session import Session
from markermend.take import Take
from markermend_app.background.jobs import Lane

Key = tuple[Artifact, str, tuple[str, ...]]
"""Artifact, method, and the markers to follow where they were chosen by hand."""

PAINTED_MS = 40
REACH_S = 2.0
"""How far around an artifact repairs look closely; further away a few samples of many matter."""


@dataclass(frozen=True, eq=False)
class _Request:
    """What was asked of the worker.

    Attributes
    ----------
    artifacts : all that were known then
    errors : how far off repairs that were made may be, mm, by the artifact's id
    """

    artifacts: tuple[Artifact, ...]
    errors: Mapping[str, float]

    def disbelieves(self, change: Change) -> bool:
        """Whether samples that change were not to be believed before either."""
        flagged = {
            marker
            for a in self.artifacts
            if a.status in (Status.PENDING, Status.ACCEPTED)
            and a.start <= change.start
            and change.stop <= a.stop
            for marker in a.markers
        }
        return flagged.issuperset(change.markers)


class Proposals(QObject):
    """A cache of proposed repairs, filled in the background.

    Attributes
    ----------
    lane : where they are made

    Signals
    -------
    ready(str) : the proposal asked for an artifact (its id) is there
    failed(object) : one could not be made; an exception
    progressed(str) : what a method that takes seconds is doing
    """

    ready = Signal(str)
    failed = Signal(object)
    progressed = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.lane = Lane("proposals", self)
        self.lane.progressed.connect(lambda _share, doing: self.progressed.emit(doing))
        self._known: dict[Key, Any] = {}
        # What was marked at the same time when each was made.
        self._beside: dict[Key, frozenset[tuple[str, int, int]]] = {}
        # A request made anew after a change gets another object, so that the answer to the old one
        # is not taken for the new.
        self._asked: dict[Key, _Request] = {}
        self._begin: Callable[[], None] = _nothing
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.timeout.connect(lambda: self._begin())

    def get(self, artifact: Artifact, method: str, references: tuple[str, ...] = ()) -> Any:
        """The proposal, or None while it is not there."""
        return self._known.get(_told((artifact, method, references)))

    def keep(self, made: Mapping[Key, Any]) -> None:
        """Take over proposals that were made elsewhere."""
        for key, repair in made.items():
            self._known[_told(key)] = repair
            self._beside.pop(_told(key), None)

    def want(self, session: Session, mesh: Mesh, wanted: Sequence[Key]) -> None:
        """Make these proposals, in this order, unless they are there or under way.

        Those asked for earlier that have not begun are let go, so that who walks fast through
        the artifacts does not wait for all that were passed by. When the first is there already,
        the others wait until the window has painted it.
        """
        wanted = tuple(map(_told, wanted))
        if session.original.skeleton:
            self._let_go_of_others(session, wanted)
        for key in self._asked.keys() - set(wanted):
            del self._asked[key]
        self._begin = partial(self._submit, session, mesh, wanted)
        if wanted and wanted[0] in self._known:
            self._later.start(PAINTED_MS)
        else:
            self._later.stop()
            self._begin()

    def _let_go_of_others(self, session: Session, wanted: Sequence[Key]) -> None:
        """Forget what rests on joints that were marked otherwise at the same time.

        Joints of one body tell of each other, so that one that was marked since must not.
        """
        for key in wanted:
            now = _at_the_same_time(key[0], session.artifacts)
            asked, made = self._asked.get(key), self._beside.get(key, now)
            if made != now:
                self._known.pop(key, None)
            if asked is not None and _at_the_same_time(key[0], asked.artifacts) != now:
                del self._asked[key]

    def _submit(self, session: Session, mesh: Mesh, wanted: Sequence[Key]) -> None:
        """Hand to the worker what is not there or under way."""
        take, artifacts, errors = session.take, session.artifacts, session.expected_errors
        for key in wanted:
            if key in self._known or key in self._asked:
                continue
            token = self._asked[key] = _Request(artifacts, errors)
            self.lane.submit(
                "Propose",
                partial(self._work, take, key, token, mesh),
                partial(self._came, key, token),
                partial(self._broke, key, token),
            )

    def invalidate(self, change: Change, rate: float) -> None:
        """Forget proposals that rest on changed samples, those under way included.

        Parameters
        ----------
        change : what has become of the samples
        rate : of the take, Hz
        """
        touched, reach = set(change.markers), round(REACH_S * rate)
        start, stop = change.start - reach, change.stop + reach

        def spoiled(key: Key) -> bool:
            # Which markers to follow was chosen by hand: all of what they do counts.
            mine = touched & {*key[0].markers, *key[2]}
            refused = key in self._known and not self._known[key].patches
            return bool(mine or refused) and (bool(key[2]) or key[0].overlaps(start, stop))

        for key in [k for k in self._known if spoiled(k)]:
            del self._known[key]
        for key in [k for k, r in self._asked.items() if spoiled(k) or not r.disbelieves(change)]:
            del self._asked[key]

    def forget(self) -> None:
        """Forget everything and stop what is under way."""
        self._later.stop()
        self._begin = _nothing
        self.lane.cancel()
        self._known.clear()
        self._beside.clear()
        self._asked.clear()

    def close(self) -> None:
        """End the worker."""
        self.lane.close()

    def _came(self, key: Key, token: _Request, repair: Any) -> None:
        """Keep a proposal unless it was invalidated meanwhile."""
        if self._asked.get(key) is token:
            del self._asked[key]
            self._known[key] = repair
            self._beside[key] = _at_the_same_time(key[0], token.artifacts)
            self.ready.emit(key[0].id)

    def _broke(self, key: Key, token: _Request, error: Exception) -> None:
        """Tell of a proposal that could not be made."""
        if self._asked.get(key) is token:
            del self._asked[key]
            self.failed.emit(error)

    def _work(
        self,
        take: Take,
        key: Key,
        token: _Request,
        mesh: Mesh,
        progress: Progress,
    ) -> Any:
        """The engine's part, on the worker; nothing when the request was let go meanwhile."""

        def report(share: float, doing: str) -> None:
            if self._asked.get(key) is not token:
                raise Cancelled
            progress(share, doing)

        if self._asked.get(key) is not token:
            raise Cancelled
        from markermend.repairs import propose

        artifact, method, references = key
        with heeded(report) as told:
            return propose(
                take,
                artifact,
                token.artifacts,
                method=method,
                mesh=mesh,
                references=references,
                errors=token.errors,
                progress=told,
            )


def _told(key: Key) -> Key:
    """The same without the operator's note, on which no repair rests."""
    return (replace(key[0], note=""), *key[1:]) if key[0].note else key


def _at_the_same_time(
    artifact: Artifact, artifacts: Sequence[Artifact]
) -> frozenset[tuple[str, int, int]]:
    """Markers and frames of others that overlap with an artifact and were not rejected."""
    return frozenset(
        (a.marker, a.start, a.stop)
        for a in artifacts
        if a.status is not Status.REJECTED and a.overlaps(artifact.start, artifact.stop)
    )


def _nothing() -> None:
    """Begin nothing."""
