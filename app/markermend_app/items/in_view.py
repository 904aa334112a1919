"""What fills the view it is in, wherever that goes."""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtCore import QRectF


class InView(pg.GraphicsObject):
    """An item that paints what is in view, and has no part in what comes into view."""

    def boundingRect(self) -> QRectF:
        """Everything in view."""
        return QRectF(self.viewRect()) if self.getViewBox() is not None else QRectF()

    def dataBounds(self, axis: int, frac: float = 1.0, orthoRange: object = None) -> None:
        """Take no part in fitting the view."""

    def viewRangeChanged(self, *_: object) -> None:
        """Follow the view."""
        self.prepareGeometryChange()
        self.update()
