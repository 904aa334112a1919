"""The repair methods for the current artifact, and what the previewed one promises."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QButtonGroup,
    QComboBox,
    QGridLayout,
    QRadioButton,
    QVBoxLayout,
    QWidget,
)

from markermend.artifact import Artifact, Status
from markermend.review.edits import RepairNote
from markermend_app import units
from markermend_app.actions import shortcuts
from markermend_app.background.preview import AUTO
from markermend_app.document import Document
from markermend_app.method_words import label_of, summary_of
from markermend_app.offered import is_offered
from markermend_app.panels.inspector.take import heading, plain
from markermend_app.panels.markers.naming import short_names
from markermend_app.telling import told
from markermend_app.words import tr

# A repair expected to be off by more than a marker is wide is worth a second look.
_DOUBTFUL_MM = 20.0
# Joints are placed within a body, where sensors are off by this much anyway.
_DOUBTFUL_JOINT_MM = 50.0


class MethodList(QWidget):
    """Radio buttons for the methods that have a key, and one drop-down list of all others.

    Attributes
    ----------
    outcome : what the previewed repair promises; whoever has the list puts it where it stays in
        sight
    """

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.buttons: dict[str, QRadioButton] = {}
        self._group = QButtonGroup(self)
        self._abreast: bool | None = None
        self.more = QComboBox()
        self.more.setPlaceholderText(self.tr("More methods…"))
        self.more.setAccessibleName(self.tr("More methods"))
        self.more.setToolTip(self.tr("Repair methods without a key of their own"))
        # Long names must not keep the dock wide.
        self.more.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.more.setMinimumContentsLength(8)
        self.more.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.more.activated.connect(
            lambda row: document.choose_method(str(self.more.itemData(row)))
        )
        self._grid = QGridLayout()
        self._grid.setHorizontalSpacing(4)
        self._grid.setVerticalSpacing(4)
        self.outcome = plain("muted")
        self.outcome.setContentsMargins(12, 8, 12, 0)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 4, 0, 0)
        column.setSpacing(4)
        column.addWidget(heading(self.tr("Repair")))
        column.addLayout(self._grid)
        column.addSpacing(4)
        column.addWidget(self.more)
        document.current_changed.connect(self._refresh)
        document.together_changed.connect(self._refresh)
        document.proposal_changed.connect(self._refresh)
        document.proposals.progressed.connect(self._tell)

    def _fill(self) -> None:
        """List the methods, once an artifact is looked at: the engine's repairs load late."""
        from markermend.repairs import REPAIRS

        self._grid.addWidget(self._made(AUTO), 0, 0, 1, 2)
        for method in REPAIRS.values():
            if method.key is not None:
                self._made(method.name)
        self._speak()
        self._lay_out()
        # Made late, they would be the last that Tab reaches; it takes no order from what it skips.
        before = self.more.previousInFocusChain()
        while before is not None and before.focusPolicy() == Qt.FocusPolicy.NoFocus:
            before = before.previousInFocusChain()
        for button in self.buttons.values():
            if before is not None:
                self.setTabOrder(before, button)
            before = button
        others = (method for method in REPAIRS.values() if method.key is None)
        for method in sorted(others, key=lambda m: tr(m.label).lower()):
            self.more.addItem(tr(method.label), method.name)

    def _lay_out(self) -> None:
        """Put the methods with a key in two columns, or in one where two would cut off names."""
        keyed = list(self.buttons.values())[1:]
        half = (len(keyed) + 1) // 2
        columns = (keyed[:half], keyed[half:])
        widths = (max((b.sizeHint().width() for b in column), default=0) for column in columns)
        wide = sum(widths) + self._grid.horizontalSpacing() <= self.width()
        if wide == self._abreast:
            return
        self._abreast = wide
        per_column = half if wide else len(keyed)
        for i, button in enumerate(keyed):
            self._grid.addWidget(button, 1 + i % per_column, i // per_column)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the width."""
        super().resizeEvent(event)
        if self.buttons:
            self._lay_out()

    def _made(self, name: str) -> QRadioButton:
        """Make the button of a method."""
        button = QRadioButton()
        # A long name is cut off in a narrow dock, rather than push what stands beside it out.
        button.setMinimumWidth(60)
        button.clicked.connect(lambda _=False: self._document.choose_method(name))
        self._group.addButton(button)
        self.buttons[name] = button
        return button

    def _refresh(self) -> None:
        """Show the chosen method and what it promises."""
        a = self._document.current
        if a is None:
            return
        if not self.buttons:
            self._fill()
        offered = is_offered(self._document, AUTO)
        note = self._note(a)
        chosen = self._document.method if note is None else note.method
        self._speak()
        # An exclusive group keeps one checked, but none is while one of the list is chosen.
        self._group.setExclusive(False)
        for name, button in self.buttons.items():
            button.setEnabled(is_offered(self._document, name))
            with QSignalBlocker(button):
                button.setChecked(name == chosen)
        self._group.setExclusive(True)
        self.more.setEnabled(offered)
        self.more.setCurrentIndex(self.more.findData(chosen))
        self.outcome.setText(self._promise())
        # A low panel has no room for all of it.
        self.outcome.setToolTip(self.outcome.text())
        proposal = self._document.proposal
        most = _DOUBTFUL_JOINT_MM if self._document.joints else _DOUBTFUL_MM
        doubtful = (note is not None and bool(note.leaves)) or (
            offered
            and proposal is not None
            and (max(self._expected().values(), default=0.0) > most or bool(proposal.leaves))
        )
        role = "warning" if doubtful else "muted"
        if self.outcome.property("role") != role:
            self.outcome.setProperty("role", role)
            self.outcome.style().polish(self.outcome)

    def _note(self, a: Artifact) -> RepairNote | None:
        """How a repaired artifact was repaired; None of one that is not."""
        session = self._document.session
        repaired = session is not None and a.status is Status.REPAIRED
        return session.notes.get(a.id) if session is not None and repaired else None

    def _speak(self) -> None:
        """Name the methods, and say what they do: to joints, or to markers."""
        from markermend.repairs import REPAIRS

        joints, a = self._document.joints, self._document.current
        for name, button in self.buttons.items():
            if name == AUTO:
                label, tip = self._best(), self.tr("The method that is expected to err least here")
            else:
                key = REPAIRS[name].key
                label = f"{key} {label_of(name, joints=joints)}"
                tip = self.tr("{0} (key {1})").format(summary_of(name, joints=joints), key)
            answer = None if a is None else self._document.proposals.get(a, name)
            if name == "swap" and answer is not None and answer.reason:
                # Where it cannot be chosen nothing else says why.
                tip += "\n" + told(answer.reason)
            button.setText(label)
            button.setToolTip(f"{label}\n{tip}")
        for row in range(self.more.count()):
            tip = summary_of(self.more.itemData(row), joints=joints)
            self.more.setItemData(row, tip, Qt.ItemDataRole.ToolTipRole)

    def _best(self) -> str:
        """What the best method is called: of joints by the method that is proposed there."""
        a, followed = self._document.current, self._document.preview.references
        made = None if a is None else self._document.proposals.get(a, AUTO, followed)
        if self._document.joints and made is not None and made.patches:
            return self.tr("Best: {0}").format(label_of(made.method, joints=True))
        return self.tr("Best for this artifact")

    def _tell(self, doing: str) -> None:
        """Say how far a method is that takes seconds."""
        if self._document.current is not None and self._document.proposal is None:
            self.outcome.setText(self.tr("Working out the repair… {0}").format(doing))

    def _expected(self) -> dict[str, float]:
        """Errors in mm that are expected of what is repaired at once, by marker, as far as known.

        One key decides of a whole limb or body, of which some joints are far surer than others.
        """
        session = self._document.session
        now = [] if session is None else self._document.at_once(session)
        made = [(a.marker, self._document.preview.get(a)) for a in now]
        return {marker: repair.error_mm for marker, repair in made if repair and repair.error_mm}

    def _promise(self) -> str:
        """What the preview is expected to achieve, or why there is none."""
        a, proposal = self._document.current, self._document.proposal
        session = self._document.session
        if a is not None and a.status is Status.REPAIRED:
            note = self._note(a)
            text = self.tr("Repaired. Reopen it to try another method.")
            return f"{text} {told(note.leaves)}" if note is not None and note.leaves else text
        if proposal is None:
            return self.tr("Working out the repair…")
        if not proposal.patches:
            why = told(proposal.reason) or self.tr("no answer here")
            text = self.tr("No repair: {0}").format(why)
            if self._document.preview.best:
                goes_on = self.tr("{0} accepts the flag, leaves the samples and goes on.")
                text += "\n" + goes_on.format(shortcuts.way_to("repair"))
            return text
        method = proposal.method
        text = label_of(method, joints=self._document.joints)
        # A swap invents nothing, so that there is nothing to be off by.
        expected = self._expected()
        if len(expected) > 1:
            worst = max(expected, key=lambda marker: expected[marker])
            most = self.tr(", expected error up to {0} ({1})")
            text += most.format(units.error(expected[worst]), worst)
        elif proposal.error_mm:
            text += self.tr(", expected error {0}").format(units.error(proposal.error_mm))
        elif proposal.error_mm is None and method != "leave_empty":
            text += self.tr(", expected error not measured")
        followed = self._document.preview.references
        if followed and session is not None:
            short = short_names(session.original.labels)
            text += self.tr(", following {0}").format(", ".join(short[m] for m in followed))
        from markermend.repairs.look_again import in_words

        said = " ".join(map(told, filter(None, (proposal.reason, in_words(proposal.leaves or ())))))
        return f"{text}. {said}" if said else text
