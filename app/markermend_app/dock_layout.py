"""Where the panels stand around the plots, and how large: at first, and kept between starts."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QByteArray, QSize, Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QSplitter, QTabBar

from markermend_app import settings
from markermend_app.panels.side_widths import SideWidths

LAYOUT_VERSION = 2
ROOMY, SIDES = QSize(1500, 940), (310, 400)
PLOTS, OVERVIEW = 620, 120
TAKES_HIGH = 330
_MIDDLE = "middle"
_H, _V = Qt.Orientation.Horizontal, Qt.Orientation.Vertical


class DockLayout:
    """Tabs, proportions and corners of a window's docks.

    Parameters
    ----------
    window : has the docks in their areas already
    docks : by name
    middle : the plots and the overview below
    """

    def __init__(
        self, window: QMainWindow, docks: Mapping[str, QDockWidget], middle: QSplitter
    ) -> None:
        self._window, self._docks, self._middle = window, docks, middle
        window.tabifyDockWidget(docks["queue"], docks["quality"])
        docks["queue"].raise_()
        # Beside the history, and only where there is more than one take.
        # Hidden first: the tabs of docks that are hidden later can stay behind on the screen.
        docks["takes"].hide()
        window.tabifyDockWidget(docks["history"], docks["takes"])
        left, right = Qt.DockWidgetArea.LeftDockWidgetArea, Qt.DockWidgetArea.RightDockWidgetArea
        window.setCorner(Qt.Corner.BottomLeftCorner, left)
        window.setCorner(Qt.Corner.BottomRightCorner, right)
        self._give_heights()

    @property
    def _sides(self) -> list[QDockWidget]:
        """A panel of each side."""
        return [self._docks["markers"], self._docks["scene"]]

    def start(self) -> None:
        """Lay all out as it was left last, once the window has its bars."""
        window = self._window
        self.take_size(ROOMY.boundedTo(window.screen().availableSize() * 0.94))
        self._default_state = window.saveState(LAYOUT_VERSION)
        geometry, state = settings.layout("geometry"), settings.layout("state")
        if isinstance(geometry, QByteArray):
            window.restoreGeometry(geometry)
        if isinstance(state, QByteArray):
            self._place(state)
        middle = settings.layout(_MIDDLE)
        if middle is not None:
            self._middle.restoreState(middle)
        SideWidths(window, self._sides, (ROOMY.width(), list(SIDES)))

    def take_size(self, size: QSize) -> None:
        """Give the window a size, with the panels beside the plots in proportion."""
        self._window.resize(size)
        self._give_widths()

    def show(self, name: str) -> None:
        """Bring a panel into sight."""
        self._docks[name].show()
        self._docks[name].raise_()

    def show_takes(self) -> None:
        """Show the list of takes, with room for some of them."""
        takes = self._docks["takes"]
        self.show("takes")
        if takes.height() < TAKES_HIGH:
            self._window.resizeDocks([takes], [TAKES_HIGH], _V)

    def reset(self) -> None:
        """Put the panels where they were at first."""
        self._place(self._default_state)
        # That knows pixels of a window that was not laid out yet, perhaps of another size.
        self._give_widths()
        self._give_heights()

    def remember(self) -> None:
        """Keep the layout for the next start."""
        # That opens one take, and has no list of them.
        self._docks["takes"].hide()
        settings.remember("geometry", self._window.saveGeometry())
        settings.remember("state", self._window.saveState(LAYOUT_VERSION))
        settings.remember(_MIDDLE, self._middle.saveState())

    def _give_widths(self) -> None:
        """Put the panels beside the plots in proportion."""
        share = min(self._window.width() / ROOMY.width(), 1.0)
        self._window.resizeDocks(self._sides, [round(wide * share) for wide in SIDES], _H)

    def _give_heights(self) -> None:
        """Put what stands in one column in proportion."""
        docks = self._docks
        self._middle.setSizes([PLOTS, OVERVIEW])
        self._window.resizeDocks([docks["markers"], docks["history"]], [640, 200], _V)
        self._window.resizeDocks([docks["scene"], docks["inspector"]], [380, 480], _V)
        self._window.resizeDocks([docks["queue"]], [230], _V)

    def _place(self, state: QByteArray) -> None:
        """Put the panels where they were; Qt makes new tabs then, and leaves the old ones lying."""
        direct = Qt.FindChildOption.FindDirectChildrenOnly
        old = self._window.findChildren(QTabBar, options=direct)
        if self._window.restoreState(state, LAYOUT_VERSION):
            for tabs in old:
                tabs.hide()
