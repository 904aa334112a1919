"""Many takes reviewed one after the other; the next one is made ready in the background."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from markermend.artifact import Status
from markermend.errors import MarkermendError
from markermend.progress import Progress, quiet
from markermend_app.actions import shortcuts
from markermend_app.background.jobs import Lane
from markermend_app.background.loading import (
    Glance,
    Prepared,
    glance,
    glance_at,
    load_item,
    open_prepared,
    prepare,
    takes_folder,
)
from markermend_app.dialogs import ask as dialogs
from markermend_app.dialogs.file_filters import WITHOUT_PATTERNS, open_filter
from markermend_app.document import Document
from markermend_app.verbs.commands import Commands

if TYPE_CHECKING:
    from markermend.batch.review import ToReview

SETTLED_MS = 300

Listed = tuple[tuple["ToReview", ...], dict[Path, Glance], dict[Path, str]]


class BatchReview(QObject):
    """A list of takes, how each stands, and the way from one to the next.

    Signals
    -------
    started() : other takes are listed
    changed() : something is known of one of them, or another one is open
    said(str) : a sentence for the status bar

    Attributes
    ----------
    items : takes in the order in which they are reviewed
    glances : how each stands, by path, as far as it is known
    problems : why one cannot be opened, by path
    """

    started = Signal()
    changed = Signal()
    said = Signal(str)

    def __init__(
        self, document: Document, commands: Commands, engine: Lane, window: QWidget
    ) -> None:
        super().__init__(window)
        self._document, self._commands, self._window = document, commands, window
        self._engine = engine
        self._ahead = Lane("ahead", self)
        self._ready: Prepared | None = None
        self.items: tuple[ToReview, ...] = ()
        self.glances: dict[Path, Glance] = {}
        self.problems: dict[Path, str] = {}
        self._settling = QTimer(self)
        self._settling.setSingleShot(True)
        self._settling.setInterval(SETTLED_MS)
        self._settling.timeout.connect(self._look)
        for lane in (engine, self._ahead):
            lane.finished.connect(lambda: QTimer.singleShot(0, self._go_on))
        document.history_changed.connect(self._settling.start)
        document.opened.connect(self.changed)
        document.current_changed.connect(self._tell_done)

    # Asking which

    def review_batch(self) -> None:
        """Ask for takes, or for the list that a batch wrote, and review them."""
        listed = self.tr("List of a batch")
        filters = f"{open_filter()};;{listed} (review.json)"
        title = self.tr("Review a batch: takes, or the review.json of a batch")
        start = str(takes_folder(self._document.path))
        names, _ = QFileDialog.getOpenFileNames(
            self._window, title, start, filters, "", WITHOUT_PATTERNS
        )
        if names:
            self.start([Path(name) for name in sorted(names)])

    def review_folder(self) -> None:
        """Ask for a folder and review the takes in it and below."""
        title = self.tr("Review the takes of a folder, or what a batch wrote to it")
        start = str(takes_folder(self._document.path))
        name = QFileDialog.getExistingDirectory(self._window, title, start)
        if name:
            self.start([Path(name)])

    def start(self, given: Sequence[Path]) -> None:
        """List takes and open the first that is not done."""

        def done(listed: Listed) -> None:
            self._ahead.cancel()
            self._ready = None
            self.items, self.glances, self.problems = listed
            self.started.emit()
            self.changed.emit()
            first = next((item for item in self.items if self._waits(item)), None)
            if first is not None:
                self.open(first)
            elif self.items:
                self.said.emit(self.tr("All takes of the list are done."))
            else:
                self.said.emit(self.tr("No artifact of this batch waits for an operator."))

        def failed(error: Exception) -> None:
            dialogs.show_problem(self._window, error)

        work = partial(_listed, given)
        self._engine.submit(self.tr("Looking for takes"), work, done, failed)

    # Walking

    @property
    def current(self) -> ToReview | None:
        """The take of the list that is open."""
        path = self._document.path
        return next((item for item in self.items if item.path == path), None)

    @property
    def next_item(self) -> ToReview | None:
        """The next take that is not done, after the open one and then from the beginning."""
        items, current = list(self.items), self.current
        if current is not None:
            i = items.index(current)
            items = items[i + 1 :] + items[:i]
        return next((item for item in items if self._waits(item)), None)

    def ready(self, item: ToReview) -> bool:
        """Whether a take was made ready."""
        return self._ready is not None and self._ready.item == item

    def next_take(self) -> None:
        """Keep the review of the open take and go to the next that is not done."""
        item = self.next_item
        if item is not None:
            self.open(item)
        elif self.items:
            self.said.emit(self.tr("All other takes of the list are done."))
        else:
            self.said.emit(self.tr("No takes are listed; File: Review a batch lists some."))

    def open(self, item: ToReview) -> None:
        """Keep the review of the open take and open one of the list."""
        if item == self.current or not self._commands.put_by():
            return
        self._look()
        # What is made ready for another take would only slow this one down.
        self._ahead.cancel()
        ready, self._ready = self._ready, None
        if ready is not None and ready.item == item:
            work = partial(open_prepared, ready)
        else:
            work = partial(load_item, item)
        self._commands.open_by(item.path, work, partial(self._broke, item))

    # Working ahead

    def _waits(self, item: ToReview) -> bool:
        """Whether a take can be opened and is not known to be done."""
        known = self.glances.get(item.path)
        return item.path not in self.problems and (known is None or not known.done)

    def _go_on(self) -> None:
        """Prepare the next take, or else see how another one stands, while nothing else runs."""
        if not self.items or self._engine.busy or self._ahead.busy:
            return
        item = self.next_item
        if item is not None and not self.ready(item):
            self._ahead.submit(
                "Prepare", partial(prepare, item), self._prepared, partial(self._broke, item)
            )
            return
        unseen = (
            i for i in self.items if i.path not in self.glances and i.path not in self.problems
        )
        other = next(unseen, None)
        if other is not None:
            saw, broke = partial(self._saw, other), partial(self._broke, other)
            self._ahead.submit("Glance", partial(glance, other), saw, broke)

    def _prepared(self, ahead: Prepared) -> None:
        """Keep what was made ready; a take in which nothing waits makes place for the next."""
        self.glances[ahead.item.path] = ahead.glance
        if not ahead.glance.done:
            self._ready = ahead
        self.changed.emit()

    def _saw(self, item: ToReview, seen: Glance) -> None:
        self.glances[item.path] = seen
        self.changed.emit()

    def _broke(self, item: ToReview, error: Exception) -> None:
        self.problems[item.path] = str(error)
        self.changed.emit()

    # Following the review

    def _look(self) -> None:
        """See how the open take stands."""
        item, session = self.current, self._document.session
        if item is not None and session is not None:
            self.glances[item.path] = glance_at(session)
            self.problems.pop(item.path, None)
            self.changed.emit()

    def _tell_done(self) -> None:
        """Say how to go on when everything is decided."""
        session = self._document.session
        if self.current is None or session is None or not session.artifacts:
            return
        if session.listed_with(Status.PENDING):
            return
        item = self.next_item
        if item is None:
            self.said.emit(self.tr("Everything is decided, in all takes of the list."))
        else:
            text = self.tr("Everything is decided. {0} goes on with {1}.")
            self.said.emit(text.format(shortcuts.way_to("next_take"), item.name))


def _listed(given: Sequence[Path], progress: Progress) -> Listed:
    """List takes, and see how they stand up to the first that is not done."""
    from markermend.batch.review import takes_to_review

    items = takes_to_review(given)
    glances: dict[Path, Glance] = {}
    problems: dict[Path, str] = {}
    for i, item in enumerate(items):
        progress(i / len(items), item.name)
        try:
            glances[item.path] = glance(item, quiet)
        except (MarkermendError, OSError) as error:
            problems[item.path] = str(error)
            continue
        if not glances[item.path].done:
            break
    return items, glances, problems
