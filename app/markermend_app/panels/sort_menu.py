"""Sorting a list without a click on its head: a menu of its columns."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHeaderView, QMenu, QWidget

from markermend_app.words import tr


def sort_menu(head: QHeaderView, parent: QWidget) -> QMenu:
    """Make a menu that sorts by a column as a click on its head does: once more turns it round.

    Columns that have no room in the list are offered as well.

    Parameters
    ----------
    head : of the list, with a sort indicator
    parent : what the menu belongs to
    """
    menu = QMenu(tr("Sort by"), parent)
    for column in range(head.count()):
        text = head.model().headerData(column, Qt.Orientation.Horizontal)
        action = menu.addAction(str(text), partial(_sort, head, column))
        action.setCheckable(True)
        action.setChecked(column == head.sortIndicatorSection())
    return menu


def _sort(head: QHeaderView, column: int) -> None:
    """Sort by a column, or the other way round where that is so already."""
    ascending, descending = Qt.SortOrder.AscendingOrder, Qt.SortOrder.DescendingOrder
    again = column == head.sortIndicatorSection() and head.sortIndicatorOrder() == ascending
    head.setSortIndicator(column, descending if again else ascending)
