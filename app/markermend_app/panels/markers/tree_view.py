"""The view of the marker tree: what keys and clicks mean, which rows match, how counts look."""

from __future__ import annotations

from PySide6.QtCore import (
    QModelIndex,
    QPersistentModelIndex,
    QSize,
    QSortFilterProxyModel,
    Qt,
    Signal,
)
from PySide6.QtGui import QKeyEvent, QPainter
from PySide6.QtWidgets import (
    QApplication,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTreeView,
    QWidget,
)

from markermend_app.panels.markers.badge import paint_counts
from markermend_app.panels.markers.marker_model import NAME, NODE
from markermend_app.panels.markers.rows import Node

Index = QModelIndex | QPersistentModelIndex
_CHECKED = Qt.ItemDataRole.CheckStateRole


class TreeView(QTreeView):
    """A tree in which Return means a row's check mark: the space bar plays.

    What can be checked but not selected is checked by a click on its name as well.

    Signals
    -------
    returned(QModelIndex) : Return was pressed on a row, or the name of such a one was clicked
    """

    returned = Signal(QModelIndex)

    def __init__(self) -> None:
        super().__init__()
        self._was: object = None
        self.pressed.connect(self._note)
        self.clicked.connect(self._click_name)

    def _note(self, index: QModelIndex) -> None:
        """Remember the check mark: a click on it changes it by itself."""
        self._was = index.siblingAtColumn(NAME).data(_CHECKED)

    def _click_name(self, index: QModelIndex) -> None:
        """Tell of a click beside the check mark of what cannot be selected."""
        name = index.siblingAtColumn(NAME)
        selects = name.flags() & Qt.ItemFlag.ItemIsSelectable
        if not selects and self._was is not None and name.data(_CHECKED) == self._was:
            self.returned.emit(name)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Tell of Return."""
        index = self.currentIndex()
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and index.isValid():
            self.returned.emit(index)
        else:
            super().keyPressEvent(event)


class Filter(QSortFilterProxyModel):
    """Matches markers and groups; a group that matches keeps its markers."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setRecursiveFilteringEnabled(True)
        self.setAutoAcceptChildRows(True)
        self.setFilterCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)

    def lessThan(self, left: Index, right: Index) -> bool:
        """By open artifacts, then by share missing; the name decides ties."""
        a, b = (index.sibling(index.row(), NAME).data(NODE) for index in (left, right))
        worse, name = (_badness(a), _badness(b)), (a.label, b.label)
        return name[0] > name[1] if worse[0] == worse[1] else worse[0] < worse[1]


def _badness(node: Node) -> tuple[int, float]:
    """How much there is to do, and how much is missing."""
    return sum(node.counts.values()), node.missing or 0.0


class CountsDelegate(QStyledItemDelegate):
    """Paints counts as class badges; rows that hold others show those beneath while closed."""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Background as ever, then badges."""
        self.initStyleOption(option, index)
        style = option.widget.style() if option.widget else QApplication.style()
        style.drawPrimitive(
            QStyle.PrimitiveElement.PE_PanelItemViewItem, option, painter, option.widget
        )
        first = index.sibling(index.row(), NAME)
        view = option.widget
        holds = first.model().hasChildren(first)
        # A joint holds others, and may be damaged itself.
        opened = isinstance(view, QTreeView) and holds and view.isExpanded(first)
        node = first.data(NODE)
        counts = node.own if opened else node.counts
        paint_counts(painter, option.rect, counts, option.font, faint=holds and not opened)

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """As high as every row; the column's width is set apart, and this is asked often."""
        return QSize(0, 24)
