"""The review queue under real clicks and keys: order, filters, and verbs on many rows."""

from __future__ import annotations

import numpy as np
import pytest
from driving import settled
from PySide6.QtCore import QRect, Qt
from PySide6.QtWidgets import QStyleOptionViewItem

from markermend.artifact import Artifact, Kind, Status
from markermend.mesh import Mesh
from markermend.repairs.proposing import propose
from markermend.review.file import open_session
from markermend.review.priority import badness
from markermend.take import Take
from markermend_app.document import Document
from markermend_app.panels.inspector.inspector import Inspector
from markermend_app.panels.queue.model import (
    CONFIDENCE,
    FRAMES,
    KIND,
    MARKER,
    REPAIR,
    STATUS,
    WHY,
    Wanted,
)
from markermend_app.panels.queue.review_queue import ReviewQueue


@pytest.fixture
def queue(document, qtbot):
    queue = ReviewQueue(document)
    qtbot.addWidget(queue)
    queue.resize(1100, 300)
    queue.show()
    return queue


def listed(qtbot, folder, take, found):
    """A document of one's own with many artifacts, and its queue."""
    document = Document()
    queue = ReviewQueue(document)
    qtbot.addWidget(queue)
    queue.resize(900, 300)
    queue.show()
    document.open(open_session(take, folder=folder), None)
    document.decisions.add_detected(found, "paper")
    return document, queue


def click(qtbot, queue, row, held=Qt.KeyboardModifier.NoModifier):
    at = queue.view.visualRect(queue.model.index(row, MARKER)).center()
    qtbot.mouseClick(queue.view.viewport(), Qt.MouseButton.LeftButton, held, at)


def click_header(qtbot, queue, column):
    header = queue.view.horizontalHeader()
    at = header.rect().center()
    at.setX(header.sectionViewportPosition(column) + header.sectionSize(column) // 2)
    qtbot.mouseClick(header.viewport(), Qt.MouseButton.LeftButton, pos=at)


def markers(queue):
    return [a.marker for a in queue.model.rows]


def test_worst_come_first_and_the_document_walks_in_that_order(queue, document):
    assert markers(queue) == ["CLAV", "LWRA", "LELB", "C7"]
    assert document.queue == tuple(a.id for a in queue.model.rows)
    assert queue.filters.progress.text() == "0 of 4 decided"


def test_header_click_sorts_and_the_walk_follows(qtbot, queue, document):
    click_header(qtbot, queue, FRAMES)
    assert markers(queue) == ["CLAV", "LELB", "C7", "LWRA"]
    click_header(qtbot, queue, FRAMES)
    assert markers(queue) == ["LWRA", "C7", "LELB", "CLAV"]
    assert document.queue == tuple(a.id for a in queue.model.rows)
    assert queue.model.index(3, FRAMES).data() == "161–190"


def test_columns_fit_at_every_width_and_what_has_no_room_is_in_the_tooltip(queue, qtbot):
    bar = queue.view.horizontalScrollBar()
    for width in (1500, 780, 500):
        queue.resize(width, 300)
        qtbot.waitUntil(lambda: queue.view.width() > queue.width() - 20 and not bar.maximum())
        assert queue.view.columnWidth(WHY) >= 200
    assert queue.view.isColumnHidden(FRAMES)
    tip = queue.model.index(0, WHY).data(Qt.ItemDataRole.ToolTipRole)
    assert "frames 161–190" in tip
    assert "30 f, 300 ms" in tip
    queue.resize(1500, 300)
    qtbot.waitUntil(lambda: not queue.view.isColumnHidden(FRAMES))


def test_frames_stay_beside_repairs_where_how_sure_a_flag_was_goes(qtbot, queue):
    queue.resize(765, 300)
    for status in range(queue.filters.status.count()):
        queue.filters.status.setCurrentIndex(status)
        qtbot.waitUntil(lambda: queue.view.width() > queue.width() - 20)
        repairs = not queue.view.isColumnHidden(REPAIR)
        assert not queue.view.isColumnHidden(FRAMES)
        assert queue.view.isColumnHidden(CONFIDENCE) is repairs
        qtbot.waitUntil(lambda: not queue.view.horizontalScrollBar().maximum())


def test_how_many_rows_the_next_key_is_about_is_said(qtbot, queue):
    queue.view.selectAll()
    assert queue.filters.progress.text() == "4 rows chosen · 0 of 4 decided"
    click(qtbot, queue, 1)
    assert queue.filters.progress.text() == "0 of 4 decided"
    queue.view.selectAll()
    queue.filters.marker.setText("nobody")
    assert queue.filters.progress.text() == "0 of 4 decided", "nothing is listed, and none chosen"


def test_frames_of_a_long_take_are_whole(qtbot, tmp_path):
    take = Take(np.zeros((30_000, 1, 3)), ("A",), 100.0)
    found = [Artifact("A", "xyz", 28_000, 29_999, Kind.NOISE, 0.9)]
    document, queue = listed(qtbot, tmp_path, take, found)
    queue.resize(1200, 300)
    text = queue.model.index(0, FRAMES).data()
    wide = queue.view.fontMetrics().horizontalAdvance(text)
    assert queue.view.columnWidth(FRAMES) > wide + 8
    document.open(None, None)
    document.proposals.close()


def test_a_second_click_on_the_row_brings_its_marker_back(qtbot, queue, document):
    click(qtbot, queue, 0)
    document.show(["T10"])
    click(qtbot, queue, 0)
    assert document.shown == (document.current.marker,)


def test_click_puts_an_artifact_under_review(qtbot, queue, document):
    click(qtbot, queue, 2)
    assert document.current is not None
    assert document.current.marker == "LELB"
    assert document.shown == ("LELB",)


def test_cursor_follows_the_current_artifact(queue, document, qtbot):
    document.select(document.queue[1])
    settled(qtbot)
    assert queue.view.currentIndex().row() == 1
    assert [i.row() for i in queue.view.selectionModel().selectedRows()] == [1]


def test_double_click_repairs(qtbot, queue, document):
    click(qtbot, queue, 2)
    i = document.current.id
    at = queue.view.visualRect(queue.model.index(2, MARKER)).center()
    qtbot.mouseDClick(queue.view.viewport(), Qt.MouseButton.LeftButton, pos=at)
    qtbot.waitUntil(lambda: document.session.artifact(i).status is Status.REPAIRED, timeout=10_000)
    queue.filters.status.setCurrentIndex(2)
    assert not queue.view.isColumnHidden(REPAIR)
    assert queue.model.index(0, REPAIR).data()


def test_decided_rows_leave_the_open_list_and_the_next_one_is_current(queue, document, qtbot):
    document.select(document.queue[0])
    document.decisions.accept_current()
    settled(qtbot)
    assert markers(queue) == ["LWRA", "LELB", "C7"]
    assert document.current.marker == "LWRA"
    assert queue.filters.progress.text() == "1 of 4 decided"
    queue.filters.status.setCurrentIndex(3)
    assert queue.model.rows[-1].marker == "CLAV"


def test_keys_that_come_at_once_mean_the_rows_as_they_are_by_then(qtbot, queue, document):
    click(qtbot, queue, 0)
    for marker in ("CLAV", "LWRA"):
        document.decisions.accept_current()
        assert markers(queue)[0] == marker, "the rows follow in a turn of their own"
        qtbot.keyClick(queue.view, Qt.Key.Key_Shift)
        assert markers(queue)[0] != marker
        assert queue.selected() == [document.current.id]


def test_the_walk_knows_at_once_what_became_of_the_order(queue, document, qtbot):
    first, second, third, fourth = document.queue
    document.select(second)
    document.decisions.reject_current()
    assert document.queue == (first, third, fourth)
    settled(qtbot)
    document.undo()
    assert document.current.id == second
    document.step(1)
    assert document.current.id == third
    document.decisions.reject([first, second])
    settled(qtbot)
    document.undo()
    assert document.current.id == first


def test_keys_mean_all_rows_when_several_are_selected(qtbot, queue, document):
    click(qtbot, queue, 1)
    click(qtbot, queue, 3, Qt.KeyboardModifier.ShiftModifier)
    assert len(queue.selected()) == 3
    qtbot.keyClick(queue.view, Qt.Key.Key_R)
    assert len(document.session.with_status(Status.REJECTED)) == 3
    assert document.session.history[-1] == "Reject 3 artifacts"


def test_delete_removes_the_selected_rows_and_undo_brings_them_back(qtbot, queue, document):
    click(qtbot, queue, 0)
    click(qtbot, queue, 2, Qt.KeyboardModifier.ControlModifier)
    qtbot.keyClick(queue.view, Qt.Key.Key_Delete)
    assert markers(queue) == ["LWRA", "C7"]
    document.undo()
    assert len(queue.model.rows) == 4


def test_menu_asks_for_the_repair_of_many(qtbot, queue, document):
    click(qtbot, queue, 0)
    click(qtbot, queue, 1, Qt.KeyboardModifier.ControlModifier)
    ids = queue.selected()
    menu = queue.menu()
    repair = next(a for a in menu.actions() if a.objectName() == "repair")
    with qtbot.waitSignal(queue.repair_requested) as asked:
        repair.trigger()
    assert asked.args == [ids]
    reopen = next(a for a in menu.actions() if a.objectName() == "reopen")
    assert not reopen.isEnabled()


def test_filters_by_class_and_marker(qtbot, queue, document):
    qtbot.mouseClick(queue.filters.kinds[Kind.STEP], Qt.MouseButton.LeftButton)
    assert markers(queue) == ["LWRA"]
    qtbot.mouseClick(queue.filters.kinds[Kind.PEAK], Qt.MouseButton.LeftButton)
    assert markers(queue) == ["LWRA", "LELB"]
    qtbot.keyClicks(queue.filters.marker, "elb")
    assert markers(queue) == ["LELB"]
    assert document.queue == (queue.model.rows[0].id,)
    queue.filters.marker.setText("nobody")
    assert "No artifact matches" in queue._hint.text()
    assert queue._hint.isVisible()


def test_keyboard_leaves_the_filter_line(qtbot, queue, document):
    queue.activateWindow()
    queue.filters.marker.setFocus()
    qtbot.keyClicks(queue.filters.marker, "LW")
    qtbot.keyClick(queue.filters.marker, Qt.Key.Key_Return)
    assert markers(queue) == ["LWRA"]
    qtbot.waitUntil(queue.view.hasFocus)
    queue.filters.marker.setFocus()
    qtbot.keyClick(queue.filters.marker, Qt.Key.Key_Escape)
    assert len(markers(queue)) == 4
    assert queue.filters.marker.hasFocus()
    qtbot.keyClick(queue.filters.marker, Qt.Key.Key_Escape)
    qtbot.waitUntil(queue.view.hasFocus)


def test_says_why_nothing_is_listed(queue, document, qtbot):
    document.decisions.reject([a.id for a in document.session.artifacts])
    settled(qtbot)
    assert queue._hint.isVisible()
    assert "All 4 artifacts are decided" in queue._hint.text()
    document.open(None, None)
    assert "Open a take" in queue._hint.text()


def test_says_so_when_detection_found_nothing(tmp_path, damaged, qtbot):
    document = Document()
    queue = ReviewQueue(document)
    qtbot.addWidget(queue)
    document.open(open_session(damaged[0], folder=tmp_path), None)
    assert "D looks for artifacts" in queue._hint.text()
    document.decisions.add_detected([], "paper")
    settled(qtbot)
    assert "Nothing was found" in queue._hint.text()
    document.open(None, None)
    document.proposals.close()


def test_class_change_updates_the_row_in_place(queue, document, qtbot):
    peak = next(a for a in document.session.artifacts if a.kind is Kind.PEAK)
    row = queue.model.row_of(peak.id)
    document.decisions.change(peak.id, kind=Kind.NOISE)
    settled(qtbot)
    assert queue.model.index(row, KIND).data() == "Noise"


def test_two_thousand_artifacts_keep_their_place(tmp_path, qtbot):
    rng = np.random.default_rng(3)
    labels = tuple(f"M{i}" for i in range(40))
    take = Take(np.zeros((60_000, 40, 3)), labels, 100.0)
    kinds = list(Kind)
    found = [
        Artifact(labels[i % 40], "xyz", 29 * i, 29 * i + 9, kinds[i % 5], float(rng.random()), 5.0)
        for i in range(2000)
    ]
    document, queue = listed(qtbot, tmp_path, take, found)
    queue.view.sortByColumn(FRAMES, Qt.SortOrder.AscendingOrder)
    document.select(document.queue[1200])
    settled(qtbot)
    bar = queue.view.verticalScrollBar()
    before = bar.value()
    assert before > 500
    document.decisions.reject([document.queue[1205]])
    settled(qtbot)
    assert abs(bar.value() - before) <= 1
    assert len(queue.model.rows) == 1999
    assert queue.view.currentIndex().row() == 1200
    queue.view.sortByColumn(STATUS, Qt.SortOrder.AscendingOrder)
    assert len(document.queue) == 1999
    document.open(None, None)
    document.proposals.close()


def test_where_hands_scrolled_to_stays_when_only_decisions_change(tmp_path, qtbot):
    labels = tuple(f"M{i}" for i in range(40))
    take = Take(np.zeros((6000, 40, 3)), labels, 100.0)
    found = [
        Artifact(labels[i % 40], "xyz", 29 * i, 29 * i + 9, Kind.PEAK, 0.9, 5.0) for i in range(200)
    ]
    document, queue = listed(qtbot, tmp_path, take, found)
    queue.filters.status.setCurrentIndex(3)
    document.select(document.queue[0])
    settled(qtbot)
    bar = queue.view.verticalScrollBar()
    bar.setValue(bar.maximum())
    document.do(lambda s: s.annotate(document.queue[0], "look at it again"))
    settled(qtbot)
    assert bar.value() == bar.maximum()
    for choose in (
        lambda i: document.select(document.queue[i]),
        lambda i: queue.view.setCurrentIndex(queue.model.index(i, MARKER)),
    ):
        choose(1)
        settled(qtbot)
        assert bar.value() < bar.maximum()
        bar.setValue(bar.maximum())
        document.do(lambda s: s.annotate(document.current.id, f"look {document.current.note}"))
        settled(qtbot)
        assert bar.value() == bar.maximum()
        document.select(document.queue[0])
        settled(qtbot)
    document.open(None, None)
    document.proposals.close()


def test_gaps_at_the_ends_of_a_take_come_last():
    inside = Artifact("A", "xyz", 50, 60, Kind.GAP)
    leading, trailing = (
        Artifact("A", "xyz", 0, 50, Kind.GAP),
        Artifact("A", "xyz", 60, 400, Kind.GAP),
    )
    peak = Artifact("A", "x", 70, 71, Kind.PEAK, 0.9, 2.0)
    order = sorted([leading, inside, trailing, peak], key=lambda a: -badness(a, 100.0, 400))
    assert order[:2] == [inside, peak]


def test_says_what_is_worked_on_before_anything_is_listed(tmp_path, damaged, qtbot):
    document = Document()
    queue = ReviewQueue(document)
    qtbot.addWidget(queue)
    document.open(open_session(damaged[0], folder=tmp_path), None)
    queue.set_doing("Looking for artifacts")
    assert queue._hint.text() == "Looking for artifacts…"
    queue.set_doing("")
    assert "D looks for artifacts" in queue._hint.text()


def test_a_copy_of_a_review_is_walked_like_its_original(queue, document, damaged, tmp_path):
    take, _ = damaged
    (tmp_path / "copy").mkdir()
    copy = open_session(take, folder=tmp_path / "copy")
    copy.session.add_detected(document.session.artifacts, "paper")
    document.open(copy, Mesh(take.labels, ()))
    document.step(1)
    assert document.current is not None


def test_names_of_a_mix_up_are_cut_each_by_itself_and_whole_where_there_is_room(qtbot, tmp_path):
    labels = ("Subject:LASIS_left", "Subject:RASIS_right")
    take = Take(np.random.default_rng(0).normal(0, 100, (100, 2, 3)), labels, 100.0)
    swap = Artifact(labels[0], "xyz", 10, 20, Kind.STEP, counterpart=labels[1])
    document, queue = listed(qtbot, tmp_path, take, [swap])
    view = queue.view
    view.resizeColumnToContents(MARKER)
    name, metrics = queue.model.index(0, MARKER).data(), view.fontMetrics()
    assert view.columnWidth(MARKER) >= metrics.horizontalAdvance(name)
    delegate, option = view.itemDelegateForColumn(MARKER), QStyleOptionViewItem()
    option.initFrom(view)
    for width in (1000, 130):
        option.rect = QRect(0, 0, width, 26)
        delegate.initStyleOption(option, queue.model.index(0, MARKER))
        assert "↔" in option.text
        assert ("…" in option.text) is (width == 130)
    document.proposals.close()


def test_a_mix_up_is_named_by_the_markers_that_its_repair_changed(qtbot, tmp_path):
    take = Take(np.random.default_rng(0).normal(0, 100, (100, 2, 3)), ("A", "B"), 100.0)
    swap = Artifact("A", "xyz", 10, 20, Kind.STEP, counterpart="B")
    for method, names in (("swap", "A ↔ B"), ("spline", "A")):
        folder = tmp_path / method
        folder.mkdir()
        document, queue = listed(qtbot, folder, take, [swap])
        inspector = Inspector(document)
        qtbot.addWidget(inspector)
        assert queue.model.index(0, MARKER).data() == "A ↔ B"
        proposal = propose(take, swap, method=method)
        document.do(lambda s, p=proposal: s.repair([(swap.id, p)]))
        document.select(swap.id)
        queue.model.set_wanted(Wanted())
        row = [a.id for a in queue.model.rows].index(swap.id)
        assert queue.model.index(row, MARKER).data() == names
        assert inspector.artifact.title.text() == names
        document.proposals.close()
