"""Joint centres of a take: how far to trust each, and why some are left out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QGuiApplication, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QStackedWidget,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from markermend_app import units
from markermend_app.dialogs.help_key import help_in
from markermend_app.panels.markers.naming import short_names
from markermend_app.panels.nothing import Nothing
from markermend_app.style import theme
from markermend_app.telling import told

if TYPE_CHECKING:
    # SciPy comes along, which a window without joints need not wait for.
    from markermend.poses.from_markers import Joint, JointCentres

JOINT, ERROR, DOUBT, TURNING, TOLD_BY = range(5)
_FIGURES = (ERROR, DOUBT, TURNING)
_ROW_PX, _PADDING = 26, 12

Ends = QDialogButtonBox.StandardButton
Role = QDialogButtonBox.ButtonRole


class JointCentresDialog(QDialog):
    """Waits for joint centres, lists them, and offers to save them.

    Parameters
    ----------
    origin : which frames they are worked out from, one sentence
    warning : what makes them doubtful, one sentence; empty for nothing
    parent : the window

    Signals
    -------
    save_wanted(bool) : save what is listed, and open it then or not

    Attributes
    ----------
    found : the joint centres listed; None while they are worked out, and where there are none
    """

    save_wanted = Signal(bool)

    def __init__(self, origin: str, warning: str, parent: QWidget) -> None:
        super().__init__(parent)
        help_in(self)
        self.setWindowTitle(self.tr("Joint centres"))
        self.found: JointCentres | None = None
        self.heading = QLabel()
        self.heading.setProperty("role", "heading")
        self.warning = QLabel(warning)
        self.warning.setProperty("role", "warning")
        self.warning.setVisible(bool(warning))
        self.table = self._make_table()
        self.nothing = Nothing(self.table, "")
        self.doing = QLabel()
        self.bar = QProgressBar()
        self.bar.setRange(0, 1000)
        self.bar.setTextVisible(False)
        self.about, saved = QLabel(origin), QLabel()
        saved.setText(
            self.tr(
                "They are saved as a skeleton recording, a CSV of joints. Error and Doubt are not "
                "in it: copy the table to keep them."
            )
        )
        for label in (self.about, saved, self.doing):
            label.setProperty("role", "muted")
        for label in (self.about, saved, self.warning):
            label.setWordWrap(True)
        work = QWidget()
        lines = QVBoxLayout(work)
        lines.setContentsMargins(0, 0, 0, 0)
        lines.addWidget(self.doing)
        lines.addWidget(self.bar)
        # They take turns in one place, so that nothing moves.
        self._foot = QStackedWidget()
        self._foot.addWidget(saved)
        self._foot.addWidget(work)
        self._foot.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 16, 20, 16)
        column.setSpacing(12)
        for above in (self.heading, self.about, self.warning):
            column.addWidget(above)
        column.addWidget(self.table, 1)
        column.addWidget(self._foot)
        column.addLayout(self._make_buttons())
        theme.watcher.changed.connect(self._list)
        self.resize(min(940, parent.width() - 40), min(620, parent.height() - 40))
        self.show_work(True)

    # The page

    def _make_table(self) -> QTableWidget:
        """The list, empty."""
        table = QTableWidget(0, 5)
        table.setAccessibleName(self.tr("Joint centres"))
        unit = units.unit()
        for column, (title, tip) in enumerate(
            (
                (self.tr("Joint between"), self.tr("The two rigid groups that it joins")),
                (
                    self.tr("Error, {0}").format(unit),
                    self.tr("How far apart the two groups carry the centre, root mean square"),
                ),
                (
                    self.tr("Doubt, {0}").format(unit),
                    self.tr(
                        "How far the centre could move, where the movement tells least, until the "
                        "squared error doubles; a bound rather than an expectation"
                    ),
                ),
                (
                    self.tr("Least turning, °"),
                    self.tr("How much the groups turn about the axis about which they turn least"),
                ),
                (
                    self.tr("Told by"),
                    self.tr("What tells where along its axis the centre of a hinge is"),
                ),
            )
        ):
            item = QTableWidgetItem(title)
            item.setToolTip(tip)
            item.setTextAlignment(_alignment(column))
            table.setHorizontalHeaderItem(column, item)
        table.verticalHeader().hide()
        table.setShowGrid(False)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        table.setTabKeyNavigation(False)
        head = table.horizontalHeader()
        head.setHighlightSections(False)
        head.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        head.setStretchLastSection(True)
        return table

    def _make_buttons(self) -> QHBoxLayout:
        """Copying to the left; saving, and leaving, which is called by what it does."""
        row, buttons = QHBoxLayout(), QDialogButtonBox()
        self.save = buttons.addButton(self.tr("Save…"), Role.AcceptRole)
        self.save_and_open = buttons.addButton(self.tr("Save and open…"), Role.AcceptRole)
        self.save_and_open.setToolTip(
            self.tr("Save, and open the joints here in place of this take")
        )
        self.copy = QPushButton(self.tr("Copy table"))
        self.close_it, self.cancel = buttons.addButton(Ends.Close), buttons.addButton(Ends.Cancel)
        self.save.clicked.connect(lambda: self.save_wanted.emit(False))
        self.save_and_open.clicked.connect(lambda: self.save_wanted.emit(True))
        self.copy.clicked.connect(self._copy)
        buttons.rejected.connect(self.reject)
        row.addWidget(self.copy)
        row.addStretch(1)
        row.addWidget(buttons)
        return row

    # What happens

    def open(self) -> None:
        """Show it, over the window only."""
        super().open()
        self.save.setDefault(True)

    def tell_progress(self, share: float, doing: str) -> None:
        """Show how far the work is, a share of 1."""
        self.bar.setValue(round(1000 * share))
        self.doing.setText(doing)

    def tell(self, found: JointCentres) -> None:
        """List what was found."""
        self.found = found
        self._list()
        self.show_work(False)
        self.save.setFocus()

    def tell_nothing(self, why: str) -> None:
        """Say why there are no joint centres."""
        self.table.horizontalHeader().hide()
        self.nothing.label.setText(why)
        self.nothing.show(True)
        self.show_work(False)
        self.close_it.setFocus()

    def show_work(self, working: bool) -> None:
        """Show the bar while something is done, else what can be done next."""
        self.bar.setValue(0)
        self.doing.clear()
        self._foot.setCurrentIndex(1 if working else 0)
        self.cancel.setVisible(working)
        self.close_it.setVisible(not working)
        self._foot.setVisible(working or self.found is not None)
        for button in (self.save, self.save_and_open, self.copy):
            button.setVisible(working or self.found is not None)
            button.setEnabled(not working)
        self.heading.setText(self._title(working))

    def _title(self, working: bool) -> str:
        """Say how many were found."""
        if self.found is None:
            return self.tr("Working out joint centres") if working else self.tr("No joint centres")
        kept, left_out = _parted(self.found.joints)
        one, many = self.tr("1 joint found"), self.tr("{0} joints found")
        title = one if len(kept) == 1 else many.format(len(kept))
        if left_out:
            title += self.tr(", {0} left out").format(len(left_out))
        return title

    # The list

    def _list(self) -> None:
        """List joints with their figures, then those left out with the reason."""
        if self.found is None:
            return
        kept, left_out = _parted(self.found.joints)
        names = short_names([joint.name for joint in self.found.joints])
        self.table.clearSpans()
        self.table.setRowCount(0)
        for joint in kept:
            self._add(
                joint.name,
                [
                    names[joint.name],
                    units.number(joint.error_mm),
                    units.number(joint.doubt_mm, 0),
                    f"{joint.turning_deg:.1f}",
                    told(joint.along or "movement"),
                ],
            )
        if left_out:
            row = self._add("", [self.tr("Left out")])
            self.table.setSpan(row, JOINT, 1, self.table.columnCount())
            head = self.table.item(row, JOINT)
            assert head is not None
            font = head.font()
            font.setBold(True)
            head.setFont(font)
            head.setFlags(Qt.ItemFlag.ItemIsEnabled)
        for joint in left_out:
            why = told(joint.left_out)
            row = self._add(joint.name, [names[joint.name], why])
            self.table.setSpan(row, ERROR, 1, self.table.columnCount() - ERROR)
            reason = self.table.item(row, ERROR)
            assert reason is not None
            reason.setTextAlignment(_alignment(TOLD_BY))
            reason.setForeground(theme.current().muted)
            reason.setToolTip(why)
        self._fit_rows()

    def _add(self, tip: str, texts: Sequence[str]) -> int:
        """Add a row and return its number."""
        row = self.table.rowCount()
        self.table.insertRow(row)
        for column, text in enumerate(texts):
            item = QTableWidgetItem(text)
            item.setTextAlignment(_alignment(column))
            self.table.setItem(row, column, item)
        first = self.table.item(row, JOINT)
        if first is not None:
            first.setToolTip(tip)
        return row

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Let reasons that have no room go on below."""
        super().resizeEvent(event)
        self._fit_rows()

    def _fit_rows(self) -> None:
        """Make rows as high as their reasons are; the table only looks at a span's first cell."""
        head, metrics = self.table.horizontalHeader(), self.table.fontMetrics()
        width = self.table.viewport().width() - head.sectionSize(JOINT) - _PADDING
        for row in range(self.table.rowCount()):
            height, reason = _ROW_PX, self.table.item(row, ERROR)
            if reason is not None and self.table.columnSpan(row, ERROR) > 1:
                wrap = Qt.TextFlag.TextWordWrap
                text = metrics.boundingRect(0, 0, width, 1000, wrap, reason.text())
                # A line counts for more than a font's height in some fonts.
                lines = round(text.height() / metrics.lineSpacing())
                height += max(lines - 1, 0) * metrics.lineSpacing()
            self.table.setRowHeight(row, height)

    def _copy(self) -> None:
        """Put the table on the clipboard, to be pasted into a spreadsheet."""
        model = self.table.model()
        columns = range(model.columnCount())
        lines = [[model.headerData(c, Qt.Orientation.Horizontal) for c in columns]]
        for row in range(model.rowCount()):
            lines.append([model.index(row, c).data() or "" for c in columns])
        QGuiApplication.clipboard().setText("\n".join("\t".join(line).rstrip() for line in lines))


def _parted(joints: Sequence[Joint]) -> tuple[list[Joint], list[Joint]]:
    """Those with a centre and those left out."""
    return [j for j in joints if not j.left_out], [j for j in joints if j.left_out]


def _alignment(column: int) -> Qt.AlignmentFlag:
    """Figures stand to the right."""
    side = Qt.AlignmentFlag.AlignRight if column in _FIGURES else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter
