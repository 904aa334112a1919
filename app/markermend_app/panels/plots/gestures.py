"""What the mouse means in the plots: select, scrub, sweep, move edges, open a menu."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, Qt

from markermend.artifact import Artifact
from markermend_app.looking import Selection
from markermend_app.panels.plots.frame import PlotFrame
from markermend_app.panels.plots.menu import artifact_menu, plot_menu, sweep_menu
from markermend_app.panels.plots.range import snapped, whole_frames
from markermend_app.panels.plots.row import PlotRow
from markermend_app.panels.plots.rows_menu import fill_rows_menu
from markermend_app.panels.staying_menu import StayingMenu
from markermend_app.style import theme
from markermend_app.words import tr

if TYPE_CHECKING:
    from markermend_app.panels.plots.trajectories import TrajectoryPanel


SNAP_PX = 6.0
"""Nearer than this to an edge, a swept range or a dragged edge ends there."""
NEAR_PX = 8.0
"""A sweep that begins nearer than this to a curve is of that curve's marker."""


class Gestures:
    """Connects every row's gestures with the document and the panel's view."""

    def __init__(self, panel: TrajectoryPanel) -> None:
        self._panel = panel
        self._document = panel.document
        self._pressed: str | None = None

    def listen(self, row: PlotFrame) -> None:
        """Connect a plot's gestures."""
        row.view.time_wanted.connect(self._time_wanted)
        row.view.pressed.connect(lambda at: self._press(row, at))
        row.view.double_pressed.connect(self._double_press)
        row.view.menu_wanted.connect(lambda at, screen: self._menu(row, at, screen))
        row.view.scrubbed.connect(lambda x: self._document.go_to(round(x)))
        row.view.swept.connect(lambda *swept: self._sweep(row, *swept))
        if isinstance(row, PlotRow):
            row.edges.dragged.connect(lambda: self._drag_edges(row))
            row.edges.dropped.connect(lambda: self._drop_edges(row))

    def _time_wanted(self, start: float, stop: float) -> None:
        """Zoom or pan as asked."""
        self._panel.framing.fit_when_proposed = False
        self._panel.framing.set_view(start, stop)

    def _press(self, row: PlotFrame, at: QPointF) -> None:
        """Select the artifact that was clicked, or move the cursor."""
        self._pressed = _hit(row, at)
        current = self._document.current
        if self._pressed is not None and (current is None or current.id != self._pressed):
            self._document.select(self._pressed)
        else:
            self._document.go_to(round(row.view.frame_at(at)))

    def _double_press(self, at: QPointF) -> None:
        """Repair the artifact the first click selected; elsewhere, show everything."""
        current = self._document.current
        if self._pressed is None:
            self._panel.framing.fit_all()
        elif current is not None and current.id == self._pressed:
            self._document.decisions.repair_current()

    def _menu(self, row: PlotFrame, at: QPointF, screen: QPointF) -> None:
        """Open the menu that fits what lies there."""
        selection = self._document.selection
        frame = row.view.frame_at(at)
        hit = _hit(row, at)
        if selection is not None and selection.start - 0.5 <= frame < selection.stop - 0.5:
            menu = sweep_menu(
                self._document,
                self._panel.mark_requested.emit,
                self._panel.verb_requested.emit,
                self._panel,
            )
        elif hit is not None and self._document.session is not None:
            self._document.select(hit, frame=False)
            artifact = self._document.session.artifact(hit)
            menu = artifact_menu(
                self._document, artifact, self._panel.verb_requested.emit, self._panel
            )
        else:
            menu = plot_menu(self._panel.verb_requested.emit, self._document, self._panel)
            rows = StayingMenu(tr("Plots"), menu)
            rows.setIcon(theme.icon("curves"))
            fill_rows_menu(rows, self._panel)
            menu.addMenu(rows)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.popup(screen.toPoint())

    def _sweep(self, row: PlotFrame, begin: QPointF, stop: float, last: bool) -> None:
        """Follow a range being swept; when it is done, select it on the marker that is meant."""
        take, shown = self._panel.take, self._document.shown
        if take is None or not shown:
            return
        near = row.nearest(begin, shown, NEAR_PX) if isinstance(row, PlotRow) else None
        marker, start = near or shown[0], row.view.frame_at(begin)
        low, high = self._whole((marker,), min(start, stop), max(start, stop) + 1, take.frames)
        for each in self._panel.canvas.frames:
            each.show_sweep(low, high)
        if last:
            self._document.sweep(Selection(marker, low, high))

    def _drag_edges(self, source: PlotRow) -> None:
        """Let the other plots follow an edge that is dragged."""
        for row in self._panel.rows:
            if row is not source:
                row.edges.place(*source.edges.frames)

    def _drop_edges(self, row: PlotRow) -> None:
        """Give the current artifact the edges it was dragged to, at whole frames."""
        current, take = self._document.current, self._panel.take
        if current is None or take is None:
            return
        edges = row.edges.frames
        start, stop = self._whole(current.markers, *edges, take.frames, besides=current)
        if (start, stop) != (current.start, current.stop):
            self._document.decisions.change_current(start=start, stop=stop)
        self._panel.show_current()

    def _whole(
        self,
        markers: Sequence[str],
        start: float,
        stop: float,
        frames: int,
        besides: Artifact | None = None,
    ) -> tuple[int, int]:
        """Whole frames, at the edge of another artifact on the markers where it is near."""
        session = self._document.session
        edges = [
            edge
            for a in (() if session is None else session.artifacts)
            if a.concerns(markers) and a != besides
            for edge in (a.start, a.stop)
        ]
        view = self._panel.canvas.frames[0].view
        low, high = view.viewRange()[0]
        reach = SNAP_PX * (high - low) / max(1.0, view.width())
        return whole_frames(snapped(start, edges, reach), snapped(stop, edges, reach), frames)


def _hit(row: PlotFrame, at: QPointF) -> str | None:
    """Id of the artifact under a point; there are none beside the markers."""
    return row.intervals.hit(at) if isinstance(row, PlotRow) else None
