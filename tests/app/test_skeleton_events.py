"""What is done by hand to a row of the queue that tells of several joints is done to each."""

from __future__ import annotations

import numpy as np
import pytest
from driving import key
from PySide6.QtCore import Qt

import markermend as mm
from markermend.artifact import Artifact, Kind, Status
from markermend.poses.nuitrack import JOINTS
from markermend.report import review_report, reviewed
from markermend.review import hand
from markermend.review.file import open_session
from markermend.review.step import stretch
from markermend_app.panels.notice import Notice
from markermend_app.panels.plots.menu import artifact_menu
from markermend_app.panels.queue.model import FRAMES
from markermend_app.telling import FORMS, compiled

CTRL = Qt.KeyboardModifier.ControlModifier
LEG = ("left_ankle", "left_knee", "left_hip")


def found(marker, start, stop):
    return Artifact(marker, "xyz", start, stop, Kind.STEP, 0.9, why="stands elsewhere")


@pytest.fixture
def leg(review, broken):
    """The window on a leg that was elsewhere, on its ankle and knee once more a little later."""
    take = mm.read(broken)
    first = [found(joint, 40, 50) for joint in LEG]
    window = review(take, [*first, *(found(joint, 60, 70) for joint in LEG[:2])])
    document = window.document
    document.select(next(a.id for a in document.session.artifacts if a.start == 40))
    assert len(document.together) == len(LEG)
    return window


def told(window):
    """Frames, class and decision of what is listed of the leg."""
    return {(a.marker, a.start, a.stop, a.kind) for a in window.document.session.artifacts}


def of_leg(start, stop, kind=Kind.STEP):
    return {(joint, start, stop, kind) for joint in LEG}


LATER = {(joint, 60, 70, Kind.STEP) for joint in LEG[:2]}


def test_edges_and_class_are_those_of_every_joint(leg, qtbot):
    key(qtbot, leg, Qt.Key.Key_BracketRight)
    key(qtbot, leg, Qt.Key.Key_BracketRight)
    assert told(leg) == of_leg(40, 52) | LATER
    assert len(leg.document.together) == len(LEG)
    assert leg.document.session.history[-1].startswith("Nudge the end of step on ")
    assert leg.document.session.history[-1].endswith(" +2")
    assert stretch(leg.document.session.steps[0][-1]) == (40, 52)
    leg.inspector.artifact.first.setValue(leg.inspector.artifact.first.value() - 3)
    assert told(leg) == of_leg(37, 52) | LATER
    key(qtbot, leg, Qt.Key.Key_3, CTRL)
    assert told(leg) == of_leg(37, 52, Kind.NOISE) | LATER
    # Nudges of one edge in a row, the field and the class are a step each.
    for _ in range(3):
        key(qtbot, leg, Qt.Key.Key_Z, CTRL)
    assert told(leg) == of_leg(40, 50) | LATER
    # One joint alone, once the queue is filtered by its name.
    leg.queue.filters.marker.setText("left_hip")
    leg.document.select(next(a.id for a in leg.document.session.artifacts if "hip" in a.marker))
    key(qtbot, leg, Qt.Key.Key_BracketRight)
    assert ("left_hip", 40, 51, Kind.STEP) in told(leg)
    assert ("left_knee", 40, 50, Kind.STEP) in told(leg)


def noted(window):
    """Who has which note."""
    return {(a.marker, a.start): a.note for a in window.document.session.artifacts if a.note}


def test_a_note_is_on_every_joint_of_its_row(leg, qtbot):
    note = leg.inspector.artifact.note
    key(qtbot, leg, Qt.Key.Key_T)
    qtbot.waitUntil(note.hasFocus)
    qtbot.keyClicks(note, "hidden by the table")
    key(qtbot, note, Qt.Key.Key_Return)
    assert noted(leg) == {(joint, 40): "hidden by the table" for joint in LEG}
    assert leg.document.session.history[-1].endswith(" +2")
    key(qtbot, leg, Qt.Key.Key_T)
    qtbot.waitUntil(note.hasFocus)
    note.selectAll()
    qtbot.keyClicks(note, "by the bench")
    # Deciding while it is being written keeps it, on all of those that were decided.
    leg.actions_by_name["reject"].trigger()
    assert noted(leg) == {(joint, 40): "by the bench" for joint in LEG}
    for _ in range(3):
        leg.actions_by_name["undo"].trigger()
    assert noted(leg) == {}
    # One joint alone, once the queue is filtered by its name.
    leg.queue.filters.marker.setText("left_hip")
    leg.document.select(next(a.id for a in leg.document.session.artifacts if "hip" in a.marker))
    leg.queue.filters.marker.setText("hip")
    key(qtbot, leg, Qt.Key.Key_T)
    qtbot.waitUntil(note.hasFocus)
    qtbot.keyClicks(note, "odd")
    key(qtbot, note, Qt.Key.Key_Return)
    assert noted(leg) == {("left_hip", 40): "odd"}


def test_an_event_is_split_and_joined_with_the_next(leg, qtbot):
    document = leg.document
    document.go_to(45)
    key(qtbot, leg, Qt.Key.Key_Slash)
    assert told(leg) == of_leg(40, 45) | of_leg(45, 50) | LATER
    assert len(document.together) == len(LEG)
    key(qtbot, leg, Qt.Key.Key_J)
    assert told(leg) == of_leg(40, 50) | LATER
    # Of the hip there is no other one: it stays as it is.
    key(qtbot, leg, Qt.Key.Key_J)
    ankle_and_knee = {(joint, 40, 70, Kind.STEP) for joint in LEG[:2]}
    assert told(leg) == ankle_and_knee | {("left_hip", 40, 50, Kind.STEP)}
    assert document.session.history[-1].endswith(" +1")
    for _ in range(3):
        key(qtbot, leg, Qt.Key.Key_Z, CTRL)
    assert told(leg) == of_leg(40, 50) | LATER


def test_rows_that_are_selected_are_joined(leg, qtbot):
    document = leg.document
    leg.queue.view.selectAll()
    assert len(leg.queue.selected()) == len(LEG) + 2
    key(qtbot, leg, Qt.Key.Key_J)
    assert ("left_ankle", 40, 70, Kind.STEP) in told(leg)
    assert ("left_knee", 40, 70, Kind.STEP) in told(leg)
    assert document.current is not None


@pytest.mark.parametrize(
    ("entry", "status"), [("Accept", Status.ACCEPTED), ("Reject", Status.REJECTED)]
)
def test_the_menu_of_a_plot_decides_about_the_event_that_it_names(leg, entry, status):
    document = leg.document
    menu = artifact_menu(document, document.current, lambda _: None, leg)
    assert menu.actions()[0].text().endswith(" +2")
    next(a for a in menu.actions() if a.text().startswith(entry)).trigger()
    decided = [a for a in document.session.artifacts if a.start == 40]
    assert {a.status for a in decided} == {status}
    assert np.array_equal(
        document.session.positions, document.session.original.positions, equal_nan=True
    )


def test_what_is_like_an_event_takes_all_of_its_joints_along(leg, qtbot):
    document = leg.document
    qtbot.keyClick(leg, Qt.Key.Key_R, Qt.KeyboardModifier.ShiftModifier)
    dialog = leg.bulk.dialog
    assert dialog.scope.currentText() == "On left_ankle"
    assert dialog.go.text() == f"Reject {len(LEG) + 2}"
    dialog.reject()
    # One joint alone, once the queue is filtered by its name.
    leg.queue.filters.marker.setText("left_ankle")
    document.select(next(a.id for a in document.session.artifacts if "ankle" in a.marker))
    qtbot.keyClick(leg, Qt.Key.Key_R, Qt.KeyboardModifier.ShiftModifier)
    assert leg.bulk.dialog.go.text() == "Reject 2"
    leg.bulk.dialog.accept()
    rejected = {a.marker for a in document.session.with_status(Status.REJECTED)}
    assert rejected == {"left_ankle"}


def test_what_is_rejected_of_a_limb_is_asked_about_once(review, broken, qtbot, tmp_path):
    rows = [found(joint, start, start + 5) for start in range(40, 90, 10) for joint in LEG]
    window = review(mm.read(broken), rows)
    document, bulk = window.document, window.bulk
    window.queue.view.sortByColumn(FRAMES, Qt.SortOrder.AscendingOrder)
    document.select(document.queue[0])
    for _ in range(3):
        assert not bulk.doubts
        key(qtbot, window, Qt.Key.Key_R)
    notice = window.findChild(Notice)
    assert notice.isVisible()
    told = notice.text.text()
    assert "rejected 9 of 9 decided as step on left_hip +2. Make the other 6 less sure" in told
    key(qtbot, window, Qt.Key.Key_Y)
    assert not bulk.doubts
    rest = document.session.with_status(Status.PENDING)
    # Each joint was rejected three times: that its next is real has a probability of 1/5.
    assert [a.confidence for a in rest] == pytest.approx([0.9 / 5] * 6)
    key(qtbot, window, Qt.Key.Key_R)
    assert not bulk.doubts
    # Nor is it asked when the review is opened again.
    take, mesh = document.session.original, document.mesh
    document.session.mark_exported()
    document.open(None, None)
    document.open(open_session(take, folder=tmp_path), mesh)
    document.artifacts_changed.emit()
    assert len(document.session.with_status(Status.REJECTED)) == 12
    assert not bulk.doubts


def test_joints_are_not_called_markers_where_work_is_told(leg, broken):
    document = leg.document

    def smoothed(session):
        columns = [session.original.index(joint) for joint in LEG]
        samples, origin = session.positions[:9, columns], session.origin[:9, columns]
        return hand.replace_samples(session, "Smooth", LEG, 0, samples, origin)

    assert document.do(smoothed)
    assert document.session.history[-1] == "Smooth 3 joints in frames 1–9"
    page = review_report(reviewed(document.session), name="sensor.csv")
    assert ">Joint<" in page
    assert ">Marker<" not in page
    document.file.save()
    document.open(None, None)
    pose = mm.read_pose(broken)
    positions = pose.positions.copy()
    positions[0, JOINTS.index("head")] += 1.0
    mm.write_pose(pose.with_samples(positions, pose.rotations, pose.confidence), broken)
    again = open_session(mm.read(broken), folder=broken.parent)
    assert "decided on the 16 joints that are the same was kept" in again.warning
    assert_known(again.warning)
    again.close()


def assert_known(sentence):
    """A sentence of the engine can be told in the language of the app."""
    assert any(compiled(form).fullmatch(sentence) for form in FORMS), sentence
