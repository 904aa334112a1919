"""The 3D view: markers selected by a box or a lasso."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPoint, QPointF, Qt
from scenes import drag, move, place

from markermend_app.panels.scene.select import Outline


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
