"""What the operator decides about artifacts, after which the review goes on with the next one."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject

from markermend.artifact import Artifact, Kind, Status
from markermend.errors import DataError
from markermend.review.edits import Change
from markermend.review.session import Session
from markermend_app.style import theme
from markermend_app.telling import told

if TYPE_CHECKING:
    from markermend_app.document import Document


class Decisions(QObject):
    """Verbs on artifacts: those named, or the one under review with the rest of its event."""

    def __init__(self, document: Document) -> None:
        super().__init__(document)
        self._document = document
        self._repair_when_ready: str | None = None

    def forget(self) -> None:
        """Repair nothing that was waited for: something else is under review."""
        self._repair_when_ready = None

    def go_on(self) -> None:
        """Use a repair that has come, when F was pressed already."""
        current = self._document.current
        waited = current is not None and self._repair_when_ready == current.id
        if waited and self._document.proposal is not None:
            self.repair_current()

    def accept(self, ids: Sequence[str]) -> None:
        """Say that flags are right; the samples stay, so that what is repaired stays repaired."""
        session = self._document.session
        if session is None:
            return
        repaired = {a.id for a in session.with_status(Status.REPAIRED)}
        chosen = [i for i in ids if i not in repaired]
        if chosen:
            self._decide(chosen, Status.ACCEPTED)
        elif ids:
            self._document.failed.emit(
                DataError("That is repaired already; reopen it to undo the repair.")
            )

    def reject(self, ids: Sequence[str]) -> None:
        """Say that flags are false alarms."""
        self._decide(ids, Status.REJECTED)

    def reopen(self, ids: Sequence[str]) -> None:
        """Take a decision back; a repaired one gets its source samples again."""
        self._document.do(lambda s: s.set_status(ids, Status.PENDING))

    def accept_current(self) -> None:
        """Accept the current artifact, and the rest of its event, and move on."""
        if self._document.current is not None:
            self.accept(self._document.together)

    def reject_current(self) -> None:
        """Reject the current artifact, and the rest of its event, and move on."""
        if self._document.current is not None:
            self.reject(self._document.together)

    def repair_current(self) -> None:
        """Replace the samples of what is under review by the previewed repairs and move on.

        When a preview is still being made, it is used as soon as it is there. Where no method
        has a repair, the flag is accepted and its samples are left, so that the review goes on.
        """
        document = self._document
        artifact, session = document.current, document.session
        if artifact is None or session is None or not document.editable:
            return
        if artifact.status is Status.REPAIRED:
            return
        made = [(a.id, document.preview.get(a)) for a in document.at_once(session)]
        if any(proposal is None for _, proposal in made):
            self._repair_when_ready = artifact.id
            return
        self._repair_when_ready = None
        ids = [i for i, _ in made]
        following = document.next_open(besides=ids)
        able = [one for one in made if one[1].patches]
        if not able and document.preview.best:
            self._leave(artifact, ids, made[0][1].reason, following)
        elif document.do(lambda s: s.repair(able or made[:1]), moving=True):
            self._move_on(following)
            if len(able) > 1:
                document.said.emit(self.tr("{0} repaired.").format(len(able)))

    def _leave(
        self, artifact: Artifact, ids: Sequence[str], reason: str, following: str | None
    ) -> None:
        """Accept what cannot be repaired, say why it stays as it is, and move on."""
        accepted = artifact.status is Status.ACCEPTED
        if accepted or self._document.do(lambda s: s.set_status(ids, Status.ACCEPTED), moving=True):
            self._move_on(following)
            text = self.tr("The flag on {0} is accepted, the samples are left. {1}")
            self._document.said.emit(text.format(artifact.marker, told(reason)))

    def repair_many(self, repairs: Sequence[tuple[str, Any]], label: str) -> None:
        """Apply many proposals as one step."""
        ids = [i for i, _ in repairs]
        following = self._document.next_open(besides=ids)
        moving = self._is_current(ids)
        if self._document.do(lambda s: s.repair(repairs, label), moving=moving) and moving:
            self._move_on(following)

    def add_detected(
        self, found: Iterable[Artifact], method: str, *, by_itself: bool = False
    ) -> None:
        """Take over what a detector found, where nobody asked it ``by_itself``."""
        self._document.do(lambda s: s.add_detected(found, method, by_itself=by_itself))

    def mark(self, artifact: Artifact) -> None:
        """Add an artifact by hand and put it under review."""
        session = self._document.session
        if session is None:
            return
        before = {a.id for a in session.artifacts}
        if self._document.do(lambda s: s.mark(artifact)):
            self._document.select(*({a.id for a in session.artifacts} - before), frame=False)

    def remove(self, ids: Sequence[str]) -> None:
        """Take artifacts off the list; when the current one is among them, move on."""
        following = self._document.next_open(besides=ids)
        moving = following is not None and self._is_current(ids)
        if self._document.do(lambda s: s.remove(ids), moving=moving) and moving:
            self._move_on(following)

    def change(
        self,
        artifact_id: str,
        *,
        kind: Kind | None = None,
        axes: str | None = None,
        start: int | None = None,
        stop: int | None = None,
        others: Sequence[str] = (),
    ) -> None:
        """Give an artifact, and the ``others`` of its event, another class, axes or edges."""
        self.adjust(
            [artifact_id, *others],
            lambda s: s.change(
                artifact_id, kind=kind, axes=axes, start=start, stop=stop, others=others
            ),
        )

    def change_current(
        self,
        *,
        kind: Kind | None = None,
        axes: str | None = None,
        start: int | None = None,
        stop: int | None = None,
    ) -> None:
        """Give the current artifact, and the rest of its event, another class, axes or edges."""
        if self._document.current is not None:
            one, *others = self._document.together
            self.change(one, kind=kind, axes=axes, start=start, stop=stop, others=others)

    def adjust(self, ids: Sequence[str], verb: Callable[[Session], Change]) -> bool:
        """Make something else of artifacts, and say so where that takes a repair back."""
        session = self._document.session
        repaired = [] if session is None else session.with_status(Status.REPAIRED)
        mine = [a for a in repaired if a.id in ids]
        done = self._document.do(verb)
        if done and session is not None and mine:
            now = {a.id for a in session.with_status(Status.REPAIRED)}
            if any(a.id not in now for a in mine):
                text = self.tr("{0} on {1} is open again: its repair was for what it was before.")
                self._document.said.emit(text.format(theme.kind_name(mine[0].kind), mine[0].marker))
        return done

    def _decide(self, ids: Sequence[str], status: Status) -> None:
        """Set a status; when the current artifact is among them, move on."""
        following = self._document.next_open(besides=ids)
        moving = self._is_current(ids)
        if self._document.do(lambda s: s.set_status(ids, status), moving=moving) and moving:
            self._move_on(following)

    def _is_current(self, ids: Sequence[str]) -> bool:
        """Whether what is under review is among these."""
        current = self._document.current
        return current is not None and current.id in ids

    def _move_on(self, artifact_id: str | None) -> None:
        """Select the next artifact, or stay when all are decided."""
        if artifact_id is None:
            self._document.stay()
        else:
            self._document.select(artifact_id)
