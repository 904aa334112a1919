"""Side panels get their width back when a window that was made small is made large again.

Also where it was made small before the last start, or started so.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QDockWidget, QMainWindow

from markermend_app import settings

_Widths = tuple[int, list[int]]
"""Of a window, and of its sides then."""
_KEPT = "side_widths"
_ROUNDED = 2
"""Pixels that a share may be off."""


class SideWidths(QObject):
    """Of a window that grows Qt widens the middle only, and leaves the sides as narrow as they are.

    Of one that shrinks it leaves them as wide as it can, so that nothing is left for the middle.

    Parameters
    ----------
    window : whose size is followed
    sides : panels, one of each side
    roomy : how wide the window and its sides are where there is room
    """

    def __init__(
        self, window: QMainWindow, sides: Sequence[QDockWidget], roomy: tuple[int, list[int]]
    ) -> None:
        super().__init__(window)
        self._window, self._sides = window, sides
        before = _kept(len(sides)) or roomy
        self._before: _Widths | None = before if window.width() < before[0] else None
        self._shared = window.width()
        self._settled: _Widths = 0, []
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._widen)
        self._less = QTimer(self, singleShot=True, interval=0)
        self._less.timeout.connect(self._narrow)
        self._note = QTimer(self, singleShot=True, interval=0)
        self._note.timeout.connect(self._remember)
        for watched in (window, *sides):
            watched.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Remember the widths before the window shrinks; use them once it is as wide again."""
        if isinstance(event, QResizeEvent) and watched is self._window:
            old, new = event.oldSize().width(), event.size().width()
            if self._before is None and 0 < new < old:
                # By now the sides may be narrower already.
                known = self._settled[0] == old
                now = [side.width() for side in self._sides]
                self._before = self._settled if known else (old, now)
                _keep(self._before)
            elif self._before is not None and new > old:
                self._soon.start()
            if 0 < new < old:
                self._less.start()
        if isinstance(event, QResizeEvent) and self._before is None:
            self._note.start()
        return super().eventFilter(watched, event)

    def _remember(self) -> None:
        """Keep the widths as they are once all has its place."""
        if self._before is None:
            self._settled = self._window.width(), [side.width() for side in self._sides]

    def _narrow(self) -> None:
        """Leave the sides no more than their share of a window that shrank."""
        if self._before is not None:
            self._shared = self._window.width()
            self._give(_shares(self._before, self._shared), lambda now, wanted: now > wanted)

    def _widen(self) -> None:
        """Give the sides what they had, where they have less; wider ones were drawn wider since."""
        if self._before is None:
            return
        if self._window.width() < self._before[0]:
            self._widen_some(self._before)
            return
        (_, widths), self._before = self._before, None
        _keep(None)
        self._note.start()
        self._give(widths, lambda now, wanted: now < wanted)

    def _widen_some(self, before: _Widths) -> None:
        """Give the sides their share of a window that is still narrower than it was.

        Those that a hand has drawn narrower than the share they had stay.
        """
        shared, self._shared = self._shared, self._window.width()
        wanted = [
            share if side.width() >= had - _ROUNDED else side.width()
            for side, had, share in zip(
                self._sides, _shares(before, shared), _shares(before, self._shared), strict=True
            )
        ]
        self._give(wanted, lambda now, wanted: now < wanted)

    def _give(self, widths: Sequence[int], where: Callable[[int, int], bool]) -> None:
        """Give the sides these widths where that of now compares so with the one wanted."""
        docked = [
            (side, width)
            for side, width in zip(self._sides, widths, strict=True)
            if side.isVisible() and not side.isFloating() and where(side.width(), width)
        ]
        if docked:
            sides, wanted = zip(*docked, strict=True)
            self._window.resizeDocks(list(sides), list(wanted), Qt.Orientation.Horizontal)


def _shares(before: _Widths, width: int) -> list[int]:
    """Widths of the sides in proportion, of a window of another width."""
    whole, widths = before
    return [round(wide * width / whole) for wide in widths]


def _keep(widths: _Widths | None) -> None:
    """Remember the widths for the next start, or forget them."""
    told = None if widths is None else " ".join(map(str, (widths[0], *widths[1])))
    settings.remember(_KEPT, told)


def _kept(sides: int) -> _Widths | None:
    """The widths remembered of so many sides, or None."""
    words = settings.text(_KEPT, "").split()
    if len(words) != 1 + sides or not all(word.isdecimal() for word in words):
        return None
    window, *widths = map(int, words)
    return window, widths
