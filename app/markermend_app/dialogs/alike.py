"""What will happen to all artifacts like the current one, before it happens."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHeaderView,
    QLabel,
    QProgressBar,
    QPushButton,
    QSpinBox,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from markermend.artifact import PAIRED, Artifact
from markermend.review.alike import alike
from markermend_app.actions import shortcuts
from markermend_app.dialogs.help_key import help_in
from markermend_app.dialogs.params_form import inset
from markermend_app.document import Document
from markermend_app.panels.inspector.artifact_text import span
from markermend_app.scope import Scope
from markermend_app.style import theme
from markermend_app.telling import told, told_repair

MARKER, FRAMES, SURE, OUTCOME = range(4)
SURE_ENOUGH = 50
"""Percent; below it repairs are not offered to begin with, as on the command line."""


class AlikeDialog(QDialog):
    """Lists artifacts of one class, with what is to become of each.

    Parameters
    ----------
    document : whose open artifacts are listed
    like : class and marker to begin with
    scopes : where to look, narrowest first
    repairing : repair them, else reject them
    parent : the window

    Signals
    -------
    wanted(tuple) : repairs have to be worked out for these artifacts

    Attributes
    ----------
    repairs : worked-out repair by artifact id, as far as :meth:`tell` was told of them
    """

    wanted = Signal(tuple)

    def __init__(
        self,
        document: Document,
        like: Artifact,
        scopes: Sequence[Scope],
        repairing: bool,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        help_in(self)
        self._document, self._like, self._repairing = document, like, repairing
        self.repairs: dict[str, Any] = {}
        self._listed: tuple[Artifact, ...] = ()
        kind = theme.kind_name(like.kind, within=True)
        if repairing:
            self.setWindowTitle(self.tr("Repair all like this: {0}").format(kind))
        else:
            self.setWindowTitle(self.tr("Reject all like this: {0}").format(kind))
        self.scope = QComboBox()
        for scope in scopes:
            self.scope.addItem(scope.text, scope)
        self.least = QSpinBox()
        inset(self.least)
        self.least.setRange(0, 100)
        self.least.setSuffix(" %")
        self.least.setValue(SURE_ENOUGH if repairing else 0)
        self.table = self._make_table()
        self.bar = QProgressBar()
        self.bar.setRange(0, 1000)
        self.bar.setTextVisible(False)
        self.said = QLabel()
        self.said.setProperty("role", "muted")
        self.said.setWordWrap(True)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.go = QPushButton()
        buttons.addButton(self.go, QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form = QFormLayout()
        form.addRow(self.tr("Where"), self.scope)
        self.scope.setAccessibleName(self.tr("Where"))
        form.addRow(self.tr("At least this sure"), self.least)
        self.least.setAccessibleName(self.tr("At least this sure"))
        column = QVBoxLayout(self)
        column.addLayout(form)
        column.addWidget(self.table, 1)
        column.addWidget(self.bar)
        column.addWidget(self.said)
        column.addWidget(buttons)
        self.scope.currentIndexChanged.connect(self._list)
        self.least.valueChanged.connect(self._list)
        self.table.itemChanged.connect(self._count)
        # Why a method is not the usual one fits beside it.
        self.resize(min(900, parent.width() - 40), 480)

    def _make_table(self) -> QTableWidget:
        """The list, empty."""
        table = QTableWidget(0, 4)
        table.setHorizontalHeaderLabels(
            [
                self.tr("Joint") if self._document.joints else self.tr("Marker"),
                self.tr("Frames"),
                self.tr("Sure"),
                self.tr("What will happen"),
            ]
        )
        table.setAccessibleName(self.tr("What will happen"))
        table.verticalHeader().hide()
        table.setShowGrid(False)
        table.setWordWrap(False)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        table.setTabKeyNavigation(False)
        head = table.horizontalHeader()
        head.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        head.setSectionResizeMode(MARKER, QHeaderView.ResizeMode.Interactive)
        head.setStretchLastSection(True)
        return table

    def open(self) -> None:
        """Show it, over the window only."""
        self._list()
        super().open()
        self.go.setDefault(True)
        self.go.setFocus()

    # What is listed

    def chosen(self) -> list[str]:
        """Ids of the checked artifacts to which something can be done, in order."""
        found = []
        for row, a in enumerate(self._listed):
            item = self.table.item(row, MARKER)
            if item is not None and item.checkState() == Qt.CheckState.Checked and self._able(a):
                found.append(a.id)
        return found

    def tell(self, repairs: dict[str, Any]) -> None:
        """Take over what was worked out for the artifacts listed."""
        self.repairs |= repairs
        with QSignalBlocker(self.table):
            for row, a in enumerate(self._listed):
                self.table.setItem(row, OUTCOME, _cell(self._outcome(a)))
        self._count()

    def _able(self, a: Artifact) -> bool:
        return not self._repairing or (a.id in self.repairs and bool(self.repairs[a.id].patches))

    def _list(self) -> None:
        """List the artifacts that are meant, and ask for their repairs."""
        session = self._document.session
        scope: Scope = self.scope.currentData()
        if session is None:
            return
        # One outside the region of interest that was asked for has its like everywhere.
        asked = session.listed if self._like in session.listed else session.artifacts
        found = alike(
            asked,
            self._like.kind,
            markers=scope.markers,
            min_confidence=self.least.value() / 100,
        )
        # Joints that went wrong together stay together, as they are one row of the queue.
        ids = {i for a in found for i in self._document.decided_with(a.id)}
        self._listed = tuple(a for a in asked if a.id in ids)
        take = session.original
        with QSignalBlocker(self.table):
            self.table.setRowCount(len(self._listed))
            for row, a in enumerate(self._listed):
                for column, text in (
                    (MARKER, PAIRED.join(a.markers)),
                    (FRAMES, span(a, take.first_frame)),
                    (SURE, f"{100 * a.confidence:.0f} %"),
                    (OUTCOME, self._outcome(a)),
                ):
                    self.table.setItem(row, column, _cell(text))
                box = self.table.item(row, MARKER)
                if box is not None:
                    box.setCheckState(Qt.CheckState.Checked)
        # The table's own hint leaves out the room around the box, and cuts the names.
        head, hint = self.table.horizontalHeader(), self.table.sizeHintForColumn(MARKER)
        head.resizeSection(MARKER, max(hint + 16, head.sectionSizeHint(MARKER)))
        self._count()
        missing = tuple(a for a in self._listed if a.id not in self.repairs)
        if self._repairing and missing:
            self.wanted.emit(missing)

    def _outcome(self, a: Artifact) -> str:
        """What will become of an artifact."""
        if not self._repairing:
            return self.tr("rejected as a false alarm, left as it is")
        repair = self.repairs.get(a.id)
        if repair is None:
            return self.tr("working it out…")
        if not repair.patches:
            return self.tr("left as it is: {0}").format(told(repair.reason))
        text = told_repair(repair.method, repair.error_mm, joints=self._document.joints)
        if repair.leaves:
            from markermend.repairs.look_again import in_words

            return f"{text}. {told(in_words(repair.leaves))}"
        # Alone it may be refused: here it can follow what is repaired along with it.
        return f"{text}. {told(repair.reason)}" if repair.reason else text

    def _count(self) -> None:
        """Say how many it will be."""
        waiting = self._repairing and any(a.id not in self.repairs for a in self._listed)
        count = len(self.chosen())
        verb = self.tr("Repair {0}") if self._repairing else self.tr("Reject {0}")
        self.go.setText(verb.format(count))
        self.go.setEnabled(count > 0 and not waiting)
        self.bar.setVisible(waiting)
        left = len(self._listed) - count
        if not self._listed:
            text = self.tr("No open artifact is like this; look further or be less strict.")
        elif waiting:
            one, many = self.tr("Working out 1 repair…"), self.tr("Working out {0} repairs…")
            text = one if len(self._listed) == 1 else many.format(len(self._listed))
        else:
            text = self.tr("One step, undone by {0}.").format(shortcuts.way_to("undo"))
            if left:
                one, many = self.tr("1 is left as it is."), self.tr("{0} are left as they are.")
                text = (one if left == 1 else many.format(left)) + " " + text
        self.said.setText(text)


def _cell(text: str) -> QTableWidgetItem:
    """A cell, told whole where it has no room."""
    item = QTableWidgetItem(text)
    item.setToolTip(text)
    return item
