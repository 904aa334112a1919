"""Joints that went wrong together are one row, and one key decides them."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt

import markermend as mm
from markermend.artifact import Kind, Status
from markermend.poses.nuitrack import JOINTS, to_nuitrack
from markermend.poses.take import pose_of, restored
from markermend_app.panels.inspector.artifact import ArtifactPage
from markermend_app.panels.queue.model import MARKER
from markermend_app.rows import Rows

WAIT = 60_000
ARM = ("left_shoulder", "left_elbow", "left_wrist")


@pytest.fixture
def opened(window, shared_data, tmp_path, qtbot):
    """The window on a walk that is carried off for a while, and lacks an arm at another time."""
    walk = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))
    positions, confidence = walk.positions.copy(), np.array(walk.confidence)
    positions[60:70] += (900.0, 0.0, 300.0)
    confidence[200:240, [JOINTS.index(name) for name in ARM]] = 0.0
    confidence[260:270, JOINTS.index("head")] = 0.0
    mm.write_pose(walk.with_samples(positions, walk.rotations, confidence), tmp_path / "walk.csv")
    window.commands.open_path(tmp_path / "walk.csv")
    qtbot.waitUntil(lambda: window.document.current is not None, timeout=3 * WAIT)
    return window


def names(window):
    return [window.queue.model.text(a, MARKER) for a in window.queue.model.rows]


def decided(window, qtbot, key):
    """Press a key, and wait until what was under review is decided."""
    document, before = window.document, window.document.current.id
    qtbot.keyClick(window, key)
    qtbot.waitUntil(
        lambda: document.session.artifact(before).status is not Status.PENDING, timeout=WAIT
    )


def test_the_body_and_an_arm_are_a_row_each(opened):
    assert names(opened) == ["Whole body", "left_shoulder +2", "head"]
    assert len(opened.document.session.artifacts) == len(JOINTS) + 4
    row = opened.queue.model.index(1, MARKER)
    assert "With it: left_elbow, left_wrist" in row.data(Qt.ItemDataRole.ToolTipRole)


def test_one_key_repairs_an_event_and_one_takes_that_back(opened, qtbot):
    document = opened.document
    before = document.session.positions.copy()
    title = opened.inspector.findChild(ArtifactPage).title
    assert title.text() == "Whole body"
    decided(opened, qtbot, Qt.Key.Key_F)
    repaired = document.session.with_status(Status.REPAIRED)
    assert {a.marker for a in repaired} == set(JOINTS)
    assert opened.status._said.whole == "17 repaired."
    moved = np.abs(document.session.positions - before).max(axis=2)
    assert (moved[60:70] > 800.0).all()
    assert not np.nan_to_num(np.delete(moved, np.r_[60:70], axis=0)).any()
    assert document.session.history[-1] == "Repair step on waist +16"
    qtbot.waitUntil(lambda: names(opened) == ["left_shoulder +2", "head"])
    assert document.current.marker == "left_shoulder"
    assert title.text() == "left_shoulder +2"
    qtbot.keyClick(opened, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert not document.session.with_status(Status.REPAIRED)
    assert len(document.together) == len(JOINTS)


def test_what_was_repaired_together_is_reopened_together_where_it_is_listed_no_more(opened, qtbot):
    document = opened.document
    waist = document.current.id
    decided(opened, qtbot, Qt.Key.Key_F)
    qtbot.waitUntil(lambda: opened.queue.model.row_of(waist) is None)
    document.select(waist)
    assert opened.inspector.findChild(ArtifactPage).title.text() == "Whole body"
    qtbot.keyClick(opened, Qt.Key.Key_U)
    assert not document.session.with_status(Status.REPAIRED)


def test_keys_walk_from_event_to_event_and_decide_each(opened, qtbot):
    document = opened.document
    qtbot.keyClick(opened, Qt.Key.Key_N)
    assert document.current.marker == "left_shoulder"
    qtbot.keyClick(opened, Qt.Key.Key_N)
    assert document.current.marker == "head"
    qtbot.keyClick(opened, Qt.Key.Key_P)
    decided(opened, qtbot, Qt.Key.Key_R)
    rejected = document.session.with_status(Status.REJECTED)
    assert {a.marker for a in rejected} == set(ARM)
    assert document.current.marker == "head"
    decided(opened, qtbot, Qt.Key.Key_A)
    assert len(document.session.with_status(Status.ACCEPTED)) == 1
    document.select(rejected[1].id)
    opened.queue.filters.status.setCurrentIndex(opened.queue.filters.status.count() - 1)
    opened.commands.reopen()
    assert len(document.session.with_status(Status.PENDING)) == len(JOINTS) + 3


def test_from_a_joint_that_stands_for_no_row_keys_go_on_as_from_its_row(opened, qtbot):
    document = opened.document
    elbow = next(
        a for a in document.session.artifacts if a.kind is Kind.GAP and "elbow" in a.marker
    )
    document.select(elbow.id)
    assert document.together[0] == elbow.id
    assert len(document.together) == 3
    qtbot.waitUntil(lambda: opened.queue.view.currentIndex().row() == 1)
    assert document.current == elbow
    qtbot.keyClick(opened, Qt.Key.Key_N)
    assert document.current.marker == "head"


def test_the_worst_of_what_one_key_repairs_is_what_is_promised(opened, qtbot):
    document, page = opened.document, opened.inspector.findChild(ArtifactPage)
    opened.document.select(opened.queue.model.rows[1].id)
    now = document.at_once(document.session)
    qtbot.waitUntil(lambda: all(document.preview.get(a) for a in now), timeout=WAIT)
    errors = {a.marker: document.preview.get(a).error_mm for a in now}
    worst = max(errors, key=errors.get)
    assert worst != "left_shoulder"
    said = f"expected error up to {errors[worst]:.1f} mm ({worst})"
    qtbot.waitUntil(lambda: said in page.methods.outcome.text())
    decided(opened, qtbot, Qt.Key.Key_F)
    document.select(now[0].id)
    assert f"± {errors[worst]:.1f} mm" in page.status.text()


def test_details_follow_what_the_queue_lists_together(opened, qtbot):
    document, title = opened.document, opened.inspector.findChild(ArtifactPage).title
    opened.queue.filters.marker.setText("elbow")
    document.select(opened.queue.model.rows[-1].id)
    assert title.text() == "left_elbow"
    opened.queue.filters.marker.setText("")
    qtbot.waitUntil(lambda: title.text() == "left_elbow +2")
    outcome = opened.inspector.findChild(ArtifactPage).methods.outcome
    qtbot.waitUntil(lambda: "expected error up to" in outcome.text(), timeout=WAIT)


def test_a_name_that_is_asked_for_stands_alone(opened, qtbot):
    document = opened.document
    opened.queue.filters.marker.setText("elbow")
    assert names(opened)[-1] == "left_elbow"
    document.select(opened.queue.model.rows[-1].id)
    decided(opened, qtbot, Qt.Key.Key_F)
    (repaired,) = document.session.with_status(Status.REPAIRED)
    assert repaired.marker == "left_elbow"


def test_selected_rows_mean_all_that_they_stand_for(opened, qtbot):
    opened.queue.view.selectRow(1)
    assert len(opened.queue.selected()) == 3
    opened.queue.apply("accept")
    accepted = opened.document.session.with_status(Status.ACCEPTED)
    assert {a.marker for a in accepted} == set(ARM)


def test_rows_are_walked_from_where_one_is():
    rows = Rows([["a", "b"], ["c"]])
    assert rows.ids == ("a", "c")
    assert rows.together("b") == ("b", "a")
    assert rows.together("x") == ("x",)
    assert [rows.beside(i, 1) for i in ("a", "b", "c", "x", None)] == ["c", "c", None, "a", "a"]
    assert [rows.beside(i, -1) for i in ("a", "c", None)] == [None, "a", "c"]
    assert Rows().beside(None, 1) is None


def test_a_review_that_is_opened_again_is_restored_before_it_is_walked(
    opened, qtbot, tmp_path, monkeypatch
):
    decided(opened, qtbot, Qt.Key.Key_F)
    assert opened.commands.put_by()
    asked, lane = [], opened.document.proposals.lane
    monkeypatch.setattr(
        "markermend.repairs.skeleton.restored",
        lambda pose, progress: asked.append((pose, lane.busy)) or restored(pose),
    )
    opened.document.open(None, None)
    opened.commands.open_path(tmp_path / "walk.csv")
    qtbot.waitUntil(lambda: opened.document.proposal is not None, timeout=3 * WAIT)
    # Proposals rest on it: none was asked for as long as it was made.
    assert asked == [(pose_of(opened.document.session.original), False)]
