"""The overview: what it paints, and where a click goes."""

from __future__ import annotations

import numpy as np
import pytest
from overviews import color, point
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from markermend.artifact import Artifact, Kind
from markermend.mesh import Group, Mesh
from markermend.take import Take
from markermend_app.document import Document
from markermend_app.panels.overview.overview import Overview
from markermend_app.panels.overview.picture import arrange, row_edges
from markermend_app.style import theme

LEFT = Qt.MouseButton.LeftButton


def test_rows_follow_the_body():
    mesh = Mesh(tuple("abcd"), (Group("B", "", (3, 1)), Group("A", "", (0,))))
    rows = arrange(4, mesh)
    assert rows.columns == (3, 1, 0, 2)
    assert rows.row_of == (2, 1, 3, 0)
    assert rows.groups == (("B", 0, 2), ("A", 2, 3), ("Others", 3, 4))
    assert arrange(3, None).columns == (0, 1, 2)


def test_rows_are_at_least_a_pixel_high():
    assert all(b > a for a, b in row_edges(300, 100))
    assert row_edges(2, 10) == [(0, 5), (5, 10)]


def test_artifacts_are_painted_by_class_and_faint_once_rejected(overview):
    kinds = theme.LIGHT.kinds
    gap = next(a for a in overview.document.session.artifacts if a.kind is Kind.GAP)
    at = point(overview, 75, 4)
    assert color(overview, at) == kinds[Kind.GAP]
    overview.document.decisions.reject([gap.id])
    overview.document.select(None)
    faint = color(overview, at)
    assert faint != kinds[Kind.GAP]
    # The samples are still missing, so the place is still shaded.
    assert faint not in (theme.LIGHT.plot, color(overview, point(overview, 130, 4)))


def test_a_mix_up_is_painted_and_clicked_on_the_rows_of_both_markers(overview):
    document = overview.document
    swap = Artifact("CLAV", "xyz", 110, 140, Kind.STEP, counterpart="LELB")
    document.decisions.add_detected([*document.session.artifacts, swap], "")

    def middle(artifact, marker):
        row = overview._rows.row_of[overview._column_of[marker]]
        return point(overview, (artifact.start + artifact.stop) / 2, row)

    places = [middle(swap, marker) for marker in swap.markers]
    assert [color(overview, at) for at in places] == [theme.LIGHT.kinds[Kind.STEP]] * 2
    # Those listed after it lie on one row each.
    assert len(document.session.artifacts) == 5
    for artifact in document.session.artifacts:
        for marker in artifact.markers:
            QTest.mouseClick(overview, LEFT, pos=middle(artifact, marker))
            assert document.current == artifact


def test_every_other_group_lies_on_a_band(overview):
    arm, trunk = (
        color(overview, point(overview, 130, 2)),
        color(overview, point(overview, 130, 6)),
    )
    assert arm == theme.LIGHT.plot
    assert trunk != arm
    assert abs(trunk.lightness() - arm.lightness()) < 30


def test_gaps_alone(overview):
    overview.mode.choose("gaps")
    assert color(overview, point(overview, 75, 4)) == theme.LIGHT.kinds[Kind.GAP]
    # The step on LWRA is no gap.
    assert color(overview, point(overview, 300, 2)) == theme.LIGHT.plot
    assert overview.mode.text().startswith("Gaps")


def test_the_mode_is_chosen_by_mouse_and_remembered(overview, qtbot):
    menu = overview.mode.menu()
    menu.popup(QPoint(10, 10))
    action = next(a for a in menu.actions() if a.text() == "Gaps")
    QTest.mouseClick(menu, LEFT, pos=menu.actionGeometry(action).center())
    assert overview.mode.mode == "gaps"
    other = Overview(overview.document)
    qtbot.addWidget(other)
    assert other.mode.mode == "gaps"
    other.mode.choose_next()
    assert other.mode.mode == "residual"
    other.mode.choose_next()
    assert other.mode.mode == "damage"


def _wheel(panel: Overview, at: QPoint, notches: int) -> None:
    event = QWheelEvent(
        QPointF(at),
        QPointF(panel.mapToGlobal(at)),
        QPoint(),
        QPoint(0, 120 * notches),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(panel, event)


def test_wheel_zooms_to_the_frame_and_double_click_shows_all(overview):
    at = point(overview, 75, 4)
    for _ in range(30):
        _wheel(overview, at, 1)
    low, high = overview._span
    assert high - low <= 8
    assert low <= 75 <= high
    # A click goes to the very frame under the mouse.
    overview.document.select(None)
    middle = QPoint(round(80 + (72.5 - low) / (high - low) * 600), 160)
    QTest.mouseClick(overview, LEFT, pos=middle)
    assert overview.document.frame == 72
    QTest.mouseDClick(overview, LEFT, pos=at)
    assert overview._span == (0, 400)


def test_a_zoomed_overview_pans_and_follows_the_plots(overview):
    overview.set_span(100, 200)
    QTest.mousePress(overview, Qt.MouseButton.RightButton, pos=QPoint(380, 80))
    event = QMouseEvent(
        QEvent.Type.MouseMove,
        QPointF(440, 80),
        QPointF(overview.mapToGlobal(QPoint(440, 80))),
        Qt.MouseButton.NoButton,
        Qt.MouseButton.RightButton,
        Qt.KeyboardModifier.NoModifier,
    )
    QApplication.sendEvent(overview, event)
    QTest.mouseRelease(overview, Qt.MouseButton.RightButton, pos=QPoint(440, 80))
    assert overview._span == pytest.approx((90, 190))
    overview.set_view(300, 340)
    low, high = overview._span
    assert low < 300 < 340 < high
    assert high - low == pytest.approx(100)


def test_click_on_an_artifact_selects_it(overview):
    QTest.mouseClick(overview, LEFT, pos=point(overview, 300, 2))
    current = overview.document.current
    assert (current.marker, current.kind) == ("LWRA", Kind.STEP)
    assert overview.document.shown == ("LWRA",)


def test_click_elsewhere_goes_there_and_drag_scrubs(overview):
    QTest.mouseClick(overview, LEFT, pos=point(overview, 350, 7))
    assert overview.document.current is None
    assert overview.document.frame == pytest.approx(350, abs=1)
    assert overview.document.shown == ("T10",)
    QTest.mousePress(overview, LEFT, pos=point(overview, 350, 7))
    QTest.mouseMove(overview, point(overview, 100, 7))
    QTest.mouseRelease(overview, LEFT, pos=point(overview, 100, 7))
    assert overview.document.frame == pytest.approx(100, abs=1)


def test_what_lies_under_the_mouse_is_named(overview):
    text = overview.describe(point(overview, 300, 2))
    assert "LWRA" in text
    assert "frames 381–430" in text
    assert "80% sure · open" in text
    assert "jumps 30 mm" in text
    assert overview.describe(point(overview, 20, 7)).startswith("T10 · Frame 121")


def test_the_part_in_view_is_framed(overview):
    def colors() -> set[str]:
        image = overview.grab().toImage()
        ratio = image.devicePixelRatio()
        return {
            image.pixelColor(round(x * ratio), round(100 * ratio)).name() for x in range(228, 235)
        }

    assert theme.LIGHT.accent.name() not in colors()
    overview.set_view(100, 200)
    assert theme.LIGHT.accent.name() in colors()


@pytest.mark.parametrize(
    "positions",
    [np.zeros((1, 1, 3)), np.full((40, 3, 3), np.nan), np.zeros((10, 0, 3))],
    ids=["one frame", "nothing seen", "no markers"],
)
def test_odd_takes_are_painted(open_overview, positions):
    take = Take(positions, tuple(f"M{i}" for i in range(positions.shape[1])), 100.0)
    panel = open_overview(take, [Artifact(m, "xyz", 0, 1, Kind.GAP) for m in take.labels])
    panel.grab()
    QTest.mouseClick(panel, LEFT, pos=QPoint(300, 60))
    panel.describe(QPoint(300, 60))


def test_nothing_open(qtbot):
    document = Document()
    panel = Overview(document)
    qtbot.addWidget(panel)
    panel.grab()
    QTest.mouseClick(panel, LEFT)
    assert panel.describe(QPoint(10, 10)) == ""
    assert panel.artifact_at(QPointF(10, 10)) is None
    document.proposals.close()
