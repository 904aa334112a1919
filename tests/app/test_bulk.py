"""Like with like in the real window: lists of what will happen, one step, one question."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from driving import WAIT, settled
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QPushButton

from markermend.artifact import Artifact, Kind, Status
from markermend.review.file import open_session
from markermend.take import Take

SHIFT, CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def peaks(review, damaged):
    """The window on a take with eight peaks on two markers of one group."""
    take = damaged[0]
    positions = take.positions.copy()
    found = []
    for i in range(8):
        marker, at = ("T10", "STRN")[i % 2], 20 + 40 * i
        positions[at, take.index(marker), 0] += 30.0
        confidence = 0.9 if i < 6 else 0.4
        found.append(Artifact(marker, "x", at, at + 1, Kind.PEAK, confidence, 30.0))
    take = Take(positions, take.labels, take.rate, take.first_frame)
    return review(take, [*found, Artifact("T10", "y", 300, 340, Kind.NOISE, 0.3, 5.0)])


def status_of(window):
    return [a.status for a in window.document.session.artifacts]


def test_repairing_all_alike_is_listed_first_and_one_step(peaks, qtbot):
    document = peaks.document
    document.select(next(a.id for a in document.session.artifacts if a.marker == "T10"))
    before, steps = document.session.positions.copy(), len(document.session.history)
    qtbot.keyClick(peaks, Qt.Key.Key_R, CTRL | SHIFT)
    dialog = peaks.bulk.dialog
    qtbot.waitUntil(lambda: dialog.go.isEnabled(), timeout=WAIT)
    # On the marker and sure enough: three of its four peaks, and not the noise.
    assert dialog.table.rowCount() == 3
    assert dialog.go.text() == "Repair 3"
    outcome = dialog.table.item(0, 3)
    assert "±" in outcome.text()
    assert outcome.toolTip() == outcome.text()
    reason = f"{outcome.text()}. Local regression would leave damage."
    room = dialog.table.columnWidth(3)
    assert dialog.table.fontMetrics().horizontalAdvance(reason) < room
    assert np.array_equal(document.session.positions, before, equal_nan=True)
    dialog.scope.setCurrentIndex(dialog.scope.count() - 1)
    qtbot.waitUntil(lambda: dialog.go.isEnabled(), timeout=WAIT)
    assert dialog.go.text() == "Repair 6"
    dialog.table.item(0, 0).setCheckState(Qt.CheckState.Unchecked)
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    assert len(document.session.history) == steps + 1
    assert len(document.session.with_status(Status.REPAIRED)) == 5
    peaks.activateWindow()
    qtbot.waitUntil(peaks.isActiveWindow)
    qtbot.keyClick(peaks, Qt.Key.Key_Z, CTRL)
    assert np.array_equal(document.session.positions, before, equal_nan=True)
    assert set(status_of(peaks)) == {Status.PENDING}


def test_one_alone_is_named_as_any_other_repair(peaks, qtbot):
    document = peaks.document
    document.select(next(a.id for a in document.session.artifacts if a.marker == "T10"))
    qtbot.keyClick(peaks, Qt.Key.Key_R, CTRL | SHIFT)
    dialog = peaks.bulk.dialog
    qtbot.waitUntil(dialog.go.isEnabled, timeout=WAIT)
    for row in range(1, dialog.table.rowCount()):
        dialog.table.item(row, 0).setCheckState(Qt.CheckState.Unchecked)
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    assert document.session.history[-1] == "Repair peak on T10"


def test_rejecting_all_alike_and_thinking_better_of_it(peaks, qtbot):
    document = peaks.document
    document.select(next(a.id for a in document.session.artifacts if a.marker == "T10"))
    qtbot.keyClick(peaks, Qt.Key.Key_R, SHIFT)
    assert peaks.bulk.dialog.go.text() == "Reject 4"
    qtbot.keyClick(peaks.bulk.dialog, Qt.Key.Key_Escape)
    assert set(status_of(peaks)) == {Status.PENDING}
    qtbot.keyClick(peaks, Qt.Key.Key_R, SHIFT)
    qtbot.keyClick(peaks.bulk.dialog, Qt.Key.Key_Return)
    assert len(document.session.with_status(Status.REJECTED)) == 4
    assert document.current.status is Status.PENDING
    document.undo()
    assert set(status_of(peaks)) == {Status.PENDING}


def test_after_several_rejections_it_asks_once_and_never_in_the_way(peaks, qtbot):
    document, bulk = peaks.document, peaks.bulk
    on_t10 = [a.id for a in document.session.artifacts if (a.marker, a.kind) == ("T10", Kind.PEAK)]
    for i in on_t10[:3]:
        document.select(i)
        assert not bulk.doubts
        qtbot.keyClick(peaks, Qt.Key.Key_R)
    texts = [label.text() for label in peaks.findChildren(QLabel) if label.isVisible()]
    assert any("rejected 3 of 3" in text for text in texts)
    assert any("the other one less sure, so that it comes last?" in text for text in texts)
    # The review goes on under the question.
    here = document.current.id
    qtbot.keyClick(peaks, Qt.Key.Key_A)
    assert document.session.artifact(here).status is Status.ACCEPTED
    sure = document.session.artifact(on_t10[3]).confidence
    qtbot.keyClick(peaks, Qt.Key.Key_Y)
    assert document.session.artifact(on_t10[3]).confidence == pytest.approx(sure / 5)
    assert peaks.status._said.whole == "1 artifact comes last now."
    assert not bulk.doubts
    # Nor is it asked when the review is opened again.
    document.opened.emit()
    document.artifacts_changed.emit()
    assert not bulk.doubts
    qtbot.keyClick(peaks, Qt.Key.Key_Z, CTRL)
    assert document.session.artifact(on_t10[3]).confidence == sure
    assert not bulk.doubts


def test_what_was_left_is_not_asked_again_when_the_review_is_opened_anew(peaks, qtbot, tmp_path):
    document, bulk = peaks.document, peaks.bulk
    on_t10 = [a.id for a in document.session.artifacts if (a.marker, a.kind) == ("T10", Kind.PEAK)]
    document.decisions.reject(on_t10[:3])
    (keep,) = [b for b in peaks.findChildren(QPushButton) if b.text() == "Leave it"]
    assert bulk.doubts
    qtbot.mouseClick(keep, Qt.MouseButton.LeftButton)
    assert not bulk.doubts
    assert document.session.history[-1] == "Leave 1 artifact (peak on T10)"
    take, mesh = document.session.original, document.mesh
    document.session.mark_exported()
    document.open(None, None)
    document.open(open_session(take, folder=tmp_path), mesh)
    document.artifacts_changed.emit()
    assert len(document.session.with_status(Status.REJECTED)) == 3
    assert not bulk.doubts
    document.undo()
    assert document.session.with_status(Status.REJECTED)


def test_a_note_is_written_with_keys_and_shown_in_the_queue(peaks, qtbot):
    document = peaks.document
    here = document.current.id
    qtbot.keyClick(peaks, Qt.Key.Key_T)
    line = peaks.inspector.artifact.note
    qtbot.waitUntil(line.hasFocus)
    qtbot.keyClicks(line, "far from it")
    qtbot.keyClick(line, Qt.Key.Key_Return)
    assert document.session.artifact(here).note == "far from it"
    settled(qtbot)
    row = peaks.queue.model.row_of(here)
    assert "far from it" in peaks.queue.model.text(peaks.queue.model.rows[row], 10)
    # The review keys work again at once.
    qtbot.keyClick(peaks, Qt.Key.Key_R)
    assert document.session.artifact(here).status is Status.REJECTED
    document.undo()
    document.undo()
    assert document.session.artifact(here).note == ""


def test_the_status_line_tells_the_operators_pace(peaks, qtbot, monkeypatch):
    now = [100.0]
    watch = peaks.document.session.stopwatch
    monkeypatch.setattr(watch, "_clock", lambda: now[0])
    monkeypatch.setattr(watch, "_touched", 100.0)
    monkeypatch.setattr(watch, "spent_s", 0.0)
    for pause in (4.0, 500.0, 2.0):
        now[0] += pause
        qtbot.keyClick(peaks, Qt.Key.Key_R)
    assert "3 of 9 decided · 2.0 s each · 6.0 s in all" in [
        label.text() for label in peaks.status.findChildren(QLabel)
    ]


def test_the_list_tells_what_would_still_be_found(peaks, qtbot):
    document = peaks.document
    peak = next(a for a in document.session.artifacts if a.marker == "T10")
    document.select(peak.id)
    qtbot.keyClick(peaks, Qt.Key.Key_R, CTRL | SHIFT)
    dialog = peaks.bulk.dialog
    qtbot.waitUntil(lambda: dialog.go.isEnabled(), timeout=WAIT)
    left = Artifact("T10", "x", peak.start, peak.stop, Kind.PEAK, 0.9, 4.0)
    dialog.tell({peak.id: replace(dialog.repairs[peak.id], leaves=(left,))})
    assert "still finds damage there: a peak of 4.0 mm" in dialog.table.item(0, 3).text()
    dialog.reject()
