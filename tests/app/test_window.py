"""The whole road in the real window: open, detect, decide with the keyboard, undo, export."""

from __future__ import annotations

import importlib
import json
import sys

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QFileDialog, QLabel, QMessageBox, QPlainTextEdit

import markermend as mm
from markermend import files
from markermend.artifact import Artifact, Kind, Status
from markermend.errors import MarkermendError
from markermend.patch import Patch
from markermend.review.edits import SetSamples
from markermend.review.file import open_session
from markermend_app import settings
from markermend_app.actions.table import ACTIONS
from markermend_app.dialogs import ask as dialogs
from markermend_app.dialogs import export as export_dialog
from markermend_app.looking import Selection
from markermend_app.main import take_screenshot
from markermend_app.window import MainWindow

WAIT = 20_000


@pytest.fixture
def take_path(tmp_path, damaged):
    path = tmp_path / "box.c3d"
    mm.write(damaged[0], path)
    return path


def keep_quiet(window):
    """Let a window close without asking what becomes of unexported work."""
    if window.document.session is not None:
        window.document.session.mark_exported()


@pytest.fixture
def window(qtbot):
    """A real window; whatever is unexported at the end is kept without asking."""
    made = MainWindow()
    qtbot.addWidget(made, before_close_func=keep_quiet)
    made.show()
    made.activateWindow()
    qtbot.waitExposed(made)
    return made


@pytest.fixture
def reviewed(window, take_path, qtbot):
    """The window with the damaged take open and detected."""
    window.commands.open_path(take_path)
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)
    qtbot.waitUntil(lambda: window.document.current is not None, timeout=WAIT)
    return window


def key(qtbot, window, what, modifier=Qt.KeyboardModifier.NoModifier):
    qtbot.keyClick(window, what, modifier)


def proposed(qtbot, window):
    qtbot.waitUntil(lambda: window.document.proposal is not None, timeout=WAIT)


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


def test_review_keys_do_not_land_in_a_filter_after_opening(reviewed):
    assert reviewed.focusWidget() not in (reviewed.tree.filter, reviewed.queue.filter)


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
    document.accept(ids)
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


def export(window, qtbot, monkeypatch, target):
    choice = export_dialog.ExportChoice(record=False, mark_outputs=False)
    monkeypatch.setattr(export_dialog, "ask_export", lambda *_: choice)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), "C3D (*.c3d)"))
    key(qtbot, window, Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)


def test_export_differs_only_at_repaired_samples(reviewed, qtbot, monkeypatch, take_path, tmp_path):
    document = reviewed.document
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.select(gap.id)
    proposed(qtbot, reviewed)
    key(qtbot, reviewed, Qt.Key.Key_F)
    target = tmp_path / "out.c3d"
    export(reviewed, qtbot, monkeypatch, target)
    assert document.session.exported
    assert not reviewed.isWindowModified()
    source, result = take_path.read_bytes(), target.read_bytes()
    assert len(source) == len(result)
    assert source != result
    old, new = mm.read(take_path), mm.read(target)
    same = (old.positions == new.positions) | (np.isnan(old.positions) & np.isnan(new.positions))
    expected = np.ones_like(same)
    expected[gap.start : gap.stop, old.index(gap.marker)] = False
    assert (same == expected).all()


def test_a_repair_that_integers_cannot_hold_is_exported_as_floats_when_wanted(
    window, qtbot, monkeypatch, tmp_path, shared_data
):
    source = tmp_path / "integers.c3d"
    source.write_bytes((shared_data / "formats" / "Eb015pi.c3d").read_bytes())
    settings.remember("detect_on_open", False)
    window.commands.open_path(source)
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    session = window.document.session
    marker = session.original.labels[0]
    patch = Patch(marker, "xyz", 3, 6, np.full((3, 3), 1e7))
    session.perform("Put a marker far away", SetSamples((patch,)))
    asked = []
    monkeypatch.setattr(dialogs, "ask_float", lambda _, problem: asked.append(problem) or True)
    target = tmp_path / "floats.c3d"
    export(window, qtbot, monkeypatch, target)
    qtbot.waitUntil(lambda: target.exists() and not window.lane.busy, timeout=WAIT)
    assert marker in asked[0]
    assert (mm.read(target).positions[3:6, 0] == 1e7).all()


def test_export_asks_when_artifacts_are_left_and_no_means_no(
    reviewed, qtbot, monkeypatch, tmp_path
):
    asked = []
    monkeypatch.setattr(export_dialog, "ask_export", lambda *args: asked.append(args) or None)
    key(qtbot, reviewed, Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    assert len(asked) == 1
    assert list(tmp_path.glob("*_clean*")) == []


def test_cancelling_the_export_before_closing_stays(reviewed, qtbot, monkeypatch, tmp_path):
    def cancelled(*_, progress, **__):
        reviewed.lane.cancel()
        progress(0.5, "Writing")

    reviewed.document.accept([reviewed.document.queue[0]])
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: "export")
    monkeypatch.setattr(files, "write", cancelled)
    choice = export_dialog.ExportChoice(record=False, mark_outputs=False)
    monkeypatch.setattr(export_dialog, "ask_export", lambda *_: choice)
    name = (str(tmp_path / "out.c3d"), "C3D (*.c3d)")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: name)
    assert not reviewed.close()
    assert reviewed.document.session is not None


def test_an_ending_added_to_the_name_does_not_replace_a_file_unasked(
    reviewed, qtbot, monkeypatch, tmp_path
):
    taken = tmp_path / "taken.c3d"
    taken.write_bytes(b"dear")
    asked = []
    monkeypatch.setattr(dialogs, "ask_replace", lambda _, target: asked.append(target))
    export(reviewed, qtbot, monkeypatch, taken.with_suffix(""))
    assert asked == [taken]
    assert taken.read_bytes() == b"dear"


def test_f_without_a_repair_says_so_aside(reviewed, qtbot, monkeypatch):
    document = reviewed.document
    document.select(next(a.id for a in document.session.artifacts if a.kind is not Kind.STEP))
    document.choose_method("swap")
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    assert not reviewed.trajectories.buttons.repair.isEnabled()
    monkeypatch.setattr(dialogs, "show_problem", lambda *_: pytest.fail("a dialog"))
    with qtbot.waitSignal(reviewed.commands.said) as said:
        key(qtbot, reviewed, Qt.Key.Key_F)
    assert "cannot be repaired" in said.args[0]


def test_keys_decide_about_nothing_that_is_out_of_sight(reviewed, qtbot):
    document, back = reviewed.document, reviewed.trajectories.header.back
    artifact = document.current
    assert not back.isVisible()
    away = next(m for m in document.session.original.labels if m != artifact.marker)
    document.show([away])
    assert back.isVisible()
    for key in (Qt.Key.Key_R, Qt.Key.Key_A, Qt.Key.Key_F):
        document.show([away])
        qtbot.keyClick(reviewed, key)
        assert document.session.artifact(artifact.id).status is Status.PENDING
        assert document.shown == (artifact.marker,)
        assert not back.isVisible()
    reviewed.trajectories.set_view(artifact.stop + 20, artifact.stop + 60)
    assert back.isVisible()
    qtbot.mouseClick(back, Qt.MouseButton.LeftButton)
    low, high = reviewed.trajectories._view
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
    reviewed.document.accept([reviewed.document.queue[0]])
    reviewed.document.file.save()
    reviewed.document.open(None, None)
    (review,) = tmp_path.glob("*.markermend.json")
    stored = json.loads(review.read_text())["done"]
    other = MainWindow()
    qtbot.addWidget(other)
    other.show()
    assert take_screenshot(other, take_path, tmp_path / "picture.png") == 0
    assert json.loads(review.read_text())["done"] == stored


def test_closing_with_unexported_work_asks(reviewed, monkeypatch):
    reviewed.document.accept([reviewed.document.queue[0]])
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: "cancel")
    assert not reviewed.close()
    assert reviewed.document.session is not None


def test_a_kept_review_comes_back(reviewed, qtbot, monkeypatch, take_path):
    document = reviewed.document
    chosen = document.queue[0]
    document.reject([chosen])
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: "keep")
    reviewed.commands.open_path(take_path)
    qtbot.waitUntil(lambda: not reviewed.lane.busy, timeout=WAIT)
    qtbot.waitUntil(lambda: bool(document.session.artifacts), timeout=WAIT)
    assert document.session.artifact(chosen).status is Status.REJECTED
    assert len(document.session.history) == 2


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
    assert "cut short" in window.status.findChild(QLabel).text()


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


def test_an_open_take_fits_small_screens_too(reviewed, qtbot):
    reviewed.resize(1500, 900)
    qtbot.waitUntil(reviewed.queue.progress.isVisible)
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
        assert len(window.document.session.history) == 1
        window.close()


def test_the_window_fits_small_screens(window):
    assert window.minimumSizeHint().width() <= 1024
    assert window.minimumSizeHint().height() <= 760


def test_cancelling_detection_leaves_the_list_as_it_was(reviewed, qtbot):
    before = reviewed.document.session.artifacts
    reviewed.actions_by_name["detect_slow"].trigger()
    reviewed.lane.cancel()
    qtbot.waitUntil(lambda: not reviewed.lane.busy, timeout=WAIT)
    assert reviewed.document.session.artifacts == before


def test_second_window_is_read_only(reviewed, qtbot, take_path, monkeypatch):
    shown = []
    monkeypatch.setattr(QMessageBox, "exec", lambda self: shown.append(self.text()))
    second = MainWindow()
    qtbot.addWidget(second)
    second.show()
    second.commands.open_path(take_path)
    qtbot.waitUntil(lambda: second.document.session is not None, timeout=WAIT)
    assert "read-only" in second.windowTitle()
    second.document.mark(Artifact("CLAV", "xyz", 1, 5, Kind.NOISE))
    assert second.document.session.artifacts == ()
    assert "another window" in shown[0]


def test_every_action_has_a_verb_and_no_shortcut_is_taken_twice(window):
    keys = [k for a in ACTIONS for k in a.keys]
    assert len(keys) == len(set(keys))
    for spec in ACTIONS:
        if not spec.enabled(window.document):
            assert not window.actions_by_name[spec.name].isEnabled()
        assert window.can(spec.name)


def test_export_dialog_says_what_is_left_and_what_no_longer_matches(qtbot, window):
    pending = [Artifact("CLAV", "xyz", 4, 9, Kind.GAP)]
    dialog = export_dialog.ExportDialog(window, pending, [], ["LKneeAngles"], 100, False)
    qtbot.addWidget(dialog)
    dialog.show()
    assert dialog.choice == export_dialog.ExportChoice(record=False, mark_outputs=True)
    shown = dialog.findChild(QPlainTextEdit).toPlainText()
    assert "104–108" in shown
    assert "LKneeAngles" in shown


def test_an_export_whose_review_cannot_be_saved_still_ends(reviewed, monkeypatch, tmp_path):
    shown = []
    monkeypatch.setattr(QMessageBox, "exec", lambda self: shown.append(self.text()))

    def full(self):
        raise MarkermendError("The disk is full.")

    monkeypatch.setattr("markermend.review.file.SessionFile.save", full)
    target = tmp_path / "out.c3d"
    choice = export_dialog.ExportChoice(False, False)
    assert reviewed.commands._exporter.export_to(target, choice, wait=True)
    assert target.exists()
    assert shown == ["The disk is full."]


def test_closing_waits_for_an_export_under_way(reviewed, monkeypatch, tmp_path):
    reviewed.document.accept([reviewed.document.queue[0]])
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: pytest.fail("it is exported"))
    target = tmp_path / "out.c3d"
    reviewed.commands._exporter.export_to(target, export_dialog.ExportChoice(False, False))
    assert reviewed.close()
    assert target.exists()


def test_a_review_that_cannot_be_saved_keeps_the_window_open(reviewed, monkeypatch):
    monkeypatch.setattr(QMessageBox, "exec", lambda self: None)
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: "keep")
    reviewed.document.accept([reviewed.document.queue[0]])

    def full(self):
        raise MarkermendError("The disk is full.")

    with monkeypatch.context() as patched:
        patched.setattr("markermend.review.file.SessionFile.save", full)
        assert not reviewed.close()
    assert reviewed.document.session is not None


def test_staying_leaves_work_under_way_alone(reviewed, monkeypatch, qtbot):
    reviewed.document.accept([reviewed.document.queue[0]])
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: "cancel")
    done = []
    reviewed.lane.submit("work", lambda progress: 1, done.append, done.append)
    assert not reviewed.close()
    qtbot.waitUntil(lambda: not reviewed.lane.busy, timeout=WAIT)
    assert done == [1]


def test_a_take_whose_opening_was_cancelled_is_not_left_locked(window, qtbot, take_path):
    window.commands.open_path(take_path)
    window.lane.cancel()
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)
    window.commands.open_path(take_path)
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    assert window.document.editable
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)


def test_a_replaced_source_is_opened_anew_and_its_original_kept(
    reviewed, qtbot, monkeypatch, take_path
):
    document = reviewed.document
    original = take_path.read_bytes()
    proposed(qtbot, reviewed)
    key(qtbot, reviewed, Qt.Key.Key_F)
    repaired = document.session
    monkeypatch.setattr(dialogs, "ask_replace_source", lambda *_: True)
    export(reviewed, qtbot, monkeypatch, take_path)
    qtbot.waitUntil(lambda: document.session not in (None, repaired), timeout=WAIT)
    qtbot.waitUntil(lambda: not reviewed.lane.busy, timeout=WAIT)
    assert take_path.read_bytes() != original
    assert take_path.with_name("box.c3d.bak").read_bytes() == original
    # What was opened anew can be exported again.
    assert reviewed.document.session.original.source.size == len(original)
    document.accept([document.queue[0]])
    export(reviewed, qtbot, monkeypatch, take_path)
    qtbot.waitUntil(lambda: document.session is not None, timeout=WAIT)
