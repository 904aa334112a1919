"""Axes drawn quickly look as pyqtgraph draws them."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
import pytest
from PySide6.QtGui import QImage, QPainter

from markermend_app.items.axis import Axis
from markermend_app.panels.plots.frame import PlotFrame

WIDTH, HEIGHT = 500, 300


@pytest.fixture
def frame(qtbot):
    """A plot of its own, laid out."""
    shown = pg.GraphicsLayoutWidget()
    qtbot.addWidget(shown)
    shown.resize(WIDTH, HEIGHT)
    frame = PlotFrame()
    shown.addItem(frame.plot)
    frame.time.set_clock(101, 100.0, 3000)
    frame.set_place(True, True)
    frame.restyle()
    shown.show()
    shown.grab()
    yield frame
    shown.close()


def published(axis: Axis):
    """Where pyqtgraph puts the edge and the lines, and which numbers it writes."""
    axis.setGrid(255)
    picture = QImage(WIDTH, HEIGHT, QImage.Format.Format_ARGB32)
    painter = QPainter(picture)
    (_, *edge), lines, numbers = axis.generateDrawSpecs(painter)
    painter.end()
    drawn = [(pen.color().alpha(), p, q) for pen, p, q in lines]
    return edge, drawn, [text for _, _, text in numbers]


def said(text) -> str:
    """What a drawn number says, its lines as pyqtgraph has them."""
    return text.text().replace("\N{LINE SEPARATOR}", "\n")


@pytest.mark.parametrize("scale", [1.0, 0.001, 1 / 25.4])
@pytest.mark.parametrize(
    ("time", "values"),
    [((0, 3000), (-1200, 900)), ((500.3, 540.9), (0.012, 0.047)), ((-40, 120), (2.99999, 3.00012))],
)
def test_lines_and_numbers_are_where_pyqtgraph_has_them(frame, time, values, scale):
    frame.values.setScale(scale)
    frame.view.setRange(xRange=time, yRange=values, padding=0)
    frame.view.scene().prepareForPaint()
    for axis in (frame.time, frame.values):
        edge, lines, numbers = published(axis)
        drawing = axis._drawing()
        assert [drawing.edge.p1(), drawing.edge.p2()] == edge
        assert [said(text) for _, text in drawing.numbers] == numbers
        assert numbers
        for (alpha, p, q), line in zip(lines, drawing.lines, strict=True):
            ends = (line.x1(), line.y1(), line.x2(), line.y2())
            np.testing.assert_allclose(ends, (p.x(), p.y(), q.x(), q.y()), atol=1e-6)
            assert abs(drawing.lines_pen.color().alpha() - alpha) <= 2


def test_numbers_follow_what_is_in_view(frame):
    frame.view.setRange(xRange=(0, 100), yRange=(0, 10), padding=0)
    seen = []
    for top in (10, 1000):
        frame.view.setRange(yRange=(0, top), padding=0)
        frame.plot.scene().views()[0].grab()
        seen.append([said(text) for _, text in frame.values.picture.numbers])
    assert max(map(float, seen[0])) <= 10 < max(map(float, seen[1])) <= 1000


def test_an_axis_without_extent_draws_no_numbers(qtbot):
    axis = Axis("left")
    axis.setRange(0.0, 1.0)
    assert not axis._drawing().numbers


def test_frame_and_seconds_are_two_lines_where_both_have_room_in_one(frame):
    frame.time.set_clock(0, 1000.0, 3000)
    frame.time.setRange(0, 12)
    frame.time.picture = None
    heights = [text.size().height() for _, text in frame.time._drawing().numbers]
    metrics = frame.time.fontMetrics() if hasattr(frame.time, "fontMetrics") else None
    assert metrics is None or min(heights) > 1.5 * metrics.height()
    widths = [text.size().width() for _, text in frame.time._drawing().numbers]
    assert len(heights) >= 3
    assert max(heights) == min(heights)
    assert max(widths) < 60


def test_a_take_of_one_frame_has_it_on_its_axis(frame):
    frame.time.set_clock(7, 100.0, 1)
    assert frame.time.tickValues(-0.4, 0.4, 400) == [(1.0, [0.0])]
