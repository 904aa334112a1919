"""Curves and intervals: what is drawn, and what is hit."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication

from markermend.artifact import Artifact, Kind, Status
from markermend_app.items.band import Band
from markermend_app.items.intervals import LANE_HEIGHT, Intervals
from markermend_app.items.points import lone_samples, pieces
from markermend_app.items.time_axis import TimeAxis
from markermend_app.style import theme


@given(arrays(bool, st.integers(1, 60)))
def test_pieces_hold_what_was_asked_for_and_do_not_join_over_holes(mask):
    values = np.arange(len(mask), dtype=float) * 10
    x, y = pieces(values, mask, join=0)
    shown = ~np.isnan(y)
    np.testing.assert_array_equal(x[shown], np.flatnonzero(mask))
    np.testing.assert_array_equal(y[shown], values[mask])
    assert (np.diff(x) > 0).all()
    for i in np.flatnonzero(np.diff(x[shown]) > 1):
        between = (x > x[shown][i]) & (x < x[shown][i + 1])
        assert np.isnan(y[between]).all()
        assert between.any()


def test_pieces_reach_their_neighbours():
    mask = np.zeros(10, dtype=bool)
    mask[4:6] = True
    x, y = pieces(np.arange(10.0), mask)
    np.testing.assert_array_equal(x, [3, 4, 5, 6])
    np.testing.assert_array_equal(y, [3, 4, 5, 6])


def test_lone_samples_are_those_without_neighbours():
    values = np.array([1.0, np.nan, 2.0, 3.0, np.nan, np.nan, 4.0, np.nan])
    assert np.flatnonzero(lone_samples(values)).tolist() == [0, 6]
    assert lone_samples(np.array([5.0])).tolist() == [True]


@pytest.fixture
def shown(qtbot):
    """A plot of 100 frames with intervals of two markers."""
    theme.watcher.theme = theme.LIGHT
    canvas = pg.GraphicsLayoutWidget()
    qtbot.addWidget(canvas)
    canvas.setBackground("w")
    canvas.resize(600, 300)
    view = canvas.addViewBox(enableMenu=False)
    intervals = Intervals()
    view.addItem(intervals, ignoreBounds=True)
    canvas.show()
    qtbot.waitExposed(canvas)
    view.setRange(xRange=(0, 100), yRange=(0, 1), padding=0)
    rows = (
        Artifact("A", "x", 10, 40, Kind.NOISE),
        Artifact("A", "x", 20, 22, Kind.PEAK),
        Artifact("B", "x", 30, 60, Kind.GAP),
        Artifact("A", "x", 70, 90, Kind.STEP, status=Status.REJECTED),
    )
    intervals.show(rows, ["A", "B"])
    qtbot.wait(10)
    return canvas, view, intervals, rows


def _at(view, frame: float, up_px: float) -> QPointF:
    """A point of the scene: a frame, and pixels above the bottom."""
    box = view.sceneBoundingRect()
    return QPointF(view.mapViewToScene(QPointF(frame, 0)).x(), box.bottom() - up_px)


def test_hit_prefers_the_shortest_then_the_current(shown):
    _, view, intervals, rows = shown
    assert intervals.hit(_at(view, 21, 150)) == rows[1].id
    assert intervals.hit(_at(view, 15, 150)) == rows[0].id
    assert intervals.hit(_at(view, 65, 150)) is None
    intervals.set_current(rows[0].id)
    assert intervals.hit(_at(view, 21, 150)) == rows[0].id


def test_lanes_tell_markers_apart(shown):
    _, view, intervals, rows = shown
    assert intervals.hit(_at(view, 35, LANE_HEIGHT / 2)) == rows[0].id
    assert intervals.hit(_at(view, 35, LANE_HEIGHT * 1.5)) == rows[2].id
    assert intervals.hit(_at(view, 15, LANE_HEIGHT * 1.5)) is None


def test_lanes_of_many_markers_leave_the_curves_free(shown):
    _, view, intervals, rows = shown
    intervals.show(rows, ["A", "B", *(f"M{i}" for i in range(25))])
    assert intervals.strip_height <= 3 * LANE_HEIGHT
    assert intervals.hit(_at(view, 35, 0.7)) == rows[0].id
    assert intervals.hit(_at(view, 35, 2.0)) == rows[2].id


def test_lanes_leave_a_low_plot_to_its_curves(shown):
    canvas, view, intervals, rows = shown
    canvas.resize(600, 90)
    QApplication.processEvents()
    assert view.height() < 90
    assert intervals.strip_height <= 0.3 * view.height()
    assert intervals.hit(_at(view, 35, 2)) == rows[0].id
    assert intervals.hit(_at(view, 35, 8)) == rows[2].id


def test_extent_is_none_out_of_view(shown):
    _, view, intervals, rows = shown
    assert intervals.extent(rows[0].id).width() == pytest.approx(
        view.sceneBoundingRect().width() * 0.3, abs=2
    )
    view.setXRange(65, 95, padding=0)
    assert intervals.extent(rows[0].id) is None


def test_what_several_markers_changed_places_in_lies_in_the_lanes_of_all(shown):
    _, view, intervals, _ = shown
    swap = Artifact("A", "x", 10, 40, Kind.STEP, counterpart="B", further_counterparts=("C",))
    intervals.show([swap], ["C", "other", "A"])
    for lane, hit in enumerate((swap.id, None, swap.id)):
        assert intervals.hit(_at(view, 20, LANE_HEIGHT * (lane + 0.5))) == hit
    # Of the foremost marker, it has a band.
    assert intervals._band_alpha(swap) > 0


def test_strip_is_painted_in_the_colour_of_the_class(shown):
    canvas, view, _, _ = shown
    image = canvas.grab().toImage()
    ratio = image.devicePixelRatio()

    def color(frame: float, up: float) -> QColor:
        at = canvas.mapFromScene(_at(view, frame, up))
        return image.pixelColor(int(at.x() * ratio), int(at.y() * ratio))

    assert color(13, LANE_HEIGHT / 2) == theme.LIGHT.kinds[Kind.NOISE]
    assert color(55, LANE_HEIGHT * 1.5) == theme.LIGHT.kinds[Kind.GAP]
    assert color(65, LANE_HEIGHT / 2) == QColor("white")
    assert color(13, 150) != QColor("white")
    # Rejected ones are hollow.
    assert color(75, LANE_HEIGHT / 2) == QColor("white")


def test_every_interval_is_at_least_a_pixel_wide(shown):
    canvas, view, intervals, _ = shown
    intervals.show([Artifact("A", "x", 50_000, 50_001, Kind.PEAK)], ["A"])
    view.setXRange(0, 100_000, padding=0)
    image = canvas.grab().toImage()
    y = int((view.sceneBoundingRect().bottom() - LANE_HEIGHT / 2) * image.devicePixelRatio())
    painted = [x for x in range(image.width()) if image.pixelColor(x, y) != QColor("white")]
    assert 1 <= len(painted) <= 2 * image.devicePixelRatio()


def test_band_leaves_missing_stretches_out():
    band = Band()
    x = np.arange(6.0)
    band.set_data(x, np.array([1, 1, np.nan, 5, 5, 5.0]), np.full(6, 0.5))
    box = band.boundingRect()
    assert (box.left(), box.right(), box.top(), box.bottom()) == (0, 5, 0.5, 5.5)
    band.clear()
    assert band.boundingRect().isEmpty()


def test_time_axis_speaks_in_the_files_numbers(qtbot):
    axis = TimeAxis()
    axis.set_clock(first_frame=101, rate=100.0, frames=950)
    assert axis.tickStrings([99, 199], 1.0, 100) == ["200\n1.0 s", "300\n2.0 s"]
    assert axis.tickStrings([19, 29], 1.0, 10) == ["120\n0.19 s", "130\n0.29 s"]
    for _, values in axis.tickValues(0, 1000, 600):
        assert all(float(v + 101) % 1 == 0 for v in values)
    assert all(spacing >= 1 for spacing, _ in axis.tickValues(0, 2, 600))
    ticks = [v for _, values in axis.tickValues(-30, 990, 600) for v in values]
    assert min(ticks) >= 0
    assert max(ticks) < 950
