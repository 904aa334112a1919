"""Every artifact of the take as a list to be worked off."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import QItemSelection, QItemSelectionModel, QModelIndex, QPoint, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QMenu,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from markermend.artifact import Artifact, Status
from markermend.review.session import Session
from markermend_app.actions import shortcuts
from markermend_app.actions.menus import entry
from markermend_app.document import Document
from markermend_app.later import Later
from markermend_app.panels.before_hands import BeforeHands
from markermend_app.panels.markers.badge import hint
from markermend_app.panels.queue.columns import QueueColumns
from markermend_app.panels.queue.filters import ACCEPTED, OPEN, QueueFilters
from markermend_app.panels.queue.keeping import KeptListed
from markermend_app.panels.queue.model import COLUMNS, MARKER, STATUS, QueueModel
from markermend_app.panels.queue.view import QueueView
from markermend_app.panels.sort_menu import sort_menu
from markermend_app.rows import Rows
from markermend_app.style import theme


class ReviewQueue(QWidget):
    """Artifacts, sortable and filtered; the row under the cursor is the one under review.

    Signals
    -------
    repair_requested(list) : ids of artifacts to be repaired with their best methods
    verb_requested(str) : name of the action to be done
    """

    repair_requested = Signal(list)
    verb_requested = Signal(str)

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._doing = ""
        self._listed: tuple[str, ...] = ()
        self._followed: str | None = None
        self._walked = Rows()
        self._syncing = self._choosing = self._stale = False
        self._soon = Later(self._catch_up, self)
        self.model = QueueModel(self)
        self.view = QueueView()
        self.view.setAccessibleName(self.tr("Review queue"))
        self.view.setModel(self.model)
        self.view.setSortingEnabled(True)
        self.view.sortByColumn(STATUS, Qt.SortOrder.AscendingOrder)
        self._columns = QueueColumns(self.view, self.model)
        self._hint = hint("")
        self._pages = QStackedWidget()
        self._pages.addWidget(self._hint)
        self._pages.addWidget(self.view)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 4, 0, 0)
        whole.setSpacing(4)
        self.filters = QueueFilters(self.view)
        self.filters.changed.connect(self._filter)
        self.kept = KeptListed(document, self.model.row_of, self)
        self.filters.marker.editingFinished.connect(self.kept.leave)
        whole.addWidget(self.filters)
        whole.addWidget(self._pages, 1)

        self.view.selectionModel().currentRowChanged.connect(self._row_changed)
        for changed in (self.view.selectionModel().selectionChanged, self.model.modelReset):
            changed.connect(lambda: self.filters.say_chosen(len(self._selected())))
        self.view.clicked.connect(self._clicked)
        self.view.doubleClicked.connect(lambda _: document.decisions.repair_current())
        BeforeHands(self.view, self._soon.catch_up)
        self.view.verb.connect(self.apply)
        self.view.customContextMenuRequested.connect(self._show_menu)
        self.model.order_changed.connect(self._order_changed)
        document.opened.connect(self._reset)
        document.artifacts_changed.connect(self._artifacts_changed)
        document.history_changed.connect(self._soon.ask)
        document.current_changed.connect(self._current_changed)
        theme.watcher.changed.connect(self.view.viewport().update)
        shortcuts.watcher.changed.connect(self._explain)
        self._filter()
        self._refresh()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave out what is told elsewhere too where room is scarce."""
        super().resizeEvent(event)
        self.filters.fit(self.width())
        self._fit_columns()

    @property
    def place(self) -> QWidget:
        """What takes the keys: the table, or what narrows it down while nothing is listed."""
        self._soon.catch_up()
        return self.view if self.model.rows else self.filters.status

    # Verbs on the selected rows

    def selected(self) -> list[str]:
        """Ids of what the selected rows stand for, from top to bottom."""
        self._soon.catch_up()
        return [a.id for row in self._selected() for a in self.model.events[row]]

    def _selected(self) -> list[int]:
        return sorted(i.row() for i in self.view.selectionModel().selectedRows())

    def apply(self, verb: str) -> None:
        """Accept, reject, reopen, repair or remove the selected rows."""
        ids = self.selected()
        if not ids:
            return
        if verb != "repair":
            getattr(self._document.decisions, verb)(ids)
        elif set(ids) == set(self._document.together):
            self._document.decisions.repair_current()
        else:
            self.repair_requested.emit(ids)

    def menu(self) -> QMenu:
        """The context menu for the selected rows."""
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        chosen = [self.model.rows[i.row()] for i in self.view.selectionModel().selectedRows()]
        statuses, many = {a.status for a in chosen}, len(chosen) > 1
        each = self.tr("Repair, each by its best method") if many else ""
        for verb, text, usable in (
            ("accept", "", statuses != ACCEPTED),
            ("reject", "", statuses != {Status.REJECTED}),
            ("repair", each, statuses != {Status.REPAIRED}),
            ("reopen", "", statuses != OPEN),
            ("remove", "", True),
        ):
            if verb in ("reopen", "remove"):
                menu.addSeparator()
            action = entry(menu, verb, partial(self.apply, verb), text)
            action.setEnabled(usable and bool(statuses) and self._document.editable)
        if many and len({a.marker for a in chosen}) == 1:
            join = partial(self.verb_requested.emit, "join_artifacts")
            entry(menu, "join_artifacts", join).setEnabled(self._document.editable)
        menu.addSeparator()
        menu.addMenu(sort_menu(self.view.horizontalHeader(), menu))
        return menu

    def _show_menu(self, at: QPoint) -> None:
        self.menu().popup(self.view.viewport().mapToGlobal(at))

    # Following the document

    def _reset(self) -> None:
        """Another take: show everything that is open."""
        if not self._document.renaming:
            self._followed = None
            self.kept.forget()
            self.filters.clear()
        session = self._document.session
        self.filters.name_joints(session is not None and session.original.skeleton)
        self._refresh()

    def _artifacts_changed(self) -> None:
        """Take decisions over soon, and at once artifacts that came or went."""
        session = self._document.session
        ids = () if session is None else tuple(a.id for a in session.listed)
        if session is None or ids != self._listed:
            self._refresh()
            return
        # Where keys go next does not wait for the rows.
        self._walk_by(self.model.listed(session.listed, session.notes))
        self._stale = True
        self._soon.ask()

    def _current_changed(self) -> None:
        """Put the cursor soon on the artifact under review, unless it was chosen here."""
        if not self._choosing:
            self._soon.ask()

    def _catch_up(self) -> None:
        """Show what was decided and what is under review now."""
        if self._stale:
            self._refresh()
        current = self._document.current
        # While it stays the same, hands have scrolled to what they look at.
        self._follow_current(scroll=current is not None and current.id != self._followed)
        self._explain()

    def _refresh(self) -> None:
        """Take over artifacts and decisions; the view stays where it is."""
        self._stale = False
        session = self._document.session
        self._listed = () if session is None else tuple(a.id for a in session.listed)
        bar = self.view.verticalScrollBar()
        at, chosen = bar.value(), {self.model.rows[row].id for row in self._selected()}
        self._syncing = True
        if session is None:
            self.model.set_artifacts((), {}, None)
        else:
            self.model.set_artifacts(session.listed, session.notes, session.original)
        self._select(chosen)
        self._syncing = False
        bar.setValue(at)
        # A copy of a review changes no row of the one before, but the document walks anew.
        self._walk_by(self.model.events)
        self._follow_current(scroll=False)
        self.filters.count(() if session is None else session.listed)
        self.filters.fit(self.width())
        if self._columns.measure():
            self._fit_columns()
        self._explain()

    def _select(self, ids: set[str]) -> None:
        """Select rows by id, as they were before the model changed."""
        picked = QItemSelection()
        for i in ids:
            row = self.model.row_of(i)
            if row is not None:
                picked.select(self.model.index(row, 0), self.model.index(row, COLUMNS - 1))
        flag = QItemSelectionModel.SelectionFlag
        self.view.selectionModel().select(picked, flag.ClearAndSelect)

    def _filter(self) -> None:
        """List what the filters ask for."""
        self._soon.catch_up()
        walked = self._walked
        self._syncing = True
        self.model.set_wanted(self.filters.wanted)
        self._syncing = False
        self._fit_columns()
        self._follow_current()
        self._explain()
        self.kept.narrowed(walked, typing=self.filters.marker.hasFocus())

    def _fit_columns(self) -> None:
        """Leave out columns where there is no room for all, or nothing to be told in them."""
        self._columns.fit(self.width(), self.filters.statuses)

    def _order_changed(self) -> None:
        """Tell the document in which order artifacts are walked."""
        self._walk_by(self.model.events)
        if not self._syncing:
            self._follow_current()

    def _walk_by(self, events: Sequence[Sequence[Artifact]]) -> None:
        """Tell the document in which order it goes on, and what is decided at once."""
        self._walked = Rows([[a.id for a in event] for event in events])
        self._document.set_queue(self._walked)

    def _follow_current(self, *, scroll: bool = True) -> None:
        """Put the cursor on the artifact under review."""
        current = self._document.current
        if scroll:
            self._followed = None if current is None else current.id
        row = None if current is None else self.model.row_of(current.id)
        selection = self.view.selectionModel()
        flag = QItemSelectionModel.SelectionFlag
        self._syncing = True
        if row is None:
            selection.clearCurrentIndex()
            if len(selection.selectedRows()) < 2:
                selection.clearSelection()
        else:
            index = self.model.index(row, max(self.view.currentIndex().column(), 0))
            kept = selection.isRowSelected(row, QModelIndex())
            how = flag.NoUpdate if kept else flag.ClearAndSelect | flag.Rows
            x = self.view.horizontalScrollBar().value()
            selection.setCurrentIndex(index, how)
            self.view.horizontalScrollBar().setValue(x)
            if scroll:
                self.view.scrollTo(self.model.index(row, MARKER))
        self._syncing = False

    def _row_changed(self, index: QModelIndex, _: QModelIndex) -> None:
        """Put the row's artifact under review."""
        if self._syncing or not index.isValid():
            return
        artifact = self.model.rows[index.row()]
        if artifact.id not in self._document.together:
            # The view is about to select the row by itself, alone or beside others.
            self._choosing = True
            self._followed = artifact.id
            self._document.select(artifact.id)
            self._choosing = False

    def _clicked(self, index: QModelIndex) -> None:
        """Bring the artifact into view again when its row is clicked again."""
        a = self.model.rows[index.row()]
        if a.id in self._document.together:
            self._document.look_at(a.markers, *self._document.asked_frames(a))

    def set_doing(self, label: str) -> None:
        """Be told what is worked on, empty for nothing: found may be what is not listed yet."""
        self._doing = label
        self._explain()

    def _all_decided(self, session: Session) -> str:
        """Say how to go on when nothing is open, and what is left as it is."""
        count, way = len(session.listed), shortcuts.way_to("export")
        if session.exported:
            one = self.tr("The only artifact is decided, and the repaired take is exported.")
            many = self.tr("All {0} artifacts are decided, and the repaired take is exported.")
        else:
            one = self.tr("The only artifact is decided. {0} exports the repaired take.")
            one = one.format(way)
            many = self.tr("All {0} artifacts are decided. {1} exports the repaired take.")
        text = one if count == 1 else many.format(count, way)
        waiting = len(session.listed_with(Status.ACCEPTED))
        if waiting:
            one = self.tr("{0} is accepted but not repaired; {1} repairs what is accepted.")
            many = self.tr("{0} are accepted but not repaired; {1} repairs what is accepted.")
            left = one if waiting == 1 else many
            text += " " + left.format(waiting, shortcuts.way_to("repair_accepted"))
        outside = len(session.artifacts) - count
        if outside:
            text += " " + self.tr("Outside the region of interest: {0}.").format(outside)
        return text

    def _explain(self) -> None:
        """Say why nothing is listed."""
        session = self._document.session
        self._pages.setCurrentIndex(1 if self.model.rows else 0)
        if session is None:
            text = self.tr("Open a take to review its artifacts here.")
        elif not session.original.markers:
            text = self.tr("This file has no markers, so there is nothing to review.")
        elif not session.artifacts:
            if self._doing:
                text = f"{self._doing}…"
            elif any(step.startswith("Detect") for step in session.history):
                text = self.tr("Nothing was found. Sweep over a curve with Shift to mark by hand.")
            elif self._document.editable:
                text = self.tr("Nothing found yet. {0} looks for artifacts.").format(
                    shortcuts.way_to("detect")
                )
            else:
                text = self.tr("Nothing has been found in it yet.")
        elif not session.listed:
            text = self.tr("Every artifact lies outside the region of interest.")
            if self._document.editable:
                reviews_all = self.tr("{0} reviews the whole take.")
                text += " " + reviews_all.format(shortcuts.way_to("region_whole"))
        elif not session.listed_with(Status.PENDING) and self.filters.statuses == OPEN:
            text = self._all_decided(session)
        else:
            text = self.tr("No artifact matches these filters.")
        self._hint.setText(text)
