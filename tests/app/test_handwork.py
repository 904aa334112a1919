"""Work by hand in the real window: sweep with the mouse, do with keys, undo, be as before."""

from __future__ import annotations

import numpy as np
import pytest
from driving import answer_with, state, undo
from plots import SHIFT, Bench
from PySide6.QtCore import QPoint, QPointF, Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QMenu

import markermend as mm
from markermend.artifact import Artifact, Kind, Status
from markermend.review import hand
from markermend.take import Origin, Take
from markermend_app.actions.palette import Palette
from markermend_app.dialogs import export as export_dialog
from markermend_app.looking import Selection
from markermend_app.telling import FORMS

WAIT = 20_000
ACCESSIBLE = Qt.ItemDataRole.AccessibleTextRole
DIRECT = Qt.FindChildOption.FindDirectChildrenOnly
CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def window(at_gap):
    """T10 foremost, the first 150 frames in view."""
    at_gap.document.show(["T10", "LSHO"])
    at_gap.trajectories.framing.set_view(0, 150)
    return at_gap


@pytest.fixture
def mouse(window):
    return Bench(window.trajectories, window.document)


def index_of(window, marker):
    """Row of a marker in the tree."""
    role, flags = Qt.ItemDataRole.DisplayRole, Qt.MatchFlag.MatchRecursive
    model = window.tree.view.model()
    return model.match(model.index(0, 0), role, marker, 1, flags)[0]


def settle(window, qtbot):
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)


def choose(window, qtbot, text):
    """Type a marker's name and press Return; gives what was offered first."""
    asked = window.findChild(Palette)
    assert asked.isVisible()
    offered = [asked.list.item(i).data(ACCESSIBLE).split()[0] for i in range(asked.list.count())]
    qtbot.keyClicks(asked.line, text)
    qtbot.keyClick(asked.line, Qt.Key.Key_Return)
    return offered


def test_cut_opens_a_gap_whose_repair_is_previewed_and_f_fills_it(window, mouse, qtbot):
    document, before = window.document, state(window)
    mouse.drag(40, 59, keys=SHIFT)
    assert (document.selection.marker, document.selection.start) == ("T10", 40)
    qtbot.keyClick(window, Qt.Key.Key_X)
    gap = document.current
    assert (gap.marker, gap.start, gap.stop, gap.kind) == ("T10", 40, 60, Kind.GAP)
    assert np.isnan(document.session.positions[40:60, 3]).all()
    sureness = window.inspector.artifact.sureness
    assert sureness.text() == "made by hand", "something was recorded"
    qtbot.keyClick(window, Qt.Key.Key_BraceRight)
    assert (document.current.stop, sureness.text()) == (59, "made by hand")
    undo(window, qtbot)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    qtbot.keyClick(window, Qt.Key.Key_F)
    document.select(gap.id)
    assert sureness.text() == "made by hand", "repaired, too"
    assert (document.session.origin[40:60, 3] == Origin.FILLED).all()
    miss = document.session.positions[40:60, 3] - document.session.original.positions[40:60, 3]
    assert np.abs(miss).max() < 5.0
    undo(window, qtbot)
    undo(window, qtbot)
    assert state(window) == before


def test_one_frame_alone_is_told_as_one(window, qtbot):
    window.document.sweep(Selection("T10", 40, 41))
    qtbot.keyClick(window, Qt.Key.Key_X)
    reason = "not seen for 1 frame, since samples were cut or moved by hand"
    assert window.inspector.artifact.why.text() == reason
    assert reason in FORMS


def test_a_swept_range_is_repaired_in_one_step(window, mouse, qtbot):
    document, before = window.document, state(window)
    mouse.drag(40, 50, keys=SHIFT)
    qtbot.keyClick(window, Qt.Key.Key_F, SHIFT)
    settle(window, qtbot)
    assert document.current.status is Status.REPAIRED
    assert document.session.history[-1] == "Repair noise on T10 by hand"
    undo(window, qtbot)
    assert state(window) == before


def test_a_key_is_about_what_details_show_and_decides_nothing_behind_a_swept_range(
    window, mouse, qtbot
):
    document = window.document
    mouse.drag(40, 50, keys=SHIFT)
    qtbot.keyClick(window, Qt.Key.Key_X)
    gap = document.current.id
    mouse.drag(100, 110, keys=SHIFT)
    qtbot.keyClick(window, Qt.Key.Key_R)
    assert document.session.artifact(gap).status is Status.PENDING
    assert not window.inspector.shows_range
    qtbot.keyClick(window, Qt.Key.Key_R)
    assert document.session.artifact(gap).status is Status.REJECTED
    mouse.drag(120, 130, keys=SHIFT)
    qtbot.keyClick(window, Qt.Key.Key_F)
    settle(window, qtbot)
    assert document.session.history[-1].startswith("Repair noise on")
    assert document.session.history[-1].endswith("by hand")
    assert document.session.artifact(gap).status is Status.REJECTED


@pytest.mark.parametrize("panel", ["scene", "tree"])
def test_a_swept_range_is_swapped_from_the_menu_on_the_other_marker(window, mouse, qtbot, panel):
    document = window.document
    document.show(["T10"])
    mouse.drag(40, 59, keys=SHIFT)
    if panel == "scene":
        window.scene.grab()
        place = window.scene._at[document.session.original.index("LSHO")]
        at = QPoint(*(round(v) for v in place.tolist()))
        QTest.mouseClick(window.scene, Qt.MouseButton.RightButton, pos=at)
        menu = window.scene.findChild(QMenu, options=DIRECT)
    else:
        window.tree._show_menu(window.tree.view.visualRect(index_of(window, "LSHO")).center())
        menu = window.tree.findChild(QMenu, options=DIRECT)
    assert document.shown == ("LSHO", "T10")
    assert "Selection on T10" in [action.text() for action in menu.actions()]
    next(a for a in menu.actions() if a.objectName() == "swap_selection").trigger()
    assert choose(window, qtbot, "")[0] == "LSHO"
    now, was = document.session.positions, document.session.original.positions
    assert np.array_equal(now[40:60, 3], was[40:60, 4])
    menu.close()


def test_swapping_from_here_to_there(window, mouse, qtbot, monkeypatch):
    document, before = window.document, state(window)
    mouse.drag(40, 59, keys=SHIFT)
    qtbot.keyClick(window, Qt.Key.Key_W)
    # The other marker that is shown is the first to be offered.
    assert choose(window, qtbot, "lsho")[0] == "LSHO"
    now, was = document.session.positions, document.session.original.positions
    assert np.array_equal(now[40:60, 3], was[40:60, 4])
    assert np.array_equal(now[40:60, 4], was[40:60, 3])
    assert np.array_equal(now[60:, 3], was[60:, 3])
    # It can be reopened like any repair.
    qtbot.keyClick(window, Qt.Key.Key_U)
    assert np.array_equal(document.session.positions, was, equal_nan=True)
    undo(window, qtbot)
    undo(window, qtbot)
    assert state(window) == before


@pytest.fixture
def unlabelled(review, damaged, tmp_path):
    """The window on a file in which CLAV's gap was seen under no name."""
    take = damaged[0]
    positions = np.concatenate([take.positions, np.full((take.frames, 1, 3), np.nan)], axis=1)
    positions[60:90, 8] = take.positions[60:90, 3] + [5.0, 0.0, 0.0]
    mm.write(Take(positions, (*take.labels, "*9"), take.rate), tmp_path / "in.c3d")
    gap = Artifact("CLAV", "xyz", 60, 90, Kind.GAP)
    return review(mm.read(tmp_path / "in.c3d"), [gap])


def export(window, qtbot, monkeypatch, target):
    choice = export_dialog.ExportChoice(record=True, mark_outputs=False)
    assert window.commands._exporter.export_to(target, choice, wait=True)
    return mm.read(target)


def test_merging_an_unlabelled_trajectory_in_and_renaming_come_out_right_in_the_file(
    unlabelled, qtbot, monkeypatch, tmp_path
):
    window, document = unlabelled, unlabelled.document
    before = state(window)
    document.show(["*9"])
    qtbot.keyClick(window, Qt.Key.Key_M, CTRL)
    assert choose(window, qtbot, "clav") == ["CLAV"]
    assert document.session.artifacts == ()
    answer_with(qtbot, "STERNUM")
    document.show(["STRN"])
    qtbot.keyClick(window, Qt.Key.Key_F2)
    assert document.shown == ("STERNUM",)
    source = document.session.original
    result = export(window, qtbot, monkeypatch, tmp_path / "out.c3d")
    assert result.labels == ("CLAV", "STERNUM", "C7", "T10", "LSHO", "LELB", "LWRA", "LWRB")
    assert np.array_equal(result.positions[60:90, 0], source.positions[60:90, 8])
    assert np.array_equal(result.positions[:, 1:], source.positions[:, 1:8], equal_nan=True)
    # The offscreen platform does not give the focus back that the list took.
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    undo(window, qtbot)
    assert document.shown == ("STRN",)
    undo(window, qtbot)
    assert state(window) == before


def test_the_gap_of_a_marker_is_closed_by_the_unlabelled_trajectory_that_fits(unlabelled, qtbot):
    window, document = unlabelled, unlabelled.document
    before = state(window)
    document.select(document.session.artifacts[0].id)
    assert "missing" in window.trajectories.header.readout.text()
    qtbot.keyClick(window, Qt.Key.Key_M, CTRL)
    assert choose(window, qtbot, "") == ["*9"]
    assert document.session.artifacts == ()
    assert document.session.take.present[60:90, 0].all()
    assert document.shown == ("CLAV",)
    assert "missing" not in window.trajectories.header.readout.text()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    undo(window, qtbot)
    assert state(window) == before


def test_a_stretch_with_the_wrong_name_is_given_to_the_right_marker(unlabelled, qtbot, monkeypatch):
    window, document = unlabelled, unlabelled.document
    before = state(window)
    document.show(["*9"])
    window.trajectories.framing.set_view(50, 100)
    Bench(window.trajectories, document).drag(70, 79, keys=SHIFT)
    qtbot.keyClick(window, Qt.Key.Key_E)
    choose(window, qtbot, "clav")
    gaps = [(a.start, a.stop) for a in document.session.artifacts]
    assert gaps == [(60, 70), (80, 90)]
    undo(window, qtbot)
    assert state(window) == before
    # What is taken back keeps the marker it was swept on in the plots.
    document.show(["CLAV"])
    window.trajectories.framing.set_view(90, 140)
    Bench(window.trajectories, document).drag(110, 119, keys=SHIFT)
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    qtbot.keyClick(window, Qt.Key.Key_E)
    choose(window, qtbot, "*9")
    undo(window, qtbot)
    assert state(window) == before
    assert document.shown == ("CLAV",)


def test_a_refusal_is_said_aside_and_changes_nothing(window, mouse, qtbot, monkeypatch):
    before = state(window)
    mouse.drag(40, 50, keys=SHIFT)
    with qtbot.waitSignal(window.commands.said) as said:
        qtbot.keyClick(window, Qt.Key.Key_E)
    assert "No other marker" in said.args[0] or "samples of its own" in said.args[0]
    assert state(window) == before


def test_a_sweep_snaps_to_the_edges_of_artifacts(window, mouse, qtbot):
    document = window.document
    document.show(["CLAV"])
    window.trajectories.framing.set_view(0, 400)
    mouse.drag(30, 57, keys=SHIFT)
    assert document.selection.stop == 60
    mouse.drag(91, 130, keys=SHIFT)
    assert document.selection.start == 90


def test_references_are_chosen_by_clicks_in_the_3d_view(window, qtbot):
    document, scene = window.document, window.scene
    document.show(["CLAV", "LSHO"])
    document.go_to(75)
    scene.reset()
    plain = scene.grab().toImage()
    qtbot.keyClick(window, Qt.Key.Key_K)
    assert scene.grab().toImage() != plain, "the view says what clicks do now"

    def click(marker):
        x, y = scene._at[document.session.original.index(marker)]
        QTest.mouseClick(scene, Qt.MouseButton.LeftButton, pos=QPointF(x, y).toPoint())

    for marker in ("STRN", "C7", "T10"):
        click(marker)
    assert document.preview.references == ("STRN", "C7", "T10")
    assert document.shown == ("CLAV", "LSHO")
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    assert document.proposal.method == "local_regression"
    assert "following STRN, C7, T10" in window.inspector.artifact.methods.outcome.text()
    click("C7")
    click("T10")
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    assert document.proposal.method == "pattern"
    assert document.proposal.params["donor"] == "STRN"
    qtbot.keyClick(window, Qt.Key.Key_F)
    assert not window.actions_by_name["choose_references"].isChecked()
    assert document.preview.references == ()


def test_swapped_samples_lie_over_the_source_of_both_and_undo_keeps_the_view(window, mouse, qtbot):
    panel = window.trajectories
    mouse.drag(40, 59, keys=SHIFT)
    qtbot.keyClick(window, Qt.Key.Key_W)
    choose(window, qtbot, "lsho")
    traces = [panel.rows[0].traces[name] for name in ("T10", "LSHO")]
    sources = max(trace.item("original").zValue() for trace in traces)
    for trace in traces:
        assert np.isfinite(trace.item("edited").values[1:-1]).all()
        assert trace.item("edited").zValue() > sources
        styles = {trace.item(p).worn.style() for p in ("measured", "filled", "edited")}
        assert len(styles) == 3
    panel.framing.set_view(30, 75)
    undo(window, qtbot)
    assert mouse.time == pytest.approx((30, 75))
    qtbot.keyClick(window, Qt.Key.Key_Y, CTRL)
    assert mouse.time == pytest.approx((30, 75))
    panel.framing.set_view(90, 120)
    undo(window, qtbot)
    qtbot.waitUntil(lambda: mouse.time[0] < 40)
    assert mouse.time[1] > 60


def test_with_the_source_in_front_its_values_are_read_out(window, mouse, qtbot):
    document, readout = window.document, window.trajectories.header.readout
    mouse.drag(40, 59, keys=SHIFT)
    qtbot.keyClick(window, Qt.Key.Key_W)
    choose(window, qtbot, "lsho")
    document.go_to(50)
    assert "(edited)" in readout.toolTip()
    qtbot.keyClick(window, Qt.Key.Key_B)
    assert "(edited)" not in readout.toolTip()
    value = document.session.original.positions[document.frame, 3, 0]
    assert f"T10 {value:.1f}" in readout.toolTip()
    row = window.trajectories.rows[0]
    assert row.value_at("T10", document.frame) == value


@pytest.mark.parametrize("what", [Qt.Key.Key_M, Qt.Key.Key_X])
def test_what_was_made_of_a_range_is_seen_in_space(window, mouse, qtbot, what):
    document = window.document
    document.go_to(130)
    view = mouse.time
    mouse.drag(40, 60, keys=SHIFT)
    qtbot.keyClick(window, what)
    assert document.current.start <= document.frame < document.current.stop
    assert mouse.time == view


def test_renaming_leaves_what_is_seen_as_it_was(window, mouse, qtbot):
    document, scene = window.document, window.scene
    mouse.drag(40, 60, keys=SHIFT)
    qtbot.keyClick(window, Qt.Key.Key_M)
    window.trajectories.framing.set_view(30, 80)
    scene.set_vertical(0)
    qtbot.keyClick(scene, Qt.Key.Key_Plus)
    qtbot.keyClicks(window.queue.filters.marker, "T1")
    seen = mouse.time, scene.camera, window.overview._view
    values = mouse.panel.rows[0].view.viewRange()[1]
    answer_with(qtbot, "LUMB")
    qtbot.keyClick(window, Qt.Key.Key_F2)
    assert document.current.marker == "LUMB"
    assert (mouse.time, scene.camera, window.overview._view) == seen
    assert mouse.panel.rows[0].view.viewRange()[1] == pytest.approx(values)
    assert scene._vertical == 0
    assert window.queue.filters.marker.text() == "T1"


def test_the_name_of_the_subject_is_not_overwritten(window, qtbot):
    document = window.document
    document.do(lambda session: hand.rename(session, {"T10": "Anna:T10"}))
    document.show(["Anna:T10"])

    def write():
        line = QApplication.activeModalWidget().findChild(QLineEdit)
        qtbot.keyClicks(line, "LUMB")
        qtbot.keyClick(line, Qt.Key.Key_Return)

    QTimer.singleShot(200, write)
    qtbot.keyClick(window, Qt.Key.Key_F2)
    assert document.shown == ("Anna:LUMB",)
