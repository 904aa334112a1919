"""What can be done to a whole trajectory, wherever it is pointed at."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtWidgets import QMenu

from markermend_app.actions.menus import entry
from markermend_app.document import Document


def add_marker_verbs(menu: QMenu, document: Document, do: Callable[[str], None]) -> None:
    """Put what can be done to the foremost marker into a menu, below its name."""
    if not document.shown:
        return
    # A styled menu does not draw the text of sections.
    menu.addAction(document.shown[0]).setEnabled(False)
    menu.addSeparator()
    for name in ("rename_marker", "merge_marker", "smooth"):
        entry(menu, name, partial(do, name)).setEnabled(document.editable)
