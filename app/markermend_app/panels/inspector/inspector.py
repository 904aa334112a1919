"""What is under review, in full: the current artifact, a swept range, or the take itself."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QStackedWidget, QVBoxLayout, QWidget

from markermend_app.document import Document
from markermend_app.panels.inspector.artifact import ArtifactPage, Decisions
from markermend_app.panels.inspector.promise import Promise
from markermend_app.panels.inspector.take import SelectionPage, TakePage
from markermend_app.panels.markers.badge import hint
from markermend_app.style import theme
from markermend_app.wheel import leave_wheel


class Inspector(QWidget):
    """Shows what can be said and done about what is selected.

    Signals
    -------
    mark_requested(Kind) : make an artifact of this class of the swept range
    verb_requested(str) : name of the action to be done to the swept range
    said(str) : a sentence for the status bar
    """

    mark_requested = Signal(object)
    verb_requested = Signal(str)
    said = Signal(str)

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.artifact = ArtifactPage(document)
        self.selection = SelectionPage(document)
        self.take = TakePage(document)
        self.decisions = Decisions(document)
        self.selection.mark_requested.connect(self.mark_requested)
        self.selection.verb_requested.connect(self.verb_requested)
        self._pages = QStackedWidget()
        self._nothing = hint(self.tr("Open a take to see its details here."))
        self._holders = {page: _scrolled(page) for page in self._all()}
        self._pages.addWidget(self._nothing)
        for holder in self._holders.values():
            self._pages.addWidget(holder)
            leave_wheel(holder)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addWidget(self._pages, 1)
        # What is decided about stays in sight beside the decision, however small the panel.
        self.promise = Promise(self.artifact.methods.outcome)
        whole.addWidget(self.promise)
        whole.addWidget(self.decisions)
        self._seen: str | None = None
        self._swept = False
        document.opened.connect(self._choose)
        document.current_changed.connect(self._current_changed)
        document.selection_changed.connect(self._selection_changed)
        for signal in (
            document.current_changed,
            document.proposal_changed,
            document.proposals.progressed,
        ):
            signal.connect(self._fit)
        theme.watcher.changed.connect(self._fit)
        self._choose()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave room for the methods where the panel is low."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        self.promise.fit(self.size())

    @property
    def page(self) -> QWidget | None:
        """The page that is seen, or None when nothing is open."""
        holder = self.place
        return None if holder is None else holder.widget()

    @property
    def place(self) -> QScrollArea | None:
        """What takes the keys: the page that is seen, to be scrolled, or None."""
        holder = self._pages.currentWidget()
        return holder if isinstance(holder, QScrollArea) else None

    @property
    def shows_range(self) -> bool:
        """Whether what is seen is a swept range, not the artifact under review."""
        document = self._document
        return document.selection is not None and (self._swept or document.current is None)

    def bring_back(self) -> bool:
        """See the artifact under review again if a swept range covers it; whether it did."""
        covered = self._document.current if self.shows_range else None
        if covered is None:
            return False
        self._swept = False
        self._choose()
        text = self.tr("{0} on {1} is under review, behind the swept range. Press again to decide.")
        self.said.emit(text.format(theme.kind_name(covered.kind), covered.marker))
        return True

    def write_note(self) -> None:
        """Put the cursor where a note on the artifact is written, and that into sight."""
        self._swept = False
        self._choose()
        note = self.artifact.note
        self._holders[self.artifact].ensureWidgetVisible(note)
        note.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def _all(self) -> tuple[QWidget, ...]:
        return (self.artifact, self.selection, self.take)

    def _current_changed(self) -> None:
        """See another artifact, even while a range is swept."""
        current = self._document.current
        now = None if current is None else current.id
        if now != self._seen:
            self._swept = False
            self._holders[self.artifact].verticalScrollBar().setValue(0)
        self._seen = now
        self._choose()

    def _selection_changed(self) -> None:
        """See the range that was swept."""
        self._swept = self._document.selection is not None
        self._choose()

    def _choose(self) -> None:
        """See what was chosen last, and the take when nothing is."""
        document = self._document
        swept = self.shows_range
        deciding = document.current is not None and not swept
        self.decisions.setVisible(deciding)
        self.promise.setVisible(deciding)
        if document.session is None:
            self._pages.setCurrentWidget(self._nothing)
        elif swept:
            self._pages.setCurrentWidget(self._holders[self.selection])
        elif document.current is not None:
            self._pages.setCurrentWidget(self._holders[self.artifact])
        else:
            self._pages.setCurrentWidget(self._holders[self.take])


def _scrolled(page: QWidget) -> QScrollArea:
    """A page that can be scrolled when the dock is small."""
    area = QScrollArea()
    area.setWidgetResizable(True)
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(page)
    return area
