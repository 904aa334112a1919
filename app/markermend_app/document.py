"""The open review, as the window sees it: a session with Qt signals.

The document is the only writer of the session. Panels read it, call its verbs or those of its
``decisions``, and listen to its signals; none of them changes samples or artifacts by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal

from markermend.artifact import Artifact
from markermend.errors import MarkermendError
from markermend.mesh import Mesh
from markermend.review.edits import Change
from markermend.review.events import events
from markermend.review.file import SessionFile
from markermend.review.session import Session
from markermend_app.background.preview import Preview
from markermend_app.decisions import Decisions
from markermend_app.following import Following
from markermend_app.later import Later
from markermend_app.looking import Looking
from markermend_app.rows import Rows
from markermend_app.walk import ahead_and_beside, open_after

AHEAD = 3
"""Artifacts after the current one whose repairs are proposed ahead of time."""


class Document(Looking):
    """What is open, what is looked at, what is under review, and how it is changed.

    Signals
    -------
    Those of :class:`Looking`, and
    opened() : another take is open, or none
    mesh_changed() : the body's structure is known now, or no longer
    data_changed(Change) : samples changed; ``Change`` says of which markers and frames
    artifacts_changed() : artifacts, decisions or repair notes changed
    history_changed() : a step was done, undone or redone
    current_changed() : another artifact is under review, or it was changed
    together_changed() : the same one is under review, with others than before
    proposal_changed() : the previewed repair of the current artifact came, went or was replaced
    failed(object) : a verb could not be done; an exception
    said(str) : a verb did something else than its name says; a sentence
    """

    opened = Signal()
    mesh_changed = Signal()
    data_changed = Signal(object)
    artifacts_changed = Signal()
    history_changed = Signal()
    current_changed = Signal()
    together_changed = Signal()
    proposal_changed = Signal()
    failed = Signal(object)
    said = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.file: SessionFile | None = None
        self.mesh: Mesh | None = None
        self._rows = Rows()
        self._current: str | None = None
        self._holding_back = False
        self._told_together: tuple[str, ...] = ()
        self._regrouped = Later(self._tell_together, self)
        self.preview = Preview(self)
        self.preview.ready.connect(self._proposal_came)
        self.proposals = self.preview.proposals
        self.decisions = Decisions(self)
        self.going_back = Following(self)

    # What is open

    @property
    def session(self) -> Session | None:
        """The review, or None while nothing is open."""
        return None if self.file is None else self.file.session

    @property
    def path(self) -> Path | None:
        """The take's file, or None when nothing is open or it has none."""
        source = None if self.session is None else self.session.original.source
        return None if source is None else source.path

    @property
    def editable(self) -> bool:
        """Whether decisions can be made: something is open and no other window holds it."""
        return self.file is not None and not self.file.read_only

    def open(self, file: SessionFile | None, mesh: Mesh | None) -> None:
        """Show another review, or none; the one before is let go."""
        self.proposals.forget()
        if self.file is not None:
            self.file.close()
        self.file, self.mesh = file, mesh
        self._rows, self._current, self._holding_back = Rows(), None, False
        self.going_back.forget()
        self._look_at_nothing(0 if file is None else file.session.original.frames)
        self.preview.reset()
        self.decisions.forget()
        first = (self.opened, self.artifacts_changed, self.history_changed, self.current_changed)
        then = (self.selection_changed, self.proposal_changed, self.shown_changed)
        for signal in (*first, *then, self.beside_changed):
            signal.emit()

    def learn(self, mesh: Mesh, *, propose: bool = True) -> None:
        """Take over the body's structure; repairs are proposed at once, or from :meth:`go_on`."""
        self.mesh, self._holding_back = mesh, not propose
        self.mesh_changed.emit()
        self._propose()

    def go_on(self) -> None:
        """Propose repairs, if these were held back."""
        if self._holding_back:
            self._holding_back = False
            self._propose()

    # What is under review

    @property
    def current(self) -> Artifact | None:
        """The artifact under review."""
        if self.session is None or self._current is None:
            return None
        return self.session.find(self._current)

    @property
    def together(self) -> tuple[str, ...]:
        """Ids of what keys decide at once: the artifact under review, and the rest of its event."""
        current = self.current
        if current is None:
            return ()
        rows = self._rows
        if self.joints and self.session is not None and current.id not in rows:
            # What was decided together and is listed no more is reopened together.
            rows = Rows([[a.id for a in event] for event in events(self.session.listed)])
        return rows.together(current.id)

    def decided_with(self, artifact_id: str) -> tuple[str, ...]:
        """Ids of an artifact and of the rest of its event, as far as the queue lists it."""
        return self._rows.together(artifact_id)

    @property
    def queue(self) -> tuple[str, ...]:
        """Ids of the rows of the review queue, in the order in which they are walked."""
        return self._rows.ids

    def set_queue(self, rows: Rows) -> None:
        """Take over in which order artifacts are walked; the review queue calls this."""
        self._rows = rows
        self._regrouped.ask()

    def _tell_together(self) -> None:
        """Tell of what keys decide at once where the queue lists it otherwise than before."""
        before, self._told_together = self._told_together, self.together
        if before[:1] == self._told_together[:1] and before != self._told_together:
            self.together_changed.emit()
            self._propose()

    def select(
        self, artifact_id: str | None, *, frame: bool = True, unless_seen: bool = False
    ) -> None:
        """Put an artifact under review; its frames come into view if ``frame`` says so.

        With ``unless_seen`` a view in which they are seen well already stays.
        """
        self.going_back.forget()
        self.decisions.forget()
        self._current = artifact_id
        artifact = self.current
        if artifact is not None:
            self.preview.reset()
            if frame:
                bring = self.reveal if unless_seen else self.look_at
                bring(artifact.markers, *self.asked_frames(artifact))
            else:
                self.show_too(artifact.markers)
        self._told_together = self.together
        self.current_changed.emit()
        self._propose()

    def asked_frames(self, artifact: Artifact) -> tuple[int, int]:
        """Frames of an artifact that are asked about; all of one outside the region of interest."""
        region = None if self.session is None else self.session.region
        if region is None or not artifact.overlaps(*region):
            return artifact.start, artifact.stop
        return max(artifact.start, region[0]), min(artifact.stop, region[1])

    def put_under_review(self, artifact_id: str) -> None:
        """Put an artifact under review that is shown soon: keys mean it already."""
        self.decisions.forget()
        self._current = artifact_id

    def stay(self) -> None:
        """Tell anew of the artifact under review."""
        self.current_changed.emit()
        self._propose()

    def step(self, by: int) -> None:
        """Go to the next (1) or previous (-1) artifact of the queue; with none, to what is seen."""
        if self.session is not None and not self.queue and not self.shown:
            take = self.session.original
            seen = [m for i, m in enumerate(take.labels) if take.present[:, i].any()]
            self.show((*seen, *take.labels)[:1])
        row = self._rows.beside(self._current, by)
        if row is not None:
            self.select(row)

    def next_open(self, besides: Sequence[str] = ()) -> str | None:
        """The next undecided artifact after the one under review, else the first one left."""
        if self.session is None:
            return None
        row = self._rows.row_of(self._current)
        return next(iter(open_after(self.session, self.queue, row, besides)), None)

    # Proposed repairs

    @property
    def proposal(self) -> Any:
        """The previewed :class:`markermend.repairs.registry.Repair`, or None while it is made."""
        return None if self.current is None else self.preview.get(self.current)

    @property
    def joints(self) -> bool:
        """Whether the take is a skeleton recording, whose markers are joints."""
        return self.session is not None and self.session.original.skeleton

    @property
    def method(self) -> str:
        """The method previewed: ``"auto"`` or a name."""
        return self.preview.method

    def choose_method(self, name: str) -> None:
        """Preview another repair method for the current artifact (``"auto"`` or a name)."""
        if self.current is not None and name != self.method:
            self.preview.method = name
            self._propose()

    def follow(self, references: Sequence[str]) -> None:
        """Preview a repair that follows these markers only; with none the method chooses."""
        if self.current is not None and tuple(references) != self.preview.references:
            self.preview.references = tuple(references)
            self._propose()

    def _propose(self) -> None:
        """Ask for the current artifact's proposal and, ahead of time, those of the next ones."""
        self.proposal_changed.emit()
        artifact, session = self.current, self.session
        if artifact is None or session is None or self.mesh is None or self._holding_back:
            return
        row = self._rows.row_of(artifact.id)
        ahead = [session.artifact(i) for i in open_after(session, self.queue, row)[:AHEAD]]
        now = self.at_once(session)
        beside = ahead_and_beside(session, now, ahead)
        self.preview.want(session, self.mesh, now, beside)

    def at_once(self, session: Session) -> list[Artifact]:
        """What is repaired at once; references chosen by hand are those of one marker."""
        ids = self.together[:1] if self.preview.references else self.together
        return [session.artifact(i) for i in ids]

    def _proposal_came(self, artifact_id: str) -> None:
        """Show a proposal that was waited for, or use it when F was pressed already."""
        if artifact_id not in self.together:
            return
        if artifact_id == self._current or self._all_proposed():
            self.proposal_changed.emit()
        self.decisions.go_on()

    def _all_proposed(self) -> bool:
        """Whether repairs of all that is decided at once are there."""
        now = () if self.session is None else self.at_once(self.session)
        return len(now) > 1 and all(self.preview.get(a) is not None for a in now)

    # Changing it

    def do(self, verb: Callable[[Session], Change], *, moving: bool = False) -> bool:
        """Run a verb of the session and tell everyone what changed; whether it could be done.

        Who is moving on to another artifact tells of that one, so that nothing is shown of the
        one that is left.
        """
        session = self.session
        if session is None:
            return False
        if not self.editable:
            self.failed.emit(
                MarkermendError("This take is open in another window; close it there to edit here.")
            )
            return False
        if not moving:
            self.going_back.catch_up()
        revision, labels = session.revision, session.original.labels
        region = session.region
        problem: MarkermendError | None = None
        change = Change()
        try:
            change = verb(session)
        except MarkermendError as error:
            problem = error
        if session.revision != revision:
            if problem is not None:
                # The step was made but could not be journalled: show everything anew.
                change = Change(session.original.labels, 0, session.original.frames, True)
            if change.names:
                self._rename(dict(zip(labels, session.original.labels, strict=True)))
            self.proposals.invalidate(change, session.original.rate)
            self._announce(change, moving=moving and problem is None)
            current = self.current
            if session.region != region and current and current not in session.listed:
                # The view stays: who begins a region goes on to its end.
                self.select(None)
        if problem is not None:
            self.failed.emit(problem)
        return problem is None

    def undo(self) -> None:
        """Take the last step back, and go to what it was about."""
        last = () if self.session is None else self.session.steps[0][-1:]
        if last and self.do(lambda s: s.undo(), moving=True):
            self.going_back.after(last)

    def redo(self) -> None:
        """Bring the last undone step back, and go to what it is about."""
        self.travel(0 if self.session is None else len(self.session.history) + 1)

    def travel(self, steps_done: int) -> None:
        """Undo or redo until so many steps are done, and go to what the last of them is about."""
        if self.do(lambda s: s.travel(steps_done), moving=True) and self.session is not None:
            self.going_back.after(self.session.steps[0][-1:])

    def _rename(self, names: dict[str, str]) -> None:
        """Follow markers to their new names; what lists them starts over."""
        assert self.session is not None
        self.proposals.forget()
        self.preview.reset()
        if self.mesh is not None:
            self.mesh = replace(self.mesh, labels=self.session.original.labels)
        shown = tuple(names[s] for s in self.shown)
        self.shown, self.selection = (), None
        self.renaming = True
        self.opened.emit()
        self.renaming = False
        self.show(shown)
        self.artifacts_changed.emit()

    def _announce(self, change: Change, moving: bool) -> None:
        """Emit the signals of a change."""
        if change.markers:
            self.data_changed.emit(change)
        if change.artifacts:
            self.artifacts_changed.emit()
        self.history_changed.emit()
        if not moving:
            self.stay()
