"""The status line: what was said last, how far the review is, and work under way with cancel."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QProgressBar, QSizePolicy, QStatusBar, QToolButton, QWidget

from markermend_app.background.jobs import Lane
from markermend_app.document import Document
from markermend_app.style import theme
from markermend_app.telling import told

_BAR_PX, _SHORT_BAR_PX = 180, 60
_BETWEEN_PX, _EDGES_PX = 8, 24
"""Pixels between two things in the line, and for what stands at its ends."""


class Sentence(QLabel):
    """A sentence that ends in dots where it has no room, rather than widen the window.

    Attributes
    ----------
    whole : all of it, which the tooltip tells too
    """

    def __init__(self) -> None:
        super().__init__()
        self.whole = ""
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setContentsMargins(8, 0, 8, 0)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)

    def say(self, text: str) -> None:
        """Show another one."""
        self.whole = text
        self.setToolTip(text)
        self._fit()

    @property
    def wanted(self) -> int:
        """Pixels that all of it takes."""
        margins = self.contentsMargins()
        edges = margins.left() + margins.right()
        return self.fontMetrics().horizontalAdvance(self.whole) + edges + 1

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show as much as has room now."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        room = self.contentsRect().width()
        right = Qt.TextElideMode.ElideRight
        self.setText(self.fontMetrics().elidedText(self.whole, right, room))


class StatusLine(QStatusBar):
    """Shows progress only while something runs.

    Parameters
    ----------
    document : whose review is counted
    lane : whose jobs are shown
    """

    def __init__(self, document: Document, lane: Lane, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._lane = lane
        self._said = Sentence()
        self._doing = QLabel()
        self._doing.setTextFormat(Qt.TextFormat.PlainText)
        self._bar = QProgressBar()
        self._bar.setRange(0, 1000)
        self._bar.setFixedWidth(_BAR_PX)
        self._bar.setTextVisible(False)
        self._bar.setAccessibleName(self.tr("Progress"))
        self._cancel = QToolButton()
        self._cancel.setToolTip(self.tr("Cancel"))
        self._cancel.setAccessibleName(self.tr("Cancel"))
        self._cancel.clicked.connect(self._stop)
        self._counts = QLabel()
        self._counts.setToolTip(
            self.tr("Artifacts decided, time for each, and time spent on the take without pauses")
        )
        self.addWidget(self._said, 1)
        for widget in (self._doing, self._bar, self._cancel, self._counts):
            self.addPermanentWidget(widget)
        self._label = ""
        self._stopping = False
        lane.started.connect(self._started)
        lane.progressed.connect(self._progressed)
        lane.finished.connect(self._finished)
        document.history_changed.connect(lambda: self.say(""))
        document.artifacts_changed.connect(self._count)
        document.opened.connect(self._count)
        theme.watcher.changed.connect(self._recolour)
        self._recolour()
        self._show_work(False)
        self._count()

    def say(self, text: str) -> None:
        """Show a sentence until the next one, or the next step of the review."""
        self._said.say(text)
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep what was said readable."""
        super().resizeEvent(event)
        self._fit()

    def take_back(self, text: str) -> None:
        """Show a sentence no longer, unless another one has followed."""
        if self._said.whole == text:
            self.say("")

    def _stop(self) -> None:
        """Ask the work to stop, which it does at its next step."""
        self._stopping = True
        self._cancel.setEnabled(False)
        self._tell(self.tr("Stopping…"))
        self._lane.cancel()

    def _started(self, label: str) -> None:
        self._label = label
        # What was stopped does not begin, so that this was asked for later.
        self._stopping = False
        self._cancel.setEnabled(True)
        self._bar.setValue(0)
        self._show_work(True)
        self._tell(f"{label}…")

    def _progressed(self, share: float, doing: str) -> None:
        if self._stopping:
            return
        self._bar.setValue(round(share * 1000))
        self._tell(f"{self._label}: {told(doing)}")

    def _tell(self, doing: str) -> None:
        """Tell what is done."""
        self._doing.setText(doing)
        self._fit()

    def _finished(self) -> None:
        if self._lane.busy:
            return
        self._show_work(False)
        self._cancel.setEnabled(True)
        if self._stopping:
            self._stopping = False
            self.say(self.tr("Cancelled."))

    def _show_work(self, shown: bool) -> None:
        for widget in (self._doing, self._bar, self._cancel):
            widget.setVisible(shown)
        self._fit()

    def _fit(self) -> None:
        """Make room for what was said while something runs: it is said once, and goes."""
        working = not self._bar.isHidden()
        work = (self._doing, self._cancel) if working else ()
        room = self.width() - _EDGES_PX - self._said.wanted
        room -= sum(w.sizeHint().width() + _BETWEEN_PX for w in (*work, self._counts))
        fits = room >= _SHORT_BAR_PX + _BETWEEN_PX
        self._bar.setFixedWidth(_BAR_PX if room >= _BAR_PX + _BETWEEN_PX else _SHORT_BAR_PX)
        self._counts.setVisible(fits or not working)

    def _count(self) -> None:
        session = self._document.session
        if session is None:
            self._counts.clear()
            return
        pace = session.pace
        if not pace.total:
            self._counts.clear()
            return
        text = self.tr("{0} of {1} decided").format(pace.decided, pace.total)
        if pace.seconds_each is not None and pace.spent_s:
            text += self.tr(" · {0:.1f} s each").format(pace.seconds_each)
            short = pace.spent_s < 60.0
            spent = self.tr(" · {0:.1f} s in all") if short else self.tr(" · {0:.1f} min in all")
            text += spent.format(pace.spent_s if short else pace.minutes)
        self._counts.setText(text)

    def _recolour(self) -> None:
        self._cancel.setIcon(theme.icon("cancel"))
