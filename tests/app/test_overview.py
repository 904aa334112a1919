"""The overview: what it paints, and where a click goes."""

from __future__ import annotations

import threading

import numpy as np
import pytest
from driving import settled
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from markermend.artifact import Artifact, Kind, Status
from markermend.heat import missing_share
from markermend.mesh import Group, Mesh
from markermend.review import hand
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app.background.jobs import Lane
from markermend_app.document import Document
from markermend_app.panels.overview.overview import Overview
from markermend_app.panels.overview.picture import arrange, heat, residual_levels, row_edges
from markermend_app.rows import Rows
from markermend_app.style import theme

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def make(qtbot, tmp_path):
    """Open a take in an overview."""
    made = []

    def build(take: Take, artifacts=(), mesh=None, first=None) -> Overview:
        theme.watcher.theme = theme.LIGHT
        document = Document()
        document.open(open_session(take, folder=tmp_path), mesh)
        if artifacts:
            document.decisions.add_detected(artifacts, "test")
        panel = Overview(document, first)
        qtbot.addWidget(panel)
        panel.resize(692, 182)
        panel.show()
        qtbot.waitExposed(panel)
        made.append((document, panel))
        return panel

    yield build
    for document, panel in made:
        panel.levels.residuals.close()
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
    assert rows.groups == (("B", 0, 2), ("A", 2, 3), ("Others", 3, 4))
    assert arrange(3, None).columns == (0, 1, 2)


def test_rows_are_at_least_a_pixel_high():
    assert all(b > a for a, b in row_edges(300, 100))
    assert row_edges(2, 10) == [(0, 5), (5, 10)]


def test_artifacts_are_painted_by_class_and_faint_once_rejected(overview):
    kinds = theme.LIGHT.kinds
    gap = next(a for a in overview.document.session.artifacts if a.kind is Kind.GAP)
    at = _point(overview, 75, 4)
    assert _color(overview, at) == kinds[Kind.GAP]
    overview.document.decisions.reject([gap.id])
    overview.document.select(None)
    faint = _color(overview, at)
    assert faint != kinds[Kind.GAP]
    # The samples are still missing, so the place is still shaded.
    assert faint not in (theme.LIGHT.plot, _color(overview, _point(overview, 130, 4)))


def test_a_mix_up_is_painted_and_clicked_on_the_rows_of_both_markers(overview):
    document = overview.document
    swap = Artifact("CLAV", "xyz", 110, 140, Kind.STEP, counterpart="LELB")
    document.decisions.add_detected([*document.session.artifacts, swap], "")

    def middle(artifact, marker):
        row = overview._rows.row_of[overview._column_of[marker]]
        return _point(overview, (artifact.start + artifact.stop) / 2, row)

    places = [middle(swap, marker) for marker in swap.markers]
    assert [_color(overview, at) for at in places] == [theme.LIGHT.kinds[Kind.STEP]] * 2
    # Those listed after it lie on one row each.
    assert len(document.session.artifacts) == 5
    for artifact in document.session.artifacts:
        for marker in artifact.markers:
            QTest.mouseClick(overview, LEFT, pos=middle(artifact, marker))
            assert document.current == artifact


def test_every_other_group_lies_on_a_band(overview):
    arm, trunk = (
        _color(overview, _point(overview, 130, 2)),
        _color(overview, _point(overview, 130, 6)),
    )
    assert arm == theme.LIGHT.plot
    assert trunk != arm
    assert abs(trunk.lightness() - arm.lightness()) < 30


def test_gaps_alone(overview):
    overview.mode.choose("gaps")
    assert _color(overview, _point(overview, 75, 4)) == theme.LIGHT.kinds[Kind.GAP]
    # The step on LWRA is no gap.
    assert _color(overview, _point(overview, 300, 2)) == theme.LIGHT.plot
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


def test_residuals_come_from_a_thread_and_follow_repairs(overview, qtbot):
    document = overview.document
    overview.mode.choose("residual")
    overview.grab()
    qtbot.waitUntil(lambda: overview.levels.residuals.values is not None, timeout=30_000)
    step, calm = (
        _color(overview, _point(overview, 305, 2)),
        _color(overview, _point(overview, 30, 2)),
    )
    most, least = heat("residual")[-1], heat("residual")[0]

    def apart(a, b):
        return sum(abs(x - y) for x, y in zip(a.toTuple(), b.toTuple(), strict=True))

    assert apart(step, most) < apart(step, least)
    assert apart(calm, least) < apart(calm, most)
    assert "mm off its body" in overview.describe(_point(overview, 350, 7))
    artifact = next(a for a in document.session.artifacts if a.kind is Kind.STEP)
    before = overview.levels.residuals.values[6, 285:325].copy()
    document.select(artifact.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=20_000)
    document.decisions.repair_current()

    def mended():
        overview.grab()
        return np.nanmedian(overview.levels.residuals.values[6, 285:325]) < 0.3 * np.median(before)

    qtbot.waitUntil(mended, timeout=30_000)


def test_residuals_are_made_anew_once_damage_is_known(overview, qtbot):
    document = overview.document
    found = document.session.artifacts
    document.decisions.remove([a.id for a in found])
    overview.mode.choose("residual")
    overview.grab()
    qtbot.waitUntil(lambda: overview.levels.residuals.values is not None, timeout=30_000)
    before = overview.levels.residuals.values
    neighbour = before[7, 285:325].copy()
    document.decisions.add_detected(found, "again")

    def anew():
        overview.grab()
        return overview.levels.residuals.share is None and not np.array_equal(
            overview.levels.residuals.values[7, 285:325], neighbour, equal_nan=True
        )

    qtbot.waitUntil(anew, timeout=30_000)


def test_residuals_give_way_to_jobs_that_come_first(make, damaged, qtbot):
    lane, order, held = Lane("first"), [], threading.Event()

    def search(progress):
        assert held.wait(30)

    def found(_):
        # As detection follows once the body is known: queued when the job before has ended.
        order.append(panel.levels.residuals.share)
        lane.submit("Last", lambda progress: None, last, order.append)

    def last(_):
        order.append(panel.levels.residuals.share)

    panel = make(damaged[0], damaged[1], first=lane)
    lane.submit("First", search, found, order.append)
    panel.mode.choose("residual")
    panel.grab()
    qtbot.wait(100)
    assert panel.levels.residuals.share is None
    held.set()
    qtbot.waitUntil(lambda: panel.levels.residuals.values is not None, timeout=30_000)
    assert order == [None, None], "they began before the last job was done"
    lane.close()


def test_unknown_residuals_are_grey_and_levels_stay_in_range():
    levels = residual_levels(np.array([0, 5, 20, 900, np.nan], dtype=np.float32))
    np.testing.assert_allclose(levels[:4], [0, 0.5, 1, 1])
    assert np.isnan(levels[4])


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
    at = _point(overview, 75, 4)
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


def test_a_repair_takes_the_shade_away(overview, qtbot):
    from markermend.patch import Patch
    from markermend.repairs.registry import Repair

    gap = next(a for a in overview.document.session.artifacts if a.kind is Kind.GAP)
    overview.grab()
    assert overview.levels.of("damage", 600, (0, 400))[0].any()
    patch = Patch("CLAV", "xyz", 60, 90, np.zeros((30, 3)))
    overview.document.decisions.repair_many([(gap.id, Repair("test", (patch,)))], "")
    settled(qtbot)
    assert not overview.levels.of("damage", 600, (0, 400))[0].any()


def test_what_is_painted_while_a_count_waits_is_painted_anew(overview, qtbot):
    from markermend.patch import Patch
    from markermend.repairs.registry import Repair

    document = overview.document
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    patch = Patch("CLAV", "xyz", 60, 90, np.zeros((30, 3)))
    document.decisions.repair_many([(gap.id, Repair("test", (patch,)))], "")
    overview.grab()
    settled(qtbot)
    now = overview.grab().toImage()
    overview._opened()
    settled(qtbot)
    assert overview.grab().toImage() == now


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
    began = time.process_time()
    panel.document.set_queue(Rows([[a.id] for a in artifacts]))
    panel.document.decisions.accept([artifacts[3].id])
    panel.grab()
    assert time.process_time() - began < 0.5
    assert panel.document.session.artifact(artifacts[3].id).status is Status.ACCEPTED


def test_what_is_missing_is_counted_anew_where_samples_changed_only(overview, monkeypatch, qtbot):
    counted = []

    def count(origin, *more):
        counted.append(origin.shape[1])
        return missing_share(origin, *more)

    overview.grab()
    monkeypatch.setattr("markermend_app.panels.overview.missing.missing_share", count)
    document = overview.document
    document.do(lambda s: hand.cut(s, "C7", 10, 60))
    settled(qtbot)
    overview.grab()
    assert counted == [1]
    take, (width, span, share) = document.session.take, overview.levels._missing._known
    assert np.array_equal(share, missing_share(take.origin, width, *span))
    assert share[take.index("C7")].max() == 1.0
    overview.set_span(0, 100)
    overview.grab()
    assert counted == [1, take.markers]


def test_a_long_take_is_counted_after_its_first_picture_and_once(make, damaged, monkeypatch, qtbot):
    take, artifacts = damaged
    counted = []

    def count(origin, *more):
        counted.append(origin.shape[1])
        return missing_share(origin, *more)

    monkeypatch.setattr("markermend_app.panels.overview.missing.missing_share", count)
    monkeypatch.setattr("markermend_app.panels.overview.levels._MUCH", 0)
    panel = make(take, artifacts)
    panel.grab()
    assert counted == []
    assert panel.levels._count.waiting
    settled(qtbot)
    gap = next(a for a in artifacts if a.kind is Kind.GAP)
    at = _point(panel, (gap.start + gap.stop) / 2, take.index(gap.marker))
    panel.mode.choose("gaps")
    settled(qtbot)
    shaded, clean = _color(panel, at), _color(panel, _point(panel, 5, take.index(gap.marker)))
    assert shaded != clean
    # Which markers belong together changes nothing of it.
    panel.document.learn(Mesh(take.labels, (Group("All", "", tuple(range(take.markers))),)))
    settled(qtbot)
    panel.grab()
    assert counted == [take.markers]
