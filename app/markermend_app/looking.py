"""What the operator looks at: markers and channels in the plots, the cursor, the swept range."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal


@dataclass(frozen=True)
class Selection:
    """A range of frames on one marker that the operator has swept over."""

    marker: str
    start: int
    stop: int


class Looking(QObject):
    """What is seen of a take, which changes nothing in it.

    Signals
    -------
    shown_changed() : other markers are shown in the plots
    beside_changed() : other channels that are no markers are shown below the plots
    selection_changed() : the swept range changed
    frame_changed(int) : the cursor moved
    frame_requested(int, int) : bring these frames into view (start, stop)
    reveal_requested(int, int) : bring these into view unless they can be seen already

    Attributes
    ----------
    bringing : whether frames are about to be requested, so that none need be shown until then
    renaming : whether the take that is told to be open was before, under other names of its
        markers, so that what is seen of it stays
    """

    shown_changed = Signal()
    beside_changed = Signal()
    selection_changed = Signal()
    frame_changed = Signal(int)
    frame_requested = Signal(int, int)
    reveal_requested = Signal(int, int)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._frames = 0
        self.bringing = self.renaming = False
        self.shown: tuple[str, ...] = ()
        self.beside: tuple[str, ...] = ()
        self.frame = 0
        self.selection: Selection | None = None

    def show(self, markers: Iterable[str]) -> None:
        """Show these markers in the plots, the first one foremost."""
        shown = tuple(dict.fromkeys(markers))
        if shown != self.shown:
            self.shown = shown
            self.shown_changed.emit()

    def show_too(self, markers: Iterable[str]) -> None:
        """Show these markers foremost, with the others where the first one is shown already."""
        wanted = tuple(markers)
        self.show((*wanted, *self.shown) if wanted[0] in self.shown else wanted)

    def foremost_of(self, markers: Sequence[str]) -> str:
        """The one of these markers that is shown, else the first of them."""
        return next((m for m in self.shown if m in markers), markers[0])

    def look_at(self, markers: Iterable[str], start: int, stop: int) -> None:
        """Bring frames of these markers into view, and the cursor into their middle."""
        self._show_first(markers)
        # With its frames in view, the cursor need not bring itself into view first.
        self.frame_requested.emit(start, stop)
        self.go_to((start + stop) // 2)

    def reveal(self, markers: Iterable[str], start: int, stop: int) -> None:
        """Look at frames of these markers; a view in which they are seen well already stays."""
        self._show_first(markers)
        self.reveal_requested.emit(start, stop)
        self.go_inside(start, stop)

    def _show_first(self, markers: Iterable[str]) -> None:
        """Show these markers, whose frames are requested next."""
        self.bringing = True
        self.show_too(markers)
        self.bringing = False

    def go_inside(self, start: int, stop: int) -> None:
        """Move the cursor into the middle of these frames, unless it is among them."""
        if not start <= self.frame < stop:
            self.go_to((start + stop) // 2)

    def show_beside(self, keys: Iterable[str]) -> None:
        """Show these channels that are no markers below the plots; for context only."""
        beside = tuple(dict.fromkeys(keys))
        if beside != self.beside:
            self.beside = beside
            self.beside_changed.emit()

    def go_to(self, frame: int) -> None:
        """Move the cursor to a frame; clipped to the take."""
        frame = max(0, min(frame, self._frames - 1))
        if frame != self.frame:
            self.frame = frame
            self.frame_changed.emit(frame)

    def sweep(self, selection: Selection | None) -> None:
        """Select a range of frames on a marker, or nothing."""
        if selection != self.selection:
            self.selection = selection
            self.selection_changed.emit()

    def _look_at_nothing(self, frames: int) -> None:
        """Start over with a take of so many frames, and tell nobody yet."""
        self._frames, self.frame = frames, 0
        self.shown, self.beside, self.selection = (), (), None
