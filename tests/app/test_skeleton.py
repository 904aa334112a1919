"""Skeleton recordings in the window: opened, reviewed and exported by the same keys as takes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import QFileDialog, QLabel

import markermend as mm
from markermend.artifact import Status
from markermend.poses.breaking import break_pose
from markermend.poses.nuitrack import JOINTS, to_nuitrack
from markermend_app.dialogs.export import ExportChoice
from markermend_app.dialogs.file_filters import export_filter, open_filter
from markermend_app.panels.markers.marker_model import NAME
from markermend_app.window import MainWindow

WAIT = 60_000
CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def broken(shared_data, tmp_path):
    """A file of joints of which each fault has some, and one joint is not seen for a while."""
    walk = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))
    pose, _ = break_pose(walk, each=1, seed=4)
    confidence = np.array(pose.confidence)
    confidence[200:230, JOINTS.index("head")] = 0.0
    path = tmp_path / "sensor.csv"
    mm.write_pose(pose.with_samples(pose.positions, pose.rotations, confidence), path)
    return path


@pytest.fixture
def window(qtbot):
    def let_close(window):
        if window.document.session is not None:
            window.document.session.mark_exported()

    window = MainWindow()
    qtbot.addWidget(window, before_close_func=let_close)
    window.show()
    window.activateWindow()
    qtbot.waitExposed(window)
    return window


@pytest.fixture
def opened(window, broken, qtbot):
    """The window on the recording, searched."""
    window.commands.open_path(broken)
    qtbot.waitUntil(lambda: window.document.current is not None, timeout=WAIT)
    return window


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


def test_what_has_joints_is_not_said_to_have_markers(opened):
    assert opened.docks["markers"].windowTitle() == "Joints"
    assert opened.tree.filter.accessibleName() == "Filter joints"
    assert opened.tree._model.headerData(NAME, Qt.Orientation.Horizontal) == "Joint"
    facts = [label.text() for label in opened.inspector.findChildren(QLabel)]
    assert "Joints" in facts
    assert "Markers" not in facts
    assert opened.queue.filters.marker.accessibleName() == "Filter by joint"
    opened.docks["quality"].raise_()
    opened.quality._count()
    for header in (opened.queue.view.horizontalHeader(), opened.quality.head.horizontalHeader()):
        named = [header.model().headerData(i, Qt.Orientation.Horizontal) for i in range(3)]
        assert "Joint" in named
        assert "Marker" not in named
    opened.document.show(())
    assert opened.trajectories.empty.accessibleName() == "No joint is shown"


def test_a_review_by_keys_changes_what_was_repaired_only(opened, broken, qtbot, tmp_path):
    document = opened.document
    pending = len(document.session.with_status(Status.PENDING))
    before = document.session.positions.copy()
    decided = []
    for key in (Qt.Key.Key_R, Qt.Key.Key_A, *[Qt.Key.Key_F] * (pending - 2)):
        current = document.current.id
        qtbot.keyClick(opened, key)
        qtbot.waitUntil(
            lambda had=current: document.session.artifact(had).status is not Status.PENDING,
            timeout=WAIT,
        )
        decided.append(document.session.artifact(current))
    assert [a.status for a in decided[:2]] == [Status.REJECTED, Status.ACCEPTED]
    repaired = document.session.with_status(Status.REPAIRED)
    assert {document.session.notes[a.id].method for a in repaired} <= {"skeleton", "swap"}
    assert len(repaired) == pending - 2
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
    assert opened.scene.seen.ghost() is not None
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


def test_a_damaged_recording_is_told_in_one_sentence(window, tmp_path, qtbot, monkeypatch):
    told = []
    monkeypatch.setattr(
        "markermend_app.dialogs.ask.show_problem", lambda _, error: told.append(str(error))
    )
    path = tmp_path / "alone.amc"
    path.write_text("1\nroot 0 0 0 0 0 0\n")
    window.commands.open_path(path)
    qtbot.waitUntil(lambda: bool(told), timeout=WAIT)
    assert told == [
        "alone.amc needs its skeleton: put the ASF file beside it, named alone.asf, or say which it"
        " is."
    ]
    assert window.document.session is None


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
