"""The inspector's page for the current artifact, and the buttons that decide about it."""

from __future__ import annotations

import math
from collections.abc import Callable

from PySide6.QtCore import QSignalBlocker, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QSpinBox,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from markermend.artifact import PAIRED, Artifact, Kind, Status, changed_markers
from markermend.take import Origin
from markermend_app import units
from markermend_app.actions.shortcuts import KeyTip
from markermend_app.document import Document
from markermend_app.offered import can_repair
from markermend_app.panels.inspector.artifact_text import span
from markermend_app.panels.inspector.methods import MethodList
from markermend_app.panels.inspector.note_line import NoteLine
from markermend_app.panels.inspector.take import heading, plain
from markermend_app.panels.markers.badge import kind_icon, tinted_icon
from markermend_app.style import theme
from markermend_app.telling import told, told_repair


class ArtifactPage(QWidget):
    """Class, axes and edges of the current artifact, why it is one, and how to repair it."""

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.title = heading()
        self.status = plain("muted")
        self.kind = QComboBox()
        self.kind.setAccessibleName(self.tr("Class"))
        self.kind.setToolTip(self.tr("Class of the artifact"))
        for kind in Kind:
            self.kind.addItem(theme.kind_name(kind))
        self.kind.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.kind.setMinimumContentsLength(6)
        self.kind.activated.connect(self._kind_chosen)
        self.axes: dict[str, QToolButton] = {}
        axes = QHBoxLayout()
        axes.setSpacing(4)
        axes.addWidget(self.kind, 1)
        axes.addSpacing(8)
        for axis in "xyz":
            button = QToolButton()
            button.setText(axis.upper())
            button.setCheckable(True)
            button.setMinimumWidth(26)
            button.setToolTip(self.tr("Whether {0} is wrong").format(axis.upper()))
            button.setAccessibleName(self.tr("Axis {0}").format(axis.upper()))
            button.clicked.connect(lambda _=False: self._axes_chosen())
            self.axes[axis] = button
            axes.addWidget(button)
        self.first, self.last = QSpinBox(), QSpinBox()
        edges = QHBoxLayout()
        edges.setSpacing(4)
        for field, name in (
            (self.first, self.tr("First frame")),
            (self.last, self.tr("Last frame")),
        ):
            field.setAccessibleName(name)
            field.setToolTip(self.tr("{0}, as numbered in the file").format(name))
            field.setKeyboardTracking(False)
            field.setAlignment(Qt.AlignmentFlag.AlignCenter)
            field.setMinimumWidth(68)
            field.valueChanged.connect(self._edges_chosen)
            edges.addWidget(field, 1)
        edges.insertWidget(1, QLabel("–"))
        self.extent = plain()
        self.confidence = QProgressBar()
        self.confidence.setRange(0, 100)
        self.confidence.setTextVisible(False)
        self.confidence.setFixedWidth(64)
        self.confidence.setAccessibleName(self.tr("Confidence"))
        self.sureness = QLabel()
        # In a narrow panel it takes two lines, rather than be cut off.
        self.sureness.setWordWrap(True)
        sure = QHBoxLayout()
        sure.setSpacing(8)
        sure.addWidget(self.confidence)
        sure.addWidget(self.sureness, 1)
        self.why = plain()
        self.note = NoteLine(document)
        self.methods = MethodList(document)

        form = QFormLayout()
        form.setRowWrapPolicy(QFormLayout.RowWrapPolicy.WrapLongRows)
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(8)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        form.addRow(self.tr("Class"), axes)
        form.addRow(self.tr("Frames"), edges)
        form.addRow(self.tr("Note"), self.note)
        # From the top what is read before every decision; what is seldom changed comes last.
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 8, 12, 8)
        column.setSpacing(4)
        for widget in (self.title, self.status, self.why, self.extent):
            column.addWidget(widget)
        column.addLayout(sure)
        column.addWidget(self.methods)
        column.addSpacing(8)
        column.addLayout(form)
        column.addStretch(1)
        document.current_changed.connect(self._refresh)
        document.together_changed.connect(self._refresh)
        theme.watcher.changed.connect(self._recolour)
        self._recolour()
        self._refresh()

    def _refresh(self) -> None:
        """Show the artifact as it stands."""
        a, session = self._document.current, self._document.session
        if a is None or session is None:
            return
        take = session.original
        note = session.notes.get(a.id)
        title = PAIRED.join(changed_markers(a, note.method if note else None))
        more = len(self._document.together) - 1
        title = f"{title} +{more}" if more else title
        self.title.setText(self.tr("Whole body") if more + 1 == len(take.labels) > 1 else title)
        session, status = self._document.session, self._status_text(a)
        if session is not None and a not in session.listed:
            status += " · " + self.tr("outside the region of interest")
        self.status.setText(status)
        editable = self._document.editable
        with QSignalBlocker(self.kind):
            self.kind.setCurrentIndex(list(Kind).index(a.kind))
        self.kind.setEnabled(editable)
        for axis, button in self.axes.items():
            button.setChecked(axis in a.axes)
            button.setEnabled(editable)
        first, end = take.first_frame, take.frame_number(take.frames - 1)
        for field, value, low, high in (
            (self.first, a.start + first, first, a.stop - 1 + first),
            (self.last, a.stop - 1 + first, a.start + first, end),
        ):
            with QSignalBlocker(field):
                field.setRange(low, high)
                field.setValue(value)
            field.setEnabled(editable)
        extent = self.tr("Frames {0}") if a.length > 1 else self.tr("Frame {0}")
        size = f", {units.length(a.amplitude_mm)}" if math.isfinite(a.amplitude_mm) else ""
        self.extent.setText(extent.format(span(a, first)) + size)
        # A bar paints itself, and all behind it, at once unless it is kept from it.
        self.confidence.setUpdatesEnabled(False)
        self.confidence.setValue(round(100 * a.confidence))
        self.confidence.setUpdatesEnabled(True)
        self.sureness.setText(self._sureness(a))
        self.why.setText(told(a.why) or self.tr("No reason was given."))

    def _sureness(self, a: Artifact) -> str:
        """How sure it is that something is wrong; of what is plain nobody has to be told."""
        if a.why == "marked by hand":
            return self.tr("marked by hand")
        if a.kind is Kind.GAP and a.confidence >= 1.0:
            if not self._recorded(a):
                return self.tr("certain: nothing was recorded")
            if self._taken_out(a):
                return self.tr("made by hand")
        return f"{100 * a.confidence:.0f} %, {self._words(a.confidence)}"

    def _recorded(self, a: Artifact) -> bool:
        """Whether the file has anything in the frames of an artifact."""
        session = self._document.session
        assert session is not None
        take = session.original
        return bool(take.present[a.start : a.stop, take.index(a.marker)].any())

    def _taken_out(self, a: Artifact) -> bool:
        """Whether hand work cut, or gave to other markers, all that was there."""
        session = self._document.session
        assert session is not None
        column = session.original.index(a.marker)
        _, origin = session.state.base.read(column, a.start, a.stop)
        return bool((origin == Origin.MISSING).all())

    def _words(self, confidence: float) -> str:
        """Confidence for people."""
        if confidence >= 0.9:
            return self.tr("nearly certain")
        if confidence >= 0.7:
            return self.tr("likely")
        return self.tr("possible") if confidence >= 0.4 else self.tr("doubtful")

    def _status_text(self, a: Artifact) -> str:
        """What was decided, by which method, and how far off it is expected to be."""
        notes = self._document.session.notes if self._document.session else {}
        note = notes.get(a.id)
        if a.status is Status.REPAIRED and note is not None:
            # Of what was repaired at once the worst.
            known = [notes[i].error_mm for i in self._document.together if i in notes]
            worst = max((error for error in known if error), default=note.error_mm)
            repair = told_repair(note.method, worst, joints=self._document.joints)
            return self.tr("Repaired: {0}").format(repair)
        return {
            Status.PENDING: self.tr("Open: not decided yet"),
            Status.ACCEPTED: self.tr("Accepted: to be repaired"),
            Status.REJECTED: self.tr("Rejected: a false alarm"),
            Status.REPAIRED: self.tr("Repaired"),
        }[a.status]

    def _kind_chosen(self, place: int) -> None:
        self._document.decisions.change_current(kind=list(Kind)[place])

    def _axes_chosen(self) -> None:
        """Change the axes; the last one stays."""
        axes = "".join(axis for axis, button in self.axes.items() if button.isChecked())
        if axes:
            self._document.decisions.change_current(axes=axes)
        self._refresh()

    def _edges_chosen(self) -> None:
        a, session = self._document.current, self._document.session
        if a is not None and session is not None:
            first = session.original.first_frame
            start, stop = self.first.value() - first, self.last.value() - first + 1
            self._document.decisions.change_current(start=start, stop=stop)

    def _recolour(self) -> None:
        t = theme.current()
        for i, kind in enumerate(Kind):
            self.kind.setItemIcon(i, kind_icon(kind))
        for axis, button in self.axes.items():
            button.setStyleSheet(
                f"QToolButton {{ color: {t.axes[axis].name()}; font-weight: 600; }}"
            )


class Decisions(QWidget):
    """Accept, Reject and Repair, or Reopen, for the current artifact."""

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.accept = self._button(
            self.tr("Accept"),
            self.tr("The flag is right; the samples stay for now"),
            "accept",
            document.decisions.accept_current,
        )
        self.reject = self._button(
            self.tr("Reject"),
            self.tr("A false alarm, never touched"),
            "reject",
            document.decisions.reject_current,
        )
        self.repair = self._button(
            self.tr("Repair"),
            self.tr("Replace the samples by the repair shown"),
            "repair",
            document.decisions.repair_current,
        )
        self.repair.setProperty("role", "primary")
        self.reopen = self._button(
            self.tr("Reopen"), self.tr("Take the decision back"), "reopen", self._reopen
        )
        grid = QGridLayout(self)
        grid.setContentsMargins(12, 8, 12, 12)
        grid.setSpacing(4)
        for i, button in enumerate((self.accept, self.reject, self.repair)):
            grid.addWidget(button, 0, i)
        grid.addWidget(self.reopen, 1, 0, 1, 3)
        document.current_changed.connect(self._refresh)
        theme.watcher.changed.connect(self._recolour)
        self._recolour()
        self._refresh()

    def _button(self, text: str, tip: str, name: str, do: Callable[[], None]) -> QPushButton:
        """A button that does what an action does, and names its key."""
        button = QPushButton(text)
        KeyTip(button, tip, name)
        button.setAccessibleName(text)
        button.setObjectName("decision")
        button.setMinimumSize(76, 32)
        button.clicked.connect(lambda _=False: do())
        return button

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Do without icons where there is hardly room for the words."""
        super().resizeEvent(event)
        size = 16 if self.width() >= self.sizeHint().width() else 0
        for button in (self.accept, self.reject, self.repair):
            button.setIconSize(QSize(size, size))

    def _reopen(self) -> None:
        if self._document.current is not None:
            self._document.decisions.reopen(self._document.together)

    def _refresh(self) -> None:
        """Offer what can be decided."""
        a = self._document.current
        editable = self._document.editable
        status = None if a is None else a.status
        self.accept.setEnabled(editable and status is not Status.ACCEPTED)
        self.reject.setEnabled(editable and status is not Status.REJECTED)
        self.repair.setEnabled(can_repair(self._document))
        self.reopen.setVisible(status is not Status.PENDING)
        self.reopen.setEnabled(editable)

    def _recolour(self) -> None:
        for button, name in (
            (self.accept, "accept"),
            (self.reject, "reject"),
            (self.reopen, "undo"),
        ):
            button.setIcon(theme.icon(name))
        self.repair.setIcon(tinted_icon("repair", theme.current().on_accent))
