"""The trajectories of the shown markers: X, Y and Z over time, with everything said about them."""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QStackedLayout, QVBoxLayout, QWidget

from markermend.edits import Change
from markermend.take import AXES, Take
from markermend_app import theme
from markermend_app.document import Document, Selection
from markermend_app.panels.artifact_text import describe
from markermend_app.panels.empty_state import EmptyState
from markermend_app.panels.floating_buttons import FloatingButtons
from markermend_app.panels.plot_header import PlotHeader
from markermend_app.panels.plot_menu import artifact_menu, plot_menu, sweep_menu
from markermend_app.panels.plot_prediction import Predictions
from markermend_app.panels.plot_range import time_range, whole_frames
from markermend_app.panels.plot_row import TIME_HEIGHT, PlotRow

_SPACING = 6


class TrajectoryPanel(QWidget):
    """Three stacked plots that share one time axis.

    Signals
    -------
    view_changed(float, float) : the frames in view
    mark_requested(Kind) : the swept range is to become an artifact of this class
    repair_selection_requested() : what lies in the swept range is to be repaired
    """

    view_changed = Signal(float, float)
    mark_requested = Signal(object)
    repair_selection_requested = Signal()

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.document = document
        self._predicting = False
        self._pressed: str | None = None
        self._fit_when_proposed = False
        self._view = (0.0, 1.0)
        self.setAccessibleName(self.tr("Trajectories"))

        self.header = PlotHeader()
        self.canvas = pg.GraphicsLayoutWidget()
        self.canvas.setAccessibleName(self.tr("Plots of the shown markers"))
        self.canvas.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.canvas.ci.layout.setSpacing(_SPACING)
        self.canvas.ci.layout.setContentsMargins(0, 4, 12, 4)
        self.rows = tuple(PlotRow(axis, axis == AXES[-1]) for axis in AXES)
        self.empty = EmptyState("curves")
        self.buttons = FloatingButtons(document, self.canvas)
        self.predictions = Predictions(self)

        plots = QWidget()
        column = QVBoxLayout(plots)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.header)
        column.addWidget(self.canvas, 1)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self.empty)
        self._stack.addWidget(plots)

        for i, row in enumerate(self.rows):
            self.canvas.addItem(row.plot, row=i, col=0)
            self._listen(row)
        self.canvas.sigDeviceRangeChanged.connect(self._share_height)
        self.canvas.scene().sigMouseMoved.connect(self._read_out)
        self.header.chosen.connect(self._bring_forward)
        self.predictions.changed.connect(self._show_predictions)
        document.opened.connect(self._opened)
        document.shown_changed.connect(self._show_markers)
        document.data_changed.connect(self._refresh)
        document.artifacts_changed.connect(self._show_artifacts)
        document.current_changed.connect(self._show_current)
        document.proposal_changed.connect(self._show_proposal)
        document.selection_changed.connect(self._show_sweep)
        document.frame_changed.connect(self._show_frame)
        document.frame_requested.connect(self._frame)
        theme.watcher.changed.connect(self._restyle)
        self._restyle()
        self._opened()
        self._show_markers()

    # Public verbs

    def fit_all(self) -> None:
        """Show the whole take."""
        if self._take is not None:
            self._show_afresh(-0.5, self._take.frames - 0.5)

    def zoom(self, factor: float) -> None:
        """Show ``factor`` times as much time, around the cursor when it is in view."""
        low, high = self._view
        at = float(self.document.frame)
        if not low <= at <= high:
            at = (low + high) / 2
        self.set_view(at - (at - low) * factor, at + (high - at) * factor)

    def set_view(self, start: float, stop: float) -> None:
        """Show these frames in all plots, as far as the take reaches."""
        take = self._take
        if take is None:
            return
        self._view = time_range(start, stop, take.frames)
        current = self.document.current
        for row in self.rows:
            row.set_view(*self._view, current)
        self._place_buttons()
        self.view_changed.emit(*self._view)

    def set_prediction_shown(self, shown: bool) -> None:
        """Draw where the rest of the body says the markers are, or not."""
        self._predicting = shown
        self._show_predictions()

    def set_before_after(self, before: bool) -> None:
        """Bring the source's samples forward, or the working ones."""
        for row in self.rows:
            row.set_before(before)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Esc forgets the swept range."""
        if event.key() == Qt.Key.Key_Escape and self.document.selection is not None:
            self.document.sweep(None)
        else:
            super().keyPressEvent(event)

    # What the document says

    @property
    def _take(self) -> Take | None:
        """The take as it stands."""
        return None if self.document.session is None else self.document.session.take

    def _opened(self) -> None:
        """Start over with another take."""
        self.predictions.forget()
        take = self._take
        if take is not None:
            for row in self.rows:
                row.time.set_clock(take.first_frame, take.rate)
            self.set_view(-0.5, take.frames - 0.5)
        self._show_frame(self.document.frame)

    def _show_markers(self) -> None:
        """Draw other markers."""
        session, shown = self.document.session, self.document.shown
        if session is None:
            self.empty.say(
                self.tr("No take is open"),
                self.tr("Open a take, or drop one onto the window."),
            )
        elif not shown:
            self.empty.say(
                self.tr("No marker is shown"),
                self.tr("Check markers in the tree, or go to an artifact in the review queue."),
            )
        self._stack.setCurrentIndex(int(bool(shown)))
        self.header.show_markers(shown)
        if session is not None:
            for row in self.rows:
                row.show_markers(session.take, session.original, shown)
            self._show_artifacts()
            self._show_proposal()
            self._show_predictions()
            self._show_sweep()
            self._show_afresh(*self._view)
        self._show_current()
        self._show_readout(self.document.frame)

    def _refresh(self, change: Change) -> None:
        """Draw changed samples anew."""
        session = self.document.session
        if session is None:
            return
        for name in change.markers:
            if name in self.document.shown:
                for row in self.rows:
                    row.refresh(session.take, session.original, name)
        self.predictions.forget()

    def _show_artifacts(self) -> None:
        """Draw the artifacts of the shown markers."""
        session, shown = self.document.session, self.document.shown
        if session is None:
            return
        artifacts = [a for a in session.artifacts if a.marker in shown]
        for row in self.rows:
            row.show_artifacts(artifacts, shown)

    def _show_current(self) -> None:
        """Mark the artifact under review."""
        current = self.document.current
        if current is not None and current.marker not in self.document.shown:
            current = None
        for row in self.rows:
            row.show_current(current, self.document.editable)
        self.buttons.refresh()
        self._place_buttons()

    def _show_proposal(self) -> None:
        """Draw what a repair of the current artifact would put there."""
        proposal = self.document.proposal
        patches = () if proposal is None else proposal.patches
        for row in self.rows:
            row.show_proposal(patches, None if proposal is None else proposal.band_mm)
        self.buttons.refresh()
        if patches and self._fit_when_proposed:
            self._fit_when_proposed = False
            self._show_afresh(*self._view)

    def _show_predictions(self) -> None:
        """Draw predictions that are there and ask for those that are not."""
        session = self.document.session
        if session is not None and self._predicting:
            self.predictions.want(session, self.document.shown)
        for row in self.rows:
            row.show_prediction(self.predictions.known if self._predicting else {})

    def _show_sweep(self) -> None:
        """Draw the swept range."""
        selection = self.document.selection
        for row in self.rows:
            if selection is None or selection.marker not in self.document.shown:
                row.show_sweep(0, 0)
            else:
                row.show_sweep(selection.start, selection.stop)

    def _show_frame(self, frame: int) -> None:
        """Move the cursor line; a cursor that leaves the view takes the view along."""
        for row in self.rows:
            row.cursor.setValue(frame)
        low, high = self._view
        if not low <= frame <= high:
            span = high - low
            # Going on, most of what is ahead comes into view; a jump lands in the middle.
            share = 0.1 if high < frame < high + span else 0.5
            self.set_view(frame - share * span, frame + (1 - share) * span)
        self._show_readout(frame)

    def _frame(self, start: int, stop: int) -> None:
        """Bring an interval into view with some of its surroundings."""
        take = self._take
        if take is None:
            return
        pad = max(take.rate, stop - start)
        self._fit_when_proposed = True
        self._show_afresh(start - pad, stop + pad)

    # What the mouse says

    def _listen(self, row: PlotRow) -> None:
        """Connect a plot's gestures."""
        row.view.time_wanted.connect(self._time_wanted)
        row.view.pressed.connect(lambda at: self._press(row, at))
        row.view.double_pressed.connect(self._double_press)
        row.view.menu_wanted.connect(lambda at, screen: self._menu(row, at, screen))
        row.view.scrubbed.connect(lambda x: self.document.go_to(round(x)))
        row.view.swept.connect(self._sweep)
        row.edges.dragged.connect(lambda: self._drag_edges(row))
        row.edges.dropped.connect(lambda: self._drop_edges(row))

    def _time_wanted(self, start: float, stop: float) -> None:
        """Zoom or pan as asked."""
        self._fit_when_proposed = False
        self.set_view(start, stop)

    def _press(self, row: PlotRow, at: QPointF) -> None:
        """Select the artifact that was clicked, or move the cursor."""
        self._pressed = row.intervals.hit(at)
        current = self.document.current
        if self._pressed is not None and (current is None or current.id != self._pressed):
            self.document.select(self._pressed)
        else:
            self.document.go_to(round(row.view.frame_at(at)))

    def _double_press(self, at: QPointF) -> None:
        """Repair the artifact the first click selected; elsewhere, show everything."""
        current = self.document.current
        if self._pressed is None:
            self.fit_all()
        elif current is not None and current.id == self._pressed:
            self.document.repair_current()

    def _menu(self, row: PlotRow, at: QPointF, screen: QPointF) -> None:
        """Open the menu that fits what lies there."""
        selection = self.document.selection
        frame = row.view.frame_at(at)
        hit = row.intervals.hit(at)
        if selection is not None and selection.start - 0.5 <= frame < selection.stop - 0.5:
            menu = sweep_menu(
                self.document, self.mark_requested.emit, self.repair_selection_requested.emit, self
            )
        elif hit is not None and self.document.session is not None:
            self.document.select(hit, frame=False)
            menu = artifact_menu(self.document, self.document.session.artifact(hit), self)
        else:
            menu = plot_menu(self.fit_all, self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.popup(screen.toPoint())

    def _sweep(self, start: float, stop: float, last: bool) -> None:
        """Follow a range being swept; when it is done, select it on the foremost marker."""
        take = self._take
        if take is None or not self.document.shown:
            return
        low, high = whole_frames(min(start, stop), max(start, stop) + 1, take.frames)
        for row in self.rows:
            row.show_sweep(low, high)
        if last:
            self.document.sweep(Selection(self.document.shown[0], low, high))

    def _drag_edges(self, source: PlotRow) -> None:
        """Let the other plots follow an edge that is dragged."""
        for row in self.rows:
            if row is not source:
                row.edges.place(*source.edges.frames)

    def _drop_edges(self, row: PlotRow) -> None:
        """Give the current artifact the edges it was dragged to, at whole frames."""
        current, take = self.document.current, self._take
        if current is None or take is None:
            return
        start, stop = whole_frames(*row.edges.frames, take.frames)
        if (start, stop) != (current.start, current.stop):
            self.document.change(current.id, start=start, stop=stop)
        self._show_current()

    def _bring_forward(self, name: str) -> None:
        """Make a shown marker the foremost."""
        self.document.show((name, *(m for m in self.document.shown if m != name)))

    # Readout and looks

    def _read_out(self, at: QPointF) -> None:
        """Say what lies under the mouse: the sample above the plots, an artifact as a tooltip."""
        session = self.document.session
        for row in self.rows:
            if session is not None and row.view.sceneBoundingRect().contains(at):
                hit = row.intervals.hit(at)
                row.intervals.setToolTip(
                    "" if hit is None else describe(session.take, session.artifact(hit))
                )
                self._show_readout(round(row.view.frame_at(at)), row)
                return
        self._show_readout(self.document.frame)

    def _show_readout(self, frame: int, row: PlotRow | None = None) -> None:
        """Say frame, time and the foremost marker's value, on one axis or on all."""
        take, shown = self._take, self.document.shown
        if take is None or not shown:
            self.header.clear()
        else:
            self.header.read_out(take, shown[0], frame, "" if row is None else row.axis)

    def _show_afresh(self, start: float, stop: float) -> None:
        """Show these frames, and of their values what matters, wherever hands had put them."""
        for row in self.rows:
            row.follows = True
        self.set_view(start, stop)

    def _place_buttons(self) -> None:
        """Put the buttons beside the current artifact."""
        current = self.document.current
        for row in self.rows:
            if current is not None and row.edges.visible:
                extent = row.intervals.extent(current.id)
                if extent is not None:
                    self.buttons.place(extent, row.view.sceneBoundingRect())
                    return
        self.buttons.hide()

    def _share_height(self, *_: object) -> None:
        """Give all three plots the same height, whoever carries the time axis."""
        free = self.canvas.height() - 8 - 2 * _SPACING - TIME_HEIGHT
        height = max(20.0, free / len(self.rows))
        layout = self.canvas.ci.layout
        for i in range(len(self.rows)):
            extra = TIME_HEIGHT if i == len(self.rows) - 1 else 0
            layout.setRowFixedHeight(i, height + extra)
        self._place_buttons()

    def _restyle(self) -> None:
        """Take over the theme's colours."""
        self.canvas.setBackground(theme.current().plot)
        for row in self.rows:
            row.restyle()
