"""The region of interest under an operator's hands."""

from __future__ import annotations

import numpy as np
import pytest
from driving import WAIT, key, settled
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QCheckBox, QFileDialog

import markermend as mm
from markermend.artifact import Artifact, Kind, Status
from markermend.patch import Patch
from markermend.repairs import Repair
from markermend_app.background.loading import glance_at
from markermend_app.dialogs import ask as dialogs
from markermend_app.dialogs import export as export_dialog
from markermend_app.looking import Selection

CONTROL = Qt.KeyboardModifier.ControlModifier
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
    assert "Frames 291–500 are reviewed" in narrowed.status._said.whole
    assert "Artifacts outside them: 2" in narrowed.status._said.whole
    document.go_to(250)
    key(qtbot, narrowed, Qt.Key.Key_O)
    settled(qtbot)
    assert document.session.region == (190, 251)
    assert listed(narrowed) == [("C7", Kind.NOISE)]
    key(qtbot, narrowed, Qt.Key.Key_O, SHIFT)
    settled(qtbot)
    assert document.session.region is None
    assert len(listed(narrowed)) == 4
    assert "whole take" in narrowed.status._said.whole


def test_the_artifact_under_review_is_left_where_it_lies_outside(reviewed, qtbot):
    document = reviewed.document
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.select(gap.id)
    document.go_to(190)
    view = reviewed.trajectories.framing.view
    key(qtbot, reviewed, Qt.Key.Key_I)
    settled(qtbot)
    assert document.current is None
    assert reviewed.trajectories.framing.view == view
    key(qtbot, reviewed, Qt.Key.Key_N)
    assert document.current in document.session.listed


def test_undo_brings_the_others_back(narrowed, qtbot):
    key(qtbot, narrowed, Qt.Key.Key_Z, CONTROL)
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
    narrowed.trajectories.framing.fit_all()
    settled(qtbot)
    for row in narrowed.trajectories.rows:
        assert row.outside.isVisible()
    row = narrowed.trajectories.rows[0]
    box = row.view.sceneBoundingRect()
    shot = narrowed.trajectories.canvas.grab().toImage()
    left, right = (
        shot.pixelColor(round(box.left() + share * box.width()), round(box.top()) + 4)
        for share in (0.31, 0.69)
    )
    assert left != right
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


@pytest.mark.parametrize("alone", [True, False])
def test_export_writes_it_alone_or_the_whole_take(narrowed, qtbot, monkeypatch, tmp_path, alone):
    document = narrowed.document
    for kind in (Kind.GAP, Kind.NOISE):
        a = next(a for a in document.session.artifacts if a.kind is kind)
        values = np.zeros((a.length, len(a.axes)))
        patch = Patch(a.marker, a.axes, a.start, a.stop, values)
        document.decisions.repair_many([(a.id, Repair("linear", (patch,)))], "Repair")
    asked = []

    def ask(*args, **more):
        asked.append(more)
        return export_dialog.ExportChoice(record=True, mark_outputs=False, region=alone)

    target = tmp_path / "part.c3d"
    monkeypatch.setattr(export_dialog, "ask_export", ask)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), "C3D (*.c3d)"))
    key(qtbot, narrowed, Qt.Key.Key_S, CONTROL)
    qtbot.waitUntil(lambda: not narrowed.lane.busy, timeout=WAIT)
    assert asked[0]["region"] == (190, 400)
    written = mm.read(target)
    size = (written.frames, written.first_frame)
    assert size == ((210, 291) if alone else (400, 101))
    record = written.source.layout.strings("MARKERMEND", "CHANGES")
    assert len(record) == (1 if alone else 2)
    # The gap before the region is repaired, and in no file yet.
    assert document.session.exported is not alone


def test_a_part_does_not_replace_the_take(narrowed, qtbot, monkeypatch, take_path):
    before, told = take_path.read_bytes(), []
    choice = export_dialog.ExportChoice(record=False, mark_outputs=False, region=True)
    monkeypatch.setattr(export_dialog, "ask_export", lambda *_, **__: choice)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(take_path), "C3D (*.c3d)"))
    monkeypatch.setattr(dialogs, "show_problem", lambda _, error: told.append(str(error)))
    key(qtbot, narrowed, Qt.Key.Key_S, CONTROL)
    qtbot.waitUntil(lambda: bool(told))
    assert "cannot replace it" in told[0]
    assert take_path.read_bytes() == before


def test_what_is_repaired_outside_it_stays_repaired(narrowed, qtbot):
    document = narrowed.document
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    patch = Patch(gap.marker, "xyz", gap.start, gap.stop, np.zeros((gap.length, 3)))
    document.decisions.repair_many([(gap.id, Repair("linear", (patch,)))], "Repair")
    document.select(gap.id)
    assert "outside the region of interest" in narrowed.inspector.artifact.status.text()
    document.decisions.accept([gap.id])
    assert document.session.artifact(gap.id).status is Status.REPAIRED
    assert document.session.take.present[gap.start, document.session.take.index(gap.marker)]


def test_a_region_chosen_before_the_search_does_not_stop_it(window, take_path, qtbot):
    window.commands.open_path(take_path)
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    window.document.go_to(190)
    window.region.region_start()
    qtbot.waitUntil(lambda: bool(window.document.session.artifacts), timeout=WAIT)
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)
    assert not glance_at(window.document.session).done


def test_redo_leaves_an_artifact_that_lies_outside(narrowed, qtbot):
    document = narrowed.document
    key(qtbot, narrowed, Qt.Key.Key_Z, CONTROL)
    document.select(next(a.id for a in document.session.artifacts if a.kind is Kind.GAP))
    key(qtbot, narrowed, Qt.Key.Key_Y, CONTROL)
    settled(qtbot)
    assert document.session.region == (190, 400)
    assert document.current is None


def test_one_that_reaches_out_is_looked_at_inside(reviewed, qtbot):
    document = reviewed.document
    step = next(a for a in document.session.artifacts if a.kind is Kind.STEP)
    document.do(lambda s: s.set_region((step.stop - 10, 400)))
    document.select(step.id)
    assert step.stop - 10 <= document.frame < step.stop


def test_quality_and_tree_count_what_it_asks_about(narrowed, qtbot):
    narrowed.docks["quality"].raise_()
    quality = narrowed.quality
    qtbot.waitUntil(lambda: quality.total.whole == "Region")
    assert sum(quality.total.rows[0].open.values()) == 2
    assert quality.total.rows[0].gap_before == 0.0
    key(qtbot, narrowed, Qt.Key.Key_O, SHIFT)
    qtbot.waitUntil(lambda: quality.total.whole == "Whole take")
    assert sum(quality.total.rows[0].open.values()) == 4
    assert quality.total.rows[0].gap_before > 0.0


def test_what_is_missing_is_counted_within_it(narrowed, qtbot):
    document, told = narrowed.document, narrowed.inspector.take._gaps
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    model = narrowed.tree._model
    node = model.node(model.index_of(gap.marker))
    qtbot.waitUntil(lambda: node.missing == 0.0)
    document.select(None)
    qtbot.waitUntil(lambda: told.text() == "0.00 % of the samples reviewed")
    document.do(lambda s: s.set_region((gap.start, gap.stop)))
    qtbot.waitUntil(lambda: node.missing == 1.0)
    share = 100 / len(document.session.original.named)
    qtbot.waitUntil(lambda: told.text() == f"{share:.2f} % of the samples reviewed")
    key(qtbot, narrowed, Qt.Key.Key_O, SHIFT)
    qtbot.waitUntil(lambda: told.text().endswith("of all samples"))
    share = gap.length / document.session.original.frames
    qtbot.waitUntil(lambda: node.missing == share)


def test_a_glance_is_of_what_it_asks_about(narrowed):
    document = narrowed.document
    document.decisions.reject([a.id for a in document.session.listed])
    seen = glance_at(document.session)
    assert seen.done
    assert seen.standing.gap_now == 0.0


def test_an_end_before_the_beginning_begins_anew(narrowed, qtbot):
    document = narrowed.document
    document.go_to(100)
    key(qtbot, narrowed, Qt.Key.Key_O)
    assert document.session.region == (0, 101)
    document.go_to(150)
    key(qtbot, narrowed, Qt.Key.Key_I)
    assert document.session.region == (150, 400)


def test_a_frame_number_that_was_typed_leaves_the_keys_to_the_review(reviewed, qtbot):
    number = reviewed.transport.number
    number.setFocus()
    number.selectAll()
    qtbot.keyClicks(number, "291")
    qtbot.keyClick(number, Qt.Key.Key_Return)
    key(qtbot, reviewed, Qt.Key.Key_I)
    assert reviewed.document.session.region == (190, 400)
    assert reviewed.focusWidget() is reviewed.trajectories.canvas


def test_doubts_are_about_what_is_asked_about(narrowed, qtbot):
    document = narrowed.document
    inside = [Artifact("STRN", "x", 200 + 5 * i, 202 + 5 * i, Kind.PEAK, 0.9) for i in range(3)]
    document.decisions.add_detected(
        [*inside, Artifact("STRN", "x", 20, 22, Kind.PEAK, 0.9)], "test"
    )
    document.decisions.reject([a.id for a in inside])
    assert not narrowed.bulk.doubts
    key(qtbot, narrowed, Qt.Key.Key_O, SHIFT)
    assert narrowed.bulk.doubts


def test_the_dialog_proposes_it_and_can_be_told_otherwise(qtbot, window):
    pending = [Artifact("C7", "xyz", 200, 240, Kind.NOISE)]
    outside = Artifact("C7", "xyz", 20, 40, Kind.NOISE)
    pending.append(outside)
    dialog = export_dialog.ExportDialog(window, pending, [], [], 101, False, region=(190, 400))
    qtbot.addWidget(dialog)
    dialog.show()
    box = next(b for b in dialog.findChildren(QCheckBox) if "291–500" in b.text())
    assert dialog.choice.region
    assert "1 not decided" in dialog._heading.text()
    qtbot.mouseClick(box, Qt.MouseButton.LeftButton)
    assert not dialog.choice.region
    assert "2 not decided" in dialog._heading.text()
    assert "Noise xyz  301–340  open" in dialog._details.toPlainText()
    box.setFocus()
    qtbot.keyClick(box, Qt.Key.Key_Return)
    assert dialog.result() == dialog.DialogCode.Accepted
    whole = export_dialog.ExportDialog(window, pending, [], [], 101, False)
    qtbot.addWidget(whole)
    whole.show()
    assert not whole.choice.region


def test_all_like_this_means_those_within_it(narrowed, qtbot):
    document = narrowed.document
    document.decisions.mark(Artifact("LELB", "x", 20, 25, Kind.NOISE, 1.0))
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

    def at(frame):
        return QPoint(round(places.x(frame)), middle)

    def drag(begin, end):
        a, b = at(begin), at(end)
        qtbot.mouseMove(overview, a)
        qtbot.mousePress(overview, Qt.MouseButton.LeftButton, pos=a)
        qtbot.mouseMove(overview, b)
        qtbot.mouseRelease(overview, Qt.MouseButton.LeftButton, pos=b)
        settled(qtbot)

    drag(190, 150)
    assert session.region[0] == pytest.approx(150, abs=1)
    assert session.region[1] == 400
    drag(390, 390)
    assert session.region[1] == 400
    drag(400, 50)
    start, stop = session.region
    assert stop == start + 1
    qtbot.mousePress(overview, Qt.MouseButton.LeftButton, pos=at(start))
    qtbot.mouseMove(overview, at(start - 20))
    key(qtbot, narrowed, Qt.Key.Key_Escape)
    qtbot.mouseRelease(overview, Qt.MouseButton.LeftButton, pos=at(start - 20))
    assert session.region == (start, stop)
    key(qtbot, narrowed, Qt.Key.Key_O, SHIFT)
    drag(150, 300)
    assert session.region is None
