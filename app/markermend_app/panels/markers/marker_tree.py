"""The take's markers as a body: what is shown in the plots, and where the open artifacts are."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import (
    QItemSelection,
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    QPoint,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDockWidget,
    QHBoxLayout,
    QHeaderView,
    QMenu,
    QStackedWidget,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from markermend.review.edits import Change
from markermend.review.session import Session
from markermend_app.document import Document
from markermend_app.later import Later
from markermend_app.panels.markers.badge import counts_width, hint
from markermend_app.panels.markers.marker_menu import add_marker_verbs, point_at
from markermend_app.panels.markers.marker_model import (
    MISSING,
    NAME,
    OPEN,
    MarkerModel,
)
from markermend_app.panels.markers.rows import Node, flatten, grow
from markermend_app.panels.markers.tree_view import CountsDelegate, Filter, TreeView
from markermend_app.panels.nothing import Nothing
from markermend_app.panels.own_ends import OwnEnds
from markermend_app.panels.queue.filter_line import FilterLine
from markermend_app.style import theme

Index = QModelIndex | QPersistentModelIndex
_COUNTS_WIDEST = 92
_MISSING_WIDE, _NAMES_LEAST, _NAMES_WIDEST = 50, 140, 260


class MarkerTree(QWidget):
    """Markers in body hierarchy, or flat with the worst on top.

    A click shows a marker alone in the plots; a check mark, Ctrl or Shift shows it beside others.
    A check mark at what is no marker shows it in a row of its own below the plots. The right button
    offers what can be done to the marker. Return is a check mark by key, unless ``pick`` takes the
    marker for something else.

    Signals
    -------
    verb_requested(str) : name of the action to be done to the foremost marker
    """

    verb_requested = Signal(str)

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.setMinimumWidth(250)
        self._syncing = self._choosing = False
        self._names_wide = 0
        self._model = MarkerModel(document.show, document.show_beside, self)
        self._proxy = Filter(self)
        self._proxy.setSourceModel(self._model)

        self.pick: Callable[[str], bool] = lambda marker: False
        self.view = TreeView()
        OwnEnds(self.view)
        self.view.returned.connect(self._check)
        self.filter = FilterLine(self.tr("Filter markers"), self.view)
        self.filter.textChanged.connect(self._filter)
        self.filter.went_on.connect(self._go_to_found)
        self.worst_first = QToolButton()
        self.worst_first.setCheckable(True)
        self.worst_first.setAccessibleName(self.tr("Worst first"))
        self.worst_first.toggled.connect(self._rebuild)

        self.view.setModel(self._proxy)
        self._nothing = Nothing(self.view, self.tr("Nothing here is named so."))
        self.view.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.view.setUniformRowHeights(True)
        self.view.setIndentation(8)
        self.view.setIconSize(QSize(12, 12))
        # Markers of one segment often differ in their last letter only.
        self.view.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.view.setItemDelegateForColumn(OPEN, CountsDelegate(self.view))
        header = self.view.header()
        header.setStretchLastSection(False)
        header.setMinimumSectionSize(40)
        header.setSectionResizeMode(NAME, QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(OPEN, QHeaderView.ResizeMode.Interactive)
        header.setSectionResizeMode(MISSING, QHeaderView.ResizeMode.Fixed)
        header.resizeSection(MISSING, _MISSING_WIDE)
        self.view.selectionModel().selectionChanged.connect(self._selected)
        self.view.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.view.customContextMenuRequested.connect(self._show_menu)
        self.view.expanded.connect(self._span)
        self.view.collapsed.connect(self._span)

        top = QHBoxLayout()
        top.setContentsMargins(4, 4, 4, 0)
        top.setSpacing(4)
        top.addWidget(self.filter, 1)
        top.addWidget(self.worst_first)
        tree = QWidget()
        column = QVBoxLayout(tree)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        column.addLayout(top)
        column.addWidget(self.view, 1)
        self._pages = QStackedWidget()
        self._pages.addWidget(hint(self.tr("Open a take to see its markers here.")))
        self._pages.addWidget(tree)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(self._pages)

        self._anew = Later(self._rebuild, self)
        self._counted: Session | None = None
        self._asked = slice(0)
        document.opened.connect(self._start_over)
        document.mesh_changed.connect(self._anew.ask)
        self._changed: set[str] = set()
        self._following = False
        self._soon = Later(self._catch_up, self)
        document.artifacts_changed.connect(self._soon.ask)
        document.data_changed.connect(self._samples_changed)
        document.shown_changed.connect(self._shown_changed)
        document.beside_changed.connect(lambda: self._model.set_beside(document.beside))
        theme.watcher.changed.connect(self._recolour)
        self._recolour()
        self._rebuild()

    def _start_over(self) -> None:
        """Show another take whole; the same one, of which markers were renamed, as it was."""
        if self._document.renaming or self._document.session is None:
            self._anew.do()
            return
        self.filter.clear()
        # Until then nobody can ask for a marker of the take before.
        self._model.set_root(Node(""))
        self._anew.ask()

    def _rebuild(self) -> None:
        """Lay the rows out anew: another take, or another order."""
        session = self._document.session
        self._pages.setCurrentIndex(0 if session is None else 1)
        self._say(skeleton=session is not None and session.original.skeleton)
        if session is None:
            self._counted = None
            return
        root = grow(session.original, self._document.mesh)
        flat = self.worst_first.isChecked()
        self._syncing = True
        self._model.set_root(flatten(root) if flat else root)
        # Only this order depends on what changes during a review.
        self._proxy.setDynamicSortFilter(flat)
        order = Qt.SortOrder.DescendingOrder if flat else Qt.SortOrder.AscendingOrder
        self._proxy.sort(OPEN if flat else -1, order)
        self.view.setRootIsDecorated(not flat)
        self._expand()
        self._names_wide = self.view.sizeHintForColumn(NAME)
        self._syncing = False
        if session is not self._counted or self._changed:
            self._counted, self._asked = session, session.asked
            self._changed.clear()
            self._model.set_missing(session.take, session.original.labels, self._asked)
        self._count()
        self._follow_shown()

    def _say(self, *, skeleton: bool) -> None:
        """Name things: skeleton recordings have joints."""
        name = self.tr("Joints") if skeleton else self.tr("Markers")
        dock = self.parentWidget()
        if isinstance(dock, QDockWidget):
            dock.setWindowTitle(name)
        self.view.setAccessibleName(name)
        self._model.set_heading(self.tr("Joint") if skeleton else self.tr("Marker"))
        worst = self.tr("Worst first: a flat list, the markers with most open artifacts on top")
        if skeleton:
            worst = self.tr("Worst first: a flat list, the joints with most open artifacts on top")
        self.worst_first.setToolTip(worst)
        missing = self.tr("Share of the frames in which the joint is missing")
        self._model.set_missing_tip(missing if skeleton else "")
        self.filter.set_text(self.tr("Filter joints") if skeleton else self.tr("Filter markers"))

    def _expand(self) -> None:
        """Open the body, but not what merely stands beside it."""
        self.view.expandAll()
        self._span_all(QModelIndex())
        self._nothing.show(bool(self.filter.text().strip()) and not self._proxy.rowCount())
        if self.filter.text():
            return
        for row in range(self._proxy.rowCount()):
            index = self._proxy.index(row, NAME)
            node = self._model.node(self._proxy.mapToSource(index))
            if node.icon in ("unlabelled", "point", "curves"):
                self.view.collapse(index)

    def _span(self, index: QModelIndex) -> None:
        """Give a name the whole row where it has no counts, or they stand in rows beneath."""
        node = self._model.node(self._proxy.mapToSource(index))
        spanned = not node.label and (self.view.isExpanded(index) or not node.all_markers())
        self.view.setFirstColumnSpanned(index.row(), index.parent(), spanned)

    def _span_all(self, parent: QModelIndex) -> None:
        for row in range(self._proxy.rowCount(parent)):
            index = self._proxy.index(row, NAME, parent)
            self._span(index)
            self._span_all(index)

    def _count(self) -> None:
        """Bring counts of open artifacts up to date."""
        session = self._document.session
        if session is None:
            return
        self._model.set_counts(session.listed)
        self._fit_counts()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Share the width between names and counts."""
        super().resizeEvent(event)
        self._fit_counts()

    def _fit_counts(self) -> None:
        """Give the counts what they need, up to a third; names go before the share missing.

        Where nothing is missing the share says nothing.
        """
        session = self._document.session
        if session is None:
            return
        widest = max(54, counts_width(self._model.open_counts(), self.view.font()))
        header = self.view.header()
        width = min(widest, _COUNTS_WIDEST, max(54, self.width() // 3))
        if header.sectionSize(OPEN) != width:
            header.resizeSection(OPEN, width)
        names = (
            self.width() - self.view.verticalScrollBar().sizeHint().width() - width - _MISSING_WIDE
        )
        cut = names < max(_NAMES_LEAST, min(self._names_wide, _NAMES_WIDEST))
        header.setSectionHidden(MISSING, cut or not self._model.any_missing)

    def _samples_changed(self, change: Change) -> None:
        """Take note of markers whose missing share changed."""
        self._changed.update(change.markers)
        self._soon.ask()

    def _shown_changed(self) -> None:
        """Check other markers, and select them soon, unless they were selected here."""
        self._model.set_shown(self._document.shown)
        self._following = not self._syncing
        self._soon.ask()

    def _catch_up(self) -> None:
        """Bring up to date what changed; to lay the rows out anew does so, too."""
        session = self._document.session
        changed, self._changed = self._changed, set()
        if session is not None and (changed or session.asked != self._asked):
            every, elsewhere = session.original.labels, session.asked != self._asked
            self._asked = session.asked
            labels = every if elsewhere else [label for label in every if label in changed]
            self._model.set_missing(session.take, labels, self._asked)
        self._count()
        # Once: a decision about what is shown already must not scroll the tree back to it.
        following, self._following = self._following, False
        if following:
            self._follow_shown()

    def _filter(self, text: str) -> None:
        """Show matching rows, and those above them."""
        self._syncing = True
        self._proxy.setFilterFixedString(text.strip())
        self._expand()
        self._syncing = False
        self._follow_shown()

    def _go_to_found(self) -> None:
        """Choose the first marker found by its name, else by its group's, unless one is shown."""
        wanted = self.filter.text().strip().casefold()
        found: dict[str, QModelIndex] = {}
        index = self._proxy.index(0, NAME)
        while wanted and index.isValid():
            found[self._model.node(self._proxy.mapToSource(index)).label] = index
            index = self.view.indexBelow(index)
        found.pop("", None)
        named = [label for label in found if wanted in label.casefold()] or list(found)
        if named and not set(named) & set(self._document.shown[:1]):
            self.view.setCurrentIndex(found[named[0]])

    def _selected(self, _: QItemSelection, __: QItemSelection) -> None:
        """Show what was selected."""
        if self._syncing or self._choosing:
            return
        labels = self._labels(self.view.selectionModel().selectedRows())
        if labels:
            self._syncing = True
            self._document.show(labels)
            self._syncing = False

    def set_choosing(self, choosing: bool) -> None:
        """Be told whether markers are chosen to follow: the plots stay where they are meanwhile."""
        self._choosing = choosing
        if not choosing:
            self._follow_shown()

    def _show_menu(self, at: QPoint) -> None:
        """Offer what can be done to the marker under the pointer, or under the cursor by key."""
        index = self.view.indexAt(at)
        label = self._model.node(self._proxy.mapToSource(index)).label if index.isValid() else ""
        if not label:
            return
        point_at(self._document, label)
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        add_marker_verbs(menu, self._document, self.verb_requested.emit)
        menu.popup(self.view.viewport().mapToGlobal(at))

    def _check(self, index: QModelIndex) -> None:
        """Set or take the check mark of a row, or open a group that has none."""
        index = index.siblingAtColumn(NAME)
        label = self._model.node(self._proxy.mapToSource(index)).label
        if label and self.pick(label):
            return
        role = Qt.ItemDataRole.CheckStateRole
        checked = index.data(role)
        if checked is None:
            self.view.setExpanded(index, not self.view.isExpanded(index))
        else:
            on = Qt.CheckState(checked) == Qt.CheckState.Checked
            state = Qt.CheckState.Unchecked if on else Qt.CheckState.Checked
            self._proxy.setData(index, state, role)

    def _labels(self, rows: Sequence[QModelIndex]) -> list[str]:
        """Markers of selected rows that are listed, the one clicked last foremost."""
        current = self.view.currentIndex()
        rows = sorted(rows, key=lambda i: i != current.siblingAtColumn(NAME))
        nodes = [self._model.node(self._proxy.mapToSource(i)) for i in rows]
        labels = dict.fromkeys(m.label for n in nodes for m in n.markers())
        listed = self._proxy.mapFromSource
        return [label for label in labels if listed(self._model.index_of(label)).isValid()]

    def _follow_shown(self) -> None:
        """Check and select what is shown, unless it was selected here."""
        shown = self._document.shown
        self._model.set_shown(shown)
        if self._syncing:
            return
        picked = QItemSelection()
        first = last = QModelIndex()
        for label in shown:
            index = self._proxy.mapFromSource(self._model.index_of(label))
            if index.isValid():
                picked.select(index, index.siblingAtColumn(MISSING))
                first, last = (first if first.isValid() else index), index
        self._syncing = True
        flag = QItemSelectionModel.SelectionFlag
        self.view.selectionModel().select(picked, flag.ClearAndSelect)
        if first.isValid():
            self.view.selectionModel().setCurrentIndex(first, flag.NoUpdate)
            self.view.scrollTo(last)
            self.view.scrollTo(first)
        self._syncing = False

    def _recolour(self) -> None:
        self.worst_first.setIcon(theme.icon("sort"))
        self._model.recolour()
