"""The line above the queue: which decisions, classes and markers are listed, and how far one is."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QToolButton, QWidget

from markermend.artifact import Artifact, Kind, Status
from markermend_app.panels.markers.badge import kind_icon
from markermend_app.panels.queue.filter_line import FilterLine
from markermend_app.panels.queue.model import Wanted, count_decided
from markermend_app.panels.spared import show_if_it_fits, spare
from markermend_app.style import theme

_STYLES = (
    Qt.ToolButtonStyle.ToolButtonTextBesideIcon,
    Qt.ToolButtonStyle.ToolButtonIconOnly,
)
_BESIDE_PX = 24
"""Pixels that frame and margins take beside the words."""
OPEN = frozenset({Status.PENDING})
ACCEPTED = frozenset({Status.ACCEPTED})
_DECIDED = frozenset({Status.ACCEPTED, Status.REJECTED, Status.REPAIRED})


class QueueFilters(QWidget):
    """Decisions, classes and a part of a marker's name.

    Parameters
    ----------
    target : the list, to which the keyboard goes on

    Signals
    -------
    changed() : something else is wanted
    """

    changed = Signal()

    def __init__(self, target: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(4, 0, 4, 0)
        self._row.setSpacing(4)
        self.status = QComboBox()
        self.status.setAccessibleName(self.tr("Which decisions are listed"))
        for text, statuses in (
            (self.tr("Open"), OPEN),
            (self.tr("Accepted, not repaired"), ACCEPTED),
            (self.tr("Decided"), _DECIDED),
            (self.tr("All"), frozenset()),
        ):
            self.status.addItem(text, statuses)
        # The words for what is rarely listed must not keep the window wide.
        self.status.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.status.setMinimumContentsLength(8)
        entries = self.status.view()
        entries.setMinimumWidth(entries.sizeHintForColumn(0) + _BESIDE_PX)
        self._row.addWidget(self.status)
        self.kinds: dict[Kind, QToolButton] = {}
        for kind in Kind:
            button = QToolButton()
            button.setCheckable(True)
            button.setAccessibleName(self.tr("Only: {0}").format(theme.kind_name(kind)))
            self.kinds[kind] = button
            self._row.addWidget(button)
        self.marker = FilterLine(self.tr("Filter by marker"), target)
        self.marker.setMaximumWidth(220)
        self._row.addWidget(self.marker)
        self._decided, self._chosen = "", 0
        self.progress = QLabel()
        self.progress.setProperty("role", "muted")
        self.progress.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        spare(self.progress)
        self._row.addWidget(self.progress, 1)
        self.setMinimumWidth(self._width_with(_STYLES[-1]))

        self.status.currentIndexChanged.connect(lambda _: self.changed.emit())
        for button in self.kinds.values():
            button.toggled.connect(lambda _: self.changed.emit())
        self.marker.textChanged.connect(lambda _: self.changed.emit())
        theme.watcher.changed.connect(self._recolour)
        self._recolour()

    @property
    def statuses(self) -> frozenset[Status]:
        """Decisions that are listed; none for all."""
        return self.status.currentData()

    @property
    def wanted(self) -> Wanted:
        """What is to be listed."""
        kinds = frozenset(k for k, button in self.kinds.items() if button.isChecked())
        return Wanted(kinds, self.statuses, self.marker.text().strip())

    def clear(self) -> None:
        """List everything that is open."""
        self.marker.clear()
        for button in self.kinds.values():
            button.setChecked(False)
        self.status.setCurrentIndex(0)

    def name_joints(self, joints: bool) -> None:
        """Speak of joints, or of markers."""
        self.marker.set_text(self.tr("Filter by joint") if joints else self.tr("Filter by marker"))

    def count(self, artifacts: Iterable[Artifact]) -> None:
        """Say how far the review is."""
        artifacts = tuple(artifacts)
        decided, total = count_decided(artifacts)
        self._decided = self.tr("{0} of {1} decided").format(decided, total) if total else ""
        self._tell()
        pending = Counter(a.kind for a in artifacts if a.status is Status.PENDING)
        for kind, button in self.kinds.items():
            button.setText(str(pending[kind]))
            number = self.tr("{0} open").format(pending[kind])
            only = self.tr("Only: {0}").format(theme.kind_name(kind))
            button.setToolTip(f"{only} ({number})")

    def say_chosen(self, rows: int) -> None:
        """Say how many rows the next key is about, where that is not just one."""
        self._chosen = rows
        self._tell()

    def _tell(self) -> None:
        chosen = self.tr("{0} rows chosen").format(self._chosen) if self._chosen > 1 else ""
        self.progress.setText(" · ".join(filter(None, (chosen, self._decided))))

    def fit(self, width: int) -> None:
        """Do without the progress, which the status line tells, then without the counts."""
        for style in _STYLES:
            if self._width_with(style) <= width:
                break
        show_if_it_fits(self.progress, self._row, width)

    def _width_with(self, style: Qt.ToolButtonStyle) -> int:
        """The least width when the buttons of the classes look like that."""
        for button in self.kinds.values():
            button.setToolButtonStyle(style)
        self._row.invalidate()
        return self._row.minimumSize().width()

    def _recolour(self) -> None:
        for kind, button in self.kinds.items():
            button.setIcon(kind_icon(kind))
