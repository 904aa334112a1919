"""The trajectories panel, driven as a hand would."""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
import pytest
from plots import LEFT, RIGHT, SHIFT
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenu

from markermend.artifact import Artifact, Kind, Status
from markermend.review.file import open_session
from markermend.take import Event
from markermend_app.looking import Selection
from markermend_app.panels.plots.prediction import SETTLED_MS


def test_all_plots_share_one_time(bench):
    bench.panel.framing.set_view(50, 150)
    ranges = [row.view.viewRange()[0] for row in bench.panel.rows]
    assert ranges[0] == ranges[1] == ranges[2] == pytest.approx([50, 150])
    heights = [row.view.sceneBoundingRect().height() for row in bench.panel.rows]
    assert max(heights) - min(heights) <= 1


def test_flags_of_events_cover_no_curve(open_plots, damaged):
    take = replace(damaged[0], events=(Event("Foot Strike", 1.0, "Left"),))
    bench = open_plots(take)
    bench.document.show(["CLAV"])
    top, below = bench.panel.rows[:2]
    assert top.flags.height > 10
    assert below.flags.height == 0
    highest = QPointF(0, float(np.nanmax(top.values_of["CLAV"])))
    at = top.view.mapViewToScene(highest).y() - top.view.sceneBoundingRect().top()
    assert at > top.flags.height


def test_click_moves_the_cursor_and_drag_scrubs(bench):
    bench.click(300)
    assert bench.document.frame == pytest.approx(300, abs=1)
    bench.drag(300, 200)
    assert bench.document.frame == pytest.approx(200, abs=1)
    assert all(row.cursor.value() == bench.document.frame for row in bench.panel.rows)


def test_the_buttons_stay_beside_their_interval_when_the_plots_have_another_size(bench, qtbot):
    bench.click(75)
    for height in (200, 500, 320):
        bench.panel.resize(bench.panel.width(), height)
        row = next(row for row in bench.panel.rows if row.edges.visible)
        qtbot.waitUntil(
            lambda row=row: (
                abs(bench.panel.buttons.y() - row.view.sceneBoundingRect().top() - row.flags.height)
                <= 10
            )
        )


def test_what_is_gone_back_to_is_in_view_with_its_values(bench):
    panel, document = bench.panel, bench.document
    document.show(["CLAV"])
    document.look_at(["CLAV"], 60, 90)
    view = panel.rows[0].view
    fitted = view.viewRange()[1]
    # As a repair that is taken back leaves it.
    view.setYRange(fitted[1], fitted[1] + 1, padding=0)
    document.reveal(["CLAV"], 60, 90)
    assert view.viewRange()[1] == pytest.approx(fitted)


def test_click_on_an_interval_selects_and_frames_it(bench):
    bench.click(75)
    current = bench.document.current
    assert (current.marker, current.kind) == ("CLAV", Kind.GAP)
    low, high = bench.time
    assert low <= 60 - 60
    assert high >= 90 + 90
    assert bench.panel.buttons.isVisible()
    assert bench.panel.rows[0].edges.visible


def test_buttons_beside_the_interval_decide(bench):
    bench.click(75)
    first = bench.document.current
    QTest.mouseClick(bench.panel.buttons.accept, LEFT)
    assert bench.document.session.artifact(first.id).status is Status.ACCEPTED
    bench.document.undo()
    bench.document.select(first.id)
    QTest.mouseClick(bench.panel.buttons.reject, LEFT)
    assert bench.document.session.artifact(first.id).status is Status.REJECTED


def test_double_click_repairs_and_undo_restores(bench, qtbot):
    before = bench.document.session.positions.copy()
    bench.double_click(75)
    artifact = next(a for a in bench.document.session.artifacts if a.kind is Kind.GAP)
    qtbot.waitUntil(
        lambda: bench.document.session.artifact(artifact.id).status is Status.REPAIRED,
        timeout=20_000,
    )
    trace = bench.panel.rows[0].traces.get("CLAV")
    if trace is not None:
        assert np.isfinite(trace.item("filled").values).any()
    bench.document.undo()
    np.testing.assert_array_equal(bench.document.session.positions, before)


def test_the_proposal_is_previewed_with_its_band(bench, qtbot):
    gap = next(a for a in bench.document.session.artifacts if a.kind is Kind.GAP)
    bench.document.select(gap.id)
    qtbot.waitUntil(lambda: bench.document.proposal is not None, timeout=20_000)
    repair = bench.document.proposal
    for row in bench.panel.rows:
        (item,) = row.proposed
        assert (item.frames[0], item.frames[-1]) == (59, 90)
        np.testing.assert_array_equal(item.values[1:-1], repair.patches[0].values[:, row.column])
    if repair.band_mm is not None:
        assert not bench.panel.rows[0].band.boundingRect().isEmpty()
    bench.document.select(None)
    assert not any(row.proposed for row in bench.panel.rows)


def test_a_repair_keeps_its_band_also_when_the_review_is_opened_again(
    bench, damaged, qtbot, tmp_path
):
    document, panel = bench.document, bench.panel
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.select(gap.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=20_000)
    previewed = [row.band.boundingRect() for row in panel.rows]
    assert all(box.height() > 0 for box in previewed)

    document.decisions.repair_current()
    document.select(gap.id)
    for row, box in zip(panel.rows, previewed, strict=True):
        assert not row.proposed
        # The review keeps it in micrometres.
        assert row.band.boundingRect().getRect() == pytest.approx(box.getRect(), abs=2e-3)

    document.undo()
    document.select(None)
    assert all(row.band.boundingRect().isEmpty() for row in panel.rows)
    document.redo()

    mesh = document.mesh
    document.open(None, None)
    document.open(open_session(damaged[0], folder=tmp_path), mesh)
    document.select(gap.id)
    assert document.current.status is Status.REPAIRED
    for row, box in zip(panel.rows, previewed, strict=True):
        assert row.band.boundingRect().getRect() == pytest.approx(box.getRect(), abs=2e-3)


def test_double_click_on_nothing_shows_everything(bench):
    bench.panel.framing.set_view(250, 350)
    bench.double_click(300)
    low, high = bench.time
    assert low <= 0
    assert high >= 399


def test_wheel_zooms_time_at_the_mouse_and_with_ctrl_values(bench):
    bench.panel.framing.fit_all()
    low, high = bench.time
    view = bench.panel.rows[0].view
    at = view.mapSceneToView(bench.panel.canvas.mapToScene(bench.at(300))).x()
    bench.wheel(300, 2)
    new_low, new_high = bench.time
    assert new_high - new_low < 0.8 * (high - low)
    assert (at - new_low) / (new_high - new_low) == pytest.approx(
        (at - low) / (high - low), abs=0.02
    )
    values = view.viewRange()[1]
    bench.wheel(300, 2, Qt.KeyboardModifier.ControlModifier)
    assert np.diff(view.viewRange()[1]) < 0.8 * np.diff(values)
    assert bench.time == (new_low, new_high)


def test_right_drag_pans(bench):
    bench.panel.framing.set_view(100, 200)
    bench.drag(150, 170, button=RIGHT)
    assert bench.time[0] == pytest.approx(80, abs=1)
    assert bench.time[1] == pytest.approx(180, abs=1)


def test_the_view_stays_on_the_take(bench):
    bench.panel.framing.set_view(-500, -400)
    assert bench.time[0] >= -10
    bench.panel.framing.set_view(-1e6, 1e6)
    assert bench.time[1] <= 410
    bench.panel.framing.zoom(1e-9)
    assert np.diff(bench.time) >= 5


def test_shift_drag_sweeps(bench, qtbot):
    with qtbot.waitSignal(bench.document.selection_changed):
        bench.drag(120, 180, keys=SHIFT)
    selection = bench.document.selection
    assert selection.marker == "CLAV"
    assert selection.start == pytest.approx(120, abs=1)
    assert selection.stop == pytest.approx(181, abs=1)
    assert bench.panel.rows[2].sweep.isVisible()
    bench.document.sweep(None)
    assert not bench.panel.rows[2].sweep.isVisible()


def test_dragging_an_edge_changes_the_interval_and_can_be_undone(bench):
    gap = next(a for a in bench.document.session.artifacts if a.kind is Kind.GAP)
    bench.document.select(gap.id)
    bench.panel.framing.set_view(40, 140)
    bench.drag(89.5, 99.5)
    changed = bench.document.session.artifact(gap.id)
    assert (changed.start, changed.stop) == (60, pytest.approx(100, abs=1))
    assert {row.edges.frames for row in bench.panel.rows} == {(60, changed.stop)}
    bench.document.undo()
    assert bench.document.session.artifact(gap.id) == gap


def test_shift_drag_sweeps_even_from_an_edge(bench):
    gap = next(a for a in bench.document.session.artifacts if a.kind is Kind.GAP)
    bench.document.select(gap.id)
    bench.panel.framing.set_view(40, 140)
    bench.drag(89.5, 120, keys=SHIFT)
    assert bench.document.session.artifact(gap.id) == gap
    assert bench.document.selection.stop == pytest.approx(121, abs=1)


def test_values_follow_the_view_until_a_hand_moves_them(bench):
    row = bench.panel.rows[0]
    bench.panel.framing.set_view(0, 50)
    before = row.view.viewRange()[1]
    bench.panel.framing.set_view(300, 350)
    assert row.view.viewRange()[1][0] > before[1]
    bench.wheel(320, 1, Qt.KeyboardModifier.ControlModifier)
    by_hand = row.view.viewRange()[1]
    bench.panel.framing.set_view(0, 50)
    assert row.view.viewRange()[1] == by_hand
    bench.panel.framing.fit_all()
    assert row.view.viewRange()[1] != by_hand


def test_a_proposal_out_of_view_takes_no_room_from_the_values_in_it(bench, qtbot):
    gap = next(a for a in bench.document.session.artifacts if a.kind is Kind.GAP)
    bench.document.select(gap.id)
    qtbot.waitUntil(lambda: bench.document.proposal is not None, timeout=20_000)
    x = bench.panel.rows[0]
    assert x.proposed
    # The body walks along X: the gap lies at 0.2 m, the end of the take at 1.2 m.
    bench.panel.framing.set_view(300, 390)
    seen = x.values_of["CLAV"][300:390]
    low, high = x.view.viewRange()[1]
    assert high - low < 1.5 * np.ptp(seen)


def test_menu_of_an_interval_changes_its_class(bench, monkeypatch):
    opened = []
    monkeypatch.setattr(QMenu, "popup", lambda menu, *_: opened.append(menu))
    bench.click(75, button=RIGHT)
    (menu,) = opened
    classes = next(a.menu() for a in menu.actions() if a.menu() and a.text() == "Class")
    next(a for a in classes.actions() if a.text() == "Step").trigger()
    assert bench.document.current.kind is Kind.STEP
    reject = next(a for a in menu.actions() if a.text().startswith("Reject"))
    reject.trigger()
    gap = next(a for a in bench.document.session.artifacts if a.marker == "CLAV")
    assert gap.status is Status.REJECTED


def test_menu_of_a_sweep_asks_the_window(bench, monkeypatch, qtbot):
    opened = []
    monkeypatch.setattr(QMenu, "popup", lambda menu, *_: opened.append(menu))
    bench.document.sweep(Selection("CLAV", 200, 260))
    bench.click(230, button=RIGHT)
    actions = {a.text().split("\t")[0]: a for a in opened[0].actions()}
    with qtbot.waitSignal(bench.panel.mark_requested) as marked:
        actions["Mark as noise"].trigger()
    assert marked.args == [Kind.NOISE]
    with qtbot.waitSignal(bench.panel.verb_requested) as asked:
        actions["Cut selection"].trigger()
    assert asked.args == ["cut_selection"]


def test_prediction_comes_on_demand(bench, qtbot):
    row = bench.panel.rows[0]
    bench.panel.set_prediction_shown(True)
    qtbot.waitUntil(lambda: "CLAV" in bench.panel.predictions.known, timeout=20_000)
    predicted = row.traces["CLAV"].item("predicted").values
    truth = bench.document.session.positions[:, 0, 0]
    assert np.nanmedian(np.abs(predicted - truth)) < 20
    bench.panel.set_prediction_shown(False)
    assert row.traces["CLAV"].item("predicted").values is None


def test_prediction_is_made_anew_when_what_it_learned_from_changes(bench, qtbot):
    known = bench.panel.predictions.known
    bench.panel.set_prediction_shown(True)
    qtbot.waitUntil(lambda: "CLAV" in known, timeout=20_000)
    first = known["CLAV"]
    noise = next(a.id for a in bench.document.session.artifacts if a.marker == "C7")
    bench.document.decisions.accept([noise])
    qtbot.wait(SETTLED_MS + 300)
    assert known["CLAV"] is first
    bench.document.decisions.reject([noise])
    assert known["CLAV"] is first
    qtbot.waitUntil(lambda: known["CLAV"] is not first, timeout=20_000)
    apart = np.abs(known["CLAV"] - first)
    assert np.nanmax(apart[200:240]) > np.nanmedian(apart)


def test_markers_passed_by_are_not_predicted(bench, qtbot, monkeypatch):
    labels = bench.document.session.original.labels
    begun, go_on = [], threading.Event()

    def predict(positions, marker, *, trusted):
        begun.append(labels[marker])
        assert go_on.wait(10)
        return positions[:, marker]

    monkeypatch.setattr("markermend.predictors.local.predict_local", predict)
    bench.document.show(labels[:2])
    bench.panel.set_prediction_shown(True)
    qtbot.waitUntil(lambda: bool(begun))
    for name in labels[2:5]:
        bench.document.show([name])
    go_on.set()
    known = bench.panel.predictions.known
    qtbot.waitUntil(lambda: labels[4] in known)
    assert begun == [labels[0], labels[4]]
    bench.document.show(labels[5:8])
    qtbot.waitUntil(lambda: set(labels[5:8]) <= set(known))
    assert begun == [labels[0], *labels[4:8]]
    go_on.clear()
    bench.document.show(labels[1:4])
    qtbot.waitUntil(lambda: len(begun) == 6)
    bench.panel.set_prediction_shown(False)
    go_on.set()
    qtbot.wait(50)
    assert len(begun) == 6
    assert labels[1] not in known
    bench.panel.set_prediction_shown(True)
    qtbot.waitUntil(lambda: set(labels[1:4]) <= set(known))
    go_on.clear()
    bench.panel.predictions.forget()
    bench.document.show(labels[:2])
    qtbot.waitUntil(lambda: begun[-1] == labels[0])
    bench.document.show([labels[1]])
    go_on.set()
    qtbot.waitUntil(lambda: labels[1] in known)
    assert labels[0] not in known


def test_the_view_follows_a_cursor_that_leaves_it(bench):
    bench.panel.framing.set_view(0, 100)
    bench.document.go_to(105)
    low, high = bench.time
    assert low <= 105 <= high
    assert high > 150


def test_what_lies_under_the_mouse_is_read_out(bench):
    readout = bench.panel.header.readout
    assert readout.text().startswith("Frame 101 · 0.000 s · CLAV ")
    bench.panel.canvas.scene().sigMouseMoved.emit(bench.panel.canvas.mapToScene(bench.at(75, "y")))
    assert readout.text() == "Frame 176 · 0.750 s · CLAV missing"
    assert "not seen for 30 frames" in bench.panel.rows[1].intervals.toolTip()
    bench.panel.canvas.scene().sigMouseMoved.emit(bench.panel.canvas.mapToScene(bench.at(300, "y")))
    value = bench.document.session.positions[300, 0, 1]
    assert readout.text() == f"Frame 401 · 3.000 s · CLAV Y {value:.1f} mm"
    assert bench.panel.rows[1].intervals.toolTip() == ""


def test_the_legend_brings_a_marker_to_the_front(bench):
    bench.document.show(["CLAV", "STRN"])
    bench.panel.header.chosen.emit("STRN")
    assert bench.document.shown == ("STRN", "CLAV")
    assert list(bench.panel.rows[0].traces) == ["STRN", "CLAV"]


def test_a_swap_is_previewed_on_both_markers(bench, qtbot):
    bench.document.decisions.mark(Artifact("CLAV", "xyz", 250, 280, Kind.STEP, counterpart="STRN"))
    assert set(bench.document.shown) == {"CLAV", "STRN"}
    bench.document.choose_method("swap")
    qtbot.waitUntil(lambda: bench.document.proposal is not None, timeout=20_000)
    assert [p.marker for p in bench.document.proposal.patches] == ["CLAV", "STRN"]
    for row in bench.panel.rows:
        assert len(row.proposed) == 2


def test_empty_states_and_before_after(bench):
    bench.panel.set_before_after(True)
    bench.panel.set_before_after(False)
    bench.document.show([])
    assert bench.panel.empty.isVisible()
    bench.document.open(None, None)
    assert "No take" in bench.panel.empty.accessibleName()
