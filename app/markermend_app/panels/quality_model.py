"""How a take and its markers stand, as rows of figures in any order."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    Qt,
)
from PySide6.QtGui import QFont

from markermend.review.standing import Standing
from markermend_app import units
from markermend_app.panels.markers.naming import short_names
from markermend_app.style import theme
from markermend_app.words import tr

Index = QModelIndex | QPersistentModelIndex
MARKER, OPEN, BEFORE, NOW, MENDED, MEAN, WORST, DECIDED = range(8)
COLUMNS = 8
COUNTS = Qt.ItemDataRole.UserRole
_KEYS: Mapping[int, Callable[[Standing], Any]] = MappingProxyType(
    {
        MARKER: lambda s: s.marker.casefold(),
        BEFORE: lambda s: s.gap_before,
        NOW: lambda s: s.gap_now,
        MENDED: lambda s: s.mended,
        OPEN: lambda s: sum(s.open.values()),
        DECIDED: lambda s: sum(s.decided.values()),
        MEAN: lambda s: -1.0 if s.mean_mm is None else s.mean_mm,
        WORST: lambda s: -1.0 if s.worst_mm is None else s.worst_mm,
    }
)


class QualityModel(QAbstractTableModel):
    """One row for each marker; a take's row has no marker's name and is heavier.

    Attributes
    ----------
    whole : what the take's row is called
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.rows: tuple[Standing, ...] = ()
        self._joints = False
        self.whole = take_name()
        self._names: Mapping[str, str] = {}
        self._by, self._order = OPEN, Qt.SortOrder.DescendingOrder

    def set_standings(self, standings: Sequence[Standing]) -> None:
        """Take over how markers stand, in the take's order."""
        rows = self._sorted(standings)
        self._names = short_names([s.marker for s in rows])
        if [s.marker for s in rows] == [s.marker for s in self.rows]:
            self.rows = rows
            if rows:
                self.dataChanged.emit(self.index(0, 0), self.index(len(rows) - 1, COLUMNS - 1))
        else:
            self.beginResetModel()
            self.rows = rows
            self.endResetModel()

    def say_joints(self, joints: bool) -> None:
        """Say that rows are joints of a skeleton recording, or that they are markers."""
        self._joints = joints
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, MARKER, MARKER)

    def row_of(self, marker: str) -> int | None:
        """Where a marker stands, if it is listed."""
        return next((i for i, s in enumerate(self.rows) if s.marker == marker), None)

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        """Order the markers; those that are alike stay as they were."""
        self._by, self._order = column, order
        self.beginResetModel()
        self.rows = self._sorted(self.rows)
        self.endResetModel()

    def _sorted(self, rows: Sequence[Standing]) -> tuple[Standing, ...]:
        down = self._order == Qt.SortOrder.DescendingOrder
        return tuple(sorted(rows, key=_KEYS[self._by], reverse=down))

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Listed ones."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Always the same."""
        return 0 if parent.isValid() else COLUMNS

    def headerData(
        self,
        section: int,
        orientation: Qt.Orientation,
        role: int = Qt.ItemDataRole.DisplayRole,
    ) -> Any:
        """Names of the columns, and in words what they say."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            joints = self._joints and section == MARKER
            return tr("Joint") if joints else _titles()[section][0]
        if role == Qt.ItemDataRole.ToolTipRole:
            return _titles()[section][1]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _alignment(section)
        return None

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Figures, grey where there is nothing to look at."""
        row, column = self.rows[index.row()], index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            whole = column == MARKER and not row.marker
            return self.whole if whole else _text(row, column, self._names)
        if role == Qt.ItemDataRole.ToolTipRole and column == MARKER:
            return row.marker
        if role == COUNTS:
            return row.open if column == OPEN else row.decided
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _alignment(column)
        if role == Qt.ItemDataRole.FontRole and not row.marker:
            return take_font()
        if role == Qt.ItemDataRole.ForegroundRole:
            t = theme.current()
            if column == NOW and row.gap_now >= 0.1:
                return t.warning
            return t.text if column == MARKER or _KEYS[column](row) > 0 else t.muted
        return None


def take_font() -> QFont:
    """How the take is written above its markers."""
    font = QFont()
    font.setPointSize(theme.BASE_PT)
    font.setWeight(QFont.Weight.DemiBold)
    return font


def take_name() -> str:
    """What the take is called above its markers."""
    return tr("Whole take")


def _text(row: Standing, column: int, names: Mapping[str, str]) -> str:
    """What a cell says; badges speak for the counts, to those who see them."""
    if column == MARKER:
        return names[row.marker]
    if column in (OPEN, DECIDED):
        counts = row.open if column == OPEN else row.decided
        return ", ".join(
            f"{n} {theme.kind_name(kind, within=True)}" for kind, n in counts.items() if n
        )
    if column in (MEAN, WORST):
        error = row.mean_mm if column == MEAN else row.worst_mm
        return "–" if error is None else units.error(error)
    return _percent(_KEYS[column](row))


def _percent(share: float) -> str:
    """A share in percent; what is there is never written as nothing."""
    return "0 %" if share == 0 else "<0.1 %" if share < 0.001 else f"{100 * share:.1f} %"


def _alignment(column: int) -> Qt.AlignmentFlag:
    """Figures stand right, so that they can be compared."""
    side = Qt.AlignmentFlag.AlignLeft
    if column not in (MARKER, OPEN, DECIDED):
        side = Qt.AlignmentFlag.AlignRight
    return side | Qt.AlignmentFlag.AlignVCenter


def _titles() -> tuple[tuple[str, str], ...]:
    """Names of the columns and what they mean, in the language spoken."""
    return (
        (tr("Marker"), tr("Click to see it in the plots, double-click for its worst artifact")),
        (tr("Open"), tr("Artifacts to be decided, by class")),
        (tr("Missing"), tr("Share of frames in which the file has no sample")),
        (tr("Now"), tr("Share of frames without a sample as the take stands")),
        (tr("Mended"), tr("Share of frames that were filled or edited")),
        (
            tr("Error"),
            tr("Mean expected error of the repairs, each counted by its length"),
        ),
        (tr("Worst"), tr("Largest expected error of a repair")),
        (tr("Decided"), tr("Artifacts accepted, rejected or repaired, by class")),
    )
