"""Skeleton recordings in the window: opened, reviewed and exported by the same keys as takes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QFileDialog,
    QLabel,
    QMenu,
    QMessageBox,
    QPlainTextEdit,
    QPushButton,
)

import markermend as mm
from markermend.artifact import Kind, Status
from markermend.poses.breaking import break_pose
from markermend.poses.nuitrack import JOINTS, to_nuitrack
from markermend.review import hand
from markermend_app.actions.palette import entries, ranked
from markermend_app.dialogs.export import ExportChoice, ExportDialog
from markermend_app.dialogs.file_filters import export_filter, open_filter
from markermend_app.dialogs.preferences import Preferences
from markermend_app.panels.inspector.artifact import ArtifactPage
from markermend_app.panels.markers.marker_menu import add_marker_verbs
from markermend_app.panels.markers.marker_model import NAME
from markermend_app.panels.markers.naming import paired_name
from markermend_app.panels.queue.model import MARKER
from markermend_app.panels.scene import paint
from markermend_app.panels.scene.proposed import proposed_body
from markermend_app.style import theme
from markermend_app.telling import _read, told
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


def test_restoring_is_compared_with_the_others_and_stands_first(opened, qtbot):
    document, comparison = opened.document, opened.comparison
    gap = next(a for a in document.session.artifacts if a.marker == "head")
    document.select(gap.id)
    comparison.start(["C"])
    qtbot.waitUntil(lambda: comparison.candidates is not None, timeout=WAIT)
    restored = next(c for c in comparison.candidates if c.method == "skeleton")
    # Both were tried where the head was seen, so that the figures can be compared.
    assert restored.trials > 0
    assert {"local_regression", "spline"} <= {c.method for c in comparison.candidates}
    assert all(c.error_mm is not None for c in comparison.candidates if c.trials)
    comparison.stop()


def test_bones_of_what_is_proposed_are_drawn_in_space(opened, qtbot):
    document, scene = opened.document, opened.scene
    take = document.session.original
    gap = next(a for a in document.session.artifacts if a.marker == "head")
    document.select(gap.id)
    document.go_to(gap.start + 2)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    now = document.session.positions[document.frame]
    placed, proposed = proposed_body(document, now)
    head = take.index("head")
    assert np.isnan(now[head]).all()
    assert proposed[head]
    np.testing.assert_array_equal(placed[head], document.proposal.patches[0].values[2])
    drawn = []
    as_it_is = paint.paint_proposed
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(paint, "paint_proposed", lambda s, p, n: drawn.append(n) or as_it_is(s, p, n))
        scene.grab()
    assert sorted((head, take.index("neck"))) in [sorted(pair) for pair in drawn[0].tolist()]
    document.go_to(gap.stop + 5)
    assert not proposed_body(document, document.session.positions[document.frame])[1].any()


def test_what_ties_swapped_joints_is_no_bone(opened, qtbot):
    """Lines from before to after a repair have a colour that no segment has."""
    document, scene = opened.document, opened.scene
    swap = next(a for a in document.session.artifacts if a.counterpart)
    document.select(swap.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    document.repair_current()
    document.select(None)
    document.go_to(swap.start + 1)
    tie = theme.current().warning

    def tied():
        image = scene.grab().toImage()
        picture = (
            image.pixelColor(x, y) for x in range(image.width()) for y in range(image.height())
        )
        return sum(abs(c.red() - tie.red()) + abs(c.green() - tie.green()) < 40 for c in picture)

    with_ties = tied()
    scene.looks.ghost = False
    assert with_ties > tied() + 5


def test_where_bones_are_rigid_a_dialog_says_which_joints_are_off(
    window, shared_data, tmp_path, qtbot
):
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
    for artifact in window.document.session.with_status(Status.PENDING):
        window.document.select(artifact.id)
        window.document.choose_method("linear")
        qtbot.waitUntil(lambda: window.document.proposal is not None, timeout=WAIT)
        window.document.repair_current()
    exporter = window.commands._exporter
    assert exporter.export_to(tmp_path / "out.amc", ExportChoice(False, False), wait=True)
    (box,) = window.findChildren(QMessageBox)
    assert "out.amc" in box.text()
    assert "ltibia" in box.informativeText() or "lfoot" in box.informativeText()
    assert " mm" in box.informativeText()
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


def test_a_mix_up_is_told_of_both_of_its_joints(opened, qtbot):
    document, queue = opened.document, opened.queue
    swap = next(a for a in document.session.artifacts if a.counterpart)
    part = swap.marker.removeprefix("left_")
    assert queue.model.text(swap, MARKER) == f"L/R {part}"
    both = f"{swap.marker} ↔ {swap.counterpart}"
    row = queue.model.index(queue.model.row_of(swap.id), MARKER)
    assert row.data(Qt.ItemDataRole.ToolTipRole).startswith(both)
    model = opened.tree._model
    qtbot.waitUntil(lambda: bool(model.node(model.index_of(swap.marker)).own))
    assert model.node(model.index_of(swap.counterpart)).own[Kind.STEP] == 1
    overview = opened.overview
    at = [overview._rows.row_of[JOINTS.index(m)] for m in swap.markers]
    assert {(swap.start, swap.stop, r) for r in at} <= set(map(tuple, overview._place.tolist()))
    document.select(swap.id)
    document.go_to(swap.start)
    assert {JOINTS.index(m) for m in swap.markers} <= set(opened.scene.seen.rings())
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    document.repair_current()
    assert document.session.history[-1] == f"Repair step on {both}"
    document.select(swap.id)
    assert opened.inspector.findChild(ArtifactPage).title.text() == both


@pytest.mark.parametrize(
    ("names", "told"),
    [
        (("left_ankle", "right_ankle"), "L/R ankle"),
        (("rtibia", "ltibia"), "L/R tibia"),
        (("LeftArm", "RightArm"), "L/R Arm"),
        (("left_ankle", "right_knee"), "left_ankle ↔ right_knee"),
        (("left_hip", "left_hip2"), "left_hip ↔ left_hip2"),
        (("lhand",), "lhand"),
    ],
)
def test_joints_that_change_places_have_a_short_name(names, told):
    assert paired_name(names) == told


def test_actions_speak_of_joints_and_those_without_use_rest(opened, window, qtbot):
    actions = opened.actions_by_name
    assert actions["rename_marker"].text() == "Rename joint…"
    assert "joint" in actions["choose_references"].toolTip()
    assert not actions["detect_slow"].isEnabled()
    assert "Only for takes of markers" in actions["detect_slow"].toolTip()
    found = entries(actions, opened.document)
    names = [entry.text for entry in ranked("joint", found)]
    assert "By hand: Rename joint…" in names
    assert "left_wrist" in names
    menu = QMenu()
    opened.document.show(["head"])
    add_marker_verbs(menu, opened.document, lambda _: None)
    assert any(action.text().startswith("Merge joint…") for action in menu.actions())
    opened.scene.looks.fill(menu, None, lambda _: None, lambda: None, joints=True)
    assert "Joints in one colour" in [action.text() for action in menu.actions()]
    assert opened.scene.buttons.trails.toolTip() == "Trails of all joints"


def test_actions_speak_of_markers_again(opened, take_path, qtbot):
    opened.document.session.mark_exported()
    opened.commands.open_path(take_path)
    qtbot.waitUntil(lambda: not opened.document.joints, timeout=WAIT)
    actions = opened.actions_by_name
    assert actions["rename_marker"].text() == "Rename marker…"
    assert actions["detect_slow"].isEnabled()
    assert opened.scene.buttons.trails.toolTip() == "Trails of all markers"


def test_the_dial_rests_where_it_changes_nothing(qtbot):
    page = Preferences()
    qtbot.addWidget(page)
    assert page.dial.isEnabled()
    page.dial_does_nothing()
    page._read_detection()
    assert not page.dial.isEnabled()
    assert not page.preset.isEnabled()
    assert "joints" in page.dial.toolTip()


def test_what_is_accepted_only_is_told_when_all_is_decided(opened, qtbot):
    session = opened.document.session
    ids = [a.id for a in session.artifacts]
    opened.document.accept(ids[:1])
    opened.document.reject(ids[1:])
    said = opened.queue._hint
    qtbot.waitUntil(lambda: "are decided" in said.text())
    assert "1 is accepted but not repaired; Ctrl+R repairs" in said.text()


def test_a_bvh_with_gaps_says_which_they_are(opened, tmp_path, monkeypatch):
    told_of = []
    monkeypatch.setattr(
        "markermend_app.dialogs.ask.show_problem", lambda _, error: told_of.append(str(error))
    )
    exporter = opened.commands._exporter
    assert not exporter.export_to(tmp_path / "out.bvh", ExportChoice(False, False), wait=True)
    (text,) = told_of
    assert "not known: head 30" in text
    assert told(text) == text
    assert _read(text) is not None


def test_restoring_is_named_where_it_is_the_best(opened, qtbot):
    document = opened.document
    methods = opened.inspector.findChild(ArtifactPage).methods
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.select(gap.id)
    assert methods.buttons["auto"].text() == "Best: Restore skeleton"
    assert methods.buttons["swap"].text() == "6 Swap joints"
    assert not methods.buttons["swap"].isEnabled()
    assert opened.inspector.findChild(ArtifactPage).sureness.text().startswith("certain")
    document.select(next(a for a in document.session.artifacts if a.counterpart).id)
    assert methods.buttons["swap"].isEnabled()
    assert "%" in opened.inspector.findChild(ArtifactPage).sureness.text()


def test_the_overview_is_in_the_order_of_the_tree(opened):
    rows = opened.overview._rows
    names = [JOINTS[column] for column in rows.columns]
    place = {name: names.index(name) for name in names}
    assert place["left_elbow"] == place["left_shoulder"] + 1
    assert place["left_wrist"] == place["left_elbow"] + 1
    assert place["left_ankle"] == place["left_knee"] + 1
    assert sorted(rows.row_of) == list(range(len(JOINTS)))
    assert [name for name, *_ in rows.groups] == names


def test_the_export_dialog_of_joints(qtbot, opened):
    document = opened.document
    pending = document.session.with_status(Status.PENDING)
    dialog = ExportDialog(opened, pending, [], [], 0, True, joints=True)
    qtbot.addWidget(dialog)
    dialog.show()
    boxes = [box for box in dialog.findChildren(QCheckBox) if box.isVisible()]
    assert not any("C3D" in box.text() for box in boxes)
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
    document.reject([document.session.artifacts[0].id])
    assert not opened.commands.let_go()
    assert asked[-1].startswith("You changed no sample of sensor.csv")
    document.do(lambda s: hand.cut(s, "head", 10, 20))
    assert not opened.commands.let_go()
    assert asked[-1].startswith("Your repairs of sensor.csv are not exported")
