"""What can be done to a whole trajectory, wherever it is pointed at."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtWidgets import QMenu

from markermend_app.actions.menus import entry
from markermend_app.document import Document
from markermend_app.words import literal, tr


def point_at(document: Document, marker: str) -> None:
    """Show the marker that a menu is opened on foremost.

    Where a range of another one is swept, that one stays beside it: they may have to be exchanged.
    """
    swept = document.selection
    if swept is not None and swept.marker != marker:
        document.show((marker, swept.marker))
    else:
        document.show_too([marker])


def add_marker_verbs(menu: QMenu, document: Document, do: Callable[[str], None]) -> None:
    """Put what can be done to the foremost marker into a menu, below its name."""
    if not document.shown:
        return
    # A styled menu does not draw the text of sections.
    menu.addAction(literal(document.shown[0])).setEnabled(False)
    menu.addSeparator()
    for name in ("rename_marker", "merge_marker", "smooth"):
        entry(menu, name, partial(do, name), joints=document.joints).setEnabled(document.editable)
    swept = document.selection
    if swept is not None and swept.marker != document.shown[0]:
        menu.addSeparator()
        text = tr("Selection on {marker}").format(marker=swept.marker)
        menu.addAction(literal(text)).setEnabled(False)
        for name in ("swap_selection", "move_selection"):
            entry(menu, name, partial(do, name), joints=document.joints).setEnabled(
                document.editable
            )
