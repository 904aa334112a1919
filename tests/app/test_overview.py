"""The overview: what it paints, and where a click goes."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest

from markermend.artifact import Artifact, Kind, Status
from markermend.mesh import Group, Mesh
from markermend.session_file import open_session
from markermend.take import Take
from markermend_app import theme
from markermend_app.document import Document
from markermend_app.panels.overview import Overview
from markermend_app.panels.overview_picture import arrange, missing_share, row_edges

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def make(qtbot, tmp_path):
    """Open a take in an overview."""
    made = []

    def build(take: Take, artifacts=(), mesh=None) -> Overview:
        theme.watcher.theme = theme.LIGHT
        document = Document()
        document.open(open_session(take, folder=tmp_path), mesh)
        if artifacts:
            document.add_detected(artifacts, "test")
        panel = Overview(document)
        qtbot.addWidget(panel)
        panel.resize(692, 182)
        panel.show()
        qtbot.waitExposed(panel)
        made.append(document)
        return panel

    yield build
    for document in made:
        document.open(None, None)
        document.proposals.close()


@pytest.fixture
def overview(make, damaged):
    take, artifacts = damaged
    labels = take.labels
    order = (4, 5, 6, 7), (0, 1, 2, 3)
    mesh = Mesh(labels, (Group("Arm", "", order[0]), Group("Trunk", "", order[1])))
    return make(take, artifacts, mesh)


def _point(panel: Overview, frame: float, row: float) -> QPoint:
    """Pixel of a frame in a row: the picture is 600 by 160 at (80, 4)."""
    return QPoint(round(80 + frame * 600 / 400), round(4 + (row + 0.5) * 160 / 8))


def _color(panel: Overview, at: QPoint):
    image = panel.grab().toImage()
    ratio = image.devicePixelRatio()
    return image.pixelColor(round(at.x() * ratio), round(at.y() * ratio))


def test_rows_follow_the_body():
    mesh = Mesh(tuple("abcd"), (Group("B", "", (3, 1)), Group("A", "", (0,))))
    rows = arrange(4, mesh)
    assert rows.columns == (3, 1, 0, 2)
    assert rows.row_of == (2, 1, 3, 0)
    assert rows.groups == (("B", 0, 2), ("A", 2, 3))
    assert arrange(3, None).columns == (0, 1, 2)


@pytest.mark.parametrize(("frames", "width"), [(1, 50), (7, 50), (1000, 50), (144_000, 600)])
def test_short_gaps_stay_visible(frames: int, width: int):
    origin = np.ones((frames, 2), dtype=np.uint8)
    origin[frames // 2, 1] = 0
    share = missing_share(origin, width)
    assert share.shape == (2, width)
    assert not share[0].any()
    assert share[1].max() >= 1 / 3
    assert missing_share(np.zeros((frames, 1), dtype=np.uint8), width).min() == 1.0


def test_rows_are_at_least_a_pixel_high():
    assert all(b > a for a, b in row_edges(300, 100))
    assert row_edges(2, 10) == [(0, 5), (5, 10)]


def test_artifacts_are_painted_by_class_and_faint_once_rejected(overview):
    kinds = theme.LIGHT.kinds
    gap = next(a for a in overview.document.session.artifacts if a.kind is Kind.GAP)
    at = _point(overview, 75, 4)
    assert _color(overview, at) == kinds[Kind.GAP]
    overview.document.reject([gap.id])
    overview.document.select(None)
    faint = _color(overview, at)
    assert faint != kinds[Kind.GAP]
    # The samples are still missing, so the place is still shaded.
    assert faint != theme.LIGHT.plot
    assert _color(overview, _point(overview, 130, 4)) == theme.LIGHT.plot


def test_click_on_an_artifact_selects_it(overview):
    QTest.mouseClick(overview, LEFT, pos=_point(overview, 300, 2))
    current = overview.document.current
    assert (current.marker, current.kind) == ("LWRA", Kind.STEP)
    assert overview.document.shown == ("LWRA",)


def test_click_elsewhere_goes_there_and_drag_scrubs(overview):
    QTest.mouseClick(overview, LEFT, pos=_point(overview, 350, 7))
    assert overview.document.current is None
    assert overview.document.frame == pytest.approx(350, abs=1)
    assert overview.document.shown == ("T10",)
    QTest.mousePress(overview, LEFT, pos=_point(overview, 350, 7))
    QTest.mouseMove(overview, _point(overview, 100, 7))
    QTest.mouseRelease(overview, LEFT, pos=_point(overview, 100, 7))
    assert overview.document.frame == pytest.approx(100, abs=1)


def test_what_lies_under_the_mouse_is_named(overview):
    text = overview.describe(_point(overview, 300, 2))
    assert "LWRA" in text
    assert "frames 381–430" in text
    assert "80% sure · open" in text
    assert "jumps 30 mm" in text
    assert overview.describe(_point(overview, 20, 7)).startswith("T10 · Frame 121")


def test_a_repair_takes_the_shade_away(overview):
    from markermend.patch import Patch
    from markermend.repairs.registry import Repair

    gap = next(a for a in overview.document.session.artifacts if a.kind is Kind.GAP)
    overview.grab()
    assert overview._missing[0].any()
    patch = Patch("CLAV", "xyz", 60, 90, np.zeros((30, 3)))
    overview.document.repair_many([(gap.id, Repair("test", (patch,)))], "")
    assert not overview._missing[0].any()


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
def test_odd_takes_are_painted(make, positions):
    take = Take(positions, tuple(f"M{i}" for i in range(positions.shape[1])), 100.0)
    panel = make(take, [Artifact(m, "xyz", 0, 1, Kind.GAP) for m in take.labels])
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


def test_long_takes_with_many_markers_are_quick(make):
    import time

    positions = np.zeros((144_000, 40, 3))
    labels = tuple(f"M{i}" for i in range(40))
    artifacts = [
        Artifact(m, "xyz", s, s + 30, Kind.NOISE) for m in labels for s in range(0, 140_000, 5_000)
    ]
    panel = make(Take(positions, labels, 240.0), artifacts)
    panel.grab()
    began = time.perf_counter()
    panel.document.set_queue([a.id for a in artifacts])
    panel.document.accept([artifacts[3].id])
    panel.grab()
    assert time.perf_counter() - began < 0.5
    assert panel.document.session.artifact(artifacts[3].id).status is Status.ACCEPTED
