"""The whole road in the real window: open, detect, decide with the keyboard, undo."""

from __future__ import annotations

import importlib
import json
import sys

import numpy as np
import pytest
from driving import WAIT, key, proposed, settled
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QMessageBox
from reviews import die

import markermend as mm
from markermend.artifact import Kind, Status
from markermend.review.file import open_session
from markermend_app import settings
from markermend_app.actions.table import ACTIONS
from markermend_app.dialogs import ask as dialogs
from markermend_app.looking import Selection
from markermend_app.main import take_screenshot
from markermend_app.window import MainWindow


def test_opening_shows_the_take_and_detects(reviewed):
    kinds = {a.kind for a in reviewed.document.session.artifacts}
    assert {Kind.GAP, Kind.PEAK} <= kinds
    assert reviewed.centre.currentIndex() == 1
    assert reviewed.windowTitle().startswith("box.c3d")
    assert not reviewed.isWindowModified()


def test_f_repairs_and_moves_on_then_undo_and_redo(reviewed, qtbot):
    document = reviewed.document
    first = document.current
    before = document.session.positions.tobytes()
    proposed(qtbot, reviewed)
    key(qtbot, reviewed, Qt.Key.Key_F)
    assert document.session.artifact(first.id).status is Status.REPAIRED
    assert document.current is not None
    assert document.current.id != first.id
    assert reviewed.isWindowModified()
    after = document.session.positions.tobytes()
    assert after != before
    key(qtbot, reviewed, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert document.session.positions.tobytes() == before
    assert document.session.artifact(first.id).status is Status.PENDING
    both = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    key(qtbot, reviewed, Qt.Key.Key_Z, both)
    assert document.session.positions.tobytes() == after


def test_a_and_r_decide_without_touching_samples(reviewed, qtbot):
    document = reviewed.document
    before = document.session.positions.tobytes()
    one = document.current.id
    key(qtbot, reviewed, Qt.Key.Key_A)
    two = document.current.id
    key(qtbot, reviewed, Qt.Key.Key_R)
    assert document.session.artifact(one).status is Status.ACCEPTED
    assert document.session.artifact(two).status is Status.REJECTED
    assert document.session.positions.tobytes() == before


def test_f_before_the_proposal_is_there_is_not_lost(reviewed, qtbot):
    document = reviewed.document
    document.proposals.forget()
    target = document.queue[-1]
    document.select(target)
    key(qtbot, reviewed, Qt.Key.Key_F)
    qtbot.waitUntil(
        lambda: document.session.artifact(target).status is Status.REPAIRED, timeout=WAIT
    )


def test_the_plots_have_the_keyboard_after_opening(reviewed):
    assert reviewed.focusWidget() is reviewed.trajectories.canvas


def test_the_plots_get_the_keyboard_once_there_are_some(window, take_path):
    window.document.open(open_session(mm.read(take_path)), None)
    # A desktop that makes the window active now gives keys to what can be seen.
    assert window.focusWidget().isVisible()
    window.document.show(["CLAV"])
    assert window.focusWidget() is window.trajectories.canvas


def test_n_and_p_walk_the_queue(reviewed, qtbot):
    document = reviewed.document
    assert document.current.id == document.queue[0]
    key(qtbot, reviewed, Qt.Key.Key_N)
    assert document.current.id == document.queue[1]
    key(qtbot, reviewed, Qt.Key.Key_P)
    assert document.current.id == document.queue[0]


def test_number_keys_choose_a_method(reviewed, qtbot):
    from markermend.repairs import REPAIRS

    names = {method.key: name for name, method in REPAIRS.items()}
    key(qtbot, reviewed, Qt.Key.Key_9)
    assert reviewed.document.method == names[9]
    key(qtbot, reviewed, Qt.Key.Key_2)
    assert reviewed.document.method == names[2]
    proposed(qtbot, reviewed)
    assert reviewed.document.proposal.method == names[2]


def test_repair_all_accepted_is_one_step(reviewed, qtbot):
    document = reviewed.document
    ids = [a.id for a in document.session.artifacts]
    document.decisions.accept(ids)
    steps = len(document.session.history)
    reviewed.actions_by_name["repair_accepted"].trigger()
    qtbot.waitUntil(lambda: not reviewed.lane.busy, timeout=WAIT)
    assert len(document.session.history) == steps + 1
    assert document.session.with_status(Status.REPAIRED)
    document.undo()
    assert not document.session.with_status(Status.REPAIRED)


def test_marking_a_swept_range_by_hand(reviewed, qtbot):
    document = reviewed.document
    document.sweep(Selection("T10", 100, 120))
    key(qtbot, reviewed, Qt.Key.Key_M)
    made = document.current
    assert (made.marker, made.start, made.stop, made.kind) == ("T10", 100, 120, Kind.NOISE)
    assert document.selection is None
    key(qtbot, reviewed, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert made.id not in {a.id for a in document.session.artifacts}


def test_f_without_a_repair_says_so_aside(reviewed, qtbot, monkeypatch):
    document = reviewed.document
    document.select(next(a.id for a in document.session.artifacts if a.kind is not Kind.STEP))
    document.choose_method("swap")
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    monkeypatch.setattr(dialogs, "show_problem", lambda *_: pytest.fail("a dialog"))
    button = reviewed.trajectories.buttons.repair
    qtbot.waitUntil(button.isVisible)
    for press in (
        lambda: key(qtbot, reviewed, Qt.Key.Key_F),
        lambda: qtbot.mouseClick(button, Qt.MouseButton.LeftButton),
    ):
        with qtbot.waitSignal(reviewed.commands.said) as said:
            press()
        assert "cannot be repaired" in said.args[0]


def test_keys_decide_about_nothing_that_is_out_of_sight(reviewed, qtbot):
    document, back = reviewed.document, reviewed.trajectories.header.back
    artifact = document.current
    assert not back.isVisible()
    away = next(m for m in document.session.original.labels if m != artifact.marker)
    document.show([away])
    assert back.isVisible()
    for pressed in (Qt.Key.Key_R, Qt.Key.Key_A, Qt.Key.Key_F):
        document.show([away])
        qtbot.keyClick(reviewed, pressed)
        assert document.session.artifact(artifact.id).status is Status.PENDING
        assert document.shown == (artifact.marker,)
        assert not back.isVisible()
    said = reviewed.status._said
    assert artifact.marker in said.whole
    qtbot.keyClick(reviewed, Qt.Key.Key_N)
    assert not said.whole
    qtbot.keyClick(reviewed, Qt.Key.Key_P)
    reviewed.trajectories.framing.set_view(artifact.stop + 20, artifact.stop + 60)
    assert back.isVisible()
    qtbot.mouseClick(back, Qt.MouseButton.LeftButton)
    low, high = reviewed.trajectories.framing.view
    assert low < artifact.start
    assert artifact.stop < high
    qtbot.keyClick(reviewed, Qt.Key.Key_R)
    assert document.session.artifact(artifact.id).status is Status.REJECTED


def test_undo_and_redo_say_what_they_did(reviewed, qtbot):
    key(qtbot, reviewed, Qt.Key.Key_A)
    step = reviewed.document.session.history[-1]
    for verb in (reviewed.commands.undo, reviewed.commands.redo):
        with qtbot.waitSignal(reviewed.commands.said) as said:
            verb()
        assert step in said.args[0]


def test_a_picture_leaves_a_review_as_it_was(reviewed, qtbot, take_path, tmp_path):
    reviewed.document.decisions.accept([reviewed.document.queue[0]])
    reviewed.document.file.save()
    reviewed.document.open(None, None)
    (review,) = tmp_path.glob("*.markermend.json")
    stored = json.loads(review.read_text())["done"]
    other = MainWindow()
    qtbot.addWidget(other)
    other.show()
    assert take_screenshot(other, take_path, tmp_path / "picture.png") == 0
    assert json.loads(review.read_text())["done"] == stored


def test_dropping_a_file_opens_it(window, qtbot, take_path):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(take_path))])
    copy, left = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton
    none = Qt.KeyboardModifier.NoModifier
    enter = QDragEnterEvent(QPointF(50, 50).toPoint(), copy, data, left, none)
    window.dragEnterEvent(enter)
    assert enter.isAccepted()
    window.dropEvent(QDropEvent(QPointF(50, 50), copy, data, left, none))
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)
    assert settings.recent() == [take_path]


def test_a_bad_file_is_one_sentence_and_leaves_the_open_take(
    reviewed, qtbot, monkeypatch, tmp_path
):
    bad = tmp_path / "bad.c3d"
    bad.write_bytes(b"not a recording")
    shown = []
    monkeypatch.setattr(QMessageBox, "exec", lambda self: shown.append(self.text()))
    reviewed.commands.open_path(bad)
    qtbot.waitUntil(lambda: bool(shown), timeout=WAIT)
    assert "bad.c3d" in shown[0]
    assert "Traceback" not in shown[0]
    assert reviewed.document.path.name == "box.c3d"


def test_a_cut_off_file_is_told_of_and_shown(window, qtbot, take_path, tmp_path):
    short = tmp_path / "short.c3d"
    short.write_bytes(take_path.read_bytes()[:-5000])
    window.commands.open_path(short)
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    (told,) = window.findChildren(QMessageBox)
    assert "short.c3d is damaged" in told.text()
    assert "cut short" in told.informativeText()
    told.close()
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)
    assert "cut short" in window.status._said.whole


def test_a_review_that_is_opened_first_loads_the_repairs_on_the_worker(
    window, qtbot, take_path, damaged, monkeypatch
):
    file = open_session(mm.read(take_path))
    file.session.add_detected(damaged[1], "truth")
    file.save()
    file.close()
    # As in a window that has just started; both are put back.
    monkeypatch.setattr(mm, "repairs", importlib.import_module("markermend.repairs"))
    monkeypatch.delitem(sys.modules, "markermend.repairs")
    begun = []
    window.lane.started.connect(begun.append)
    loaded = []
    window.document.current_changed.connect(
        lambda: loaded.append((window.document.current, "markermend.repairs" in sys.modules))
    )
    window.commands.open_path(take_path)
    qtbot.waitUntil(lambda: window.document.current is not None, timeout=WAIT)
    assert all(there for current, there in loaded if current is not None)
    assert begun[:2] == ["Opening box.c3d"] * 2


def test_a_take_that_is_not_searched_loads_the_repairs_on_the_worker_too(
    window, qtbot, take_path, monkeypatch
):
    settings.remember("detect_on_open", False)
    monkeypatch.setattr(mm, "repairs", importlib.import_module("markermend.repairs"))
    monkeypatch.delitem(sys.modules, "markermend.repairs")
    window.commands.open_path(take_path)
    qtbot.waitUntil(lambda: window.document.mesh is not None and not window.lane.busy, timeout=WAIT)
    assert window.document.current is None
    assert "markermend.repairs" in sys.modules


def test_an_open_take_fits_small_screens_too(reviewed, qtbot):
    reviewed.resize(1500, 900)
    qtbot.waitUntil(reviewed.queue.filters.progress.isVisible)
    assert reviewed.minimumSizeHint().width() <= 1100


def test_a_take_in_which_nothing_was_found_is_not_searched_again(qtbot, take_path, tmp_path):
    clean = tmp_path / "clean.c3d"
    take = mm.read(take_path)
    mm.write(take.with_positions(np.zeros_like(take.positions), np.zeros_like(take.origin)), clean)
    for _ in range(2):
        window = MainWindow()
        qtbot.addWidget(window)
        window.show()
        window.commands.open_path(clean)
        qtbot.waitUntil(
            lambda w=window: w.document.mesh is not None and not w.lane.busy, timeout=20_000
        )
        settled(qtbot)
        assert len(window.document.session.history) == 1
        assert window.document.shown == take.labels[:1]
        window.close()


def test_where_nothing_was_found_a_marker_is_shown_all_the_same(window, qtbot, tmp_path):
    mm.write(mm.simulate(duration_s=3, damaged=False)[0], tmp_path / "clean.c3d")
    window.commands.open_path(tmp_path / "clean.c3d")
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    qtbot.waitUntil(lambda: bool(window.document.session.history), timeout=WAIT)
    settled(qtbot)
    assert window.document.session.artifacts == ()
    assert window.document.shown == window.document.session.original.labels[:1]
    assert window.trajectories.canvas.isVisible()


def test_the_window_fits_small_screens(window):
    assert window.minimumSizeHint().width() <= 1024
    assert window.minimumSizeHint().height() <= 760


def test_cancelling_detection_leaves_the_list_as_it_was(reviewed, qtbot):
    before = reviewed.document.session.artifacts
    reviewed.actions_by_name["detect_slow"].trigger()
    reviewed.lane.cancel()
    qtbot.waitUntil(lambda: not reviewed.lane.busy, timeout=WAIT)
    assert reviewed.document.session.artifacts == before


def test_every_action_has_a_verb_and_no_shortcut_is_taken_twice(window):
    keys = [k for a in ACTIONS for k in a.keys]
    assert len(keys) == len(set(keys))
    for spec in ACTIONS:
        if not spec.enabled(window.document):
            assert not window.actions_by_name[spec.name].isEnabled()
        assert window.can(spec.name)


def test_undo_takes_nothing_back_that_came_with_opening_but_a_search_that_was_asked_for(
    reviewed, qtbot
):
    session, ctrl = reviewed.document.session, Qt.KeyboardModifier.ControlModifier
    found = session.artifacts
    assert found
    assert not reviewed.actions_by_name["undo"].isEnabled()
    key(qtbot, reviewed, Qt.Key.Key_Z, ctrl)
    assert session.artifacts == found
    key(qtbot, reviewed, Qt.Key.Key_D)
    qtbot.waitUntil(lambda: len(session.history) == 2, timeout=WAIT)
    key(qtbot, reviewed, Qt.Key.Key_Z, ctrl)
    assert len(session.history) == 1
    # Who wants the take without them says so.
    reviewed.document.travel(0)
    assert session.artifacts == ()


@pytest.mark.parametrize("killed", [True, False])
def test_a_review_goes_on_where_it_was_left(reviewed, qtbot, take_path, killed):
    document = reviewed.document
    key(qtbot, reviewed, Qt.Key.Key_R)
    later = document.session.artifact(document.queue[-1])
    assert document.queue[0] != later.id
    document.select(later.id)
    document.go_to(later.start + 1)
    if killed:
        path = document.file.path.with_name("box.c3d.markermend.journal")
        wanted = f'"at": {{"artifact": "{later.id}", "frame": {later.start + 1}}}'
        qtbot.waitUntil(lambda: wanted in path.read_text(), timeout=WAIT)
        die(document.file)
        # What is left of the window in this process writes no more.
        document.file.read_only, document.file._journal = True, None
    else:
        reviewed.commands.put_by()
        document.open(None, None)
    again = MainWindow()
    qtbot.addWidget(again)
    again.show()
    again.commands.open_path(take_path)
    qtbot.waitUntil(lambda: again.document.current is not None, timeout=WAIT)
    assert again.document.current == later
    assert again.document.frame == later.start + 1
    low, high = again.trajectories.rows[0].view.viewRange()[0]
    assert low < later.start < high
    again.document.session.mark_exported()
