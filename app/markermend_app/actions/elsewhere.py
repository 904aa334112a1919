"""What the palette finds beside actions, markers and artifacts: all that stands in the panels."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QMenu

from markermend_app import settings
from markermend_app.actions.palette import Entry
from markermend_app.document import Document
from markermend_app.offered import is_offered
from markermend_app.style import theme
from markermend_app.words import tr

if TYPE_CHECKING:
    from markermend_app.window import MainWindow


def elsewhere(window: MainWindow) -> Iterator[Entry]:
    """Panels, what the plots and the 3D view can show, methods, and the takes opened lately."""
    blank = theme.blank_icon()
    view, panels = tr("View"), tr("Panels")
    for name, dock in window.docks.items():
        text = f"{view}: {panels}: {dock.windowTitle()}"
        yield Entry(text, "", blank, True, partial(window.walk.go, name), "dock window show")
    if window.document.session is not None:
        yield from _entries(window.trajectories.menu, tr("Plots"))
        buttons, space = window.scene.buttons, window.docks["scene"].windowTitle()
        for button in (buttons.fit, buttons.follow, buttons.trails, buttons.labels):
            words = f"{space}: {button.accessibleName()}"
            yield Entry(words, "", button.icon(), True, button.click)
        yield from _entries(buttons.menu, space)
    yield from _methods(window.document)
    for path in settings.recent():
        open_it = partial(window.commands.open_path, path)
        yield Entry(path.name, tr("recent take"), theme.icon("open"), True, open_it, str(path))


def _methods(document: Document) -> Iterator[Entry]:
    """Repair methods without a key, once an artifact is looked at: repairs load late."""
    if document.current is None:
        return
    from markermend.repairs import REPAIRS

    path = f"{tr('Review')}: {tr('Repair method')}"
    for method in REPAIRS.values():
        if method.key is None:
            choose = partial(document.choose_method, method.name)
            text, summary = f"{path}: {tr(method.label)}", tr(method.summary)
            usable = is_offered(document, method.name)
            yield Entry(text, "", theme.icon("method"), usable, choose, summary)


def _entries(menu: QMenu, path: str) -> Iterator[Entry]:
    """What a menu holds that is filled when it is shown, and the menus below it."""
    menu.aboutToShow.emit()
    yield from _leaves(menu, path)


def _leaves(menu: QMenu, path: str) -> Iterator[Entry]:
    """Everything in a menu and below it that does something."""
    blank = theme.blank_icon()
    for action in menu.actions():
        name, _, keys = action.text().partition("\t")
        text, below = f"{path}: {name}", action.menu()
        if isinstance(below, QMenu):
            yield from _leaves(below, text)
        elif not action.isSeparator():
            shown, words = tr("shown") if action.isChecked() else keys, action.property("words")
            yield Entry(text, shown, blank, action.isEnabled(), action.trigger, words or "")
