"""What the overview shows behind each pixel: missing samples, or how far off the body they are."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from PySide6.QtCore import QObject, Signal

from markermend.arrays import FloatArray
from markermend.heat import worst
from markermend.review.edits import Change
from markermend_app.background.jobs import Lane
from markermend_app.document import Document
from markermend_app.later import Later
from markermend_app.panels.overview.missing import Missing
from markermend_app.panels.overview.picture import residual_levels
from markermend_app.panels.overview.residual import Residuals

_MUCH = 2_000_000
"""Samples of which more take long to be looked through for missing ones."""


class Levels(QObject):
    """Kept up with the edits; what takes long comes later.

    Parameters
    ----------
    document : what is open
    first : the jobs that residuals give way to

    Signals
    -------
    changed() : some came
    """

    changed = Signal()

    def __init__(self, document: Document, first: Lane | None, parent: QObject) -> None:
        super().__init__(parent)
        self._document = document
        self.residuals = Residuals(first, self)
        self.residuals.changed.connect(self.changed)
        self._missing = Missing()
        self._moved: set[int] = set()
        self._asked = 1, (0.0, 1.0)
        self._count = Later(self._count_missing, self)

    def forget(self) -> None:
        """Start over with another take, or with other names in the same one."""
        self.residuals.forget()
        if not self._document.renaming:
            self._missing.forget()
            self._moved.clear()

    def note(self, change: Change, columns: Iterable[int]) -> None:
        """Samples of the markers in these columns changed."""
        self.residuals.note(change)
        self._moved.update(columns)

    def catch_up(self) -> bool:
        """Count what is missing of markers that changed; whether there were any."""
        session, moved = self._document.session, sorted(self._moved)
        self._moved.clear()
        if session is None or not moved:
            return False
        self._missing.note(session.take, moved)
        return True

    def of(self, mode: str, width: int, span: tuple[float, float]) -> FloatArray:
        """What is behind each pixel of a picture, or nothing yet.

        Parameters
        ----------
        mode : see :class:`markermend_app.panels.overview.mode.ModeButton`
        width : pixels
        span : frames from the left edge to the right one

        Returns
        -------
        (markers, width) in [0, 1], NaN where nothing is known
        """
        session = self._document.session
        if session is None:
            return np.zeros((0, width))
        take = session.take
        if mode != "residual":
            if self._missing.known or take.origin.size <= _MUCH:
                return self._missing.share(take, width, span)
            self._asked = width, span
            self._count.ask()
            return np.zeros((take.markers, width))
        self.residuals.want(session)
        if self.residuals.values is None:
            return np.full((take.markers, width), np.nan)
        return residual_levels(worst(self.residuals.values, width, *span))

    def _count_missing(self) -> None:
        """Count what is missing of a long take that was just opened."""
        session = self._document.session
        if session is not None:
            self._missing.share(session.take, *self._asked)
            self.changed.emit()
