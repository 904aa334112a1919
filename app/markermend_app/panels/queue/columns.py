"""How wide the columns of the review queue are, and which are left out where room is scarce."""

from __future__ import annotations

from collections.abc import Collection

from PySide6.QtCore import QObject, Qt

from markermend.artifact import Status
from markermend_app.panels.queue.model import (
    AXES,
    CONFIDENCE,
    FRAMES,
    LENGTH,
    MARKER,
    REPAIR,
    SIZE,
    STATUS,
    TIME,
    WHY,
    QueueModel,
)
from markermend_app.panels.queue.view import QueueView

_WIDTHS = (98, 96, 96, 54, 90, 66, 66, 90, 92, 210, 60)
_PADDING = 24
_SPARED = (TIME, LENGTH, AXES)
_SPARED_OF_OPEN, _SPARED_OF_ALL = (SIZE, STATUS, FRAMES), (CONFIDENCE, SIZE, FRAMES, STATUS)
"""Columns that are left out one after the other where room is scarce; tooltips tell them.

Of those that are open the status says nothing, of decided ones how sure a flag was.
"""
_WHY_LEAST, _WHY_LEAST_OF_ALL, _WHY_SPARED, _NAMES_WIDEST = 200, 120, 80, 220
"""Pixels: the reasons' least, how many of these names may take, the most for names."""


class QueueColumns(QObject):
    """Widths as a hand has chosen them, kept of columns that are left out, too.

    Parameters
    ----------
    view : shows the model already
    model : whose rows are listed
    """

    def __init__(self, view: QueueView, model: QueueModel) -> None:
        super().__init__(view)
        self._view, self._model = view, model
        self._fitting = False
        self._names_wide, self._frames_wide = 0, _WIDTHS[FRAMES]
        self._widths = list(_WIDTHS)
        for column, width in enumerate(_WIDTHS):
            view.setColumnWidth(column, width)
        # Some languages have a longer word for what needs least room.
        name = model.headerData(AXES, Qt.Orientation.Horizontal)
        named = view.horizontalHeader().fontMetrics().horizontalAdvance(name) + _PADDING
        self._widths[AXES] = max(_WIDTHS[AXES], named)
        view.setColumnWidth(AXES, self._widths[AXES])
        view.horizontalHeader().sectionResized.connect(self._remember)

    def measure(self) -> bool:
        """Note how wide names and frame numbers are; whether that is otherwise than before."""
        each = {a.markers: a for a in self._model.rows}
        metrics = self._view.fontMetrics()
        wide = [metrics.horizontalAdvance(self._model.text(a, MARKER)) for a in each.values()]
        before = self._names_wide, self._frames_wide
        self._names_wide = max(wide, default=0) + _PADDING
        last = max((a.stop - 1 for a in self._model.rows), default=0) + self._model.first_frame
        frames = metrics.horizontalAdvance(f"{last}–{last}") + _PADDING
        self._frames_wide = max(_WIDTHS[FRAMES], frames)
        # A width that a hand has chosen stays.
        if self._widths[FRAMES] == before[1]:
            self._widths[FRAMES] = self._frames_wide
            self._view.setColumnWidth(FRAMES, self._frames_wide)
        return (self._names_wide, self._frames_wide) != before

    def fit(self, width: int, statuses: Collection[Status]) -> None:
        """Leave room for the reasons; repairs are listed only where something repaired can be.

        Parameters
        ----------
        width : pixels there are for all columns and the scroll bar
        statuses : those listed; empty for all
        """
        repairs = not statuses or Status.REPAIRED in statuses
        hidden = set() if repairs else {REPAIR}
        room = width - self._view.verticalScrollBar().sizeHint().width()
        room -= _WHY_LEAST_OF_ALL if repairs else _WHY_LEAST
        for column in (*_SPARED, *(_SPARED_OF_ALL if repairs else _SPARED_OF_OPEN)):
            if self._taken(hidden) <= room:
                break
            hidden.add(column)
        for column in range(WHY):
            self._view.setColumnHidden(column, column in hidden)
        spare = room + _WHY_SPARED - self._taken(hidden)
        more = min(self._names_wide, _NAMES_WIDEST) - self._widths[MARKER]
        # A width that a hand has chosen stays.
        if self._widths[MARKER] == _WIDTHS[MARKER]:
            self._fitting = True
            self._view.setColumnWidth(MARKER, _WIDTHS[MARKER] + max(0, min(more, spare)))
            self._fitting = False

    def _taken(self, hidden: Collection[int]) -> int:
        """Pixels that the columns before the reasons take where these are left out."""
        return sum(w for c, w in enumerate(self._widths[:WHY]) if c not in hidden)

    def _remember(self, column: int, _: int, width: int) -> None:
        """Remember how wide a column is while it is left out, too."""
        if width and column != WHY and not self._fitting:
            self._widths[column] = width
