"""The 3D view: projection, vertical axis, real drags and clicks, and what is painted."""

from __future__ import annotations

import math

import numpy as np
import pytest
from driving import settled
from PySide6.QtCore import QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QContextMenuEvent, QFont, QFontMetrics, QWheelEvent
from PySide6.QtWidgets import QApplication

from markermend.artifact import Kind, Status
from markermend.mesh import Group, Mesh
from markermend.patch import Patch
from markermend.repairs.registry import Repair
from markermend.review import hand
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app.document import Document
from markermend_app.panels.scene.looks import marker_colours
from markermend_app.panels.scene.paint import place_labels
from markermend_app.panels.scene.scene import Scene
from markermend_app.panels.scene.select import Outline
from markermend_app.style import theme


@pytest.fixture
def mesh(damaged):
    labels = damaged[0].labels
    return Mesh(labels, (Group("Trunk", "", (0, 1, 2, 3)),), ((0, 1), (0, 2), (0, 3)))


@pytest.fixture
def scene(document, qtbot):
    scene = Scene(document)
    qtbot.addWidget(scene)
    scene.resize(500, 400)
    scene.show()
    scene.grab()
    return scene


def place(scene, document, label):
    scene.grab()
    x, y = scene._at[document.session.original.index(label)]
    return QPoint(round(x), round(y))


def drag(qtbot, scene, by, button=Qt.MouseButton.LeftButton, held=Qt.KeyboardModifier.NoModifier):
    start = QPoint(120, 320)
    qtbot.mousePress(scene, button, held, start)
    for share in (0.5, 1.0):
        at = QPointF(start + by * share)
        move(scene, at, button, held)
    qtbot.mouseRelease(scene, button, held, start + by)


def move(scene, at, button, held):
    from PySide6.QtCore import QEvent
    from PySide6.QtGui import QMouseEvent
    from PySide6.QtWidgets import QApplication

    event = QMouseEvent(
        QEvent.Type.MouseMove, at, scene.mapToGlobal(at), Qt.MouseButton.NoButton, button, held
    )
    QApplication.sendEvent(scene, event)


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


# What else is seen


def colors_around(scene, at: QPoint, reach: int = 12) -> set[tuple[int, int, int]]:
    """Colours painted around a pixel."""
    image = scene.grab().toImage()
    ratio = image.devicePixelRatio()
    found = set()
    for x in range(round((at.x() - reach) * ratio), round((at.x() + reach) * ratio)):
        for y in range(round((at.y() - reach) * ratio), round((at.y() + reach) * ratio)):
            found.add(image.pixelColor(x, y).getRgb()[:3])
    return found


def test_colours_of_groups_can_be_told_apart(scene, document):
    def colours() -> set[str]:
        """Colours that fill at least a square of 4 by 4 pixels somewhere."""
        image = scene.grab().toImage()
        names = np.array(
            [[image.pixel(x, y) for x in range(image.width())] for y in range(image.height())]
        )
        views = np.lib.stride_tricks.sliding_window_view(names, (4, 4)).reshape(-1, 16)
        return set(views[(views == views[:, :1]).all(axis=1), 0].tolist())

    document.show([])
    document.select(None)
    document.decisions.remove([a.id for a in document.session.artifacts])
    plain = colours()
    scene.looks.set_colours("group")
    assert len(colours() - plain) >= 1
    scene.looks.set_colours("plain")


def test_segments_of_the_wrong_length_are_red(tmp_path, qtbot):
    positions = np.zeros((300, 4, 3))
    positions[:, 1], positions[:, 2], positions[:, 3] = (0, 0, 500), (0, 400, 0), (0, 400, 500)
    positions += np.random.default_rng(1).normal(0, 0.3, positions.shape)
    positions[100:120, 1, 2] += 80
    take = Take(positions, ("A", "B", "C", "D"), 100.0)
    document = Document()
    document.open(open_session(take, folder=tmp_path), Mesh(take.labels, (), ((0, 1), (2, 3))))
    scene = Scene(document)
    qtbot.addWidget(scene)
    scene.resize(500, 400)
    scene.show()

    def red() -> int:
        image, target = scene.grab().toImage(), theme.current().axes["x"]
        return sum(
            image.pixelColor(x, y) == target
            for x in range(60, image.width() - 60)
            for y in range(image.height())
        )

    document.go_to(50)
    assert scene.seen.off(positions[50]).tolist() == [False, False]
    assert red() == 0
    document.go_to(110)
    assert scene.seen.off(positions[110]).tolist() == [True, False]
    assert red() > 20
    scene.looks.set_lengths(False)
    assert red() == 0
    document.open(None, None)
    document.proposals.close()


def test_the_other_version_is_a_ghost_that_before_and_after_swap(scene, document):
    step = next(a for a in document.session.artifacts if a.kind is Kind.STEP)
    column = document.session.original.index(step.marker)
    values = document.session.positions[step.start : step.stop, column, 2:3] - 400.0
    patch = Patch(step.marker, "z", step.start, step.stop, values)
    document.decisions.repair_many([(step.id, Repair("test", (patch,)))], "")
    document.select(None)
    document.show(["CLAV"])
    document.go_to(300)
    scene.grab()
    original = document.session.original.positions[300]
    was = scene.camera.project(original[[column]], scene.width(), scene.height())[0]
    now = scene._at[column]
    assert np.hypot(*(now - was)) > 20
    shade = theme.blend(theme.current().original, theme.current().text, 0.2).getRgb()[:3]
    at = QPoint(*np.rint(was).astype(int).tolist())
    assert shade in colors_around(scene, at)
    scene.set_before(True)
    scene.grab()
    np.testing.assert_allclose(scene._at[column], was, atol=1e-6)
    assert shade in colors_around(scene, QPoint(*np.rint(now).astype(int).tolist()))
    scene.set_before(False)
    scene.looks.set_ghost(False)
    assert shade not in colors_around(scene, at)


def test_markers_are_coloured_by_group_or_by_damage(scene, document):
    document.show([])
    scene.looks.set_colours("group")
    trunk = {name: place(scene, document, name) for name in ("STRN", "T10")}
    other = place(scene, document, "LELB")
    hues = {n: colors_around(scene, at, 2) for n, at in trunk.items()}
    assert hues["STRN"] & hues["T10"]
    assert not hues["STRN"] & hues["T10"] & colors_around(scene, other, 2)
    scene.looks.set_colours("damage")
    damage = scene.seen.damage()
    take = document.session.take
    assert damage[take.index("LWRA")] == pytest.approx(50 / 400)
    assert damage[take.index("STRN")] == 0
    colours = marker_colours(scene.looks, take.markers, document.mesh, damage)
    assert colours[take.index("STRN")] != colours[take.index("LWRA")]
    step = next(a for a in document.session.artifacts if a.kind is Kind.STEP)
    document.decisions.reject([step.id])
    assert scene.seen.damage()[take.index("LWRA")] == 0


def test_looks_are_chosen_in_the_menu_and_remembered(scene, document, qtbot):
    menu = scene.buttons.menu
    menu.popup(QPoint(20, 20))
    action = next(a for a in menu.actions() if a.text() == "Coloured by damage")
    qtbot.mouseClick(menu, Qt.MouseButton.LeftButton, pos=menu.actionGeometry(action).center())
    assert scene.looks.colours == "damage"
    menu.popup(QPoint(20, 20))
    up = next(a.menu() for a in menu.actions() if a.text() == "Axis that points up")
    up.popup(QPoint(20, 20))
    action = next(a for a in up.actions() if a.text() == "Y")
    qtbot.mouseClick(up, Qt.MouseButton.LeftButton, pos=up.actionGeometry(action).center())
    assert scene.stage.up == 1
    other = Scene(document)
    qtbot.addWidget(other)
    assert other.looks.colours == "damage"


def sweep(qtbot, scene, points, held=Qt.KeyboardModifier.NoModifier):
    """Drag along points with the left button."""
    left = Qt.MouseButton.LeftButton
    qtbot.mousePress(scene, left, held, points[0])
    for at in points[1:]:
        move(scene, QPointF(at), left, held)
    qtbot.mouseRelease(scene, left, held, points[-1])


def test_a_box_selects_and_ctrl_adds(scene, document, qtbot):
    qtbot.mouseClick(scene.buttons.box, Qt.MouseButton.LeftButton)
    camera, at = scene.camera, place(scene, document, "LELB")
    sweep(qtbot, scene, [at - QPoint(9, 9), at, at + QPoint(9, 9)])
    assert scene.camera == camera
    inside = set(document.shown)
    assert "LELB" in inside
    for name in document.session.original.labels:
        spot = place(scene, document, name)
        near = max(abs(spot.x() - at.x()), abs(spot.y() - at.y()))
        assert near == 9 or (name in inside) == (near < 9)
    other = place(scene, document, "STRN")
    sweep(
        qtbot,
        scene,
        [other - QPoint(5, 5), other, other + QPoint(5, 5)],
        Qt.KeyboardModifier.ControlModifier,
    )
    assert inside | {"STRN"} <= set(document.shown)
    scene.drop_tool()
    assert scene.buttons.tool == ""
    drag(qtbot, scene, QPoint(40, 0))
    assert scene.camera != camera


def test_a_lasso_selects_what_it_goes_round(scene, document, qtbot):
    qtbot.mouseClick(scene.buttons.box, Qt.MouseButton.LeftButton)
    qtbot.mouseClick(scene.buttons.lasso, Qt.MouseButton.LeftButton)
    assert scene.buttons.tool == "lasso"
    at = place(scene, document, "T10")
    ring = [QPoint(12, 0), QPoint(0, 12), QPoint(-12, 0), QPoint(0, -12), QPoint(12, 0)]
    sweep(qtbot, scene, [at + step for step in ring])
    assert "T10" in document.shown
    gap = Outline("lasso", [QPointF(0, 0), QPointF(10, 0), QPointF(0, 10)])
    found = gap.holds(np.array([[2.0, 2.0], [9.0, 9.0], [np.nan, np.nan]]))
    assert found.tolist() == [True, False, False]


def test_an_empty_box_changes_nothing(scene, document, qtbot):
    document.show(["CLAV"])
    qtbot.mouseClick(scene.buttons.box, Qt.MouseButton.LeftButton)
    sweep(qtbot, scene, [QPoint(3, 3), QPoint(8, 8), QPoint(12, 12)])
    assert document.shown == ("CLAV",)


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
