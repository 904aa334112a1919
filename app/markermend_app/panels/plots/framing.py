"""Which frames the plots show, and when the values in view are chosen anew."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from markermend_app.panels.plots.range import surrounded, time_range, well_seen

if TYPE_CHECKING:
    from markermend_app.panels.plots.trajectories import TrajectoryPanel


class Framing(QObject):
    """Follows hands, the cursor and what is under review through time.

    Attributes
    ----------
    view : frames from the left edge of the plots to the right one
    fit_when_proposed : whether values are chosen anew once there is a proposal
    """

    def __init__(self, panel: TrajectoryPanel) -> None:
        super().__init__(panel)
        self._panel = panel
        self._document = panel.document
        self.view = (0.0, 1.0)
        self.fit_when_proposed = False
        self._unframed = False

    def fit_all(self) -> None:
        """Show the whole take."""
        if (take := self._panel.take) is not None:
            self._show_afresh(-0.5, take.frames - 0.5)

    def zoom(self, factor: float) -> None:
        """Show ``factor`` times as much time, around the cursor when it is in view."""
        low, high = self.view
        at = float(self._document.frame)
        if not low <= at <= high:
            at = (low + high) / 2
        self.set_view(at - (at - low) * factor, at + (high - at) * factor)

    def set_view(self, start: float, stop: float) -> None:
        """Show these frames in all plots, as far as the take reaches."""
        take, panel = self._panel.take, self._panel
        if take is None:
            return
        self.view = time_range(start, stop, take.frames)
        for row in panel.rows:
            row.set_view(*self.view, self._document.current)
        for beside in panel.canvas.beside:
            beside.set_view(*self.view)
        panel.place_buttons()
        panel.view_changed.emit(*self.view)

    def follow_cursor(self, frame: int) -> None:
        """Go along with a cursor that leaves the view."""
        low, high = self.view
        if not low <= frame <= high:
            span = high - low
            # Going on, most of what is ahead comes into view; a jump lands in the middle.
            share = 0.1 if high < frame < high + span else 0.5
            self.set_view(frame - share * span, frame + (1 - share) * span)

    def follow_markers(self) -> None:
        """Choose the values of other markers, unless their frames are requested next."""
        self._unframed = self._document.bringing
        if not self._unframed:
            self._show_afresh(*self.view)

    def follow_proposal(self) -> None:
        """Make room for a proposal that was waited for."""
        if self.fit_when_proposed:
            self.fit_when_proposed = False
            self._show_afresh(*self.view)

    def frame(self, start: int, stop: int) -> None:
        """Bring an interval into view with some of its surroundings."""
        take = self._panel.take
        if take is None:
            return
        self._panel.catch_up()
        self.fit_when_proposed = False
        self._panel.show_proposal()
        self.fit_when_proposed = self._document.proposal is None
        self._show_afresh(*surrounded(start, stop, take.rate))

    def reveal(self, start: int, stop: int) -> None:
        """Bring an interval into view unless it can be seen well where the plots are."""
        take = self._panel.take
        if take is not None and not well_seen(start, stop, take.rate, self.view):
            self.frame(start, stop)
        elif self._unframed:
            self._show_afresh(*self.view)
        else:
            # Values that are others than before may be out of view.
            self._panel.catch_up()
            self.set_view(*self.view)

    def _show_afresh(self, start: float, stop: float) -> None:
        """Show these frames, and of their values what matters, wherever hands had put them."""
        self._unframed = False
        for row in self._panel.canvas.frames:
            row.follows = True
        self.set_view(start, stop)
