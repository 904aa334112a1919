"""Joint centres in the real window: key, dialog, what is saved, and what is left when cancelled."""

from __future__ import annotations

import time

import numpy as np
import pytest
from driving import WAIT
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog, QMessageBox

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.files.pose import write_pose
from markermend.files.restructure import crop
from markermend.poses.from_markers import joint_centres
from markermend.review import hand
from markermend.simulation import simulate_clean
from markermend_app import settings
from markermend_app.actions import menus
from markermend_app.dialogs.joint_centres import DOUBT, ERROR, JOINT, TOLD_BY, TURNING
from markermend_app.style import theme

CTRL = Qt.KeyboardModifier.ControlModifier
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture(scope="module")
def performer():
    """A whole body of which some joints are found and some are not."""
    return simulate_clean(duration_s=20.0, rate=50.0, seed=0)


@pytest.fixture
def opened(window, performer, tmp_path, qtbot):
    """The window on a file of the performer that nobody has searched."""
    settings.remember("detect_on_open", False)
    path = tmp_path / "walk.c3d"
    mm.write(performer, path)
    return show(window, path, qtbot)


def show(window, path, qtbot):
    window.commands.open_path(path)
    qtbot.waitUntil(lambda: window.document.path == path, timeout=WAIT)
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)
    return window


def press(window, qtbot):
    """Ask for joint centres by key."""
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    qtbot.keyClick(window, Qt.Key.Key_J, CTRL)
    assert window.centring.dialog.isVisible()
    return window.centring.dialog


def listed(window, qtbot):
    """The dialog, once joints are listed."""
    dialog = press(window, qtbot)
    qtbot.waitUntil(lambda: dialog.found is not None, timeout=WAIT)
    return dialog


def choose(monkeypatch, target):
    """Let the file dialog answer with a name, and note what it proposed."""
    proposed = []

    def ask(_parent, _title, proposal, _kinds):
        proposed.append(proposal)
        return str(target), ""

    monkeypatch.setattr(QFileDialog, "getSaveFileName", ask)
    return proposed


def rows(dialog):
    """What each row says, cell by cell."""
    model = dialog.table.model()
    return [
        [model.index(row, column).data() or "" for column in range(model.columnCount())]
        for row in range(model.rowCount())
    ]


def test_joints_are_listed_with_their_figures_then_what_is_left_out_and_why(
    opened, performer, qtbot
):
    dialog = listed(opened, qtbot)
    wanted = joint_centres(performer)
    kept = [j for j in wanted.joints if not j.left_out]
    left_out = [j for j in wanted.joints if j.left_out]
    assert kept
    assert left_out
    assert dialog.heading.text() == f"{len(kept)} joints found, {len(left_out)} left out"
    told = rows(dialog)
    for joint, row in zip(kept, told, strict=False):
        assert row[JOINT] == joint.name
        assert float(row[ERROR]) == pytest.approx(joint.error_mm, abs=0.051)
        assert float(row[DOUBT]) == pytest.approx(joint.doubt_mm, abs=0.51)
        assert float(row[TURNING]) == pytest.approx(joint.turning_deg, abs=0.051)
        assert row[TOLD_BY] == (joint.along or "movement")
    assert told[len(kept)][JOINT] == "Left out"
    assert [row[:2] for row in told[len(kept) + 1 :]] == [[j.name, j.left_out] for j in left_out]
    assert "all frames" in dialog.about.text()
    assert dialog.warning.isHidden()
    qtbot.mouseClick(dialog.copy, LEFT)
    pasted = [line.split("\t") for line in QGuiApplication.clipboard().text().splitlines()]
    assert pasted[0][:3] == ["Joint between", "Error, mm", "Doubt, mm"]
    assert pasted[1] == told[0]
    assert len(pasted) == len(told) + 1


def test_what_is_saved_is_what_the_command_makes_of_the_exported_take(
    opened, qtbot, tmp_path, monkeypatch
):
    document, target = opened.document, tmp_path / "joints.csv"
    document.do(lambda s: hand.cut(s, "LTHI", 100, 400))
    before, steps = document.session.positions.copy(), document.session.history
    mm.write(document.session.take, tmp_path / "exported.c3d")
    wanted = joint_centres(mm.read(tmp_path / "exported.c3d"))
    proposed, said = choose(monkeypatch, target), []
    opened.centring.said.connect(said.append)
    dialog = listed(opened, qtbot)
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: opened.centring.dialog is None, timeout=WAIT)
    assert proposed == [str(tmp_path / "walk_joints.csv")]
    assert said == [f"Joint centres written to {target}."]
    saved = mm.read_pose(target)
    assert saved.joints == wanted.pose.joints
    assert saved.parents == wanted.pose.parents
    assert np.nanmax(np.abs(saved.positions - wanted.pose.positions)) < 0.01
    # The take is under review as before.
    assert document.path == tmp_path / "walk.c3d"
    assert document.session.history == steps
    assert np.array_equal(document.session.positions, before, equal_nan=True)


def test_saved_joints_open_in_place_of_the_take_and_need_no_joint_centres(
    opened, qtbot, tmp_path, monkeypatch
):
    target = tmp_path / "joints.csv"
    choose(monkeypatch, target)
    action = opened.actions_by_name["joint_centres"]
    assert action.isEnabled()
    dialog = listed(opened, qtbot)
    names = dialog.found.pose.joints
    qtbot.keyClick(dialog, Qt.Key.Key_Tab)
    qtbot.keyClick(dialog.focusWidget(), Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: opened.document.path == target, timeout=WAIT)
    assert opened.document.joints
    assert opened.document.session.original.labels == names
    assert not action.isEnabled()
    assert action.toolTip().startswith("Only for takes of markers")
    qtbot.waitUntil(lambda: not opened.lane.busy, timeout=WAIT)


def test_work_not_exported_is_asked_about_before_another_take_opens(
    opened, qtbot, tmp_path, monkeypatch
):
    asked = []
    monkeypatch.setattr(
        "markermend_app.dialogs.ask.ask_unexported", lambda *_: asked.append(1) or "cancel"
    )
    opened.document.do(lambda s: hand.cut(s, "LTHI", 100, 120))
    choose(monkeypatch, tmp_path / "joints.csv")
    dialog = listed(opened, qtbot)
    qtbot.mouseClick(dialog.save_and_open, LEFT)
    qtbot.waitUntil(lambda: bool(asked), timeout=WAIT)
    assert opened.document.path == tmp_path / "walk.c3d"
    assert (tmp_path / "joints.csv").exists()


def test_only_the_region_of_interest_is_used_and_what_is_not_repaired_is_told(
    opened, performer, qtbot, tmp_path, monkeypatch
):
    document, target = opened.document, tmp_path / "joints.csv"
    found = [Artifact("LTHI", "x", at, at + 1, Kind.PEAK, 0.9, 9.0) for at in (50, 500, 600)]
    document.decisions.add_detected(found, "truth")
    document.decisions.reject([document.session.artifacts[2].id])
    document.do(lambda s: s.set_region((250, 1000)))
    choose(monkeypatch, target)
    dialog = listed(opened, qtbot)
    first = performer.first_frame
    assert f"frames {first + 250}–{first + 999} " in dialog.about.text()
    # One lies outside and one is a false alarm.
    assert dialog.warning.text().startswith("1 artifact is not repaired")
    assert dialog.warning.isVisible()
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    qtbot.waitUntil(target.exists, timeout=WAIT)
    saved, wanted = mm.read_pose(target), joint_centres(crop(performer, 250, 1000)).pose
    assert saved.joints == wanted.joints
    assert np.nanmax(np.abs(saved.positions - wanted.positions)) < 0.01
    assert saved.first_frame == first + 250
    assert saved.first_time == pytest.approx(5.0)


def test_nothing_is_written_over_unasked_and_never_the_take(
    window, performer, qtbot, tmp_path, monkeypatch
):
    settings.remember("detect_on_open", False)
    path, other, problems = tmp_path / "walk.csv", tmp_path / "joints.csv", []
    mm.write(performer, path)
    source = path.read_bytes()
    other.write_text("mine")
    show(window, path, qtbot)
    monkeypatch.setattr(
        "markermend_app.dialogs.ask.show_problem", lambda _, error: problems.append(str(error))
    )
    dialog = listed(window, qtbot)
    choose(monkeypatch, path)
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    assert problems == ["walk.csv is the take itself; choose another name."]
    # The system's dialog has asked about “joints”, which is not there.
    answers = [QMessageBox.StandardButton.No, QMessageBox.StandardButton.Yes]
    monkeypatch.setattr(QMessageBox, "question", lambda *_: answers.pop(0))
    choose(monkeypatch, tmp_path / "joints")
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    assert other.read_text() == "mine"
    assert dialog.save.isEnabled()
    choose(monkeypatch, tmp_path / "nowhere" / "joints.csv")
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: len(problems) == 2, timeout=WAIT)
    assert "joints.csv could not be written" in problems[1]
    choose(monkeypatch, tmp_path / "joints")
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: window.centring.dialog is None, timeout=WAIT)
    assert mm.read_pose(other).joints
    assert path.read_bytes() == source


def test_a_take_without_a_body_says_so_and_offers_nothing_to_save(review, damaged, qtbot):
    take = mm.Take(damaged[0].positions[:, :2], damaged[0].labels[:2], damaged[0].rate)
    window = review(take, ())
    dialog = press(window, qtbot)
    qtbot.waitUntil(lambda: dialog.heading.text() == "No joint centres", timeout=WAIT)
    assert dialog.nothing.label.isVisible()
    assert dialog.nothing.label.text().startswith("No joint centre can be told from this take;")
    assert dialog.close_it.isVisible()
    assert not any(b.isVisible() for b in (dialog.save, dialog.save_and_open, dialog.copy))
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    assert window.centring.dialog is None


def test_work_shows_how_far_it_is_and_stops_when_cancelled(opened, qtbot, tmp_path, monkeypatch):
    ended, there = [], sorted(tmp_path.iterdir())

    def endless(_take, *, progress):
        try:
            while True:
                progress(0.4, "body mesh")
                time.sleep(0.001)
        finally:
            ended.append(True)

    monkeypatch.setattr("markermend.poses.from_markers.joint_centres", endless)
    dialog = press(opened, qtbot)
    qtbot.waitUntil(lambda: dialog.bar.value() == 400, timeout=WAIT)
    assert dialog.bar.isVisible()
    assert dialog.doing.text() == "body mesh"
    assert not dialog.save.isEnabled()
    qtbot.mouseClick(dialog.cancel, LEFT)
    qtbot.waitUntil(lambda: bool(ended), timeout=WAIT)
    assert opened.centring.dialog is None
    assert sorted(tmp_path.iterdir()) == there


def test_nothing_is_left_of_a_file_when_writing_is_cancelled(opened, qtbot, tmp_path, monkeypatch):
    ended = []

    def slow(pose, path, *, progress):
        def hold(share, doing):
            while share > 0.3:
                progress(share, doing)
                time.sleep(0.001)

        try:
            write_pose(pose, path, progress=hold)
        finally:
            ended.append(True)

    monkeypatch.setattr("markermend.files.pose.write_pose", slow)
    choose(monkeypatch, tmp_path / "joints.csv")
    there = sorted(tmp_path.iterdir())
    dialog = listed(opened, qtbot)
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: dialog.bar.value() > 300, timeout=WAIT)
    assert dialog.bar.isVisible()
    assert not dialog.save.isEnabled()
    assert len(list(tmp_path.iterdir())) == len(there) + 1
    qtbot.keyClick(dialog, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: bool(ended), timeout=WAIT)
    assert opened.centring.dialog is None
    assert sorted(tmp_path.iterdir()) == there


def test_reasons_go_on_below_where_the_window_is_narrow(opened, qtbot, qapp):
    dialog = listed(opened, qtbot)
    last = dialog.table.rowCount() - 1
    dialog.resize(1500, 500)
    wide = dialog.table.rowHeight(0)

    def on_one_line():
        assert dialog.table.rowHeight(last) == wide

    qtbot.waitUntil(on_one_line, timeout=WAIT)
    dialog.resize(480, 500)
    qtbot.waitUntil(lambda: dialog.table.rowHeight(last) > wide, timeout=WAIT)
    assert dialog.table.rowHeight(0) == wide
    try:
        theme.apply(qapp, "dark")
        reason = dialog.table.item(last, ERROR)
        assert reason.foreground().color() == theme.current().muted
    finally:
        theme.apply(qapp, "light")


def test_the_hint_names_what_comes_of_it():
    assert "how far to trust each" in menus.hint_of("joint_centres")
    assert "has its joints in it already" in menus.hint_of("joint_centres", joints=True)


def test_a_name_that_is_too_long_or_a_take_that_is_gone_is_no_riddle(
    opened, qtbot, tmp_path, monkeypatch
):
    problems, target = [], tmp_path / "joints.csv"
    monkeypatch.setattr(
        "markermend_app.dialogs.ask.show_problem", lambda _, error: problems.append(str(error))
    )
    dialog = listed(opened, qtbot)
    choose(monkeypatch, tmp_path / ("a" * 300))
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: bool(problems), timeout=WAIT)
    assert "could not be written" in problems[0]
    assert dialog.save.isEnabled()
    # Somebody moved the take away; the system's dialog has asked whether to replace the other file.
    (tmp_path / "walk.c3d").unlink()
    target.write_text("of yesterday")
    choose(monkeypatch, target)
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: opened.centring.dialog is None, timeout=WAIT)
    assert mm.read_pose(target).joints
    assert len(problems) == 1
