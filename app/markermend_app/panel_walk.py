"""From panel to panel by key: every open panel in turn, as they stand from left to right."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDockWidget, QWidget

from markermend_app.panels.tour_card import TourCard

if TYPE_CHECKING:
    from markermend_app.window import MainWindow


class PanelWalk:
    """Gives the keyboard to the next or previous panel, and back to the plots."""

    def __init__(self, window: MainWindow) -> None:
        self._window = window

    def next(self) -> None:
        """Go to the next panel."""
        self._step(1)

    def previous(self) -> None:
        """Go to the previous panel."""
        self._step(-1)

    def go(self, name: str) -> None:
        """Go to the panel of that name, open or not."""
        dock = self._window.docks[name]
        self._window.dock_layout.show(name)
        for panel, part in self._stops():
            if panel is dock:
                _give_keyboard(part)

    def home(self) -> None:
        """Give the keyboard back to the plots, for the review."""
        plots = self._window.trajectories
        # Qt would give it to whatever comes next while there are none yet.
        _give_keyboard(plots.canvas if plots.canvas.isVisible() else plots)

    def filter(self) -> None:
        """Give the keyboard to what narrows down the review queue, if it is there, or the tree."""
        name, line = "markers", self._window.tree.filter
        if _is_in(QApplication.focusWidget(), self._window.docks["queue"]):
            name, line = "queue", self._window.queue.filters.marker
        self._window.dock_layout.show(name)
        _give_keyboard(line)
        line.selectAll()

    def _stops(self) -> list[tuple[QWidget, QWidget]]:
        """Open panels, each with the part of it that takes the keys."""
        window, docks = self._window, self._window.docks
        panels: tuple[tuple[QWidget, QWidget | None], ...] = (
            (docks["markers"], window.tree.view),
            (docks["history"], window.history.view),
            (docks["takes"], window.takes.view),
            (window.welcome, window.welcome.first),
            (window.trajectories, window.trajectories.canvas),
            *((card, card.end) for card in window.findChildren(TourCard)),
            (window.overview, window.overview),
            (docks["queue"], window.queue.place),
            (docks["quality"], window.quality.view),
            (docks["scene"], window.scene),
            (docks["inspector"], window.inspector.place),
        )
        return [
            (panel, part)
            for panel, part in panels
            if part is not None and _is_open(panel) and part.isVisibleTo(panel)
        ]

    def _step(self, by: int) -> None:
        stops, focus = self._stops(), QApplication.focusWidget()
        here = next((i for i, (panel, _) in enumerate(stops) if _is_in(focus, panel)), None)
        # From a menu or the toolbar, the walk begins with the first or the last panel.
        at = (0 if by > 0 else -1) if here is None else (here + by) % len(stops)
        panel, part = stops[at]
        # One that another covers as a tab comes forward.
        panel.raise_()
        _give_keyboard(part)


def _give_keyboard(part: QWidget) -> None:
    """Let a part of a panel take the keys, also where its panel floats."""
    part.activateWindow()
    part.setFocus(Qt.FocusReason.ShortcutFocusReason)


def _is_open(panel: QWidget) -> bool:
    """Whether a panel was not closed; one that another covers as a tab is open."""
    return not panel.isHidden() if isinstance(panel, QDockWidget) else panel.isVisible()


def _is_in(widget: QWidget | None, panel: QWidget) -> bool:
    """Whether a widget is a panel or stands in it."""
    return widget is not None and (panel is widget or panel.isAncestorOf(widget))
