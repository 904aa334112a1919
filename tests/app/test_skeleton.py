"""Skeleton recordings in the window: opened, reviewed and exported by the same keys as takes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QTimer, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import (
    QApplication,
    QCheckBox,
    QComboBox,
    QFileDialog,
    QListView,
    QMessageBox,
    QPlainTextEdit,
    QPushButton,
)

import markermend as mm
from markermend.artifact import Status
from markermend.files import Export
from markermend.poses.nuitrack import JOINTS
from markermend.review import hand
from markermend_app import settings
from markermend_app.dialogs.export import ExportChoice, ExportDialog
from markermend_app.dialogs.file_filters import WITHOUT_PATTERNS, export_filter, open_filter
from markermend_app.panels.markers.marker_model import NAME
from markermend_app.telling import told

WAIT = 60_000
CTRL = Qt.KeyboardModifier.ControlModifier


def test_joints_stand_in_their_tree(opened):
    proxy, model = opened.tree.view.model(), opened.tree._model
    index = proxy.mapFromSource(model.index_of("left_wrist"))
    above = []
    while index.isValid():
        above.append(index.sibling(index.row(), NAME).data())
        index = index.parent()
    assert above == ["left_wrist", "left_elbow", "left_shoulder", "collar", "torso", "waist"]
    assert proxy.rowCount() == 1
    assert len(opened.scene.seen.links) == len(JOINTS) - 1


def test_a_review_by_keys_changes_what_was_repaired_only(opened, broken, qtbot, tmp_path):
    document = opened.document
    pending = len(document.session.with_status(Status.PENDING))
    before = document.session.positions.copy()
    decided = []
    for key in (Qt.Key.Key_R, Qt.Key.Key_A, *[Qt.Key.Key_F] * (len(document.queue) - 2)):
        current, together = document.current.id, document.together
        qtbot.keyClick(opened, key)
        qtbot.waitUntil(
            lambda had=current: document.session.artifact(had).status is not Status.PENDING,
            timeout=WAIT,
        )
        decided.append([document.session.artifact(i) for i in together])
    for artifacts, status in zip(decided, (Status.REJECTED, Status.ACCEPTED), strict=False):
        assert {a.status for a in artifacts} == {status}
    repaired = document.session.with_status(Status.REPAIRED)
    assert {document.session.notes[a.id].method for a in repaired} <= {"skeleton", "swap"}
    assert len(repaired) == pending - len(decided[0]) - len(decided[1])
    target = tmp_path / "clean.csv"
    assert opened.commands._exporter.export_to(target, ExportChoice(False, False), wait=True)
    mask = np.zeros(before.shape[:2], dtype=bool)
    for a in repaired:
        for marker in a.markers:
            mask[a.start : a.stop, JOINTS.index(marker)] = True
    source, back = mm.read_pose(broken), mm.read_pose(target)
    np.testing.assert_array_equal(back.positions[~mask], source.positions[~mask])
    assert mask.any()
    assert (back.positions[mask] != source.positions[mask]).any(axis=1).all()
    for _ in decided:
        qtbot.keyClick(opened, Qt.Key.Key_Z, CTRL)
    assert np.array_equal(document.session.positions, before, equal_nan=True)
    assert len(document.session.with_status(Status.PENDING)) == pending


def test_the_preview_has_an_error_band_and_other_methods(opened, qtbot):
    document = opened.document
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    assert document.proposal.method == "skeleton"
    assert (document.proposal.band_mm >= 0).all()
    assert opened.scene.seen.ghosts()
    qtbot.keyClick(opened, Qt.Key.Key_2)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    assert document.proposal.method == "spline"


def test_a_dropped_recording_opens(window, shared_data, qtbot, tmp_path):
    for name in ("02.asf", "02_01.amc"):
        (tmp_path / name).write_bytes((shared_data / "poses" / name).read_bytes())
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(tmp_path / "02_01.amc"))])
    none = Qt.KeyboardModifier.NoModifier
    window.dropEvent(
        QDropEvent(
            QPointF(QPoint(9, 9)), Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton, none
        )
    )
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    assert window.document.session.original.markers == 31
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)


def test_a_movement_without_a_skeleton_is_told_in_one_sentence(
    window, tmp_path, qtbot, monkeypatch
):
    asked = []
    monkeypatch.setattr(QMessageBox, "exec", lambda box: asked.append(box.text()))
    path = tmp_path / "alone.amc"
    path.write_text("1\nroot 0 0 0 0 0 0\n")
    window.commands.open_path(path)
    qtbot.waitUntil(lambda: bool(asked), timeout=WAIT)
    assert asked == [
        "alone.amc needs its skeleton: put the ASF file beside it, named alone.asf, or choose it."
    ]
    assert window.document.session is None


def test_a_skeleton_that_is_chosen_is_copied_beside_its_movement(
    window, shared_data, tmp_path, qtbot, monkeypatch
):
    folder, path = shared_data / "poses", tmp_path / "jump.amc"
    path.write_bytes((folder / "02_01.amc").read_bytes())
    for name in ("02.asf", "03.asf"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    asked = []

    def choose(box):
        asked.append(box.text())
        next(b for b in box.buttons() if b.text() == "Choose skeleton…").click()

    chosen = str(tmp_path / "02.asf")
    monkeypatch.setattr(QMessageBox, "exec", choose)
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (chosen, ""))
    window.commands.open_path(path)
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    assert "none of the ASF files beside it is named jump.asf" in asked[0]
    assert asked[0].endswith("or choose it.")
    assert (tmp_path / "jump.asf").read_bytes() == (folder / "02.asf").read_bytes()
    assert window.document.session.original.markers == 31
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)


def test_the_dialog_names_each_ending_once_and_finds_it_in_capitals(qtbot, window, tmp_path):
    for name in ("one.amc", "TWO.AMC", "other.txt"):
        (tmp_path / name).touch()
    dialogs = []

    def look():
        dialog = QApplication.activeModalWidget()
        dialogs.append(dialog.findChild(QComboBox, "fileTypeCombo").itemText(0))
        model = dialog.findChild(QListView, "listView").model()
        root = dialog.findChild(QListView, "listView").rootIndex()
        dialogs.append({model.index(i, 0, root).data() for i in range(model.rowCount(root))})
        dialog.reject()

    QTimer.singleShot(1000, look)
    QFileDialog.getOpenFileName(
        window,
        "",
        str(tmp_path),
        open_filter(),
        "",
        WITHOUT_PATTERNS | QFileDialog.Option.DontUseNativeDialog,
    )
    assert dialogs[0].startswith("Takes: C3D, TRC")
    assert dialogs[0].count("AMC") == 1
    assert "*" not in dialogs[0]
    assert dialogs[1] == {"one.amc", "TWO.AMC"}


def test_dialogs_offer_the_formats(broken):
    assert all(f"*{ending}" in open_filter() for ending in (".amc", ".asf", ".bvh"))
    assert export_filter(mm.read(broken)).startswith("CSV (*.csv);;AMC (*.amc);;BVH (*.bvh);;C3D")


@pytest.mark.parametrize(
    ("ending", "proposed"), [(".asf", "01_clean.csv"), (".bvh", "01_clean.bvh")]
)
def test_no_name_is_proposed_that_cannot_be_written(
    opened, monkeypatch, tmp_path, ending, proposed
):
    asked = []
    monkeypatch.setattr(
        QFileDialog,
        "getSaveFileName",
        lambda _, title, name, kinds: asked.append((name, kinds)) or ("", ""),
    )
    source = property(lambda _: tmp_path / f"01{ending}")
    monkeypatch.setattr(type(opened.document), "path", source)
    opened.commands._exporter._ask_target(opened.document.session.original)
    ((name, kinds),) = asked
    assert Path(name).name == proposed
    # The files listed are of the kind proposed.
    assert kinds.partition("(*")[2].startswith(Path(proposed).suffix)


@pytest.fixture
def without_a_shin(window, shared_data, tmp_path, qtbot):
    """The window with a skeleton file that lacks the angles of a shin in some frames."""
    (tmp_path / "02.asf").write_bytes((shared_data / "poses" / "02.asf").read_bytes())
    lines = (shared_data / "poses" / "02_01.amc").read_text().splitlines()
    at, kept = 0, []
    for line in lines:
        at = int(line) if line.isdigit() else at
        if not (100 <= at < 140 and line.startswith("ltibia ")):
            kept.append(line)
    (tmp_path / "02_01.amc").write_text("\n".join(kept) + "\n")
    window.commands.open_path(tmp_path / "02_01.amc")
    qtbot.waitUntil(lambda: window.document.proposal is not None, timeout=WAIT)
    return window


def test_where_bones_are_rigid_a_dialog_says_which_joints_are_off(without_a_shin, tmp_path, qtbot):
    window, session = without_a_shin, without_a_shin.document.session
    while pending := session.with_status(Status.PENDING):
        window.document.select(pending[0].id)
        window.document.choose_method("linear")
        window.document.decisions.repair_current()
        # What went wrong together is repaired together, once all of it is worked out.
        qtbot.waitUntil(lambda p=pending: session.with_status(Status.PENDING) != p, timeout=WAIT)
    exporter = window.commands._exporter
    assert exporter.export_to(tmp_path / "out.amc", ExportChoice(False, False))
    qtbot.waitUntil(lambda: bool(window.findChildren(QMessageBox)), timeout=WAIT)
    (box,) = window.findChildren(QMessageBox)
    # The review goes on below it.
    assert not window.lane.busy
    assert "out.amc" in box.text()
    assert "ltibia" in box.informativeText() or "lfoot" in box.informativeText()
    assert " mm" in box.informativeText()
    box.close()


def test_joints_that_are_off_are_told_before_a_window_closes(without_a_shin, tmp_path, monkeypatch):
    window, answered = without_a_shin, []
    target = tmp_path / "out.amc"
    off = (("ltibia", 30.0),)
    monkeypatch.setattr("markermend.files.write", lambda _, path, **more: Export(path, 3, off=off))
    monkeypatch.setattr("markermend_app.dialogs.ask.ask_unexported", lambda *_: "export")
    asked = ExportChoice(False, False)
    monkeypatch.setattr("markermend_app.dialogs.export.ask_export", lambda *_, **__: asked)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), ""))

    def answer(box):
        answered.append((box.informativeText(), window.isVisible()))

    monkeypatch.setattr(QMessageBox, "exec", answer)
    window.document.decisions.reject([window.document.current.id])
    window.close()
    ((text, visible),) = answered
    assert "ltibia 30" in text
    assert visible
    assert not window.isVisible()


def test_joints_that_are_hardly_off_are_told_in_the_status_line(
    without_a_shin, tmp_path, qtbot, monkeypatch
):
    window, said = without_a_shin, []
    exporter = window.commands._exporter
    exporter.said.connect(said.append)
    off = ("ltibia", 4.9), ("lfoot", 0.9)
    monkeypatch.setattr("markermend.files.write", lambda _, path, **more: Export(path, 3, off=off))
    assert exporter.export_to(tmp_path / "out.amc", ExportChoice(False, False), wait=True)
    assert window.findChildren(QMessageBox) == []
    assert said[-1].endswith("Its bones are rigid: ltibia is 4.9 mm off there, no joint is more.")


def test_a_dialog_says_which_joints_an_amc_lacks(without_a_shin, tmp_path, qtbot):
    window, document = without_a_shin, without_a_shin.document
    window.queue.filters.marker.setText("lfoot")
    foot = next(a for a in document.session.artifacts if a.marker == "lfoot")
    document.select(foot.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    document.decisions.repair_current()
    exporter = window.commands._exporter
    assert exporter.export_to(tmp_path / "out.amc", ExportChoice(False, False))
    qtbot.waitUntil(lambda: bool(window.findChildren(QMessageBox)), timeout=WAIT)
    (box,) = window.findChildren(QMessageBox)
    # The review goes on below it.
    assert not window.lane.busy
    assert "not in the file: lfoot. Repair what they hang on, too." in box.informativeText()
    assert " mm" not in box.informativeText()
    box.close()


def test_an_export_that_failed_is_not_said_to_be_done(opened, tmp_path, monkeypatch):
    said = []
    exporter = opened.commands._exporter
    exporter.said.connect(said.append)
    monkeypatch.setattr("markermend_app.dialogs.ask.show_problem", lambda *_: None)
    choice = ExportChoice(False, False)
    assert exporter.export_to(tmp_path / "one.csv", choice, wait=True)
    assert not exporter.export_to(tmp_path / "two.amc", choice, wait=True)
    assert said[0].startswith("Exported to")
    assert said[-1] == "two.amc was not written."


def test_what_is_accepted_only_is_told_when_all_is_decided(opened, qtbot):
    session = opened.document.session
    ids = [a.id for a in session.artifacts]
    opened.document.decisions.accept(ids[:1])
    opened.document.decisions.reject(ids[1:])
    said = opened.queue._hint
    qtbot.waitUntil(lambda: "are decided" in said.text())
    assert "1 is accepted but not repaired; Ctrl+R repairs" in said.text()


@pytest.mark.parametrize(
    ("recording", "told"),
    [("opened", "Joints were renamed meanwhile"), ("reviewed", "Markers were renamed meanwhile")],
)
def test_what_was_searched_under_other_names_is_told(request, recording, told, qtbot, monkeypatch):
    window, said = request.getfixturevalue(recording), []
    monkeypatch.setattr("markermend_app.detection.search", lambda *_, **__: ())
    window.detecting.said.connect(said.append)
    first = window.document.session.original.labels[0]
    window.detecting.detect()
    window.document.do(lambda session: hand.rename(session, {first: "other"}))
    qtbot.waitUntil(lambda: f"{told}; detect again." in said, timeout=WAIT)


def test_a_bvh_with_gaps_says_which_they_are(opened, tmp_path, monkeypatch):
    told_of = []
    monkeypatch.setattr(
        "markermend_app.dialogs.ask.show_problem", lambda _, error: told_of.append(str(error))
    )
    exporter = opened.commands._exporter
    assert not exporter.export_to(tmp_path / "out.bvh", ExportChoice(False, False), wait=True)
    (text,) = told_of
    assert "not known: head 30" in text
    assert "F the one under review and Ctrl+R all that are accepted" in told(text)
    assert "markermend clean" not in told(text)


def test_the_export_dialog_of_joints(qtbot, opened):
    document = opened.document
    pending = document.session.with_status(Status.PENDING)
    # What will be written is never written unseen, be it chosen for takes of markers.
    for record in (True, False):
        dialog = ExportDialog(opened, pending, [], [], 0, record, joints=True)
        qtbot.addWidget(dialog)
        dialog.show()
        boxes = [box for box in dialog.findChildren(QCheckBox) if box.isVisible()]
        assert any("C3D" in box.text() for box in boxes) == record == dialog.choice.record
    show = next(b for b in dialog.findChildren(QPushButton) if b.text() == "Show list")
    show.setFocus()
    qtbot.keyClick(show, Qt.Key.Key_Return)
    assert dialog.isVisible()
    assert dialog.findChild(QPlainTextEdit).isVisible()


def test_a_review_without_repairs_is_not_said_to_have_some(opened, monkeypatch):
    asked = []
    monkeypatch.setattr(
        "markermend_app.dialogs.ask.QMessageBox.exec", lambda box: asked.append(box.text())
    )
    document = opened.document
    document.decisions.reject([document.session.artifacts[0].id])
    assert not opened.commands.let_go()
    assert asked[-1] == "You changed no sample of sensor.csv, but its review would be lost."
    document.do(lambda s: hand.rename(s, {"torso": "chest"}))
    assert not opened.commands.let_go()
    assert asked[-1].startswith("You changed no sample of sensor.csv, but its review and its new")
    document.do(lambda s: hand.cut(s, "head", 10, 20))
    assert not opened.commands.let_go()
    assert asked[-1].startswith("Your repairs of sensor.csv are not exported")


def test_nothing_is_asked_before_the_export_where_nothing_is_left(opened, qtbot, monkeypatch):
    shown = []
    monkeypatch.setattr(ExportDialog, "exec", lambda self: shown.append(self) or 0)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: ("", ""))
    settings.remember("record_repairs", True)
    document = opened.document
    first, *rest = (a.id for a in document.session.artifacts)
    document.decisions.reject(rest)
    opened.actions_by_name["export"].trigger()
    assert len(shown) == 1
    document.decisions.reject([first])
    opened.actions_by_name["export"].trigger()
    assert len(shown) == 1
    # What is wanted of takes is kept.
    assert settings.flag("record_repairs", False)
    document.do(lambda s: s.set_region((10, 60)))
    opened.actions_by_name["export"].trigger()
    assert len(shown) == 2
