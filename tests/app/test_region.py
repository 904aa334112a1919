"""The region of interest under an operator's hands."""

from __future__ import annotations

import pytest
from driving import WAIT, key, settled
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QCheckBox, QFileDialog

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend_app.dialogs import export as export_dialog
from markermend_app.looking import Selection

SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def narrowed(reviewed, qtbot):
    """The damaged take, of which the last half is reviewed."""
    reviewed.document.go_to(190)
    key(qtbot, reviewed, Qt.Key.Key_I)
    settled(qtbot)
    return reviewed


def listed(window):
    return [(a.marker, a.kind) for a in window.queue.model.rows]


def test_keys_choose_it_and_the_queue_lists_what_reaches_into_it(narrowed, qtbot):
    document = narrowed.document
    assert document.session.region == (190, 400)
    assert sorted(listed(narrowed)) == [("C7", Kind.NOISE), ("LWRA", Kind.STEP)]
    assert set(document.queue) == {a.id for a in document.session.listed}
    assert narrowed.queue.filters.progress.text().endswith(" of 2 decided")
    assert narrowed.inspector.take._reviewed.text() == "Frames 291 to 500"
    assert "Frames 291–500 are reviewed" in narrowed.status._said.text()
    assert "Artifacts outside them: 2" in narrowed.status._said.text()
    document.go_to(250)
    key(qtbot, narrowed, Qt.Key.Key_O)
    settled(qtbot)
    assert document.session.region == (190, 251)
    assert listed(narrowed) == [("C7", Kind.NOISE)]
    key(qtbot, narrowed, Qt.Key.Key_O, SHIFT)
    settled(qtbot)
    assert document.session.region is None
    assert len(listed(narrowed)) == 4
    assert "whole take" in narrowed.status._said.text()


def test_the_artifact_under_review_is_left_where_it_lies_outside(reviewed, qtbot):
    document = reviewed.document
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.select(gap.id)
    document.go_to(190)
    view = reviewed.trajectories._view
    key(qtbot, reviewed, Qt.Key.Key_I)
    settled(qtbot)
    assert document.current is None
    assert reviewed.trajectories._view == view
    key(qtbot, reviewed, Qt.Key.Key_N)
    assert document.current in document.session.listed


def test_undo_brings_the_others_back(narrowed, qtbot):
    key(qtbot, narrowed, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    settled(qtbot)
    assert narrowed.document.session.region is None
    assert len(listed(narrowed)) == 4


def test_a_swept_range_becomes_it(reviewed, qtbot):
    reviewed.document.sweep(Selection("C7", 190, 260))
    qtbot.mouseClick(
        reviewed.inspector.selection.verbs["region_selection"], Qt.MouseButton.LeftButton
    )
    settled(qtbot)
    assert reviewed.document.session.region == (190, 260)
    assert reviewed.document.selection is None


def test_frames_outside_are_paled(narrowed, qtbot):
    narrowed.trajectories.fit_all()
    settled(qtbot)
    for row in narrowed.trajectories.rows:
        assert row.outside.isVisible()
    picture = narrowed.overview.grab().toImage()
    key(qtbot, narrowed, Qt.Key.Key_O, SHIFT)
    settled(qtbot)
    assert not any(row.outside.isVisible() for row in narrowed.trajectories.rows)
    assert narrowed.overview.grab().toImage() != picture


def test_a_row_that_comes_later_is_paled_too(narrowed, qtbot):
    narrowed.trajectories.choose_rows(["x", "speed"])
    settled(qtbot)
    assert all(row.outside.isVisible() for row in narrowed.trajectories.rows)


def test_playing_stays_within_it(narrowed, qtbot):
    transport = narrowed.transport
    narrowed.document.go_to(300)
    assert transport._range() == (190, 400)
    narrowed.document.go_to(100)
    assert transport._range() == (0, 400)


def test_nothing_within_it_is_told(reviewed, qtbot):
    document = reviewed.document
    document.go_to(380)
    key(qtbot, reviewed, Qt.Key.Key_I)
    settled(qtbot)
    assert listed(reviewed) == []
    assert "outside the region of interest" in reviewed.queue._hint.text()
    assert reviewed.actions_by_name["region_whole"].isEnabled()


def test_export_writes_it_alone(narrowed, qtbot, monkeypatch, tmp_path):
    asked = []

    def ask(*args, **more):
        asked.append((args, more))
        return export_dialog.ExportChoice(record=True, mark_outputs=False, region=True)

    target = tmp_path / "part.c3d"
    monkeypatch.setattr(export_dialog, "ask_export", ask)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), "C3D (*.c3d)"))
    key(qtbot, narrowed, Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: not narrowed.lane.busy, timeout=WAIT)
    ((_, pending, *_), more) = asked[0]
    assert (len(pending), more["region"]) == (2, (190, 400))
    part = mm.read(target)
    assert (part.frames, part.first_frame) == (210, 291)


def test_the_dialog_proposes_it_and_can_be_told_otherwise(qtbot, window):
    pending = [Artifact("C7", "xyz", 200, 240, Kind.NOISE)]
    dialog = export_dialog.ExportDialog(window, pending, [], [], 101, False, region=(190, 400))
    qtbot.addWidget(dialog)
    dialog.show()
    box = next(b for b in dialog.findChildren(QCheckBox) if "291–500" in b.text())
    assert dialog.choice.region
    qtbot.mouseClick(box, Qt.MouseButton.LeftButton)
    assert not dialog.choice.region
    whole = export_dialog.ExportDialog(window, pending, [], [], 101, False)
    qtbot.addWidget(whole)
    whole.show()
    assert not whole.choice.region


def test_all_like_this_means_those_within_it(narrowed, qtbot):
    document = narrowed.document
    document.mark(Artifact("LELB", "x", 20, 25, Kind.NOISE, 1.0))
    document.select(next(a.id for a in document.session.listed if a.kind is Kind.NOISE))
    key(qtbot, narrowed, Qt.Key.Key_R, SHIFT)
    qtbot.waitUntil(lambda: narrowed.bulk.dialog is not None)
    scope = narrowed.bulk.dialog.scope
    scope.setCurrentIndex(scope.count() - 1)
    assert [a.marker for a in narrowed.bulk.dialog._listed] == ["C7"]
    narrowed.bulk.dialog.reject()


def test_its_edges_are_dragged_in_the_overview(narrowed, qtbot):
    overview, session = narrowed.overview, narrowed.document.session
    middle = overview.rect().center().y()
    places = overview._places

    def drag(begin, end):
        a, b = (QPoint(round(places.x(frame)), middle) for frame in (begin, end))
        qtbot.mouseMove(overview, a)
        qtbot.mousePress(overview, Qt.MouseButton.LeftButton, pos=a)
        qtbot.mouseMove(overview, b)
        qtbot.mouseRelease(overview, Qt.MouseButton.LeftButton, pos=b)
        settled(qtbot)

    drag(190, 150)
    assert session.region[0] == pytest.approx(150, abs=1)
    assert session.region[1] == 400
    drag(400, 50)
    start, stop = session.region
    assert stop == start + 1
    key(qtbot, narrowed, Qt.Key.Key_O, SHIFT)
    drag(150, 300)
    assert session.region is None
