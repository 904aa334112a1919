"""What was done, step by step; a click goes back or forth to any step."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, QSize, Qt
from PySide6.QtGui import QFont, QResizeEvent
from PySide6.QtWidgets import (
    QListView,
    QStackedWidget,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from markermend.review.step import Step, stretch
from markermend_app.document import Document
from markermend_app.later import Later
from markermend_app.panels.before_hands import BeforeHands
from markermend_app.panels.markers.badge import hint
from markermend_app.panels.own_ends import OwnEnds
from markermend_app.style import theme
from markermend_app.telling import told

Index = QModelIndex | QPersistentModelIndex


class HistoryPanel(QWidget):
    """Steps done, and below them those undone, in grey."""

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.model = _Steps(self)
        self.view = _View()
        self.view.setModel(self.model)
        self.view.setUniformItemSizes(True)
        OwnEnds(self.view)
        # What is longer than the panel is wide is cut in its middle, since frames end it, and told
        # whole in its tooltip.
        self.view.setItemDelegate(_Narrow(self.view))
        self.view.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.view.setAccessibleName(self.tr("History"))
        self.view.setToolTip(
            self.tr("Click a step to go there; it is undone and done again in order.")
        )
        self.view.clicked.connect(self._travel)
        self.view.activated.connect(self._travel)
        self._pages = QStackedWidget()
        self._pages.addWidget(hint(self.tr("What you do appears here; every step can be undone.")))
        self._pages.addWidget(self.view)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(self._pages)
        soon = Later(self._refresh, self)
        BeforeHands(self.view, soon.catch_up)
        document.history_changed.connect(soon.ask)
        theme.watcher.changed.connect(self.model.repaint)
        self._refresh()

    def _refresh(self) -> None:
        """Show the steps as they stand."""
        session = self._document.session
        done, undone = ((), ()) if session is None else session.steps
        self._pages.setCurrentIndex(1 if done or undone else 0)
        first = 1 if session is None else session.original.first_frame
        self.model.set_steps(done, tuple(reversed(undone)), first)
        here = self.model.index(len(done))
        self.view.setCurrentIndex(here)
        self.view.scrollTo(here)

    def _travel(self, index: QModelIndex) -> None:
        """Undo or redo up to a step."""
        self._document.travel(index.row())


class _View(QListView):
    """Steps, of which the present one stays in sight where it was."""

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Follow it when the panel is made lower."""
        here = self.currentIndex()
        seen = here.isValid() and 0 <= self.visualRect(here).top() < event.oldSize().height()
        super().resizeEvent(event)
        if seen:
            self.scrollTo(here)


class _Narrow(QStyledItemDelegate):
    """Rows no wider than the list."""

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """As high as any row."""
        return QSize(0, super().sizeHint(option, index).height())


class _Steps(QAbstractListModel):
    """One row for the take as it was opened, and one for each step."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._steps: tuple[Step, ...] = ()
        self._done, self._first_frame = 0, 1

    def set_steps(self, done: tuple[Step, ...], undone: tuple[Step, ...], first_frame: int) -> None:
        """Show other steps, those undone as redo would bring them back."""
        steps, before = (*done, *undone), self._steps
        # Steps never change, so that those which stay are the same objects.
        pairs = enumerate(zip(steps, before, strict=False))
        least = min(len(steps), len(before))
        first_row = 1 + next((i for i, (a, b) in pairs if a is not b), least)
        self._done, self._first_frame = len(done), first_frame
        if first_row <= len(before):
            self.beginRemoveRows(QModelIndex(), first_row, len(before))
            self._steps = before[: first_row - 1]
            self.endRemoveRows()
        if first_row <= len(steps):
            self.beginInsertRows(QModelIndex(), first_row, len(steps))
            self._steps = steps
            self.endInsertRows()
        self.repaint()

    def repaint(self) -> None:
        """Have the rows painted anew that are seen."""
        self.dataChanged.emit(self.index(0), self.index(len(self._steps)))

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Steps, and the take as opened."""
        return 0 if parent.isValid() else 1 + len(self._steps)

    def _text(self, row: int) -> str:
        """What a step is called, and the frames it is about as the file counts them."""
        if row == 0:
            return self.tr("As opened")
        step = self._steps[row - 1]
        about, text = stretch(step), told(step.label)
        if about is None:
            return text
        start, last = about[0] + self._first_frame, about[1] - 1 + self._first_frame
        if f"{start}–{last}" in text:
            return text
        return f"{text}, {start}" if start == last else f"{text}, {start}–{last}"

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Label, grey where undone, the present one heavier."""
        row = index.row()
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole):
            return self._text(row)
        if role == Qt.ItemDataRole.ForegroundRole and row > self._done:
            return theme.current().muted
        if role == Qt.ItemDataRole.FontRole:
            font = QFont()
            font.setPointSize(theme.BASE_PT)
            font.setItalic(row > self._done)
            font.setWeight(QFont.Weight.DemiBold if row == self._done else QFont.Weight.Normal)
            return font
        return None
