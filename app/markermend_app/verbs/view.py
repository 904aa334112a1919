"""What actions do that are about what is seen, not about the review."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QApplication

from markermend.artifact import Kind
from markermend_app import settings
from markermend_app.actions import palette, shortcuts
from markermend_app.actions.elsewhere import elsewhere
from markermend_app.actions.shortcut_sheet import ShortcutSheet
from markermend_app.actions.table import METHOD_KEYS
from markermend_app.dialogs import ask as dialogs
from markermend_app.document import Document
from markermend_app.panels.tour_card import TourCard
from markermend_app.style import theme

if TYPE_CHECKING:
    from markermend_app.window import MainWindow

THEMES = ("light", "dark", "contrast", "system")


def view_verbs(window: MainWindow) -> dict[str, Callable[[], object]]:
    """Verbs by the names of their actions."""
    document, hand, plots = window.document, window.hand, window.trajectories
    transport = window.transport

    def checked(name: str) -> bool:
        return window.actions_by_name[name].isChecked()

    return {
        "play": transport.toggle_play,
        "frame_forward": lambda: transport.step(1),
        "frame_back": lambda: transport.step(-1),
        "frames_forward": lambda: transport.step(10),
        "frames_back": lambda: transport.step(-10),
        "to_start": lambda: document.go_to(0),
        "to_end": lambda: document.go_to(1 << 40),
        "note": lambda: _write_note(window),
        "clear_selection": lambda: _let_go(window),
        "compare": lambda: window.comparison.start(shortcuts.table()["compare"]),
        "choose_references": lambda: window.references.choose(checked("choose_references")),
        "start_earlier": lambda: hand.nudge(-1, 0),
        "start_later": lambda: hand.nudge(1, 0),
        "end_earlier": lambda: hand.nudge(0, -1),
        "end_later": lambda: hand.nudge(0, 1),
        **{f"class_{kind}": partial(hand.call, kind) for kind in Kind},
        "fit": plots.framing.fit_all,
        "zoom_in": lambda: plots.framing.zoom(0.5),
        "zoom_out": lambda: plots.framing.zoom(2.0),
        "before_after": lambda: _show_before(window, checked("before_after")),
        "prediction": lambda: plots.set_prediction_shown(checked("prediction")),
        "overview_mode": window.overview.mode.choose_next,
        "plots": plots.open_menu,
        "next_panel": window.walk.next,
        "previous_panel": window.walk.previous,
        **{f"theme_{name}": partial(_set_theme, name) for name in THEMES},
        "detect_on_open": lambda: settings.remember("detect_on_open", checked("detect_on_open")),
        "reset_layout": window.dock_layout.reset,
        "manual": lambda: _show_manual(window),
        "tour": lambda: _show_tour(window),
        "preferences": lambda: window.preferred.open(),
        "shortcuts": lambda: ShortcutSheet(window).exec(),
        "palette": lambda: _open_palette(window),
        "filter": window.walk.filter,
        **{f"method_{key}": partial(_choose_method, document, key) for key in METHOD_KEYS},
        "about": lambda: dialogs.show_about(window),
    }


def wear(name: str) -> None:
    """Give the whole application a theme."""
    app = QApplication.instance()
    if isinstance(app, QApplication):
        theme.apply(app, name)


def _set_theme(name: str) -> None:
    """Wear a theme from now on."""
    settings.remember("theme", name)
    wear(name)


def _write_note(window: MainWindow) -> None:
    """Put the cursor where a note is written."""
    window.dock_layout.show("inspector")
    window.inspector.write_note()


def _let_go(window: MainWindow) -> None:
    """Leave what was begun, what lies on top first; then the panel for the plots; then the tour."""
    if window.overview.let_go():
        return
    if window.references.choosing:
        window.references.choose(False)
    elif window.scene.buttons.tool:
        window.scene.drop_tool()
    elif window.document.selection is not None:
        window.document.sweep(None)
    elif window.trajectories.canvas.hasFocus():
        for card in window.findChildren(TourCard):
            card.end.click()
    else:
        window.walk.home()


def _open_palette(window: MainWindow) -> None:
    """Find an action, marker or artifact, or what a panel can show, by a few letters."""
    found = palette.entries(window.actions_by_name, window.document)
    joints = window.document.joints
    palette.Palette(list(found), window, more=partial(elsewhere, window), joints=joints).open()


def _choose_method(document: Document, key: int) -> None:
    """Preview the repair method with that number key."""
    if document.current is None:
        return
    from markermend.repairs import REPAIRS

    for method in REPAIRS.values():
        if method.key == key:
            document.choose_method(method.name)


def _show_before(window: MainWindow, before: bool) -> None:
    """Show the samples before repair, in the plots and in space."""
    window.trajectories.set_before_after(before)
    window.scene.set_before(before)


def _show_manual(window: MainWindow) -> None:
    """Open the manual at the page about the panel that has the focus."""
    from markermend_app.dialogs.manual import Manual, page_about

    page = page_about(QApplication.focusWidget())
    manual = window.findChild(Manual) or Manual(window)
    # Only what is laid out can be scrolled to a heading.
    manual.show()
    manual.show_page(page)
    manual.raise_()
    manual.activateWindow()


def _show_tour(window: MainWindow) -> None:
    """Show the window around, from the first step on."""
    from markermend_app.tour import Tour

    (window.findChild(Tour) or Tour(window)).start()
