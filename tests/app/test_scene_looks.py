"""The 3D view: which colours markers, segments and ghosts are painted in."""

from __future__ import annotations

import numpy as np
import pytest
from pictures import colours, off
from PySide6.QtCore import QPoint, Qt
from scenes import place

from markermend.artifact import Kind
from markermend.mesh import Group, Mesh
from markermend.patch import Patch
from markermend.repairs.registry import Repair
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app.document import Document
from markermend_app.panels.scene.looks import marker_colours
from markermend_app.panels.scene.scene import Scene
from markermend_app.style import theme


@pytest.fixture
def mesh(damaged):
    labels = damaged[0].labels
    return Mesh(labels, (Group("Trunk", "", (0, 1, 2, 3)),), ((0, 1), (0, 2), (0, 3)))


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
    def filling() -> set[int]:
        """Colours that fill at least a square of 4 by 4 pixels somewhere."""
        names = colours(scene) @ (1, 256, 256**2)
        views = np.lib.stride_tricks.sliding_window_view(names, (4, 4)).reshape(-1, 16)
        return set(views[(views == views[:, :1]).all(axis=1), 0].tolist())

    document.show([])
    document.select(None)
    document.decisions.remove([a.id for a in document.session.artifacts])
    plain = filling()
    scene.looks.set_colours("group")
    assert len(filling() - plain) >= 1
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
        away = off(colours(scene), theme.current().axes["x"])
        return np.count_nonzero(away[:, 60:-60] == 0)

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
