"""Rows of the review queue: which artifacts, in which order, and what each cell says."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    Qt,
    Signal,
)

from markermend.artifact import PAIRED, Artifact, Kind, Status, changed_markers
from markermend.review.edits import RepairNote
from markermend.review.events import events
from markermend.review.priority import badness
from markermend.take import Take
from markermend_app import units
from markermend_app.panels.inspector.artifact_text import describe, span
from markermend_app.panels.markers.badge import dot_icon
from markermend_app.panels.markers.naming import paired_name, short_names
from markermend_app.style import theme
from markermend_app.telling import told, told_repair

Index = QModelIndex | QPersistentModelIndex
STATUS, KIND, MARKER, AXES, FRAMES, TIME, LENGTH, SIZE, CONFIDENCE, REPAIR, WHY = range(11)
COLUMNS = 11
RIGHT = (FRAMES, TIME, LENGTH, SIZE)
ARTIFACT = Qt.ItemDataRole.UserRole

_ORDER = {Status.PENDING: 0, Status.ACCEPTED: 1, Status.REPAIRED: 2, Status.REJECTED: 3}
STATUS_ICON = {Status.ACCEPTED: "accept", Status.REJECTED: "reject", Status.REPAIRED: "repair"}


@dataclass(frozen=True)
class Wanted:
    """Which artifacts are listed.

    Attributes
    ----------
    kinds : classes; empty for all
    statuses : decisions; empty for all
    text : part of the marker's or its counterpart's name, in any case
    """

    kinds: frozenset[Kind] = frozenset()
    statuses: frozenset[Status] = frozenset()
    text: str = ""

    def __call__(self, a: Artifact) -> bool:
        """Whether an artifact is listed."""
        name = " ".join(a.markers).lower()
        return (
            (not self.kinds or a.kind in self.kinds)
            and (not self.statuses or a.status in self.statuses)
            and self.text.lower() in name
        )


def describe_length(a: Artifact, rate: float) -> str:
    """Length in frames and in time."""
    ms = 1000 * a.length / rate
    time = f"{ms:.0f} ms" if ms < 1000 else f"{ms / 1000:.1f} s"
    return f"{a.length} f, {time}"


class QueueModel(QAbstractTableModel):
    """Artifacts, filtered and sorted here: a thousand decisions must not each cost a second.

    Attributes
    ----------
    rows : the artifact that stands for each row
    events : what is decided with each row, that artifact first

    Signals
    -------
    order_changed() : other artifacts are listed, or in another order
    """

    order_changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.rows: list[Artifact] = []
        self.events: list[tuple[Artifact, ...]] = []
        self.rate, self.frames = 100.0, 0
        self.first_frame = 1
        self._all: tuple[Artifact, ...] = ()
        self._notes: Mapping[str, RepairNote] = {}
        self._take: Take | None = None
        self._names: Mapping[str, str] = {}
        self._row_of: dict[str, int] = {}
        self._wanted = Wanted()
        self._column, self._descending = STATUS, False
        self._headers = (
            self.tr("Status"),
            self.tr("Class"),
            self.tr("Marker"),
            self.tr("Axes"),
            self.tr("Frames"),
            self.tr("Time"),
            self.tr("Length"),
            self.tr("Size"),
            self.tr("Confidence"),
            self.tr("Repair"),
            self.tr("Why"),
        )
        self._status_names = {
            Status.PENDING: self.tr("Open"),
            Status.ACCEPTED: self.tr("Accepted"),
            Status.REJECTED: self.tr("Rejected"),
            Status.REPAIRED: self.tr("Repaired"),
        }
        self._texts: dict[int, Callable[[Artifact], str]] = {
            STATUS: lambda a: self._status_names[a.status],
            KIND: lambda a: theme.kind_name(a.kind),
            MARKER: self._marker_text,
            AXES: lambda a: a.axes.upper(),
            FRAMES: lambda a: span(a, self.first_frame),
            TIME: lambda a: f"{a.start / self.rate:.2f} s",
            LENGTH: lambda a: f"{a.length} f",
            SIZE: lambda a: units.length(a.amplitude_mm) if math.isfinite(a.amplitude_mm) else "–",
            CONFIDENCE: lambda a: f"{100 * a.confidence:.0f} %",
            REPAIR: self._repair_text,
            WHY: lambda a: f"✎ {a.note} – {told(a.why)}" if a.note else told(a.why),
        }

    def set_artifacts(
        self,
        artifacts: tuple[Artifact, ...],
        notes: Mapping[str, RepairNote],
        take: Take | None,
    ) -> None:
        """Take over what the session holds."""
        self._all, self._notes = artifacts, notes
        if take is not None and take is not self._take:
            self.rate, self.first_frame = take.rate, take.first_frame
            self.frames = take.frames
            self._names = short_names(take.labels)
        self._take = take
        self._arrange()

    def set_wanted(self, wanted: Wanted) -> None:
        """List other artifacts."""
        self._wanted = wanted
        self._arrange()

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        """List in another order; the column of decisions puts open ones first, worst on top."""
        self._column = column if column >= 0 else STATUS
        self._descending = order == Qt.SortOrder.DescendingOrder
        self._arrange()

    def row_of(self, artifact_id: str) -> int | None:
        """Row in which an artifact is listed, or None when it is not."""
        return self._row_of.get(artifact_id)

    def listed(
        self, artifacts: Iterable[Artifact], notes: Mapping[str, RepairNote]
    ) -> list[tuple[Artifact, ...]]:
        """Those of some artifacts that are wanted, in the order that was chosen.

        Joints that went wrong together are one row, for which the worst of them stands.
        """
        wanted = [a for a in artifacts if self._wanted(a)]
        rows: list[tuple[Artifact, ...]] = [(a,) for a in wanted]
        if self._take is not None and self._take.skeleton:
            rows = [self._worst_first(self._take, event) for event in events(wanted)]
        key = self._keys(notes)[self._column]
        rows.sort(key=lambda event: key(event[0]), reverse=self._descending)
        return rows

    def _worst_first(self, take: Take, event: Sequence[Artifact]) -> tuple[Artifact, ...]:
        """An event whose worst artifact comes first; of those as bad the one of the first joint."""

        def key(a: Artifact) -> tuple[float, int]:
            return -round(badness(a, self.rate, self.frames), 3), take.index(a.marker)

        return tuple(sorted(event, key=key))

    def _arrange(self) -> None:
        """Filter and sort; rows that stay in place are only repainted."""
        before, self.events = self.events, self.listed(self._all, self._notes)
        rows = [event[0] for event in self.events]
        ids = [[a.id for a in event] for event in self.events]
        if ids == [[a.id for a in event] for event in before]:
            self.rows = rows
            if rows:
                self.dataChanged.emit(self.index(0, 0), self.index(len(rows) - 1, COLUMNS - 1))
            return
        self.beginResetModel()
        self.rows = rows
        self._row_of = {i: row for row, event in enumerate(ids) for i in event}
        self.endResetModel()
        self.order_changed.emit()

    def _keys(self, notes: Mapping[str, RepairNote]) -> dict[int, Callable[[Artifact], Any]]:
        """Sort key of each column; the order of frames decides ties."""
        kinds = {k: i for i, k in enumerate(Kind)}

        def error(a: Artifact) -> tuple[str, float]:
            note = notes.get(a.id)
            return (note.method, note.error_mm or 0.0) if note else ("", 0.0)

        return {
            STATUS: lambda a: (_ORDER[a.status], -badness(a, self.rate, self.frames)),
            KIND: lambda a: (kinds[a.kind], a.start),
            MARKER: lambda a: (a.marker.lower(), a.start),
            AXES: lambda a: (len(a.axes), a.axes, a.start),
            FRAMES: lambda a: (a.start, a.stop),
            TIME: lambda a: (a.start, a.stop),
            LENGTH: lambda a: (a.length, a.start),
            SIZE: lambda a: (
                a.amplitude_mm if math.isfinite(a.amplitude_mm) else -1.0,
                a.start,
            ),
            CONFIDENCE: lambda a: (a.confidence, a.start),
            REPAIR: error,
            WHY: lambda a: (a.why, a.start),
        }

    # What Qt asks

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008, D102
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008, D102
        return COLUMNS

    def headerData(  # noqa: D102
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        if orientation is not Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            joints = section == MARKER and self._joints
            return self.tr("Joint") if joints else self._headers[section]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            side = Qt.AlignmentFlag.AlignRight if section in RIGHT else Qt.AlignmentFlag.AlignLeft
            return side | Qt.AlignmentFlag.AlignVCenter
        if role == Qt.ItemDataRole.ToolTipRole and section == STATUS:
            return self.tr("Open ones first, the worst on top: size times confidence")
        return None

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:  # noqa: D102
        a = self.rows[index.row()]
        column = index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            return self.text(a, column)
        if role == ARTIFACT:
            return a
        if role == Qt.ItemDataRole.ToolTipRole:
            return None if self._take is None else self._tip(self._take, a)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            side = Qt.AlignmentFlag.AlignRight if column in RIGHT else Qt.AlignmentFlag.AlignLeft
            return side | Qt.AlignmentFlag.AlignVCenter
        if role == Qt.ItemDataRole.DecorationRole and column == STATUS:
            if a.status is Status.PENDING:
                return dot_icon(theme.current().muted, filled=False, size=16)
            return theme.icon(STATUS_ICON[a.status])
        if role == Qt.ItemDataRole.ForegroundRole and (
            a.status is Status.REJECTED or column in (WHY, REPAIR)
        ):
            return theme.current().muted
        return None

    def text(self, a: Artifact, column: int) -> str:
        """What a cell says."""
        return self._texts[column](a)

    def _tip(self, take: Take, a: Artifact) -> str:
        """All that is known, since not every column has room."""
        lines = [describe(take, a), describe_length(a, self.rate)]
        if math.isfinite(a.amplitude_mm):
            lines[1] += f", {units.length(a.amplitude_mm)}"
        rest = [self._named(b) for b in self._with(a)]
        if rest:
            lines.append(self.tr("With it: {0}").format(", ".join(rest)))
        return "\n".join([*lines, *filter(None, [a.note])])

    def _with(self, a: Artifact) -> tuple[Artifact, ...]:
        """What else is decided with the row of an artifact."""
        row = self._row_of.get(a.id)
        return () if row is None else self.events[row][1:]

    def _marker_text(self, a: Artifact) -> str:
        """Who it is, and how many others went wrong with it."""
        more = len(self._with(a))
        if self._take is not None and more + 1 == len(self._take.labels):
            return self.tr("Whole body")
        return f"{self._named(a)} +{more}" if more else self._named(a)

    def _named(self, a: Artifact) -> str:
        """The marker, and those it changes places with, unless it was repaired by itself."""
        note = self._notes.get(a.id)
        markers = changed_markers(a, note.method if note else None)
        names = [self._names.get(m, m) for m in markers]
        return paired_name(names) if self._joints else PAIRED.join(names)

    @property
    def _joints(self) -> bool:
        """Whether it is a skeleton recording."""
        return self._take is not None and self._take.skeleton

    def _repair_text(self, a: Artifact) -> str:
        """How a repaired artifact was repaired."""
        note = self._notes.get(a.id)
        if note is None:
            return ""
        return told_repair(note.method, note.error_mm, joints=self._joints)


def count_decided(artifacts: Iterable[Artifact]) -> tuple[int, int]:
    """How many are decided, and how many there are."""
    statuses = [a.status for a in artifacts]
    return sum(s is not Status.PENDING for s in statuses), len(statuses)
