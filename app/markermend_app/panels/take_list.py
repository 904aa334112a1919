"""The takes of a batch: how far each is reviewed, and its quality at a glance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import (
    QAbstractListModel,
    QModelIndex,
    QPersistentModelIndex,
    QRectF,
    QSize,
    Qt,
)
from PySide6.QtGui import QFont, QFontMetrics, QIcon, QPainter, QResizeEvent
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QListView,
    QPushButton,
    QSizePolicy,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from markermend_app import units
from markermend_app.actions import shortcuts
from markermend_app.background.batch_review import BatchReview
from markermend_app.background.loading import Glance
from markermend_app.panels.markers.badge import dot_icon, paint_share
from markermend_app.panels.own_ends import OwnEnds
from markermend_app.panels.queue.view import PlainDelegate
from markermend_app.panels.spared import spare
from markermend_app.style import theme
from markermend_app.telling import told
from markermend_app.words import tr

if TYPE_CHECKING:
    from markermend.batch.review import ToReview

Index = QModelIndex | QPersistentModelIndex
ROW = Qt.ItemDataRole.UserRole
_HEIGHT, _ICON, _BAR = 44, 16, 44
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


@dataclass(frozen=True)
class Row:
    """One take, as the list shows it.

    Attributes
    ----------
    item : the take
    glance : how it stands, or None while that is not known
    problem : why it cannot be opened, or empty
    ready : it was made ready to be opened at once
    current : it is open
    """

    item: ToReview
    glance: Glance | None
    problem: str
    ready: bool
    current: bool

    @property
    def share(self) -> float | None:
        """Share of the artifacts that is decided, or None where it was not searched for any."""
        if self.problem or self.glance is None or not self.glance.begun:
            return None
        total = self.glance.decided + self.glance.left
        return self.glance.decided / total if total else 1.0

    def facts(self) -> str:
        """How it stands, and the worst repair."""
        return " · ".join(filter(None, (self.standing(), self.worst())))

    def worst(self) -> str:
        """How far off the worst repair may be; empty where nothing was repaired."""
        worst = None if self.problem or self.glance is None else self.glance.standing.worst_mm
        return "" if worst is None else units.give_or_take(worst)

    def standing(self) -> str:
        """How many artifacts are decided, and what is missing."""
        if self.problem:
            return tr("cannot be opened")
        if self.glance is None:
            return "…"
        s = self.glance.standing
        total = self.glance.decided + self.glance.left
        counted = f"{self.glance.decided}/{total}" if self.glance.begun else tr("not searched")
        exported = tr("exported") if self.glance.exported else ""
        # How many are decided says nothing more where all are, and went into the file.
        done = "" if exported and not self.glance.left else counted
        missing = tr("{0:.1f} % missing").format(100 * s.gap_now)
        return " · ".join(filter(None, (done, exported, missing)))

    def icon(self) -> QIcon:
        """Exported, done, ready to be opened, neither, or not to be opened at all."""
        if self.problem:
            return theme.icon("warning")
        if self.glance is not None and self.glance.exported:
            return theme.icon("export")
        if self.glance is not None and self.glance.done:
            return theme.icon("accept")
        t = theme.current()
        return dot_icon(t.accent if self.ready else t.muted, filled=self.ready, size=_ICON)

    def tip(self) -> str:
        """Everything that is known, in a few lines."""
        lines = [str(self.item.path)]
        if self.problem:
            lines.append(self.problem)
        if self.glance is not None:
            s = self.glance.standing
            lines.append(
                tr("Missing {0:.2%}, in the file {1:.2%}; mended {2:.2%}").format(
                    s.gap_now, s.gap_before, s.mended
                )
            )
            if s.worst_mm is not None:
                worst = units.error(s.worst_mm)
                lines.append(tr("Largest expected error of a repair: {0}").format(worst))
            lines += [
                tr("{0}: {1} open, {2} decided").format(
                    theme.kind_name(kind), s.open.get(kind, 0), s.decided.get(kind, 0)
                )
                for kind in {**s.open, **s.decided}
            ]
        if self.glance is not None and self.glance.exported:
            lines.append(tr("Exported as it stands."))
        if self.ready:
            lines.append(tr("Made ready: it opens at once."))
        return "\n".join(lines)


class TakeList(QWidget):
    """Takes in the order of review; a double click opens one."""

    def __init__(self, batch: BatchReview, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._batch = batch
        self._opened: ToReview | None = None
        self.model = TakeModel(self)
        self.view = QListView()
        self.view.setModel(self.model)
        self.view.setUniformItemSizes(True)
        OwnEnds(self.view)
        self.view.setAccessibleName(self.tr("Takes"))
        self._painter = _RowDelegate(self)
        self.view.setItemDelegate(self._painter)
        self.view.activated.connect(self._open)
        self.told = QLabel()
        self.told.setProperty("role", "muted")
        self.next = QPushButton()
        self.next.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.next.clicked.connect(batch.next_take)
        # Words do not keep the window wide: the key goes first, then they are cut.
        spare(self.told)
        self.next.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        line = QHBoxLayout()
        line.setContentsMargins(8, 4, 8, 4)
        line.setSpacing(12)
        line.addWidget(self.told, 1)
        line.addWidget(self.next)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addLayout(line)
        whole.addWidget(self.view, 1)
        batch.changed.connect(self._refresh)
        shortcuts.watcher.changed.connect(self._refresh)
        theme.watcher.changed.connect(self._refresh)
        self._refresh()

    def _refresh(self) -> None:
        """Show what is known now."""
        batch, current = self._batch, self._batch.current
        rows = [
            Row(
                item,
                batch.glances.get(item.path),
                told(batch.problems.get(item.path, "")),
                batch.ready(item),
                item is current,
            )
            for item in batch.items
        ]
        self.model.set_rows(rows)
        done = sum(row.glance is not None and row.glance.done for row in rows)
        self.told.setText(self.tr("{0} of {1} takes done").format(done, len(rows)) if rows else "")
        self.told.setToolTip(self.told.text())
        self._fit()
        self.next.setEnabled(batch.next_item is not None)
        finished = current is not None and any(
            r.current and r.glance and r.glance.done for r in rows
        )
        role = "primary" if finished else ""
        if self.next.property("role") != role:
            self.next.setProperty("role", role)
            self.next.style().polish(self.next)
        opened, self._opened = self._opened, current
        for i, row in enumerate(rows):
            if row.current:
                if current is not opened:
                    self.view.setCurrentIndex(self.model.index(i))
                self.view.scrollTo(self.model.index(i))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Name the key on the button where there is room."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        short = self.tr("Next take")
        named, widths = shortcuts.with_key(short, "next_take"), []
        for text in (short, named):
            self.next.setText(text)
            widths.append(self.next.sizeHint().width())
        room = self.width() - self.told.sizeHint().width() - 28
        fits = widths[1] <= room
        self.next.setText(named if fits else short)
        self.next.setMinimumWidth(widths[0])
        self.next.setToolTip(named)

    def _open(self, index: QModelIndex) -> None:
        """Open the take of a row."""
        self._batch.open(self.model.rows[index.row()].item)


class TakeModel(QAbstractListModel):
    """Rows of the list."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.rows: list[Row] = []

    def set_rows(self, rows: list[Row]) -> None:
        """Show other takes, or other facts about the same ones."""
        if [r.item for r in rows] == [r.item for r in self.rows]:
            self.rows = rows
            if rows:
                self.dataChanged.emit(self.index(0), self.index(len(rows) - 1))
            return
        self.beginResetModel()
        self.rows = rows
        self.endResetModel()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008, D102
        return 0 if parent.isValid() else len(self.rows)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:  # noqa: D102
        row = self.rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return row.item.name
        if role == ROW:
            return row
        if role == Qt.ItemDataRole.ToolTipRole:
            return row.tip()
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return f"{row.item.name}: {row.facts()}"
        return None


class _RowDelegate(PlainDelegate):
    """Name and worst repair above, and below a small bar and how the take stands."""

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """Two lines, as wide as there is room."""
        return QSize(_BAR, _HEIGHT)

    def paint_cell(self, painter: QPainter, rect: QRectF, row: Row) -> None:
        """Paint both lines."""
        t = theme.current()
        upper, lower = rect.adjusted(_ICON + 6, 4, -4, -_HEIGHT / 2), rect.adjusted(0, 0, -4, -4)
        lower.setLeft(upper.left())
        lower.setTop(upper.bottom())
        row.icon().paint(painter, round(rect.left()), round(upper.center().y() - 8), _ICON, _ICON)
        font, small = QFont(painter.font()), QFont(painter.font())
        font.setWeight(QFont.Weight.DemiBold if row.current else QFont.Weight.Normal)
        small.setPointSize(theme.SMALL_PT)
        painter.setFont(small)
        painter.setPen(t.muted)
        painter.drawText(upper, _RIGHT, row.worst())
        upper.setRight(upper.right() - painter.fontMetrics().horizontalAdvance(row.worst()) - 8)
        painter.setFont(font)
        painter.setPen(t.muted if row.problem else t.text)
        _write(painter, upper, row.item.name, Qt.TextElideMode.ElideLeft)
        painter.setFont(small)
        if row.share is not None:
            bar = QRectF(lower.left(), lower.top(), _BAR, lower.height())
            paint_share(painter, bar, row.share)
            lower.setLeft(bar.right() + 8)
        painter.setPen(t.muted)
        _write(painter, lower, row.standing(), Qt.TextElideMode.ElideRight)


def _write(painter: QPainter, rect: QRectF, text: str, cut: Qt.TextElideMode) -> None:
    """Write a line, cut where there is no room."""
    short = QFontMetrics(painter.font()).elidedText(text, cut, int(rect.width()))
    painter.drawText(rect, Qt.AlignmentFlag.AlignVCenter, short)
