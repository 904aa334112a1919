"""A curve in a plot: what of it is drawn, and that nothing that matters is lost on the way."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QGuiApplication, QImage

from markermend_app.items.curve import Curve, CurveView
from markermend_app.items.points import pieces, thinned_points, thinned_values

BLACK = QColor("black")


@pytest.fixture
def view(qtbot):
    """The area of a plot, 400 pixels wide and 200 high, of frames 0 to 400 and values -1 to 1."""
    canvas = pg.GraphicsView()
    qtbot.addWidget(canvas)
    canvas.setBackground("w")
    area = CurveView(enableMenu=False, border=None)
    canvas.setCentralItem(area)
    canvas.resize(400, 200)
    area.setRange(xRange=(0, 400), yRange=(-1, 1), padding=0)
    area.canvas = canvas
    return area


def picture(view) -> np.ndarray:
    """(height, width) how dark each pixel is, 0 to 1."""
    image: QImage = view.canvas.grab().toImage().convertToFormat(QImage.Format.Format_Grayscale8)
    flat = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return 1.0 - flat[:, : image.width()] / 255.0


def test_each_value_is_drawn_where_it_belongs(view):
    curve = Curve(BLACK)
    view.add_curve(curve)
    values = np.where(np.arange(401) < 200, -0.5, 0.5)
    values[100:150] = np.nan
    curve.set_values(values)
    dark = picture(view)
    rows = np.argmax(dark, axis=0)
    assert set(rows[5:95]) <= {149, 150}
    assert set(rows[205:395]) <= {49, 50}
    assert dark[:, 102:148].max() == 0.0


def test_other_frames_and_other_sizes_are_drawn_afresh(view):
    curve = Curve(BLACK)
    view.add_curve(curve)
    values = np.full(100_000, -0.5)
    values[60_000:] = 0.5
    curve.set_values(values)
    assert picture(view)[140:160, 5:395].max(axis=0).min() > 0.2
    view.setRange(xRange=(60_100, 60_500), padding=0)
    dark = picture(view)
    assert dark[40:60, 5:395].max(axis=0).min() > 0.2
    assert dark[100:].max() == 0.0
    drawn = curve.path().elementCount()
    view.canvas.resize(200, 200)
    view.setRange(xRange=(0, 100_000), padding=0)
    picture(view)
    assert curve.path().elementCount() <= 2 * 202 < drawn + 10


def test_nothing_is_drawn_where_all_is_missing(view):
    curve = Curve(BLACK)
    view.add_curve(curve)
    values = np.full(1000, np.nan)
    values[600:] = 0.0
    curve.set_values(values)
    assert picture(view).max() == 0.0
    view.setRange(xRange=(500, 900), padding=0)
    dark = picture(view)
    assert dark[:, :98].max() == 0.0
    assert dark[95:105, 105:395].max(axis=0).min() > 0.2


def test_what_was_emptied_or_taken_out_is_drawn_no_longer(view):
    curve = Curve(BLACK)
    view.add_curve(curve)
    curve.set_values(np.zeros(401))
    assert picture(view).max() > 0.5
    curve.clear()
    assert picture(view).max() == 0.0
    curve.set_points(np.arange(10.0), np.zeros(10))
    assert picture(view)[:, :9].max() > 0.5
    view.remove_curve(curve)
    assert picture(view).max() == 0.0
    assert view.curves == ()
    curve.set_values(np.zeros(401))


def test_points_without_neighbours_are_drawn_as_dots(view):
    dots = Curve(BLACK, dots=True)
    view.add_curve(dots)
    dots.set_points(np.array([100.0, 150.0, 200.0]), np.array([0.0, np.nan, 0.0]))
    dark = picture(view)
    assert dark[97:104, 97:104].sum() == pytest.approx(4 * np.pi, rel=0.3)
    assert dark[97:104, 197:204].sum() == pytest.approx(4 * np.pi, rel=0.3)
    assert dark[:, 104:196].max() == 0.0


def test_a_single_point_is_drawn_and_goes(view):
    dots, other = Curve(BLACK, dots=True), Curve(BLACK)
    for curve in (dots, other):
        view.add_curve(curve)
    dots.set_points(np.array([100.0]), np.array([0.5]))
    assert picture(view)[47:54, 97:104].sum() == pytest.approx(4 * np.pi, rel=0.3)
    dots.set_points(np.array([3.0]), np.array([0.0]))
    assert picture(view)[97:104, :8].max() > 0.5
    dots.clear()
    other.set_values(np.full(401, 0.9))
    # A curve without extent is thought to be at frame 0 and value 0, which is in view.
    view.setRange(xRange=(-10, 390), padding=0)
    assert picture(view)[20:].max() == 0.0


def test_a_single_point_at_the_origin_goes_as_well(view):
    dots = Curve(BLACK, dots=True)
    view.add_curve(dots)
    dots.set_points(np.zeros(1), np.zeros(1))
    assert picture(view).max() > 0.5
    dots.clear()
    assert picture(view).max() == 0.0


def test_wide_lines_are_as_wide_on_fine_screens(view, monkeypatch):
    wide = Curve(BLACK, width=2)
    view.add_curve(wide)
    values = np.zeros(401)
    values[200:210] = np.nan
    wide.set_values(values)
    dark = picture(view)
    assert dark[:, 50].sum() == pytest.approx(2.0, abs=0.2)
    assert dark[:, 202:208].max() == 0.0
    monkeypatch.setattr(QGuiApplication, "devicePixelRatio", lambda _: 2.0)
    wide.wear(BLACK, width=2)
    assert picture(view)[:, 50].sum() == pytest.approx(4.0, abs=0.2)
    wide.wear(BLACK)
    assert picture(view)[:, 50].sum() == pytest.approx(1.0, abs=0.2)
    wide.wear(BLACK, width=2, style=Qt.PenStyle.DashLine)
    assert wide.worn.widthF() == 2.0
    Curve(BLACK, dots=True).wear(BLACK, width=9)


def test_a_mouse_hits_no_curve(view):
    curve = Curve(BLACK)
    view.add_curve(curve)
    curve.set_values(np.zeros(401))
    picture(view)
    assert curve not in view.scene().items(QRectF(0, 0, 400, 200))
    assert curve not in view.scene().items(QPointF(200, 100))


def test_values_out_of_all_measure_spoil_nothing(view):
    curve = Curve(BLACK)
    view.add_curve(curve)
    values = np.zeros(401)
    values[100], values[200], values[300] = 1e300, -np.inf, np.inf
    curve.set_values(values)
    dark = picture(view)
    assert dark[95:105, 210:290].max(axis=0).min() > 0.2


def test_a_view_without_room_is_left_alone(view):
    curve = Curve(BLACK)
    view.add_curve(curve)
    curve.set_values(np.zeros(401))
    view.resize(0, 0)
    view.prepareForPaint()


@given(
    count=st.integers(0, 3000),
    low=st.floats(-500, 3000),
    span=st.floats(1, 4000),
    step=st.sampled_from([0.1, 1.0, 2.5]),
    seed=st.integers(0, 9),
)
def test_thinned_values_keep_extremes_and_holes(count, low, span, step, seed):
    rng = np.random.default_rng(seed)
    values = rng.normal(size=count)
    values[rng.random(count) < 0.02] = np.nan
    x, y = thinned_values(values, step, (low, low + span, 100.0))
    assert len(x) == len(y) <= 3 * 100 + 8
    assert (np.diff(x) >= 0).all()
    at = step * np.arange(count)
    seen = (at >= low) & (at <= low + span)
    if not seen.any():
        return
    inside = values[seen]
    if np.isfinite(y).all():
        assert y.max() >= inside.max()
        assert y.min() <= inside.min()
    # A pixel of which a sample is missing is a hole, and no other.
    pixel = max(step, span / 100.0)
    for frame in at[seen & np.isnan(values)]:
        assert (
            np.isnan(y[np.argmin(np.abs(x - frame))])
            or np.isnan(y[np.abs(x - frame) <= pixel]).any()
        )
    if np.isfinite(inside).all() and np.isfinite(values).all():
        assert np.isfinite(y).all()


@given(
    parts=st.lists(st.tuples(st.integers(1, 400), st.integers(2, 2000)), max_size=40),
    low=st.floats(-500, 20_000),
    span=st.floats(10, 80_000),
)
def test_thinned_points_keep_extremes_and_the_gaps_between(parts, low, span):
    frames, values, start = [], [], 0
    for length, hole in parts:
        frames += [*range(start, start + length), start + length - 0.5]
        values += [*np.sin(np.arange(start, start + length)), np.nan]
        start += length + hole
    whole_x, whole_y = np.array(frames), np.array(values)
    pixels = 100.0
    x, y = thinned_points(whole_x, whole_y, (low, low + span, pixels))
    assert (np.diff(x) >= 0).all()
    seen = (whole_x >= low) & (whole_x <= low + span) & np.isfinite(whole_y)
    if seen.any():
        assert np.nanmax(y) >= whole_y[seen].max()
        assert np.nanmin(y) <= whole_y[seen].min()
    # Nothing is drawn across a hole that is wide enough to be seen.
    joined = np.isfinite(y[:-1]) & np.isfinite(y[1:])
    holes = np.flatnonzero(np.isnan(whole_y))
    wide = 2 * max(1.0, span / pixels)
    for i in holes[holes < len(whole_x) - 1]:
        left, right = whole_x[i - 1], whole_x[i + 1]
        if right - left > wide + 1:
            across = (x[:-1] <= left + wide / 2) & (x[1:] >= right - wide / 2)
            assert not (joined & across).any()


def test_a_spike_among_many_is_drawn():
    values = np.zeros(50_000)
    values[31_234] = 99.0
    for x, y in (
        thinned_values(values, 1.0, (0.0, 50_000.0, 400.0)),
        thinned_points(np.arange(50_000.0), values, (0.0, 50_000.0, 400.0)),
    ):
        assert len(x) < 1000
        assert y.max() == 99.0
        assert abs(x[np.argmax(y)] - 31_234) <= 125


def test_short_stretches_of_a_long_take_are_drawn_however_far_out():
    mask = np.zeros(144_000, dtype=bool)
    starts = np.arange(70, 143_000, 700)
    for start in starts:
        mask[start : start + 2] = True
    pixels = 900.0
    x, y = thinned_points(*pieces(np.zeros(144_000), mask), (0.0, 144_000.0, pixels))
    drawn = set(np.floor(x[np.isfinite(y)] / (144_000 / pixels)).tolist())
    assert set(np.floor(starts / (144_000 / pixels)).tolist()) <= drawn
