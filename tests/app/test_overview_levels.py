"""The overview: what is missing, and how far off the body samples are, kept up with the edits."""

from __future__ import annotations

import threading

import numpy as np
from driving import settled
from overviews import color, point

from markermend.artifact import Kind
from markermend.heat import missing_share
from markermend.mesh import Group, Mesh
from markermend.review import hand
from markermend_app.background.jobs import Lane
from markermend_app.panels.overview.picture import heat, residual_levels


def test_residuals_come_from_a_thread_and_follow_repairs(overview, qtbot):
    document = overview.document
    overview.mode.choose("residual")
    overview.grab()
    qtbot.waitUntil(lambda: overview.levels.residuals.values is not None, timeout=30_000)
    step, calm = (
        color(overview, point(overview, 305, 2)),
        color(overview, point(overview, 30, 2)),
    )
    most, least = heat("residual")[-1], heat("residual")[0]

    def apart(a, b):
        return sum(abs(x - y) for x, y in zip(a.toTuple(), b.toTuple(), strict=True))

    assert apart(step, most) < apart(step, least)
    assert apart(calm, least) < apart(calm, most)
    assert "mm off its body" in overview.describe(point(overview, 350, 7))
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


def test_residuals_give_way_to_jobs_that_come_first(open_overview, damaged, qtbot):
    lane, order, held = Lane("first"), [], threading.Event()

    def search(progress):
        assert held.wait(30)

    def found(_):
        # As detection follows once the body is known: queued when the job before has ended.
        order.append(panel.levels.residuals.share)
        lane.submit("Last", lambda progress: None, last, order.append)

    def last(_):
        order.append(panel.levels.residuals.share)

    panel = open_overview(damaged[0], damaged[1], first=lane)
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


def test_a_long_take_is_counted_after_its_first_picture_and_once(
    open_overview, damaged, monkeypatch, qtbot
):
    take, artifacts = damaged
    counted = []

    def count(origin, *more):
        counted.append(origin.shape[1])
        return missing_share(origin, *more)

    monkeypatch.setattr("markermend_app.panels.overview.missing.missing_share", count)
    monkeypatch.setattr("markermend_app.panels.overview.levels._MUCH", 0)
    panel = open_overview(take, artifacts)
    panel.grab()
    assert counted == []
    assert panel.levels._count.waiting
    settled(qtbot)
    gap = next(a for a in artifacts if a.kind is Kind.GAP)
    at = point(panel, (gap.start + gap.stop) / 2, take.index(gap.marker))
    panel.mode.choose("gaps")
    settled(qtbot)
    shaded, clean = color(panel, at), color(panel, point(panel, 5, take.index(gap.marker)))
    assert shaded != clean
    # Which markers belong together changes nothing of it.
    panel.document.learn(Mesh(take.labels, (Group("All", "", tuple(range(take.markers))),)))
    settled(qtbot)
    panel.grab()
    assert counted == [take.markers]
