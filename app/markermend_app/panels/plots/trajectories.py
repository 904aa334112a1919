"""The shown markers over time, row by row, with everything said about them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import QEvent, QTimer, Signal
from PySide6.QtWidgets import QStackedLayout, QVBoxLayout, QWidget

from markermend.review.edits import Change
from markermend.take import Take
from markermend_app import settings
from markermend_app.document import Document
from markermend_app.panels.empty_state import EmptyState
from markermend_app.panels.floating_buttons import FloatingButtons
from markermend_app.panels.markers.naming import short_names
from markermend_app.panels.plots.beside import channel, grouped
from markermend_app.panels.plots.crosshair import Crosshair
from markermend_app.panels.plots.drawn import Drawn, Shown
from markermend_app.panels.plots.frame import PlotFrame, events_of
from markermend_app.panels.plots.framing import Framing
from markermend_app.panels.plots.gestures import Gestures
from markermend_app.panels.plots.header import PlotHeader
from markermend_app.panels.plots.nothing import why_empty
from markermend_app.panels.plots.partner import partner_of
from markermend_app.panels.plots.prediction import Predictions
from markermend_app.panels.plots.quantity import COORDINATES, QUANTITIES, can_show
from markermend_app.panels.plots.row import PlotRow
from markermend_app.panels.plots.rows_menu import fill_rows_menu, remembered_rows
from markermend_app.panels.plots.shown_repair import shown_repair
from markermend_app.panels.plots.stack import PlotStack
from markermend_app.panels.staying_menu import StayingMenu
from markermend_app.style import theme

_MUCH = 20_000
"""Frames of which more take long to draw, where they changed."""
_FEW = 2
"""Markers that the first three rows draw at once; of more only the first row does."""


class TrajectoryPanel(QWidget):
    """Stacked plots that share one time axis.

    Signals
    -------
    view_changed(float, float) : the frames in view
    mark_requested(Kind) : the swept range is to become an artifact of this class
    verb_requested(str) : name of the action to be done
    """

    view_changed = Signal(float, float)
    mark_requested = Signal(object)
    verb_requested = Signal(str)

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.document = document
        self.chosen = remembered_rows()
        self.chosen_partner: str | None = None
        self._predicting = False
        self._known = Drawn()
        self._stale: set[str] = set()
        self._much = False
        self.setAccessibleName(self.tr("Trajectories"))

        self.header = PlotHeader()
        self.framing = Framing(self)
        self.gestures = Gestures(self)
        self._placing = QTimer(self, singleShot=True, interval=0)
        self._placing.timeout.connect(self.place_buttons)
        self.canvas = PlotStack(self._made)
        self.cross = Crosshair(document, self.canvas, self.header)
        self.menu = StayingMenu(self)
        self.menu.aboutToShow.connect(lambda: fill_rows_menu(self.menu, self))
        self.header.plots.setMenu(self.menu)
        self.empty = EmptyState("curves")
        self.buttons = FloatingButtons(document, self.canvas)
        self.predictions = Predictions(document.proposals.lane, self)

        plots = QWidget()
        column = QVBoxLayout(plots)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.header)
        column.addWidget(self.canvas, 1)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self.empty)
        self._stack.addWidget(plots)

        self.header.chosen.connect(lambda marker: document.show_too([marker]))
        self.predictions.changed.connect(self._show_predictions)
        document.opened.connect(self._opened)
        document.shown_changed.connect(self._show_markers)
        document.beside_changed.connect(self._show_beside)
        document.data_changed.connect(self._refresh)
        document.artifacts_changed.connect(self._show_artifacts)
        document.artifacts_changed.connect(self._show_region)
        document.artifacts_changed.connect(partial(self.predictions.note, samples=False))
        document.mesh_changed.connect(self._show_markers)
        document.current_changed.connect(self.show_current)
        document.proposal_changed.connect(self.show_proposal)
        document.selection_changed.connect(self._show_sweep)
        document.frame_changed.connect(self._show_frame)
        document.frame_requested.connect(self.framing.frame)
        document.reveal_requested.connect(self.framing.reveal)
        theme.watcher.changed.connect(self._restyle)
        self._restyle()
        self._opened()
        self._show_markers()

    def _made(self, row: PlotFrame) -> None:
        """Listen to a new row."""
        self.gestures.listen(row)
        # Rows are laid out after the canvas has another size, and flags after their row.
        row.view.sigResized.connect(self._placing.start)

    # Public verbs

    @property
    def rows(self) -> tuple[PlotRow, ...]:
        """Rows of the shown markers, from the top."""
        return self.canvas.rows

    @property
    def partner(self) -> str | None:
        """The marker that distances are measured to: the one chosen, else one that suits."""
        chosen, take = self.chosen_partner, self.take
        if chosen is not None and take is not None and chosen in take:
            return chosen
        return partner_of(self.document)

    def choose_rows(self, names: Sequence[str]) -> None:
        """Show these quantities and remember them; those a take does not hold are passed over."""
        chosen = tuple(n for n in QUANTITIES if n in names) or COORDINATES[:1]
        if chosen != self.chosen:
            self.chosen = chosen
            settings.remember("plots", " ".join(chosen))
            self._lay_rows()

    def choose_partner(self, marker: str | None) -> None:
        """Measure distances to this marker, or to one that suits; shows them."""
        self.chosen_partner = marker
        self.choose_rows((*self.chosen, "distance"))
        self._show_markers()

    def open_menu(self) -> None:
        """Open the menu of what the plots show."""
        button = self.header.plots
        self.menu.popup(button.mapToGlobal(button.rect().bottomLeft()))

    def set_prediction_shown(self, shown: bool) -> None:
        """Draw where the rest of the body says the markers are, or not."""
        self._predicting = shown
        self._show_predictions()

    def set_before_after(self, before: bool) -> None:
        """Bring the source's samples forward, or the working ones."""
        for row in self.rows:
            row.set_before(before)
        self.cross.before = before
        self.cross.read_out(self.document.frame)

    # What the document says

    @property
    def take(self) -> Take | None:
        """The take as it stands."""
        return None if self.document.session is None else self.document.session.take

    def _opened(self) -> None:
        """Start over with another take."""
        self.predictions.forget()
        self._known.forget()
        self.chosen_partner = None
        name = self.tr("Plots of the shown markers")
        name = self.tr("Plots of the shown joints") if self.document.joints else name
        self.canvas.setAccessibleName(name)
        self._lay_rows()
        if (take := self.take) is not None and not self.document.renaming:
            self.framing.set_view(-0.5, take.frames - 0.5)
        self._show_frame(self.document.frame)

    def _lay_rows(self) -> None:
        """Lay out the rows chosen, as far as the take holds what they show."""
        least = COORDINATES if self.take is None or self.take.markers else ()
        self.canvas.set_rows([n for n in self.chosen if can_show(self.take, n)] or least)
        self._prepare(self.rows)
        if self.take is not None and self.document.shown:
            self._show_markers()

    def _show_beside(self) -> None:
        """Draw what was recorded beside the markers, as far as it was asked for."""
        take = self.take
        found = () if take is None else tuple(channel(take, k) for k in self.document.beside)
        self.canvas.set_beside(grouped(c for c in found if c is not None))
        self._prepare(self.canvas.beside)
        self._turn_page()
        self.framing.set_view(*self.framing.view)

    def _prepare(self, rows: Sequence[PlotFrame]) -> None:
        """Tell rows of the take's clock, its events, and where the cursor is."""
        take = self.take
        if take is None:
            return
        events = events_of(take)
        for row in rows:
            row.time.set_clock(take.first_frame, take.rate, take.frames)
            row.show_events(events)
            row.cursor.setValue(self.document.frame)
            row.show_cross(None, None)
        self._show_region()

    def _show_markers(self) -> None:
        """Draw other markers."""
        session, shown = self.document.session, self.document.shown
        self._turn_page()
        self.header.show_markers(shown)
        if session is not None:
            drawn = {name: self._drawn(name) for name in shown}
            self._known.keep(shown)
            self._stale.clear()
            self._much = False
            at_once = len(COORDINATES) if len(shown) <= _FEW else 1
            for i, row in enumerate(self.rows):
                row.show_markers(drawn, soon=i >= at_once)
            self._name_distance()
            self._show_artifacts()
            self.show_proposal()
            self._show_predictions()
            self._show_sweep()
            self.framing.follow_markers()
        self.show_current()

    def _turn_page(self) -> None:
        """Show the plots where there is something in them, else say what to do."""
        self.empty.say(*why_empty(self.take))
        self._stack.setCurrentIndex(int(bool(self.document.shown or self.document.beside)))
        if self.hasFocus() and self.canvas.isVisible():
            self.canvas.setFocus()

    def _drawn(self, name: str) -> Shown:
        """A marker as the rows draw it."""
        session = self.document.session
        assert session is not None
        partner = self.partner if self.canvas.row("distance") is not None else None
        predicted = self.predictions.known.get(name)
        return self._known.of(session, name, None if partner == name else partner, predicted)

    def _name_distance(self) -> None:
        """Say to which marker distances are measured."""
        row, partner = self.canvas.row("distance"), self.partner
        if row is not None:
            short = short_names((partner, *self.document.shown)) if partner else {}
            row.set_title(self.tr("To {0}").format(short[partner]) if partner else row.title)

    def _refresh(self, change: Change) -> None:
        """Take note of changed samples: which artifact is under review is told next."""
        if self.document.session is None:
            return
        self._known.note(change.markers)
        everyone = self.partner in change.markers and self.canvas.row("distance") is not None
        self._stale |= set(self.document.shown if everyone else change.markers)
        self._much |= change.stop - change.start > _MUCH
        self.predictions.note(samples=True)

    def catch_up(self) -> None:
        """Draw anew what has changed since it was drawn."""
        stale = {name: self._drawn(name) for name in self.document.shown if name in self._stale}
        self._stale.clear()
        if stale:
            for i, row in enumerate(self.rows):
                row.renew(stale, soon=i > 0 or self._much)
        self._much = False
        self.cross.read_out(self.document.frame)

    def _show_artifacts(self) -> None:
        """Draw the artifacts of the shown markers."""
        session, shown = self.document.session, self.document.shown
        if session is None:
            return
        artifacts = [a for a in session.artifacts if a.concerns(shown)]
        for row in self.rows:
            row.show_artifacts(artifacts, shown)

    def _show_region(self) -> None:
        """Set the frames that are not reviewed off from the others."""
        session = self.document.session
        for row in self.canvas.frames:
            row.outside.show_region(None if session is None else session.region)

    def show_current(self) -> None:
        """Mark the artifact under review."""
        self.catch_up()
        current = self.document.current
        if current is not None and not current.concerns(self.document.shown):
            current = None
        for row in self.rows:
            row.show_current(current, self.document.editable)
        self.buttons.refresh()
        self.place_buttons()

    def show_proposal(self) -> None:
        """Draw what a repair of the current artifact would put there, and how far off it may be."""
        patches, banded = shown_repair(self.document)
        for row in self.rows:
            row.show_proposal(patches, banded)
        if patches:
            self.framing.follow_proposal()

    def _show_predictions(self) -> None:
        """Draw predictions that are there and ask for those that are not."""
        session, residual = self.document.session, self.canvas.row("residual")
        if session is not None:
            wanted = self._predicting or residual is not None
            self.predictions.want(session, self.document.shown if wanted else ())
        for row in self.rows:
            row.show_prediction(self.predictions.known if self._predicting else {})
        if session is not None and residual is not None:
            for name in residual.traces:
                residual.refresh(name, self._drawn(name))
            residual.set_view(*self.framing.view, self.document.current)

    def _show_sweep(self) -> None:
        """Draw the swept range."""
        swept = self.document.selection
        seen = swept is not None and swept.marker in self.document.shown
        start, stop = (swept.start, swept.stop) if swept is not None and seen else (0, 0)
        for row in self.canvas.frames:
            row.show_sweep(start, stop)

    def _show_frame(self, frame: int) -> None:
        """Move the cursor line, and the view along with it."""
        for row in self.canvas.frames:
            row.cursor.setValue(frame)
        self.framing.follow_cursor(frame)
        self.cross.read_out(frame)

    # What the mouse says

    def leaveEvent(self, event: QEvent) -> None:
        """Take the crosshair away with the mouse."""
        self.cross.leave()
        super().leaveEvent(event)

    # Looks

    def place_buttons(self) -> None:
        """Put the buttons beside the current artifact, once its frames are in view."""
        if self.document.bringing:
            return
        current = self.document.current
        for row in self.rows:
            if current is not None and row.edges.visible:
                extent = row.intervals.extent(current.id)
                if extent is not None:
                    below = row.view.sceneBoundingRect().adjusted(0, row.flags.height, 0, 0)
                    self.buttons.place(extent, below)
                    return
        self.buttons.hide()

    def _restyle(self) -> None:
        """Take over the theme's colours."""
        self.canvas.setBackground(theme.current().plot)
        for row in self.canvas.frames:
            row.restyle()
