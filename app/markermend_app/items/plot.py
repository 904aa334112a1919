"""An area of curves with an axis on its left and one below it."""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtWidgets import QGraphicsGridLayout, QGraphicsItem, QSizePolicy

_MARGIN = 1


class Plot(pg.GraphicsWidget):
    """A view and its two axes.

    pyqtgraph's own comes with two more axes, a title, a button and a menu of forty widgets, which
    took half of the time in which a row is made.

    Parameters
    ----------
    view : the area
    left, bottom : its axes; their lines lie behind all that the view holds
    """

    def __init__(self, view: pg.ViewBox, left: pg.AxisItem, bottom: pg.AxisItem) -> None:
        super().__init__()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        grid = QGraphicsGridLayout()
        grid.setContentsMargins(_MARGIN, _MARGIN, _MARGIN, _MARGIN)
        grid.setSpacing(0)
        self.setLayout(grid)
        grid.addItem(view, 0, 1)
        for axis, row, column in ((left, 0, 0), (bottom, 1, 1)):
            axis.linkToView(view)
            grid.addItem(axis, row, column)
            axis.setZValue(-1000)
            axis.setFlag(QGraphicsItem.GraphicsItemFlag.ItemNegativeZStacksBehindParent)
        grid.setRowStretchFactor(0, 100)
        grid.setColumnStretchFactor(1, 100)
