"""Half a screen, 960 pixels wide: nothing needed is cut off, and what is left out comes back."""

from __future__ import annotations

import numpy as np
import pytest
from driving import settled
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QTabBar

from markermend.artifact import Artifact, Kind
from markermend.take import Take
from markermend_app.panels.markers.marker_model import MISSING
from markermend_app.panels.plots.readout import read_out
from markermend_app.panels.queue.model import FRAMES, MARKER, WHY
from markermend_app.panels.take_list import TakeList

HALF = 960
WORDS = Qt.ToolButtonStyle.ToolButtonTextBesideIcon


@pytest.fixture
def window(review, damaged):
    return review(*damaged)


def widen(window, width, height=700):
    window.resize(width, height)
    for _ in range(4):
        QApplication.processEvents()


def test_the_window_fits_half_a_screen(window):
    widen(window, 400)
    assert window.width() <= HALF
    widen(window, HALF)
    assert window.width() == HALF
    assert window.toolbar.sizeHint().width() <= window.toolbar.width()
    assert window.queue.filters._row.minimumSize().width() <= window.queue.width()
    row = window.transport._row
    assert row.minimumSize().width() <= window.transport.width()
    assert window.inspector.decisions.minimumSizeHint().width() <= window.inspector.width()


def test_names_of_methods_are_read_whole(window):
    buttons = list(window.inspector.artifact.methods.buttons.values())
    for width, columns in ((1500, 2), (HALF, 1), (1500, 2)):
        widen(window, width, 900)
        window.resizeDocks(
            [window.docks["scene"]], [400 * width // 1500], Qt.Orientation.Horizontal
        )
        widen(window, width, 900)
        assert len({button.x() for button in buttons[1:]}) == columns
        assert all(button.width() >= button.sizeHint().width() for button in buttons[1:])


def test_words_and_counts_are_left_out_where_they_have_no_room(window):
    queue, button = window.queue, next(iter(window.queue.filters.kinds.values()))
    open_button = window.toolbar._buttons[0]
    widen(window, 1500, 900)
    assert button.toolButtonStyle() == open_button.toolButtonStyle() == WORDS
    assert queue.filters.progress.isVisible()
    widen(window, 400)
    assert open_button.toolButtonStyle() != WORDS
    assert button.toolButtonStyle() != WORDS
    assert "1 open" in button.toolTip()
    assert queue.filters.progress.isHidden()
    widen(window, 1500, 900)
    assert button.toolButtonStyle() == open_button.toolButtonStyle() == WORDS


def test_names_of_markers_go_before_the_share_missing(window):
    header = window.tree.view.header()
    for wide, hidden in ((310, False), (230, True), (310, False)):
        window.resize(1500, 900)
        window.resizeDocks([window.docks["markers"]], [wide], Qt.Orientation.Horizontal)
        widen(window, 1500, 900)
        assert header.isSectionHidden(2) == hidden
        assert header.sectionSize(0) >= 140


def test_the_readout_says_what_has_room(window):
    header = window.trajectories.header
    widen(window, 1500, 900)
    header.read_out("Frame 12345 · 123.456 s · CLAV -1234.5, 1234.5, 1234.5 mm (edited)")
    assert header.readout.text().startswith("Frame 12345 · 123.456 s · CLAV")
    widen(window, HALF)
    assert header.readout.text().endswith("1234.5 mm (edited)")
    assert header.readout.sizeHint().width() <= header.readout.width()
    assert "123.456 s" in header.readout.toolTip()
    header.setFixedWidth(280)
    widen(window, HALF)
    assert header.readout.text().endswith("…")
    assert header.readout.sizeHint().width() <= header.readout.width()


def test_blanks_and_length_of_a_name_leave_the_values_their_room(window, damaged):
    take = damaged[0]
    long, first = "a marker " * 9, take.labels[0]
    take = take.renamed({first: long})
    text = read_out(take, [long], 5, None)
    frame, _, rest = text.split(" · ")
    assert frame.startswith("Frame ")
    assert len(rest) < 60
    header = window.trajectories.header
    header.read_out(text)
    header.setFixedWidth(420)
    widen(window, HALF)
    assert header.readout.text() == rest.partition(" ")[2], "the name goes whole, the values stay"


def test_the_name_of_a_row_that_was_low_stands_in_its_middle(window):
    axis = window.trajectories.rows[0].values
    widen(window, HALF, 560)
    assert not axis.label.isVisible()
    widen(window, 1500, 900)
    assert axis.label.isVisible()
    middle = axis.label.pos().y() - axis.label.boundingRect().width() / 2
    assert middle == pytest.approx(axis.size().height() / 2, abs=2)


def test_no_tabs_of_before_lie_about_in_a_layout_that_was_kept(window, qtbot):
    def tabs():
        """Rows of tabs within the window, by their names; those of one dock alone lie outside."""
        bars = window.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly)
        seen = [bar for bar in bars if bar.isVisible() and bar.geometry().x() >= 0]
        return sorted(tuple(bar.tabText(i) for i in range(bar.count())) for bar in seen)

    widen(window, 1500, 900)
    window.dock_layout.reset()
    widen(window, 1500, 900)
    assert tabs() == [("Review queue", "Quality")]
    window.dock_layout.show("takes")
    widen(window, 1500, 900)
    window.dock_layout.reset()
    widen(window, 1500, 900)
    assert tabs() == [("Review queue", "Quality")]
    window.dock_layout.show("takes")
    widen(window, 1500, 900)
    assert tabs() == [("History", "Takes"), ("Review queue", "Quality")]


def test_the_list_of_takes_does_not_keep_the_window_wide(qtbot, window):
    takes = TakeList(window.batch)
    qtbot.addWidget(takes)
    takes.resize(700, 300)
    takes.show()
    qtbot.waitUntil(lambda: "(" in takes.next.text())
    takes.resize(takes.minimumSizeHint().width(), 300)
    qtbot.waitUntil(lambda: takes.next.text() == "Next take")
    assert takes.width() < 160
    assert "(" in takes.next.toolTip()


def test_sides_are_as_wide_again_once_the_window_is(window, qtbot):
    widen(window, 1500, 900)
    sides = [window.docks["markers"], window.docks["scene"]]
    window.resizeDocks(sides, [320, 400], Qt.Orientation.Horizontal)
    widen(window, 1500, 900)
    before = [side.width() for side in sides]
    for width in (1300, 1000, HALF):
        widen(window, width)
    assert sum(side.width() for side in sides) < sum(before) - 20
    widen(window, 1200)
    widen(window, 1500, 900)
    qtbot.waitUntil(lambda: [side.width() for side in sides] == before)


def test_a_sentence_without_room_ends_in_dots(window):
    widen(window, HALF)
    window.status.say("One & <b>two</b>. " * 30)
    shown = window.status._said
    assert shown.text().endswith("…")
    assert shown.text().startswith("One & <b>two</b>.")
    assert shown.sizeHint().width() <= shown.width()
    assert shown.toolTip() == shown.whole


def test_sides_get_their_widths_back_after_a_narrow_window(window):
    widen(window, 1500, 900)
    sides = [window.docks["markers"], window.docks["scene"]]
    window.resizeDocks(sides, [320, 420], Qt.Orientation.Horizontal)
    widen(window, 1500, 900)
    before = [side.width() for side in sides]
    widen(window, HALF)
    assert [side.width() for side in sides] != before
    widen(window, 1500, 900)
    assert [side.width() for side in sides] == before


def test_sides_grow_with_a_window_that_has_never_been_wide(window):
    sides = [window.docks["markers"], window.docks["scene"]]
    wide = 1400
    window.resize(wide, 900)
    window.actions_by_name["reset_layout"].trigger()
    widen(window, wide, 900)
    before = [side.width() for side in sides]
    widen(window, HALF)
    assert all(now.width() < then for now, then in zip(sides, before, strict=True))
    widen(window, wide, 900)
    assert [side.width() for side in sides] == pytest.approx(before, abs=2)
    # What a hand has drawn narrower stays so.
    window.resizeDocks(sides[:1], [255], Qt.Orientation.Horizontal)
    widen(window, wide + 60, 900)
    assert sides[0].width() == pytest.approx(255, abs=2)
    assert sides[1].width() > before[1]


def test_sides_get_their_widths_back_in_the_next_start_too(window, qtbot, review, damaged):
    widen(window, 1500, 900)
    sides = [window.docks["markers"], window.docks["scene"]]
    window.resizeDocks(sides, [320, 420], Qt.Orientation.Horizontal)
    widen(window, 1500, 900)
    before = [side.width() for side in sides]
    widen(window, HALF)
    window.document.session.mark_exported()
    window.close()
    again = review(*damaged)
    assert again.width() <= HALF
    sides = [again.docks["markers"], again.docks["scene"]]
    assert [side.width() for side in sides] != before
    widen(again, 1500, 900)
    qtbot.waitUntil(lambda: [side.width() for side in sides] == before)


def test_a_share_missing_of_nothing_takes_no_room(review, damaged, qtbot):
    whole = Take(np.nan_to_num(damaged[0].positions), damaged[0].labels, damaged[0].rate)
    window = review(whole, [Artifact("C7", "x", 200, 240, Kind.NOISE)])
    widen(window, 1500, 900)
    window.resizeDocks([window.docks["markers"]], [310], Qt.Orientation.Horizontal)
    widen(window, 1500, 900)
    assert window.tree.view.isColumnHidden(MISSING)


def test_names_deep_in_a_tree_go_before_the_share_missing(review, qtbot):
    labels = tuple("the_marker_with_a_long_name_" + c for c in "abcd")
    positions = np.random.default_rng(0).normal(0, 100, (100, 4, 3))
    positions[10:20, 0] = np.nan
    window = review(Take(positions, labels, 100.0), [Artifact(labels[0], "xyz", 10, 20, Kind.GAP)])
    for wide, hidden in ((310, True), (420, False)):
        widen(window, 1500, 900)
        window.resizeDocks([window.docks["markers"]], [wide], Qt.Orientation.Horizontal)
        widen(window, 1500, 900)
        assert window.tree.view.isColumnHidden(MISSING) is hidden


def test_the_row_under_review_stays_in_sight_when_the_queue_gets_lower(review, damaged, qtbot):
    take = damaged[0]
    found = [Artifact("C7", "x", 10 * i, 10 * i + 3, Kind.NOISE, 0.9) for i in range(30)]
    window = review(take, found)
    queue = window.queue
    widen(window, 1500, 900)
    window.resizeDocks([window.docks["queue"]], [420], Qt.Orientation.Vertical)
    widen(window, 1500, 900)
    window.document.select(queue.model.rows[9].id)
    settled(qtbot)

    def seen():
        box = queue.view.visualRect(queue.view.currentIndex().siblingAtColumn(MARKER))
        return queue.view.viewport().rect().contains(box.center())

    assert seen()
    widen(window, HALF, 560)
    assert seen()
    # Who has scrolled elsewhere stays there.
    queue.view.scrollToBottom()
    assert not seen()
    widen(window, HALF, 540)
    assert not seen()


def test_the_foremost_name_is_read_whole_in_a_narrow_window(review, qtbot):
    labels = ("right_ankle", "left_ankle")
    positions = np.random.default_rng(0).normal(0, 100, (100, 2, 3))
    window = review(Take(positions, labels, 100.0), [Artifact(labels[0], "x", 5, 9, Kind.NOISE)])
    window.document.show(labels)
    for width, words in ((1500, True), (HALF, False)):
        widen(window, width, 700)
        header = window.trajectories.header
        assert header.legend.chips[0].text() == labels[0]
        assert (header.plots.toolButtonStyle() == WORDS) is words
        assert header.readout.text()


def test_reasons_are_cut_before_names_unless_a_hand_made_these_narrow(review, qtbot):
    labels = ("left_shoulder_blade", "B")
    take = Take(np.random.default_rng(0).normal(0, 100, (100, 2, 3)), labels, 100.0)
    found = [Artifact(labels[0], "xyz", 10, 11, Kind.PEAK, 0.9, 5.0, "jumps " * 30)]
    window = review(take, found)
    widen(window, 1500, 900)
    view = window.queue.view
    assert window.queue.model.index(0, FRAMES).data() == "11"
    assert view.columnWidth(MARKER) >= view.fontMetrics().horizontalAdvance(labels[0]) + 8
    assert view.columnWidth(WHY) >= 100
    view.setColumnWidth(MARKER, 60)
    widen(window, 1400, 900)
    assert view.columnWidth(MARKER) == 60
