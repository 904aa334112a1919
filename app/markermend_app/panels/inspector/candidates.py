"""Draws compared repairs over the plots: a thin line each, and a list that names them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor, QPainter, QPixmap
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QWidget

from markermend.artifact import Status
from markermend_app import units
from markermend_app.actions import shortcuts
from markermend_app.items.curve import Curve
from markermend_app.later import Later, OneByOne
from markermend_app.method_words import label_of
from markermend_app.panels.plots.row import PlotRow, same_objects
from markermend_app.panels.plots.trajectories import TrajectoryPanel
from markermend_app.style import theme
from markermend_app.verbs.comparison import MOST, Comparison

_MARGIN = 8


class Candidates(QFrame):
    """The list, below the plots so that it hides none of them, and the lines in the rows."""

    def __init__(self, comparison: Comparison, panel: TrajectoryPanel, window: QWidget) -> None:
        super().__init__(window)
        self._comparison, self._panel, self._window = comparison, panel, window
        self._lines: list[tuple[PlotRow, Curve, int]] = []
        self._drawn: Sequence[object] = ()
        self.setObjectName("floatingButtons")
        self.setAccessibleName(self.tr("Repairs compared"))
        grid = QGridLayout(self)
        grid.setContentsMargins(8, 6, 12, 6)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(2)
        grid.setColumnStretch(1, 1)
        self.rows = tuple((QLabel(), QLabel(), QLabel()) for _ in range(MOST))
        for i, row in enumerate(self.rows):
            for column, label in enumerate(row):
                grid.addWidget(label, i, column)
            row[2].setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.said = QLabel()
        self.said.setProperty("role", "small")
        grid.addWidget(self.said, MOST, 0, 1, 3)
        comparison.changed.connect(Later(self._refresh, self).ask)
        self._turns = OneByOne(self)
        self.hide()

    def _refresh(self) -> None:
        """Show what is compared now."""
        c = self._comparison
        self.setVisible(c.shown)
        found, place = (c.candidates or ()) if c.shown else (), c.place
        self._draw(found)
        self._style()
        if not c.shown:
            return
        current, joints = self._panel.document.current, self._panel.document.joints
        for i, labels in enumerate(self.rows):
            for label in labels:
                label.setVisible(i < len(found))
            if i >= len(found):
                continue
            color, chosen = theme.marker_color(i + 1), i == place
            error = found[i].error_mm
            labels[0].setPixmap(_stroke(color))
            labels[1].setText(label_of(found[i].method, joints=joints))
            labels[2].setText(units.give_or_take(error) if error else "–")
            for label in labels[1:]:
                font = label.font()
                font.setBold(chosen)
                label.setFont(font)
        if c.candidates is None:
            self.said.setText(self.tr("Working out what every method would do…"))
        elif current is not None and current.status is Status.REPAIRED:
            text = self.tr("This is repaired already; {0} takes that back.")
            self.said.setText(text.format(shortcuts.way_to("reopen")))
        elif not found:
            self.said.setText(self.tr("No method has an answer here."))
        else:
            text = self.tr("↑ ↓ choose, {0} repairs. ± is judged by like stretches in sight.")
            if joints:
                text = self.tr(
                    "↑ ↓ choose, {0} repairs. ± is each method's own estimate; Restore skeleton "
                    "comes first unless another is clearly surer."
                )
            text = text.format(shortcuts.way_to("repair"))
            if c.hopeless:
                one = self.tr("1 other method has no answer here.")
                many = self.tr("{0} other methods have no answer here.")
                text += " " + (one if c.hopeless == 1 else many.format(c.hopeless))
            self.said.setText(text)
        self.adjustSize()
        self._place()

    def _place(self) -> None:
        """Stand over the overview, or as low as the window allows."""
        window, panel = self._window, self._panel
        left = int(panel.rows[0].values.width()) + _MARGIN
        corner = panel.mapTo(window, QPoint(left, panel.height() + _MARGIN))
        lowest = window.height() - self.height() - _MARGIN
        self.move(corner.x(), min(corner.y(), lowest))
        self.raise_()

    def _draw(self, found: Sequence[Any]) -> None:
        """Have the candidates drawn row by row, unless they stand there already."""
        wanted = (*found, *self._panel.rows)
        if same_objects(wanted, self._drawn):
            return
        for row, line, _ in self._lines:
            row.view.remove_curve(line)
        self._lines.clear()
        self._drawn = wanted
        for row in self._panel.rows if found else ():
            # Making so many curves takes long.
            self._turns.ask(partial(self._draw_in, row, wanted, found))

    def _draw_in(self, row: PlotRow, wanted: Sequence[object], found: Sequence[Any]) -> None:
        """Draw the candidates in a row, unless others are wanted meanwhile."""
        if wanted is not self._drawn:
            return
        for i, advice in enumerate(found):
            for patch in advice.repair.patches:
                joined = row.joined(patch)
                if joined is not None:
                    line = Curve(theme.marker_color(i + 1))
                    line.set_points(*joined)
                    row.view.add_curve(line)
                    self._lines.append((row, line, i))
        self._style()

    def _style(self) -> None:
        """Let the one that is walked to stand out."""
        place = self._comparison.place
        for _, line, i in self._lines:
            chosen = i == place
            line.wear(theme.marker_color(i + 1), width=2 if chosen else 1)
            line.setZValue(17 if chosen else 16)


def _stroke(color: QColor) -> QPixmap:
    """A stroke in a colour, as the line has it."""
    pixmap = QPixmap(18, 10)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.fillRect(0, 4, 18, 2, color)
    painter.end()
    return pixmap
