"""What is written and kept in the real window: exports, reviews, and what closing asks."""

from __future__ import annotations

import json
import threading

import numpy as np
import pytest
from driving import WAIT, key, proposed
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox, QPlainTextEdit

import markermend as mm
from markermend import files
from markermend.artifact import Artifact, Kind, Status
from markermend.errors import MarkermendError
from markermend.patch import Patch
from markermend.review.edits import SetSamples
from markermend.review.saving import Snapshot
from markermend_app import settings
from markermend_app.dialogs import ask as dialogs
from markermend_app.dialogs import export as export_dialog
from markermend_app.window import MainWindow


def export(window, qtbot, monkeypatch, target):
    choice = export_dialog.ExportChoice(record=False, mark_outputs=False)
    monkeypatch.setattr(export_dialog, "ask_export", lambda *_, **__: choice)
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


def test_a_take_whose_file_is_gone_is_no_riddle_to_an_export(
    reviewed, qtbot, monkeypatch, take_path, tmp_path
):
    document, target, problems = reviewed.document, tmp_path / "out.c3d", []
    monkeypatch.setattr(
        "markermend_app.dialogs.ask.show_problem", lambda _, error: problems.append(str(error))
    )
    document.decisions.reject([a.id for a in document.session.artifacts])
    take_path.unlink()
    target.write_text("of yesterday")
    export(reviewed, qtbot, monkeypatch, target)
    assert problems[0].startswith(
        "box.c3d, which the take was read from, cannot be opened any more"
    )
    assert target.read_text() == "of yesterday"


def test_what_is_exported_is_not_to_be_exported_again(reviewed, qtbot, monkeypatch, tmp_path):
    document, said = reviewed.document, reviewed.queue._hint
    document.decisions.reject([a.id for a in document.session.artifacts])
    qtbot.waitUntil(lambda: "Ctrl+S exports the repaired take" in said.text(), timeout=WAIT)
    export(reviewed, qtbot, monkeypatch, tmp_path / "out.c3d")
    qtbot.waitUntil(
        lambda: said.text().endswith("and the repaired take is exported."), timeout=WAIT
    )
    document.decisions.accept([document.session.artifacts[0].id])
    qtbot.waitUntil(lambda: "Ctrl+S exports the repaired take" in said.text(), timeout=WAIT)


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
    monkeypatch.setattr(export_dialog, "ask_export", lambda *args, **_: asked.append(args) or None)
    key(qtbot, reviewed, Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    assert len(asked) == 1
    assert list(tmp_path.glob("*_clean*")) == []


def test_cancelling_the_export_before_closing_stays(reviewed, qtbot, monkeypatch, tmp_path):
    def cancelled(*_, progress, **__):
        reviewed.lane.cancel()
        progress(0.5, "Writing")

    reviewed.document.decisions.accept([reviewed.document.queue[0]])
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: "export")
    monkeypatch.setattr(files, "write", cancelled)
    choice = export_dialog.ExportChoice(record=False, mark_outputs=False)
    monkeypatch.setattr(export_dialog, "ask_export", lambda *_, **__: choice)
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


def test_closing_with_unexported_work_asks(reviewed, monkeypatch):
    reviewed.document.decisions.accept([reviewed.document.queue[0]])
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: "cancel")
    assert not reviewed.close()
    assert reviewed.document.session is not None


def test_where_a_review_is_kept_is_told(reviewed, monkeypatch, tmp_path):
    said = []
    monkeypatch.setattr(QMessageBox, "exec", lambda box: said.append(box.informativeText()))
    reviewed.document.decisions.accept([reviewed.document.queue[0]])
    assert not reviewed.close()
    assert "beside the take" in said[0]
    # As where nothing can be written beside a demo take.
    reviewed.document.file.path = tmp_path / "reviews" / "box.json"
    assert not reviewed.close()
    assert f"it is saved in {tmp_path / 'reviews'}, with its full history" in said[1]


def test_a_kept_review_comes_back(reviewed, qtbot, monkeypatch, take_path):
    document = reviewed.document
    chosen = document.queue[0]
    document.decisions.reject([chosen])
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: "keep")
    reviewed.commands.open_path(take_path)
    qtbot.waitUntil(lambda: not reviewed.lane.busy, timeout=WAIT)
    qtbot.waitUntil(lambda: bool(document.session.artifacts), timeout=WAIT)
    assert document.session.artifact(chosen).status is Status.REJECTED
    assert len(document.session.history) == 2


def test_second_window_is_read_only(reviewed, qtbot, take_path, monkeypatch):
    shown = []
    monkeypatch.setattr(QMessageBox, "exec", lambda self: shown.append(self.text()))
    second = MainWindow()
    qtbot.addWidget(second)
    second.show()
    second.commands.open_path(take_path)
    qtbot.waitUntil(lambda: second.document.session is not None, timeout=WAIT)
    assert "read-only" in second.windowTitle()
    second.document.decisions.mark(Artifact("CLAV", "xyz", 1, 5, Kind.NOISE))
    assert second.document.session.artifacts == reviewed.document.session.artifacts
    assert "another window" in shown[0]


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

    monkeypatch.setattr("markermend.review.saving.Snapshot.write", full)
    target = tmp_path / "out.c3d"
    choice = export_dialog.ExportChoice(False, False)
    assert reviewed.commands._exporter.export_to(target, choice, wait=True)
    assert target.exists()
    assert shown == ["The disk is full."]


def test_what_is_decided_while_the_review_is_saved_is_saved_too(
    reviewed, monkeypatch, tmp_path, qtbot
):
    document, saver = reviewed.document, reviewed.commands._saver
    file, go_on, really = document.file, threading.Event(), Snapshot.write
    threads = []

    def slow(self):
        threads.append(threading.current_thread())
        assert go_on.wait(20)
        really(self)

    monkeypatch.setattr(Snapshot, "write", slow)
    target = tmp_path / "out.c3d"
    reviewed.commands._exporter.export_to(target, export_dialog.ExportChoice(False, False))
    qtbot.waitUntil(lambda: bool(threads), timeout=WAIT)
    document.decisions.accept([document.queue[0]])
    go_on.set()
    saver.finish()
    assert len(threads) == 2
    assert threading.main_thread() not in threads
    stored = json.loads(file.path.read_text(encoding="utf-8"))
    assert len(stored["done"]) == len(document.session.history)
    assert stored["exported"] == len(document.session.history) - 1
    assert not list(file.path.parent.glob("*.part"))


def test_closing_waits_for_an_export_under_way(reviewed, monkeypatch, tmp_path):
    reviewed.document.decisions.accept([reviewed.document.queue[0]])
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: pytest.fail("it is exported"))
    target = tmp_path / "out.c3d"
    reviewed.commands._exporter.export_to(target, export_dialog.ExportChoice(False, False))
    assert reviewed.close()
    assert target.exists()


def test_what_is_decided_while_a_take_is_exported_is_not_in_the_file(reviewed, tmp_path, qtbot):
    document, exporter = reviewed.document, reviewed.commands._exporter
    target = tmp_path / "out.c3d"
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    before = document.session.positions.copy()
    exporter.export_to(target, export_dialog.ExportChoice(False, False))
    document.decisions.repair_many([(document.current.id, document.proposal)], "Repair it")
    assert not np.array_equal(document.session.positions, before, equal_nan=True)
    exporter.finish()
    np.testing.assert_allclose(mm.read(target).positions, before, atol=1e-3)
    assert not document.session.exported


def test_a_review_that_cannot_be_saved_keeps_the_window_open(reviewed, monkeypatch):
    monkeypatch.setattr(QMessageBox, "exec", lambda self: None)
    monkeypatch.setattr(dialogs, "ask_unexported", lambda *_: "keep")
    reviewed.document.decisions.accept([reviewed.document.queue[0]])

    def full(self):
        raise MarkermendError("The disk is full.")

    with monkeypatch.context() as patched:
        patched.setattr("markermend.review.file.SessionFile.save", full)
        assert not reviewed.close()
    assert reviewed.document.session is not None


def test_staying_leaves_work_under_way_alone(reviewed, monkeypatch, qtbot):
    reviewed.document.decisions.accept([reviewed.document.queue[0]])
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
    left = {a.id for a in repaired.artifacts if a.status is not Status.REPAIRED}
    assert left
    monkeypatch.setattr(dialogs, "ask_replace_source", lambda *_: True)
    export(reviewed, qtbot, monkeypatch, take_path)
    qtbot.waitUntil(lambda: document.session not in (None, repaired), timeout=WAIT)
    qtbot.waitUntil(lambda: not reviewed.lane.busy, timeout=WAIT)
    assert {a.id for a in document.session.artifacts} == left
    assert take_path.read_bytes() != original
    assert take_path.with_name("box.c3d.bak").read_bytes() == original
    # What was opened anew can be exported again.
    assert reviewed.document.session.original.source.size == len(original)
    document.decisions.accept([document.queue[0]])
    export(reviewed, qtbot, monkeypatch, take_path)
    qtbot.waitUntil(lambda: document.session is not None, timeout=WAIT)
