"""Work by hand, when the machine is wrong: on a swept range, on a marker, on artifacts."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from markermend.artifact import Artifact, Kind, Status
from markermend.errors import DataError
from markermend.progress import Progress
from markermend.review import hand
from markermend.review.edits import Change
from markermend.review.fitting import donors, exchangers, receivers
from markermend.review.session import Session
from markermend.take import AXES, Origin, is_unlabelled
from markermend_app import units
from markermend_app.actions.palette import Entry, Palette
from markermend_app.background.jobs import Lane
from markermend_app.dialogs import ask as dialogs
from markermend_app.document import Document
from markermend_app.looking import Selection
from markermend_app.style import theme
from markermend_app.telling import told

NEAR_S = 0.25
"""As far as this from the current artifact the next one of its marker is joined by a key."""


class HandWork(QObject):
    """The verbs behind the actions of hand work. Asking and doing are kept apart.

    Parameters
    ----------
    document, lane : what is worked on, and where longer work is done
    window : parent of what is asked
    chosen : ids of the rows that are selected in the review queue

    Signals
    -------
    said(str) : a sentence for the status bar
    """

    said = Signal(str)

    def __init__(
        self,
        document: Document,
        lane: Lane,
        window: QWidget,
        chosen: Callable[[], Sequence[str]] = tuple,
    ) -> None:
        super().__init__(window)
        self._document, self._lane = document, lane
        self._window, self._chosen = window, chosen

    # A swept range

    def mark_selection(self, kind: Kind | None = None) -> None:
        """Make an artifact of the swept range; by default a gap if nothing is seen, else noise."""
        artifact = self._swept(kind)
        if artifact is not None:
            self._document.sweep(None)
            self._document.decisions.mark(artifact)
            # In space it is seen where the cursor is.
            self._document.go_inside(artifact.start, artifact.stop)

    def repair_selection(self) -> None:
        """Replace what lies in the swept range by the best repair."""
        artifact, mesh = self._swept(), self._document.mesh
        if artifact is None:
            return

        def prepare(session: Session) -> Callable[[Progress], Any]:
            take, everything, errors = session.take, session.artifacts, session.expected_errors

            def work(progress: Progress) -> Any:
                from markermend.repairs import propose

                return propose(take, artifact, everything, mesh=mesh, errors=errors)

            return work

        self._work(
            self.tr("Repairing"), prepare, lambda s, repair: hand.repair(s, artifact, repair)
        )

    def cut_selection(self) -> None:
        """Make the swept range missing; the gap comes under review, its repair previewed."""
        swept = self._document.selection
        if swept is not None:
            self._change(lambda s: hand.cut(s, swept.marker, swept.start, swept.stop))

    def swap_selection(self) -> None:
        """Exchange the swept range with that of another marker, from here to there."""
        swept, session = self._document.selection, self._document.session
        if swept is None or session is None:
            return
        offered = exchangers(session.take, swept.marker, swept.start, swept.stop)
        beside = [name for name in self._document.shown if name != swept.marker]
        joint, marker = (
            self.tr("Swap {0} with which joint, {1}?"),
            self.tr("Swap {0} with which marker, {1}?"),
        )
        question = (joint if self._document.joints else marker).format(
            swept.marker, self._frames(swept.start, swept.stop)
        )
        self._ask_marker(
            question,
            # Who put one other beside it most likely means that one.
            sorted(offered, key=lambda pair: len(beside) != 1 or pair[0] != beside[0]),
            lambda other: self._swap(swept, other),
            self.tr("jumps {0} at the edges"),
        )

    def _swap(self, swept: Selection, other: str) -> None:
        """Exchange a range of two markers."""
        artifact = Artifact(
            swept.marker, AXES, swept.start, swept.stop, Kind.STEP, counterpart=other,
            why="marked by hand",
        )  # fmt: skip

        def swap(session: Session) -> Change:
            from markermend.repairs import propose

            repair = propose(session.take, artifact, session.artifacts, method="swap")
            return hand.repair(session, artifact, repair)

        self._change(swap)

    def move_selection(self) -> None:
        """Give the swept range to another marker: it has the wrong name there."""
        swept = self._document.selection
        if swept is not None:
            question = self.tr("Which marker is {0} in truth, {1}?")
            if self._document.joints:
                question = self.tr("Which joint is {0} in truth, {1}?")
            self._ask_receiver(
                question.format(swept.marker, self._frames(swept.start, swept.stop)),
                swept,
                lambda other: self._change(
                    lambda s: hand.move(s, swept.marker, other, swept.start, swept.stop)
                ),
            )

    # A whole trajectory

    def rename_marker(self) -> None:
        """Give the foremost marker another name in the whole take."""
        session = self._document.session
        if session is None or not self._document.shown:
            return
        old = self._document.shown[0]
        take = session.original

        def refuse(new: str) -> str:
            try:
                take.renamed({old: new.strip()})
            except DataError as error:
                return told(str(error))
            return ""

        new = dialogs.ask_text(self._window, self.tr("Rename {0}").format(old), old, refuse)
        if new is not None:
            self._change(lambda s: hand.rename(s, {old: new}))

    def merge_marker(self) -> None:
        """Merge an unlabelled trajectory into the foremost marker, or the foremost into another."""
        session = self._document.session
        if session is None or not self._document.shown:
            return
        foremost = self._document.shown[0]
        fitting = () if is_unlabelled(foremost) else donors(session.take, foremost)
        if fitting:
            question = self.tr("Which unlabelled trajectory belongs to {0}?").format(foremost)
            merge = partial(self._merge, receiver=foremost)
            self._ask_marker(question, fitting, merge, self.tr("{0} away"))
        else:
            joint = self.tr("Merge {0} into which joint?")
            marker = self.tr("Merge {0} into which marker?")
            question = (joint if self._document.joints else marker).format(foremost)
            whole = Selection(foremost, 0, session.original.frames)
            self._ask_receiver(question, whole, partial(self._merge, foremost))

    def _merge(self, donor: str, receiver: str) -> None:
        """Give all samples of one marker to another, and look at where they went."""
        session = self._document.session
        if session is None:
            return
        seen = np.flatnonzero(session.take.present[:, session.take.index(donor)])
        self._change(lambda s: hand.merge(s, donor, receiver))
        self._document.show([receiver])
        if len(seen):
            self._document.look_at([receiver], int(seen[0]), int(seen[-1]) + 1)

    # Artifacts

    def split_artifact(self) -> None:
        """Make two of the current artifact, and of each of its event, at the cursor."""
        ids, at = self._document.together, self._document.frame
        if ids:
            one, *others = ids
            verb = partial(hand.split, artifact_id=one, at=at, others=others)
            self._document.decisions.adjust(ids, verb)

    def join_artifacts(self) -> None:
        """Make one of the artifacts selected in the queue, else of the current and the next one."""
        session, current = self._document.session, self._document.current
        if session is None or current is None:
            return
        ids, together = list(self._chosen()), self._document.together
        if set(ids) <= set(together):
            # One row alone, which may be an event of several joints.
            ids = [current.id]
            following = self._next_on_its_marker(session, current)
            if following is not None and self._far(current, following):
                return
            for a in map(session.artifact, together):
                following = self._next_on_its_marker(session, a)
                if following is not None and self._near(session, a, following):
                    ids = list(dict.fromkeys((*ids, a.id, following.id)))
        if (
            self._document.decisions.adjust(ids, lambda s: hand.join(s, ids))
            and self._document.current is None
        ):
            left = [i for i in ids if session.find(i) is not None]
            self._document.select(left[0])

    def call(self, kind: Kind) -> None:
        """Give the current artifact, and the rest of its event, another class."""
        self._document.decisions.change_current(kind=kind)

    def nudge(self, start: int, stop: int) -> None:
        """Move an edge of the current artifact, and of its event; one frame at least is left."""
        ids = self._document.together
        if ids:
            one, *others = ids
            verb = partial(hand.nudge, artifact_id=one, start=start, stop=stop, others=others)
            self._document.decisions.adjust(ids, verb)

    # Inner workings

    def _next_on_its_marker(self, session: Session, one: Artifact) -> Artifact | None:
        """The next artifact of a marker that was not rejected."""
        later = (
            a
            for a in session.artifacts
            if a.marker == one.marker
            and a.start >= one.start
            and a.id != one.id
            and a.status is not Status.REJECTED
        )
        return next(later, None)

    def _near(self, session: Session, one: Artifact, other: Artifact) -> bool:
        """Whether two artifacts are so near that a key by itself joins them."""
        return other.start - one.stop <= NEAR_S * session.original.rate

    def _far(self, one: Artifact, other: Artifact) -> bool:
        """Say so where two artifacts are too far apart for that."""
        session = self._document.session
        if session is None or self._near(session, one, other):
            return False
        text = self.tr(
            "The next artifact of {0} begins {1} frames later; select both in the queue to join "
            "them."
        )
        self.said.emit(text.format(one.marker, other.start - one.stop))
        return True

    def _swept(self, kind: Kind | None = None) -> Artifact | None:
        """Describe the swept range as an artifact."""
        swept, session = self._document.selection, self._document.session
        if swept is None or session is None:
            return None
        if kind is None:
            column = session.original.index(swept.marker)
            origin = session.origin[swept.start : swept.stop, column]
            kind = Kind.GAP if (origin == Origin.MISSING).all() else Kind.NOISE
        why = "marked by hand"
        return Artifact(swept.marker, AXES, swept.start, swept.stop, kind, 1.0, why=why)

    def _change(self, verb: Callable[[Session], Change]) -> None:
        """Do something to samples or names; a new artifact comes under review."""
        session = self._document.session
        if session is None:
            return
        before = {a.id for a in session.artifacts}
        if self._document.do(verb):
            self._document.sweep(None)
            self.said.emit(self.tr("{0}.").format(told(session.history[-1])))
            new = [a for a in session.artifacts if a.id not in before]
            opened = next((a for a in new if a.status is Status.PENDING), *new[:1] or (None,))
            if opened is not None:
                self._document.select(opened.id, frame=False)
                self._document.go_inside(opened.start, opened.stop)

    def _work(
        self,
        label: str,
        prepare: Callable[[Session], Callable[[Progress], Any]],
        keep: Callable[[Session, Any], Change],
    ) -> None:
        """Work something out on the worker and keep it, unless the review changed meanwhile."""
        session = self._document.session
        if session is None:
            return
        revision = session.revision

        def done(result: Any) -> None:
            if self._document.session is session and session.revision == revision:
                self._change(lambda s: keep(s, result))
            else:
                self.said.emit(self.tr("The review changed meanwhile; do it again."))

        self._lane.submit(label, prepare(session), done, self._document.failed.emit)

    def _ask_receiver(self, question: str, given: Selection, then: Callable[[str], object]) -> None:
        """Ask which marker is to have the samples of one."""
        session = self._document.session
        if session is None:
            return
        offered = receivers(session.take, given.marker, given.start, given.stop)
        if offered:
            self._ask_marker(question, offered, then, self.tr("{0} away"))
            return
        text = self.tr("No other marker is missing wherever {0} is seen; to exchange two, swap.")
        if self._document.joints:
            text = self.tr("No other joint is missing wherever {0} is seen; to exchange two, swap.")
        self._document.failed.emit(DataError(text.format(given.marker)))

    def _ask_marker(
        self,
        question: str,
        offered: Sequence[tuple[str, float]],
        then: Callable[[str], object],
        aside: str,
    ) -> None:
        """Ask for one of some markers, the likeliest first, each with how well it fits."""
        icon = theme.icon("marker")
        found = [
            Entry(
                label,
                aside.format(units.length(mm)) if math.isfinite(mm) else "",
                icon,
                True,
                partial(then, label),
            )
            for label, mm in offered
        ]
        Palette(found, self._window, question).open()

    def _frames(self, start: int, stop: int) -> str:
        """Frames as the file counts them, in words."""
        session = self._document.session
        first = 0 if session is None else session.original.first_frame
        return self.tr("frames {0}–{1}").format(start + first, stop - 1 + first)
