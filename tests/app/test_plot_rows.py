"""What the plots can show: rows chosen from the menu, crosshair, flags, and channels beside."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest

from markermend.artifact import Kind, Status
from markermend.measures import acceleration, distance, speed
from markermend.mesh import infer_mesh
from markermend.review import hand
from markermend.review.file import open_session
from markermend.take import Analog, Event, Points, Take
from markermend_app.document import Document
from markermend_app.panels.plots.quantity import QUANTITIES, can_show
from markermend_app.panels.plots.range import value_range
from markermend_app.panels.plots.trajectories import TrajectoryPanel
from markermend_app.rows import Rows
from markermend_app.style import theme

LEFT = Qt.MouseButton.LeftButton


def richer(take: Take) -> Take:
    """The same take with events, force, an angle, residuals and camera counts."""
    frames = take.frames
    t = np.arange(frames * 10) / (10 * frames)
    force = np.stack([800 * np.sin(np.pi * t), np.zeros_like(t)], axis=1).astype(np.float32)
    angle = np.repeat(np.linspace(0, 60, frames)[:, None, None], 3, axis=2)
    angle[:80] = np.nan
    return replace(
        take,
        events=(Event("Foot Strike", 2.0, "Left"), Event("Foot Off", 3.5, "Right")),
        analog=Analog(force, ("Fz1", "EMG"), ("N", "V"), 10 * take.rate),
        points=Points(angle, ("LKneeAngles",), ("angle",), (8,), {"angle": "deg"}),
        residuals=np.where(take.present, 0.7, np.nan).astype(np.float32),
        cameras=np.full(take.present.shape, 5, dtype=np.uint8),
    )


@pytest.fixture
def panel(qtbot, tmp_path, damaged):
    take, artifacts = damaged
    take = richer(take)
    document = Document()
    document.open(open_session(take, folder=tmp_path), infer_mesh(take))
    panel = TrajectoryPanel(document)
    qtbot.addWidget(panel)
    panel.resize(900, 700)
    panel.show()
    qtbot.waitExposed(panel)
    document.decisions.add_detected(artifacts, "test")
    document.set_queue(Rows([[a.id] for a in document.session.artifacts]))
    document.show(["CLAV"])
    yield panel
    document.open(None, None)
    panel.predictions.close()
    document.proposals.close()


def names(panel) -> list[str]:
    return [row.quantity.name for row in panel.rows]


def pick(panel, *texts: str) -> None:
    """Open the menu of plots and click through it with the mouse."""
    panel.open_menu()
    menu = panel.menu
    for text in texts:
        action = next(a for a in menu.actions() if a.text().startswith(text))
        QTest.mouseClick(menu, LEFT, pos=menu.actionGeometry(action).center())
        if action.menu() is not None:
            menu = action.menu()
            menu.popup(QPoint(50, 50))
    panel.menu.close()


def hover(panel, row, frame: float) -> None:
    """Move the mouse over a frame in the middle of a row."""
    box = row.view.sceneBoundingRect()
    x = row.view.mapViewToScene(QPointF(frame, 0)).x()
    # The scene passes over moves that follow each other too quickly.
    QTest.qWait(30)
    QTest.mouseMove(panel.canvas.viewport(), panel.canvas.mapFromScene(x, box.center().y()))
    QTest.qWait(30)


def test_rows_are_chosen_in_the_menu_and_remembered(panel, qtbot):
    assert names(panel) == ["x", "y", "z"]
    pick(panel, "Speed")
    pick(panel, "X coordinate")
    pick(panel, "Acceleration")
    assert names(panel) == ["y", "z", "speed", "acceleration"]
    heights = [row.view.sceneBoundingRect().height() for row in panel.rows]
    assert max(heights) - min(heights) <= 1
    shown = [row.time.style["showValues"] for row in panel.rows]
    assert shown == [False, False, False, True]
    other = TrajectoryPanel(panel.document)
    qtbot.addWidget(other)
    assert names(other) == names(panel)
    pick(panel, "X, Y and Z only")
    assert names(panel) == ["x", "y", "z"]


def test_the_menu_stays_open_while_check_marks_are_set(panel, qtbot):
    panel.open_menu()
    menu = panel.menu
    actions = {a.text(): a for a in menu.actions()}
    before = panel.chosen
    for name in ("Speed", "Acceleration", "Speed"):
        action = next(a for text, a in actions.items() if text.startswith(name))
        QTest.mouseClick(menu, LEFT, pos=menu.actionGeometry(action).center())
        assert menu.isVisible()
    assert panel.chosen == (*before, "acceleration")
    for name in panel.chosen:
        menu.setActiveAction(actions[QUANTITIES[name].meaning])
        qtbot.keyClick(menu, Qt.Key.Key_Space)
    assert menu.isVisible()
    # The last row stays, and its check mark says so.
    assert len(panel.chosen) == 1
    assert [a.isChecked() for a in actions.values()].count(True) == 1
    qtbot.keyClick(menu, Qt.Key.Key_Escape)
    assert not menu.isVisible()


def test_the_last_row_cannot_be_taken_away(panel):
    panel.choose_rows(())
    assert names(panel) == ["x"]


def test_derived_rows_show_what_was_measured(panel):
    panel.choose_rows(["speed", "acceleration"])
    take = panel.document.session.take
    way = take.positions[:, take.index("CLAV")]
    for row, expected in zip(
        panel.rows, (speed(way, take.rate), acceleration(way, take.rate)), strict=True
    ):
        curve = row.traces["CLAV"].item("measured")
        np.testing.assert_array_equal(curve.values, expected)
        low, _ = row.view.viewRange()[1]
        assert low < 0 < 0.3 * np.nanmax(expected)


def test_filled_samples_are_drawn_apart_in_every_row(panel, qtbot):
    panel.choose_rows(["x", "speed"])
    document = panel.document
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.select(gap.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=20_000)
    for row in panel.rows:
        (item,) = row.proposed
        assert {59, 90} <= set(item.frames.tolist())
    document.decisions.repair_current()
    assert document.session.artifact(gap.id).status is Status.REPAIRED
    document.show(["CLAV"])
    for row in panel.rows:
        trace = row.traces["CLAV"]
        assert np.isnan(trace.item("measured").values[60:90]).all()
        x = trace.item("filled").frames[np.isfinite(trace.item("filled").values)]
        assert set(range(60, 90)) <= set(x.tolist())
        assert trace.item("filled").worn.style() != trace.item("measured").worn.style()


def test_distance_goes_to_the_second_marker_or_to_the_one_chosen(panel):
    panel.document.show(["LWRA", "LWRB"])
    panel.choose_rows(["distance"])
    (row,) = panel.rows
    take = panel.document.session.take
    assert row.title == "To LWRB"
    at = {name: take.positions[:, take.index(name)] for name in take.labels}
    apart = distance(at["LWRA"], at["LWRB"])
    np.testing.assert_array_equal(row.traces["LWRA"].item("measured").values, apart)
    assert row.traces["LWRB"].item("measured").values is None
    panel.choose_partner("CLAV")
    assert row.title == "To CLAV"
    away = distance(at["LWRB"], at["CLAV"])
    np.testing.assert_array_equal(row.traces["LWRB"].item("measured").values, away)
    # Where all belong to one subject its name is not said.
    labels = {label: f"Ann:{label}" for label in take.labels}
    panel.document.do(lambda session: hand.rename(session, labels))
    panel.document.show(["Ann:LWRA", "Ann:LWRB"])
    panel.open_menu()
    texts = [action.text() for action in panel.menu.actions()]
    panel.menu.close()
    assert "Distance to LWRB" in texts
    panel.document.undo()
    panel.document.show(["LWRA", "LWRB"])
    panel.choose_rows(["distance"])
    (row,) = panel.rows
    # The step stands out of a distance that is constant otherwise.
    panel.choose_partner(None)
    low, high = row.view.viewRange()[1]
    assert low < np.nanmedian(apart) < high


def test_a_lone_marker_is_measured_to_one_of_its_segment(panel):
    panel.choose_rows(["distance"])
    mesh, take = panel.document.mesh, panel.document.session.take
    group = mesh.group_of(take.index("CLAV"))
    assert mesh.group_of(take.index(panel.partner)) == group


def test_the_residual_to_the_body_comes_from_a_thread(panel, qtbot):
    panel.document.show(["LWRA"])
    panel.choose_rows(["residual"])
    (row,) = panel.rows
    assert row.traces["LWRA"].item("measured").values is None
    qtbot.waitUntil(lambda: row.traces["LWRA"].item("measured").values is not None, timeout=20_000)
    values = row.values_of["LWRA"]
    assert np.median(values[285:325]) > 20
    assert np.median(values[:250]) < 3


def test_what_the_file_does_not_hold_cannot_be_chosen(panel, tmp_path, damaged):
    panel.choose_rows(["x", "file_residual", "cameras"])
    assert names(panel) == ["x", "file_residual", "cameras"]
    assert panel.rows[1].value_at("CLAV", 10) == pytest.approx(0.7)
    assert panel.rows[2].value_at("CLAV", 10) == 5
    assert np.isnan(panel.rows[2].value_at("CLAV", 70))
    take, _ = damaged
    panel.document.open(open_session(take, folder=tmp_path / ".."), None)
    panel.document.show(["CLAV"])
    assert names(panel) == ["x"]
    panel.open_menu()
    action = next(a for a in panel.menu.actions() if a.text().startswith("Residual"))
    assert not action.isEnabled()
    panel.menu.close()


def test_the_crosshair_reads_frame_time_and_value(panel):
    panel.document.show(["STRN", "CLAV"])
    panel.choose_rows(["x", "speed"])
    x, speeds = panel.rows
    hover(panel, speeds, 75)
    text = panel.header.readout.text()
    assert text.startswith("Frame 176 · 0.750 s · Speed: STRN ")
    assert f"{speeds.value_at('STRN', 75):.3f} m/s" in text
    assert text.endswith("CLAV missing")
    assert (x.across.value(), speeds.across.value()) == (75, 75)
    assert speeds.along.value() == speeds.value_at("STRN", 75)
    assert speeds.along.isVisible()
    assert not x.along.isVisible()
    hover(panel, x, 40)
    assert x.along.isVisible()
    assert not speeds.along.isVisible()


def test_events_fly_as_flags_over_the_first_row(panel):
    x, y, _ = panel.rows
    assert x.flags.named
    assert not y.flags.named
    image = panel.canvas.grab().toImage()
    ratio = image.devicePixelRatio()
    flag = theme.current().flag
    for seconds in (2.0, 3.5):
        # The file's clock begins at its frame 1, and this take at its frame 101.
        frame = seconds * 100 - 100
        at = panel.canvas.mapFromScene(x.view.mapViewToScene(QPointF(frame, 0)))
        top = round(x.view.sceneBoundingRect().top())
        pixel = QColor(image.pixel(round((at.x() + 2) * ratio), round((top + 3) * ratio)))
        assert max(abs(a - b) for a, b in zip(pixel.toTuple(), flag.toTuple(), strict=True)) < 30


def test_channels_stand_in_rows_of_their_own(panel):
    document = panel.document
    document.show_beside(["analog 0", "point 0", "analog 1"])
    assert names(panel) == ["x", "y", "z"]
    groups = [[c.name for c in row.channels] for row in panel.canvas.beside]
    assert groups == [["Fz1"], ["LKneeAngles"], ["EMG"]]
    panel.framing.set_view(50, 250)
    force = panel.canvas.beside[0]
    assert force.view.viewRange()[0] == [50, 250]
    assert force.view.viewRange()[1][1] > 750
    assert "Fz1" in force.caption.text
    hover(panel, force, 200)
    assert panel.header.readout.text().endswith("Fz1 800 N")
    hover(panel, panel.canvas.beside[1], 200)
    at_200 = "30.08, 30.08, 30.08"
    assert panel.header.readout.text().endswith(f"LKneeAngles {at_200} deg")
    assert panel.canvas.beside[1]._named[0] == "Angle (deg)"
    hover(panel, panel.canvas.beside[1], 60)
    assert panel.header.readout.text().endswith("LKneeAngles missing")
    assert force.time.style["showValues"] is False
    assert panel.canvas.beside[-1].time.style["showValues"]
    document.show_beside(())
    assert panel.canvas.frames == panel.rows
    assert panel.rows[-1].time.style["showValues"]


def test_channels_are_chosen_in_the_menu_and_leave_with_the_take(panel, tmp_path, damaged):
    pick(panel, "Analog channels", "Fz1")
    assert panel.document.beside == ("analog 0",)
    pick(panel, "Hide all channels")
    assert panel.document.beside == ()
    panel.document.show_beside(["point 0"])
    panel.document.open(open_session(damaged[0], folder=tmp_path / ".."), None)
    assert panel.document.beside == ()
    assert panel.canvas.beside == ()


def test_a_clicked_channel_moves_the_cursor(panel):
    panel.document.show_beside(["analog 0"])
    (row,) = panel.canvas.beside
    at = row.view.mapViewToScene(QPointF(320, 0)).x()
    point = panel.canvas.mapFromScene(at, row.view.sceneBoundingRect().center().y())
    QTest.mouseClick(panel.canvas.viewport(), LEFT, pos=point)
    assert panel.document.frame == pytest.approx(320, abs=1)


def test_speeds_begin_at_zero():
    low, high = value_range([np.full(50, 2.0)], least=0.5, least_at=0.0)
    assert low < 0 < 2.0 < high
    assert low > -0.3


def test_numbers_of_low_rows_do_not_cover_each_other(panel):
    panel.choose_rows(["x", "y", "z", "speed", "acceleration", "distance", "cameras"])
    panel.resize(900, 300)
    QTest.qWait(50)
    for row in panel.rows:
        low, high = row.view.viewRange()[1]
        height = row.view.height()
        at = row.values.tickValues(low, high, height)[0][1]
        assert at, row.quantity.name
        pixels = np.diff(sorted(at)) * height / (high - low)
        assert (pixels >= 14).all(), row.quantity.name


def test_distance_comes_with_the_mesh(qtbot, tmp_path, damaged):
    take, _ = damaged
    document = Document()
    panel = TrajectoryPanel(document)
    qtbot.addWidget(panel)
    panel.choose_rows(["x", "distance"])
    document.open(open_session(take, folder=tmp_path), None)
    document.show(["CLAV"])
    assert panel.partner is None
    document.learn(infer_mesh(take))
    partner = take.index(panel.partner)
    expected = distance(take.positions[:, 0], take.positions[:, partner])
    shown = panel.canvas.row("distance").traces["CLAV"].item("measured").values
    assert np.nanmedian(shown) == pytest.approx(np.nanmedian(expected), abs=0.5)
    document.open(None, None)
    document.proposals.close()


def test_cameras_that_were_never_counted_are_no_row(panel, damaged):
    take, _ = damaged
    assert can_show(richer(take), "cameras")
    assert not can_show(
        replace(take, cameras=np.zeros(take.present.shape, dtype=np.uint8)), "cameras"
    )
