"""Pages of the inspector for what is not an artifact: a swept range, and the take."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QFormLayout,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from markermend.artifact import Kind
from markermend.heat import count_missing
from markermend_app.actions.menus import hint_of
from markermend_app.document import Document
from markermend_app.panels.markers.badge import kind_icon
from markermend_app.style import theme
from markermend_app.telling import told
from markermend_app.words import tr

_KNOWN = ("subject", "subjects", "x_screen", "y_screen")
"""Keys of a take's info that are told elsewhere, or tell operators nothing."""
_WORDED = ("storage", "missing_samples")
"""Keys whose values are words of the engine, not of the file."""


def heading(text: str = "") -> QLabel:
    """A line that names what follows."""
    label = QLabel(text)
    label.setProperty("role", "heading")
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(True)
    return label


def plain(role: str = "") -> QLabel:
    """Wrapped text that can be copied."""
    label = QLabel()
    label.setWordWrap(True)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    if role:
        label.setProperty("role", role)
    return label


class SelectionPage(QWidget):
    """What can be made of a swept range.

    Signals
    -------
    mark_requested(Kind) : a class was chosen
    verb_requested(str) : name of the action to be done to the range
    """

    mark_requested = Signal(object)
    verb_requested = Signal(str)

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.title = heading()
        self.about = plain("muted")
        self.buttons: dict[Kind, QPushButton] = {}
        grid = QGridLayout()
        grid.setSpacing(8)
        for i, kind in enumerate(Kind):
            button = QPushButton(theme.kind_name(kind))
            button.setToolTip(self.tr("Mark the swept frames as: {0}").format(button.text()))
            button.clicked.connect(lambda _=False, kind=kind: self.mark_requested.emit(kind))
            self.buttons[kind] = button
            grid.addWidget(button, i // 2, i % 2)
        self.verbs: dict[str, QPushButton] = {}
        work = QGridLayout()
        work.setSpacing(8)
        for i, (name, text) in enumerate(
            (
                ("repair_selection", self.tr("Repair")),
                ("smooth", self.tr("Smooth…")),
                ("cut_selection", self.tr("Cut")),
                ("swap_selection", self.tr("Swap…")),
                ("move_selection", self.tr("Give away…")),
                ("region_selection", self.tr("Review only this")),
            )
        ):
            button = QPushButton(text)
            button.clicked.connect(lambda _=False, name=name: self.verb_requested.emit(name))
            self.verbs[name] = button
            work.addWidget(button, i // 2, i % 2)
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 12, 12, 12)
        column.setSpacing(8)
        column.addWidget(self.title)
        column.addWidget(self.about)
        column.addSpacing(4)
        column.addWidget(QLabel(self.tr("Mark the selection as")))
        column.addLayout(grid)
        column.addSpacing(4)
        column.addWidget(QLabel(self.tr("Do something to it")))
        column.addLayout(work)
        column.addStretch(1)
        document.selection_changed.connect(self._refresh)
        theme.watcher.changed.connect(self._recolour)
        self._recolour()

    def _refresh(self) -> None:
        """Describe the swept range."""
        swept, session = self._document.selection, self._document.session
        if swept is None or session is None:
            return
        take = session.original
        n = swept.stop - swept.start
        first, last = take.frame_number(swept.start), take.frame_number(swept.stop - 1)
        self.title.setText(self.tr("Selection on {0}").format(swept.marker))
        if n == 1:
            text = self.tr("Frame {0}, {1:.2f} s").format(first, 1 / take.rate)
        else:
            text = self.tr("Frames {0} to {1}: {2} frames, {3:.2f} s")
            text = text.format(first, last, n, n / take.rate)
        self.about.setText(text)
        for button in (*self.buttons.values(), *self.verbs.values()):
            button.setEnabled(self._document.editable)
        for name, button in self.verbs.items():
            button.setToolTip(hint_of(name, joints=take.skeleton))

    def _recolour(self) -> None:
        for kind, button in self.buttons.items():
            button.setIcon(kind_icon(kind))


class TakePage(QWidget):
    """What the take holds, and what was odd about its file."""

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.title = heading()
        self.facts = QFormLayout()
        self.facts.setHorizontalSpacing(16)
        self.facts.setVerticalSpacing(4)
        self.facts.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        self.warnings = QVBoxLayout()
        self.warnings.setSpacing(8)
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 12, 12, 12)
        column.setSpacing(8)
        column.addWidget(self.title)
        column.addLayout(self.facts)
        column.addSpacing(4)
        column.addLayout(self.warnings)
        column.addStretch(1)
        document.opened.connect(self._refresh)
        document.data_changed.connect(lambda _: self._refresh_gaps())
        document.artifacts_changed.connect(self._refresh_region)
        theme.watcher.changed.connect(self._refresh)
        self._gaps, self._reviewed = plain(), plain()
        self._asked = slice(0)
        self._refresh()

    def _refresh(self) -> None:
        """Tell about another take."""
        session = self._document.session
        while self.facts.rowCount():
            self.facts.removeRow(0)
        while (item := self.warnings.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.deleteLater()
        if session is None:
            return
        take = session.original
        source = take.source
        self.title.setText(self.tr("Take") if source is None else source.path.name)
        named = [s for s in take.subjects if s]
        self._gaps, self._reviewed = plain(), plain()
        for text, value in (
            (
                self.tr("Frames"),
                f"{take.frames} ({take.first_frame}–{take.frame_number(take.frames - 1)})",
            ),
            (self.tr("Rate"), f"{take.rate:g} Hz"),
            (self.tr("Duration"), f"{take.duration_s:.2f} s"),
            (self.tr("Joints") if take.skeleton else self.tr("Markers"), str(len(take.named))),
            (self.tr("Unlabelled"), str(take.markers - len(take.named))),
            (self.tr("Subjects"), ", ".join(named)),
            (self.tr("Other points"), "" if take.points is None else str(len(take.points.labels))),
            (self.tr("Analog"), "" if take.analog is None else str(len(take.analog.labels))),
            (self.tr("Events"), str(len(take.events)) if take.events else ""),
            *(
                (tr(key.replace("_", " ").capitalize()), _value(key, text))
                for key, text in take.info.items()
                if key not in _KNOWN
            ),
        ):
            if value not in ("", "0"):
                self._add(text, value)
        if take.named:
            self.facts.addRow(_name(self.tr("Missing")), self._gaps)
        self.facts.addRow(_name(self.tr("Reviewed")), self._reviewed)
        self._asked = slice(0)
        self._refresh_region()
        for sentence in take.warnings:
            self.warnings.addWidget(_warning(told(sentence)))

    def _refresh_region(self) -> None:
        """Tell which frames are reviewed, unless all are."""
        session = self._document.session
        if session is None:
            return
        region, take = session.region, session.original
        self.facts.setRowVisible(self._reviewed, region is not None)
        if region is not None:
            first, last = take.frame_numbers(*region)
            text = self.tr("Frames {0} to {1}").format(first, last)
            self._reviewed.setText(text)
        if session.asked != self._asked:
            self._refresh_gaps()

    def _refresh_gaps(self) -> None:
        """Tell how much is missing now."""
        session = self._document.session
        if session is None or not self.isVisible():
            return
        named = list(session.original.named)
        if named and session.original.frames:
            self._asked = session.asked
            origin = session.origin[self._asked]
            share = count_missing(origin)[named].mean() / len(origin)
            text = self.tr("{0:.2f} % of all samples")
            if session.region is not None:
                text = self.tr("{0:.2f} % of the samples reviewed")
            self._gaps.setText(text.format(100 * share))

    def showEvent(self, event: QShowEvent) -> None:
        """Catch up with repairs made while another page was seen."""
        self._refresh_gaps()
        super().showEvent(event)

    def _add(self, name: str, value: str) -> None:
        label = plain()
        label.setText(value)
        self.facts.addRow(_name(name), label)


def _value(key: str, text: str) -> str:
    """A fact of the file; what the engine words is told in the language of the window."""
    return "; ".join(map(told, text.split("; "))) if key in _WORDED else text


def _name(text: str) -> QLabel:
    """Name of a fact."""
    label = QLabel(text)
    label.setProperty("role", "muted")
    return label


def _warning(sentence: str) -> QWidget:
    """An oddity of the file, with an icon."""
    row = QWidget()
    box = QHBoxLayout(row)
    box.setContentsMargins(0, 0, 0, 0)
    box.setSpacing(8)
    sign = QLabel()
    sign.setPixmap(theme.icon("warning").pixmap(16, 16))
    text = plain("warning")
    text.setText(sentence)
    box.addWidget(sign, 0, Qt.AlignmentFlag.AlignTop)
    box.addWidget(text, 1)
    return row
