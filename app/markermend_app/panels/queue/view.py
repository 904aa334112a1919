"""The table of the review queue: keys for many rows at once, and painted cells."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import (
    QEvent,
    QKeyCombination,
    QModelIndex,
    QPersistentModelIndex,
    QRectF,
    Qt,
    Signal,
)
from PySide6.QtGui import QFontMetrics, QKeyEvent, QKeySequence, QPainter, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from markermend.artifact import PAIRED, Artifact
from markermend_app.actions import shortcuts
from markermend_app.panels.markers.badge import badge_font, paint_badge, paint_share
from markermend_app.panels.queue.model import ARTIFACT, AXES, CONFIDENCE, KIND, MARKER
from markermend_app.style import theme

Index = QModelIndex | QPersistentModelIndex
PADDING_PX = 4
"""Of a cell, as the style sheet has it, on either side."""
VERBS = ("accept", "reject", "repair", "reopen", "remove")


class QueueView(QTableView):
    """Rows of artifacts.

    With several rows selected the review keys mean all of them; with one, the window's actions
    take the key.

    Signals
    -------
    verb(str) : a review key was pressed for several rows
    """

    verb = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(26)
        self.horizontalHeader().setHighlightSections(False)
        self.horizontalHeader().setStretchLastSection(True)
        self._delegates = {
            KIND: _KindDelegate(self),
            AXES: _AxesDelegate(self),
            CONFIDENCE: _ConfidenceDelegate(self),
            MARKER: _MarkerDelegate(self),
        }
        for column, delegate in self._delegates.items():
            self.setItemDelegateForColumn(column, delegate)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the row under the cursor in sight where it was."""
        # A column that is left out has no place on the screen.
        index = self.currentIndex().siblingAtColumn(MARKER)
        seen = index.isValid() and 0 <= self.visualRect(index).top() < event.oldSize().height()
        super().resizeEvent(event)
        if seen:
            self.scrollTo(index)

    def event(self, event: QEvent) -> bool:
        """Keep review keys for itself while several rows are selected."""
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and isinstance(event, QKeyEvent)
            and self._verb_of(event)
        ):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Do what a review key means for several rows."""
        verb = self._verb_of(event)
        if verb:
            self.verb.emit(verb)
        else:
            super().keyPressEvent(event)

    def _verb_of(self, event: QKeyEvent) -> str:
        """What a key means here, or nothing."""
        if len(self.selectionModel().selectedRows()) < 2:
            return ""
        held = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        pressed = QKeySequence(QKeyCombination(held, Qt.Key(event.key()))).toString()
        keys = shortcuts.table()
        return next((verb for verb in VERBS if pressed in keys[verb]), "")


class _MarkerDelegate(QStyledItemDelegate):
    """Names that differ in their last letters stay apart where there is no room for all."""

    def initStyleOption(self, option: QStyleOptionViewItem, index: Index) -> None:
        """As ever, but the middle goes; of several names that of each by itself."""
        super().initStyleOption(option, index)
        option.textElideMode = Qt.TextElideMode.ElideMiddle
        names = option.text.split(PAIRED)
        # Asked how wide it would be, all of it counts.
        if len(names) == 1 or option.rect.width() <= 0:
            return
        style = option.widget.style() if option.widget else QApplication.style()
        edge = 2 * (style.pixelMetric(QStyle.PixelMetric.PM_FocusFrameHMargin) + 1 + PADDING_PX)
        option.text = _joined(names, option.fontMetrics, option.rect.width() - edge)


def _joined(names: Sequence[str], metrics: QFontMetrics, room: int) -> str:
    """Names of markers that change places, whole if they can be, else each without its middle."""
    for between in (PAIRED, PAIRED.strip()):
        if metrics.horizontalAdvance(between.join(names)) <= room:
            return between.join(names)
    each = (room - (len(names) - 1) * metrics.horizontalAdvance(between)) // len(names)
    middle = Qt.TextElideMode.ElideMiddle
    return between.join(metrics.elidedText(name, middle, max(each, 0)) for name in names)


class PlainDelegate(QStyledItemDelegate):
    """Paints a cell's background; subclasses paint what stands on it."""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Background as ever, then the cell's own.

        The option stays as the view made it: to fill it in would ask the model for seven more
        things that are not painted here.
        """
        style = option.widget.style() if option.widget else QApplication.style()
        style.drawPrimitive(
            QStyle.PrimitiveElement.PE_PanelItemViewItem, option, painter, option.widget
        )
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(option.font)
        self.paint_cell(painter, QRectF(option.rect.adjusted(8, 0, -4, 0)), index.data(ARTIFACT))
        painter.restore()

    def paint_cell(self, painter: QPainter, rect: QRectF, a: Any) -> None:
        """Paint what the cell says of its row's object."""


class _KindDelegate(PlainDelegate):
    """Class letter on its colour, and the class's name."""

    def paint_cell(self, painter: QPainter, rect: QRectF, a: Artifact) -> None:
        """Badge and name."""
        t = theme.current()
        font = painter.font()
        painter.setFont(badge_font(font))
        badge = QRectF(rect.left(), rect.center().y() - 8, 16, 16)
        paint_badge(painter, badge, theme.KIND_LETTER[a.kind], t.kinds[a.kind])
        painter.setFont(font)
        painter.setPen(t.text)
        painter.drawText(
            rect.adjusted(22, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, theme.kind_name(a.kind)
        )


class _AxesDelegate(PlainDelegate):
    """Letters of the axes that are wrong, in their colours; the others faint."""

    def paint_cell(self, painter: QPainter, rect: QRectF, a: Artifact) -> None:
        """Three letters, each in its place."""
        t = theme.current()
        x = rect.left()
        for axis in "xyz":
            painter.setPen(t.axes[axis] if axis in a.axes else theme.faded(t.muted, 0.35))
            painter.drawText(
                QRectF(x, rect.top(), 14, rect.height()),
                Qt.AlignmentFlag.AlignVCenter,
                axis.upper(),
            )
            x += 14


class _ConfidenceDelegate(PlainDelegate):
    """A small bar, and the share in percent."""

    def paint_cell(self, painter: QPainter, rect: QRectF, a: Artifact) -> None:
        """Bar and number."""
        number = QFontMetrics(painter.font()).horizontalAdvance("100 %") + 8
        paint_share(painter, rect.adjusted(0, 0, -number, 0), a.confidence)
        painter.setPen(theme.current().text)
        side = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight
        painter.drawText(rect, side, f"{100 * a.confidence:.0f} %")
