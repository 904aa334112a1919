"""The menu of takes opened lately."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QMenu

from markermend_app import settings
from markermend_app.words import literal, tr


def fill_when_shown(menu: QMenu, open_path: Callable[[Path], None]) -> None:
    """List the recent takes in a menu, afresh each time it is opened."""

    def fill() -> None:
        menu.clear()
        for path in settings.recent():
            action = menu.addAction(literal(f"{path.name}   –   {path.parent}"))
            action.triggered.connect(lambda _=False, p=path: open_path(p))
        if menu.isEmpty():
            menu.addAction(tr("None yet")).setEnabled(False)

    menu.aboutToShow.connect(fill)
