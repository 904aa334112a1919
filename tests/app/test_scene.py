"""The 3D view: projection, vertical axis, real drags and clicks, and what is painted."""

from __future__ import annotations

import math

import numpy as np
import pytest
from driving import settled
from PySide6.QtCore import QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QContextMenuEvent, QFont, QFontMetrics, QWheelEvent
from PySide6.QtWidgets import QApplication
from scenes import drag, place

from markermend.artifact import Kind, Status
from markermend.patch import Patch
from markermend.repairs.registry import Repair
from markermend.review import hand
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app.document import Document
from markermend_app.panels.scene.paint import place_labels
from markermend_app.panels.scene.scene import Scene
from markermend_app.style import theme


def test_drags_turn_move_zoom_and_scrub(qtbot, scene, document):
    before = scene.camera
    drag(qtbot, scene, QPoint(60, 20))
    assert scene.camera.yaw != before.yaw
    assert scene.camera.pitch > before.pitch
    assert scene.camera.target == before.target
    before = scene.camera
    drag(qtbot, scene, QPoint(60, 20), Qt.MouseButton.MiddleButton)
    assert scene.camera.target != before.target
    assert scene.camera.yaw == before.yaw
    before = scene.camera
    # By some systems the menu is asked for with the press already.
    at = QPoint(120, 320)
    asked = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at, scene.mapToGlobal(at))
    QApplication.sendEvent(scene, asked)
    drag(qtbot, scene, QPoint(60, 20), Qt.MouseButton.RightButton)
    assert scene.camera.target != before.target
    assert QApplication.activePopupWidget() is None
    before = scene.camera
    drag(qtbot, scene, QPoint(60, 20), held=Qt.KeyboardModifier.ShiftModifier)
    assert scene.camera.target != before.target
    scene.follow.setChecked(False)
    before = scene.camera
    drag(qtbot, scene, QPoint(100, 0), held=Qt.KeyboardModifier.ControlModifier)
    assert document.frame == 200
    assert scene.camera == before
    event = QWheelEvent(
        QPointF(250, 200),
        scene.mapToGlobal(QPointF(250, 200)),
        QPoint(),
        QPoint(0, 120),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    scene.wheelEvent(event)
    assert scene.camera.distance < before.distance


def test_click_picks_the_nearest_marker_and_ctrl_adds(qtbot, scene, document):
    left = Qt.MouseButton.LeftButton
    qtbot.mouseClick(scene, left, pos=place(scene, document, "LWRA"))
    assert document.shown == ("LWRA",)
    control = Qt.KeyboardModifier.ControlModifier
    qtbot.mouseClick(scene, left, control, place(scene, document, "STRN"))
    assert document.shown == ("LWRA", "STRN")
    qtbot.mouseClick(scene, left, control, place(scene, document, "LWRA"))
    assert document.shown == ("STRN",)
    qtbot.mouseClick(scene, left, pos=QPoint(20, 120))
    assert document.shown == ("STRN",)


def test_double_click_beside_the_markers_shows_everything(qtbot, scene):
    first = scene.camera
    scene.camera = first.zoomed(0.3).panned(80, 80, 400)
    qtbot.mouseDClick(scene, Qt.MouseButton.LeftButton, pos=QPoint(20, 120))
    assert scene.camera.distance == pytest.approx(first.distance)
    np.testing.assert_allclose(scene.camera.target, first.target)


def test_missing_markers_are_not_drawn(scene, document):
    document.go_to(70)
    scene.grab()
    assert np.isnan(scene._at[0]).all()
    assert np.isfinite(scene._at[1:]).all()


def test_open_artifacts_ring_their_markers_until_decided(scene, document):
    document.go_to(150)
    column = document.session.original.index("LELB")
    assert scene.seen.rings() == {column: Kind.PEAK}
    theme_ring = theme.current().kinds[Kind.PEAK]
    image = scene.grab().toImage()
    x, y = scene._at[column]
    around = [
        image.pixelColor(round(x + 6 * math.cos(a)), round(y + 6 * math.sin(a)))
        for a in np.linspace(0, 6.2, 24)
    ]
    near = [abs(c.red() - theme_ring.red()) + abs(c.blue() - theme_ring.blue()) for c in around]
    assert min(near) < 60
    document.decisions.reject([a.id for a in document.session.artifacts if a.kind is Kind.PEAK])
    assert scene.seen.rings() == {}


def test_ghost_shows_where_the_preview_puts_the_marker(scene, document, monkeypatch):
    peak = next(a for a in document.session.artifacts if a.kind is Kind.PEAK)
    patch = Patch("LELB", "y", 150, 151, np.array([[123.0]]))
    repair = Repair("linear", (patch,))
    monkeypatch.setattr(Document, "proposal", property(lambda self: repair))
    document.select(peak.id)
    [(column, way, start)] = scene.seen.ghosts()
    assert (column, start) == (document.session.original.index("LELB"), 150)
    now = document.session.positions[150, 5]
    np.testing.assert_allclose(way, [[now[0], 123.0, now[2]]])
    assert peak.status is Status.PENDING
    assert not scene.grab().isNull()


def test_follow_keeps_the_body_in_the_middle(scene, document):
    document.go_to(0)
    first = scene._at.copy() if scene.grab() else None
    document.go_to(390)
    scene.grab()
    # The body has walked 1.2 m; on the screen it stays within a hand's breadth.
    assert np.abs(np.nanmean(scene._at, axis=0) - np.nanmean(first, axis=0)).max() < 60
    scene.follow.click()
    document.go_to(0)
    scene.grab()
    whole = scene._at.copy()
    document.go_to(390)
    scene.grab()
    assert np.abs(np.nanmean(scene._at, axis=0) - np.nanmean(whole, axis=0)).max() > 60


def test_of_several_subjects_the_one_looked_at_is_followed(tmp_path, qtbot, damaged):
    body = damaged[0].positions[:100]
    there = body + np.array([5000.0, 0.0, 0.0])
    labels = [f"{who}:{s}" for who in "AB" for s in damaged[0].labels]
    loose = np.full((100, 1, 3), 9000.0)
    take = Take(np.concatenate((body, there, loose), axis=1), (*labels, "*7"), 100.0)
    document = Document()
    document.open(open_session(take, folder=tmp_path), None)
    scene = Scene(document)
    qtbot.addWidget(scene)
    scene.resize(500, 400)
    scene.show()
    scene.grab()
    far = scene.camera.distance
    named = take.positions[:6, :-1, 0]
    assert scene.camera.target[0] == pytest.approx(np.nanmedian(named), abs=1)
    count = len(damaged[0].labels)
    for who, columns in (("B", slice(count, 2 * count)), ("A", slice(0, count))):
        document.show([f"{who}:{damaged[0].labels[3]}"])
        middle = np.nanmedian(take.positions[:6, columns, 0])
        assert scene.camera.target[0] == pytest.approx(middle, abs=1)
    assert scene.camera.distance < far / 2
    scene.camera = beside = scene.camera.zoomed(0.5)
    document.do(lambda s: hand.rename(s, {document.shown[0]: "A:CHEST"}))
    settled(qtbot)
    assert document.shown == ("A:CHEST",)
    assert scene.camera == beside
    document.show(["*7"])
    assert scene.camera == beside
    scene.follow.click()
    still = scene.camera
    document.show([labels[-1]])
    assert scene.camera == still
    document.open(None, None)
    document.proposals.close()


def test_a_body_with_most_markers_at_one_end_is_seen_whole(tmp_path, qtbot):
    # Twenty markers on a shoulder, one on a hand far above, two on feet far below.
    rng = np.random.default_rng(3)
    heights = np.concatenate((rng.normal(1300, 40, 20), [2100.0], [60.0, 80.0]))
    body = np.stack((rng.normal(0, 60, 23), rng.normal(0, 60, 23), heights), axis=1)
    stray = np.array([[400_000.0, 0.0, 0.0]])
    positions = np.tile(np.concatenate((body, stray)), (50, 1, 1))
    document = Document()
    labels = (*(f"M{i}" for i in range(23)), "*7")
    document.open(open_session(Take(positions, labels, 100.0), folder=tmp_path), None)
    scene = Scene(document)
    qtbot.addWidget(scene)
    scene.resize(500, 400)
    scene.show()
    document.show(["M0"])
    scene.grab()
    down = scene._at[:23, 1]
    assert down.min() > 0
    assert down.max() < 400
    assert np.ptp(down) > 150
    document.open(None, None)
    document.proposals.close()


def test_vertical_axis_can_be_set(scene):
    scene.set_vertical(1)
    assert scene.camera.up == 1
    scene.set_vertical(None)
    assert scene.camera.up == scene.stage.up


def test_names_cover_neither_each_other_nor_markers_that_have_room_beside_them(scene):
    metrics = scene.fontMetrics()
    # A marker stands where the first name would be written, and two lie on the same spot.
    at = np.array([[100.0, 100.0], [125.0, 100.0], [300.0, 100.0], [300.0, 100.0], [np.nan] * 2])
    names = [(i, f"M{i}") for i in range(5)]
    room = QRectF(0.0, 0.0, 500.0, 400.0)
    boxes = dict((name, box) for box, name in place_labels(metrics, at, names, room))
    assert sorted(boxes) == ["M0", "M1", "M2", "M3"]
    assert not any(box.contains(QPointF(x, y)) for box in boxes.values() for x, y in at[:4])
    placed = list(boxes.values())
    assert not any(a.intersects(b) for i, a in enumerate(placed) for b in placed[:i])


def test_names_at_the_border_are_whole(qapp):
    metrics = QFontMetrics(QFont())
    room = QRectF(0.0, 0.0, 300.0, 200.0)
    at = np.array([[2.0, 100.0], [298.0, 100.0], [150.0, 1.0], [150.0, 199.0]])
    names = [(i, f"LongMarkerName{i}") for i in range(4)]
    placed = place_labels(metrics, at, names, room)
    assert len(placed) == 4
    assert all(room.contains(box) for box, _ in placed)


def test_says_so_while_nothing_is_open(scene, document):
    document.open(None, None)
    assert scene.stage is None
    assert not scene.grab().isNull()


def test_a_take_of_other_markers_is_shown_with_the_preferred_axis(tmp_path, qtbot, damaged):
    document = Document()
    scene = Scene(document)
    qtbot.addWidget(scene)
    scene.resize(500, 400)
    scene.show()
    document.opened.connect(lambda: scene.set_vertical(1))
    for i, count in enumerate((8, 5)):
        take = damaged[0]
        fewer = Take(take.positions[:, :count], take.labels[:count], take.rate)
        document.open(open_session(fewer, folder=tmp_path / str(i)), None)
        document.show(fewer.labels[:1])
        scene.grab()
        settled(qtbot)
        scene.grab()
        assert scene.stage is not None
        assert scene.stage.up == 1
        assert len(scene._at) == count
    document.open(None, None)
    document.proposals.close()


def test_renaming_keeps_the_room_in_sight_and_the_view(scene, document, qtbot):
    document.show(["CLAV"])
    settled(qtbot)
    drag(qtbot, scene, QPoint(60, 20))
    stage, camera = scene.stage, scene.camera
    assert stage is not None
    seen = []
    document.opened.connect(lambda: seen.append(scene.stage))
    document.do(lambda s: hand.rename(s, {"CLAV": "CHEST"}))
    assert [s.radius for s in seen] == [stage.radius]
    settled(qtbot)
    assert document.shown == ("CHEST",)
    assert scene.camera == camera


def test_where_markers_of_the_take_before_were_nothing_can_be_clicked(
    scene, document, damaged, tmp_path
):
    spot = place(scene, document, "LELB")
    take = damaged[0]
    two = Take(take.positions[:, :2], take.labels[:2], take.rate)
    document.open(open_session(two, folder=tmp_path / "two"), None)
    assert scene.marker_at(QPointF(spot)) is None
