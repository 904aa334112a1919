"""How the take stands, marker by marker: what is missing, open, decided, mended and how well."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QPoint, Qt, QTimer
from PySide6.QtGui import QAction, QFontMetrics, QPainter, QShowEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QStackedWidget,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from markermend.artifact import Status
from markermend.review.priority import badness
from markermend.review.standing import Standing, standings
from markermend.take import is_unlabelled
from markermend_app.document import Document
from markermend_app.panels.markers.badge import hint, paint_counts
from markermend_app.panels.quality_model import (
    COUNTS,
    DECIDED,
    MARKER,
    OPEN,
    QualityModel,
    take_font,
    take_name,
)
from markermend_app.panels.sort_menu import sort_menu
from markermend_app.style import theme

Index = QModelIndex | QPersistentModelIndex
_SETTLED_MS = 60
_WIDTHS = (108, 126, 72, 70, 72, 98, 98, 84)
_ROW_PX, _PADDING = 26, 16


class QualityPanel(QWidget):
    """A table of the take and its markers.

    A click shows a marker in the plots, a double click or Return goes to its worst open artifact,
    the right button sorts.
    Unlabelled trajectories are listed where something was found on them.
    """

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._stale = False
        self.model = QualityModel(self)
        self.total = QualityModel(self)
        self._badges = _Badges(self)
        self.view = self._table(self.model)
        self.view.horizontalHeader().hide()
        # The take and the names of the columns stay in sight above the markers.
        self.head = self._table(self.total)
        self.head.setAccessibleName(self.tr("Quality of the whole take"))
        self.head.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.head.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.head.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        header = self.head.horizontalHeader()
        header.setHighlightSections(False)
        header.setStretchLastSection(True)
        header.setSortIndicatorShown(True)
        header.setSectionsClickable(True)
        header.setSortIndicator(OPEN, Qt.SortOrder.DescendingOrder)
        header.sortIndicatorChanged.connect(self._sort)
        header.sectionResized.connect(self._resize_column)
        self.view.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.view.customContextMenuRequested.connect(self._show_menu)
        self.view.horizontalHeader().setStretchLastSection(True)
        self.view.horizontalScrollBar().valueChanged.connect(
            self.head.horizontalScrollBar().setValue
        )
        self.head.setFixedHeight(header.sizeHint().height() + _ROW_PX + 2)
        for column, width in enumerate(_WIDTHS):
            # The words of other languages may be longer.
            self.head.setColumnWidth(column, max(width, header.sectionSizeHint(column)))
        named = QFontMetrics(take_font()).horizontalAdvance(take_name()) + _PADDING
        self.head.setColumnWidth(MARKER, max(named, self.head.columnWidth(MARKER)))
        table = QWidget()
        rows = QVBoxLayout(table)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(0)
        rows.addWidget(self.head)
        rows.addWidget(self.view, 1)
        self._pages = QStackedWidget()
        self._pages.addWidget(hint(self.tr("How an open take stands appears here.")))
        self._pages.addWidget(table)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(self._pages)

        self._covered = False
        # A decision changes samples, artifacts and history: it is counted once, after it is shown.
        self._settle = QTimer(self)
        self._settle.setSingleShot(True)
        self._settle.setInterval(_SETTLED_MS)
        self._settle.timeout.connect(self._count)
        self.view.clicked.connect(self._show_marker)
        self.view.activated.connect(self._go_to_worst)
        document.opened.connect(self._count)
        document.artifacts_changed.connect(self._settle.start)
        document.data_changed.connect(lambda _: self._settle.start())
        document.shown_changed.connect(self._follow_shown)
        theme.watcher.changed.connect(self.update)
        self._count()

    def _table(self, model: QualityModel) -> QTableView:
        """A table of standings."""
        view = QTableView()
        view.setModel(model)
        view.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        view.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        view.setShowGrid(False)
        view.setWordWrap(False)
        view.setTabKeyNavigation(False)
        view.verticalHeader().hide()
        view.verticalHeader().setDefaultSectionSize(_ROW_PX)
        for column in (OPEN, DECIDED):
            view.setItemDelegateForColumn(column, self._badges)
        return view

    def _resize_column(self, column: int, _: int, width: int) -> None:
        """Follow the head, but in the last column, which takes the room that each table has."""
        if column != DECIDED:
            self.view.setColumnWidth(column, width)

    def showEvent(self, event: QShowEvent) -> None:
        """Catch up with what was decided while another panel was seen."""
        super().showEvent(event)
        if self._stale and not self._covered:
            self._count()

    def set_seen(self, seen: bool) -> None:
        """Be told whether another tab covers it, of which Qt tells the dock alone."""
        self._covered = not seen
        if seen and self._stale:
            self._count()

    def _count(self) -> None:
        """Work out how the take stands, once somebody looks."""
        self._settle.stop()
        session = self._document.session
        self._pages.setCurrentIndex(0 if session is None else 1)
        name = self.tr("Quality, marker by marker")
        name = self.tr("Quality, joint by joint") if self._document.joints else name
        self.view.setAccessibleName(name)
        self._stale = self._covered or not self.isVisible()
        if session is None:
            self.total.set_standings(())
            self.model.set_standings(())
        elif not self._stale:
            self.total.say_joints(session.original.skeleton)
            self.total.whole = take_name() if session.region is None else self.tr("Region")
            found = standings(
                session.original, session.take, session.listed, session.notes, session.region
            )
            self.total.set_standings(found[:1])
            self.model.set_standings([s for s in found[1:] if _listed(s)])
            self._follow_shown()

    def _sort(self, column: int, order: Qt.SortOrder) -> None:
        """Order the markers by a column."""
        self.model.sort(column, order)
        self._follow_shown()

    def _show_menu(self, at: QPoint) -> None:
        """Offer to sort, which the head does at a click only."""
        menu = sort_menu(self.head.horizontalHeader(), self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        # By itself a menu shows its title nowhere, and names of columns alone say nothing.
        title = QAction(menu.title(), menu)
        title.setEnabled(False)
        menu.insertAction(menu.actions()[0], title)
        menu.popup(self.view.viewport().mapToGlobal(at))

    def _follow_shown(self) -> None:
        """Choose the foremost marker of the plots."""
        shown = self._document.shown
        row = self.model.row_of(shown[0]) if shown else None
        if row is None:
            self.view.clearSelection()
        else:
            self.view.selectRow(row)

    def _show_marker(self, index: QModelIndex) -> None:
        """Show a marker in the plots."""
        marker = self._marker(index)
        if self._document.shown != (marker,):
            self._document.show((marker,))

    def _go_to_worst(self, index: QModelIndex) -> None:
        """Put the worst open artifact of a marker under review."""
        session, marker = self._document.session, self._marker(index)
        if session is None:
            return
        self._show_marker(index)
        open_ = [a for a in session.listed_with(Status.PENDING) if a.concerns([marker])]
        if open_:
            take = session.take
            worst = max(open_, key=lambda a: badness(a, take.rate, take.frames))
            self._document.select(worst.id)

    def _marker(self, index: QModelIndex) -> str:
        """The marker of a row."""
        return self.model.rows[index.row()].marker


def _listed(standing: Standing) -> bool:
    """Whether there is something to say about a trajectory."""
    found = any(standing.open.values()) or any(standing.decided.values())
    return found or not is_unlabelled(standing.marker)


class _Badges(QStyledItemDelegate):
    """Paints counts as one badge a class."""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Background as ever, then badges."""
        self.initStyleOption(option, index)
        style = option.widget.style() if option.widget else QApplication.style()
        style.drawPrimitive(
            QStyle.PrimitiveElement.PE_PanelItemViewItem, option, painter, option.widget
        )
        decided = index.column() == DECIDED
        paint_counts(painter, option.rect, index.data(COUNTS), option.font, faint=decided)
