"""How much to smooth, where and by what method, seen before it is done."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt, QTimer, Signal
from PySide6.QtGui import QShortcut
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from markermend.arrays import ByteArray, FloatArray
from markermend.artifact import Artifact, Kind
from markermend.take import AXES, Take
from markermend_app.actions import shortcuts
from markermend_app.dialogs.help_key import help_in
from markermend_app.dialogs.params_form import ParamsForm
from markermend_app.dialogs.smooth_pictures import SmoothPictures
from markermend_app.scope import Scope
from markermend_app.style import theme
from markermend_app.telling import told
from markermend_app.words import tr

_PATIENCE_MS = 150
"""A value that is still being turned is not worked out yet."""


@dataclass(frozen=True, eq=False)
class Smoothed:
    """What smoothing would make of a take.

    Attributes
    ----------
    take : the smoothed one
    markers : labels of those that were smoothed
    start, stop : in these frames
    positions, origin : (frames, markers, 3) float64 mm and (frames, markers) uint8, of those
    percent : (markers, 3) %SM1
    """

    take: Take
    markers: tuple[str, ...]
    start: int
    stop: int
    positions: FloatArray
    origin: ByteArray
    percent: FloatArray

    @property
    def changed(self) -> bool:
        """Whether any sample is another one."""
        return bool(self.percent.any())


class SmoothDialog(QDialog):
    """Method and scope on the left, the preview on the right.

    Parameters
    ----------
    take : as it stands
    scopes : where it can be done, the one proposed first
    marker : looked at first
    frame : the cursor
    method, values : smoother to begin with, and its parameters
    damage : artifacts that were not repaired
    parent : the window

    Signals
    -------
    wanted() : what is chosen has to be worked out; the last answer no longer holds
    look_wanted() : the marker looked at has to be inspected

    Attributes
    ----------
    answer : :class:`Smoothed` for what is chosen, or None while it is worked out
    """

    wanted = Signal()
    look_wanted = Signal()

    def __init__(
        self,
        take: Take,
        scopes: Sequence[Scope],
        marker: str,
        frame: int,
        method: str,
        values: Mapping[str, Any],
        damage: Sequence[Artifact],
        pictures: SmoothPictures,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.pictures, self._joints = pictures, take.skeleton
        help_in(self)
        from markermend.smoothers import SMOOTHERS

        self.setWindowTitle(self.tr("Smooth"))
        self._take, self._smoothers, self._damage = take, SMOOTHERS, damage
        self.answer: Smoothed | None = None
        self._found: Any = None
        self._make_choices(scopes)
        self._make_view(frame, scopes[0])
        self._lay_out()
        self._patience = QTimer(self, singleShot=True, interval=_PATIENCE_MS)
        self._patience.timeout.connect(self._ask)
        self.method.setCurrentIndex(max(0, self.method.findData(method)))
        self._method_chosen(values)
        self._offer_markers(marker)
        self._say_damage()
        self.scope.currentIndexChanged.connect(self._scope_chosen)
        self.method.currentIndexChanged.connect(lambda _: self._method_chosen({}))
        self.params.changed.connect(self._want)
        self.marker.currentIndexChanged.connect(self._other_marker)
        self.axis.currentIndexChanged.connect(lambda _: self._draw())
        self.quantity.currentIndexChanged.connect(lambda _: self._draw())
        self.before.toggled.connect(lambda _: self._draw())
        theme.watcher.changed.connect(self._restyle)
        self.resize(1160, 720)

    # The page

    def _make_choices(self, scopes: Sequence[Scope]) -> None:
        """Where, and how."""
        self.scope, self.method = QComboBox(), QComboBox()
        for scope in scopes:
            self.scope.addItem(scope.text, scope)
        for smoother in self._smoothers.values():
            self.method.addItem(tr(smoother.label), smoother.name)
        self.summary = QLabel()
        self.summary.setProperty("role", "muted")
        self.summary.setWordWrap(True)
        self.params = ParamsForm()
        self.percent = QLabel()
        self.warning = QLabel()
        self.damage = QLabel()
        for label in (self.warning, self.damage):
            label.setProperty("role", "warning")
        for label in (self.percent, self.warning, self.damage):
            label.setWordWrap(True)
        self.bar = QProgressBar()
        self.bar.setRange(0, 1000)
        self.bar.setTextVisible(False)
        policy = self.bar.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        self.bar.setSizePolicy(policy)

    def _make_view(self, frame: int, scope: Scope) -> None:
        """What is looked at."""
        self.marker, self.axis, self.quantity = QComboBox(), QComboBox(), QComboBox()
        self.axis.addItems([a.upper() for a in AXES])
        self.quantity.addItem(self.tr("Position"), (0, "mm", 1.0))
        self.quantity.addItem(self.tr("Velocity"), (1, "m/s", 1e-3))
        self.quantity.addItem(self.tr("Acceleration"), (2, "m/s²", 1e-3))
        self.before = QCheckBox(self.tr("Before"))
        self.before.setToolTip(shortcuts.with_key(self.tr("Before smoothing"), "before_after"))
        for key in shortcuts.table()["before_after"]:
            QShortcut(key, self, self.before.toggle)
        take = self._take
        self.pictures.start_over()
        self.pictures.set_clock(take.first_frame, take.rate, take.frames)
        start, stop = frame - round(1.5 * take.rate), frame + round(1.5 * take.rate)
        if scope.stop is not None:
            margin = (scope.stop - scope.start) // 4 + 2
            start, stop = scope.start - margin, scope.stop + margin
        self.pictures.show_frames(max(0, start), min(take.frames - 1, stop))

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        form.setVerticalSpacing(8)
        form.addRow(self.tr("Where"), self.scope)
        self.scope.setAccessibleName(self.tr("Where"))
        form.addRow(self.tr("Method"), self.method)
        self.method.setAccessibleName(self.tr("Method"))
        left = QWidget()
        left.setFixedWidth(320)
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 8, 0)
        column.setSpacing(8)
        column.addLayout(form)
        column.addWidget(self.summary)
        column.addWidget(self.params)
        column.addWidget(self.damage)
        column.addStretch(1)
        column.addWidget(self.percent)
        column.addWidget(self.warning)
        row = QHBoxLayout()
        for box, name in (
            (
                self.marker,
                self.tr("Joint looked at") if self._joints else self.tr("Marker looked at"),
            ),
            (self.axis, self.tr("Axis looked at")),
            (self.quantity, self.tr("Quantity looked at")),
        ):
            box.setAccessibleName(name)
            row.addWidget(box)
        row.addStretch(1)
        row.addWidget(self.before)
        right = QVBoxLayout()
        right.addLayout(row)
        right.addWidget(self.pictures, 1)
        self.pictures.show()
        sides = QHBoxLayout()
        sides.addWidget(left)
        sides.addLayout(right, 1)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.go = QPushButton(self.tr("Smooth"))
        buttons.addButton(self.go, QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.addLayout(sides, 1)
        column.addWidget(self.bar)
        column.addWidget(buttons)

    # What is chosen

    @property
    def chosen_scope(self) -> Scope:
        """Where."""
        scope: Scope = self.scope.currentData()
        return scope

    @property
    def chosen_method(self) -> str:
        """Name of the smoother."""
        return str(self.method.currentData())

    @property
    def looked_at(self) -> str:
        """Label of the marker drawn."""
        return self.marker.currentText()

    def open(self) -> None:
        """Show it, over the window only."""
        super().open()
        self.go.setDefault(True)
        self.method.setFocus()
        self._ask()

    def _scope_chosen(self) -> None:
        self._offer_markers(self.looked_at)
        self._say_damage()
        self._want()

    def _say_damage(self) -> None:
        """Say what a smoother would spread; where nothing was recorded there is nothing to."""
        scope = self.chosen_scope
        left = [a for a in self._damage if a.kind is not Kind.GAP and scope.reaches(a)]
        one = self.tr("1 artifact there is not repaired. Smoothing spreads damage: repair first.")
        many = self.tr(
            "{0} artifacts there are not repaired. Smoothing spreads damage: repair first."
        )
        self.damage.setText((one if len(left) == 1 else many.format(len(left))) if left else "")
        self.damage.setVisible(bool(left))

    def _method_chosen(self, values: Mapping[str, Any]) -> None:
        smoother = self._smoothers[self.chosen_method]
        self.summary.setText(tr(smoother.summary))
        self.params.show_params(smoother.params(**values))
        self._want()

    def _offer_markers(self, marker: str) -> None:
        """List the markers of the scope, to be looked at."""
        scope = self.chosen_scope
        labels = [s for s in self._take.labels if scope.markers is None or s in scope.markers]
        with QSignalBlocker(self.marker):
            self.marker.clear()
            self.marker.addItems(labels)
            self.marker.setCurrentIndex(max(0, self.marker.findText(marker)))

    def _want(self) -> None:
        """Let go of the answer, which no longer fits, and soon ask for another."""
        self.answer, self._found = None, None
        self.go.setEnabled(False)
        self._patience.start()

    def _ask(self) -> None:
        """Have what is chosen worked out."""
        self._patience.stop()
        self.answer, self._found = None, None
        self.go.setEnabled(False)
        self.bar.setValue(0)
        self.bar.show()
        self.wanted.emit()

    def _other_marker(self) -> None:
        self._found = None
        self._draw()
        self.look_wanted.emit()

    # What comes back

    def tell(self, answer: Smoothed) -> None:
        """Show what smoothing would make of the take."""
        self.answer = answer
        self.bar.hide()
        self.go.setEnabled(answer.changed)
        self._draw()
        self.look_wanted.emit()

    def tell_found(self, found: Any) -> None:
        """Show the spectra of the marker looked at."""
        self._found = found
        self._draw()

    def tell_problem(self, error: Exception) -> None:
        """Say why there is no preview."""
        self.bar.hide()
        self._draw()
        self.percent.clear()
        self.warning.setText(told(str(error)))

    def _draw(self) -> None:
        """Draw marker and axis that are looked at, and say how much of the way goes."""
        from markermend.smoothers.bands import acceleration, velocity

        axis, (order, unit, factor) = self.axis.currentIndex(), self.quantity.currentData()
        column, factor = self._take.index(self.looked_at), factor * self._take.rate**order
        derive = (np.asarray, velocity, acceleration)[order]
        color = theme.current().axes[AXES[axis]]
        raw = derive(self._take.positions[:, column, axis]) * factor
        smooth = None
        if self.answer is not None and not self.before.isChecked():
            smooth = derive(self.answer.take.positions[:, column, axis]) * factor
        name = f"{self.looked_at} {AXES[axis].upper()}"
        self.pictures.show_way(raw, smooth, name, unit, color)
        self.pictures.show_inspection(self._found, axis, color)
        self._say_percent()

    def _say_percent(self) -> None:
        """%SM1 of the marker looked at, and whether any is doubtful."""
        from markermend.smoothers import TOO_MUCH

        answer = self.answer
        self.percent.clear()
        self.warning.clear()
        if answer is None:
            return
        mine = answer.percent[answer.markers.index(self.looked_at)]
        values = "  ".join(f"{a.upper()} {v:z.1f}" for a, v in zip(AXES, mine, strict=True))
        meaning = self.tr(
            "%SM1: how much shorter the way of the marker becomes on each axis. Noise makes it "
            "longer; above {0:g} % some of the movement may go, too."
        )
        self.percent.setToolTip(meaning.format(TOO_MUCH))
        self.percent.setText(self.tr("%SM1 of {0}:  {1}").format(self.looked_at, values))
        above = (answer.percent > TOO_MUCH).any(axis=1)
        if not answer.changed:
            self.warning.setText(self.tr("Nothing changes: the stretches seen are too short."))
        elif above.any():
            most, axis = np.unravel_index(answer.percent.argmax(), answer.percent.shape)
            text = self.tr(
                "{0} of {1} markers lose more than {2:g} % of their way, {3} most ({4} {5:.0f}). "
                "Look whether movement went with the noise."
            )
            if self._joints:
                text = self.tr(
                    "{0} of {1} joints lose more than {2:g} % of their way, {3} most "
                    "({4} {5:.0f}). Look whether movement went with the noise."
                )
            if above.sum() == 1:
                text = self.tr(
                    "{3} loses more than {2:g} % of its way ({4} {5:.0f}). "
                    "Look whether movement went with the noise."
                )
            self.warning.setText(
                text.format(
                    int(above.sum()),
                    len(answer.markers),
                    TOO_MUCH,
                    answer.markers[most],
                    AXES[axis].upper(),
                    answer.percent[most, axis],
                )
            )

    def _restyle(self) -> None:
        self.pictures.restyle()
        self._draw()
