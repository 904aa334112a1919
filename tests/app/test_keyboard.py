"""A review without a mouse: from panel to panel, and back to the plots; what is typed is kept."""

from __future__ import annotations

import pytest
from driving import key, settled
from PySide6.QtCore import QItemSelectionModel, Qt, QTimer
from PySide6.QtWidgets import QApplication, QLabel, QLineEdit

from markermend_app.actions import shortcuts
from markermend_app.looking import Selection

SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def window(review, damaged):
    """The real window on a small damaged take."""
    return review(*damaged)


def focus():
    return QApplication.focusWidget()


def test_f6_goes_round_through_all_open_panels_and_shift_f6_back(window, qtbot):
    window.document.decisions.accept([window.document.current.id])
    settled(qtbot)
    assert focus() is window.trajectories.canvas
    way = [
        window.overview,
        window.queue.view,
        window.quality.view,
        window.scene,
        window.inspector.place,
        window.tree.view,
        window.history.view,
        window.trajectories.canvas,
    ]
    for panel in way:
        key(qtbot, focus(), Qt.Key.Key_F6)
        assert focus() is panel
        assert panel.isVisible()
    for panel in way[-2::-1]:
        key(qtbot, focus(), Qt.Key.Key_F6, SHIFT)
        assert focus() is panel


def test_f6_passes_over_closed_panels_and_those_that_have_nothing_to_say(window, qtbot):
    window.docks["quality"].hide()
    window.document.open(None, None)
    assert window.document.session is None
    for _ in range(4):
        key(qtbot, focus() or window, Qt.Key.Key_F6)
        assert focus().isVisible()


def test_esc_gives_the_keyboard_back_to_the_plots_from_every_panel(window, qtbot):
    plots = window.trajectories.canvas
    note = window.inspector.artifact.note
    views = (window.tree.view, window.queue.view, window.quality.view)
    others = (window.overview, window.scene, window.inspector.place, window.transport.number)
    for place in (window.tree.filter, window.queue.filters.marker, note, *views, *others):
        window.docks["quality" if place is window.quality.view else "queue"].raise_()
        place.setFocus()
        # Esc in a line that narrows a list goes to that list first.
        for _ in range(2):
            if focus() is not plots:
                key(qtbot, focus(), Qt.Key.Key_Escape)
        assert focus() is plots, place


def test_esc_lets_the_range_go_before_the_panel(window, qtbot):
    window.document.sweep(Selection("CLAV", 10, 20))
    window.queue.view.setFocus()
    key(qtbot, focus(), Qt.Key.Key_Escape)
    assert window.document.selection is None
    assert focus() is window.queue.view
    key(qtbot, focus(), Qt.Key.Key_Escape)
    assert focus() is window.trajectories.canvas


def test_the_overview_walks_from_marker_to_marker_and_zooms_by_key(window, qtbot):
    overview, document = window.overview, window.document
    overview.setFocus()
    seen = set()
    for _ in range(8):
        key(qtbot, overview, Qt.Key.Key_Up)
    for _ in range(8):
        seen.add(document.shown[0])
        key(qtbot, overview, Qt.Key.Key_Down)
    assert seen == set(document.session.take.labels)
    key(qtbot, overview, Qt.Key.Key_Plus)
    assert overview._span[1] - overview._span[0] == pytest.approx(200)


def test_no_preset_takes_f6_away(qapp):
    for name in shortcuts.PRESETS:
        shortcuts.use_preset(name)
        assert shortcuts.table()["next_panel"] == ("F6",)
        assert shortcuts.table()["previous_panel"] == ("Shift+F6",)


def test_a_range_is_swept_from_cursor_to_cursor_and_marked_by_keys(window, qtbot):
    document = window.document
    document.show(("STRN",))
    document.go_to(100)
    key(qtbot, window, Qt.Key.Key_V)
    assert document.selection == Selection("STRN", 100, 101)
    key(qtbot, window, Qt.Key.Key_Right, SHIFT)
    key(qtbot, window, Qt.Key.Key_Left)
    assert document.selection == Selection("STRN", 100, 110)
    key(qtbot, window, Qt.Key.Key_V)
    key(qtbot, window, Qt.Key.Key_Right, SHIFT)
    assert document.selection == Selection("STRN", 100, 110)
    key(qtbot, window, Qt.Key.Key_M)
    marked = [a for a in document.session.artifacts if a.marker == "STRN"]
    assert [(a.start, a.stop) for a in marked] == [(100, 110)]


def test_a_range_swept_by_keys_goes_backward_too_and_esc_ends_it(window, qtbot):
    document = window.document
    document.show(("STRN",))
    document.go_to(100)
    key(qtbot, window, Qt.Key.Key_V)
    key(qtbot, window, Qt.Key.Key_Left, SHIFT)
    assert document.selection == Selection("STRN", 90, 101)
    key(qtbot, window, Qt.Key.Key_Escape)
    key(qtbot, window, Qt.Key.Key_Left)
    assert document.selection is None


def test_a_range_swept_by_keys_ends_where_another_marker_comes_forward(window, qtbot):
    document = window.document
    document.show(("STRN",))
    key(qtbot, window, Qt.Key.Key_V)
    swept = document.selection
    document.show(("T10",))
    key(qtbot, window, Qt.Key.Key_Home)
    assert document.selection == swept


def test_home_and_end_are_the_ends_of_the_list_that_has_the_keyboard(window, qtbot):
    document, steps = window.document, window.history.view
    for artifact in document.session.artifacts[:3]:
        document.decisions.accept([artifact.id])
    settled(qtbot)
    frame, count = document.frame, window.history.model.rowCount()
    steps.setFocus()
    key(qtbot, steps, Qt.Key.Key_Home)
    assert steps.currentIndex().row() == 0
    key(qtbot, steps, Qt.Key.Key_End)
    assert steps.currentIndex().row() == count - 1
    tree = window.tree.view
    tree.setFocus()
    key(qtbot, tree, Qt.Key.Key_End)
    assert tree.indexBelow(tree.currentIndex()).isValid() is False
    assert document.frame == frame
    window.trajectories.canvas.setFocus()
    key(qtbot, focus(), Qt.Key.Key_End)
    assert document.frame == document.session.take.frames - 1


def in_tree(window, marker):
    """Put the tree's cursor on a marker, as the arrows do."""
    tree = window.tree
    tree.view.setFocus()
    tree.view.selectionModel().setCurrentIndex(
        tree._proxy.mapFromSource(tree._model.index_of(marker)),
        QItemSelectionModel.SelectionFlag.NoUpdate,
    )


def test_return_in_the_tree_is_a_check_mark(window, qtbot):
    document = window.document
    assert document.shown == ("CLAV",)
    in_tree(window, "T10")
    key(qtbot, window.tree.view, Qt.Key.Key_Return)
    assert document.shown == ("CLAV", "T10")
    in_tree(window, "CLAV")
    key(qtbot, window.tree.view, Qt.Key.Key_Return)
    assert document.shown == ("T10",)


def test_markers_to_follow_are_chosen_by_return(window, qtbot):
    document = window.document
    key(qtbot, window, Qt.Key.Key_K)
    for marker in ("T10", "STRN", "T10"):
        in_tree(window, marker)
        key(qtbot, window.tree.view, Qt.Key.Key_Return)
    assert document.preview.references == ("STRN",)
    assert document.shown == ("CLAV",)
    # The arrows go to others, and the plots stay with what is repaired.
    key(qtbot, window.tree.view, Qt.Key.Key_Down)
    at = window.tree.view.currentIndex().data()
    assert at not in ("STRN", "CLAV")
    assert document.shown == ("CLAV",)
    key(qtbot, window, Qt.Key.Key_K)
    assert window.tree.view.currentIndex().data() == "CLAV"
    key(qtbot, window.tree.view, Qt.Key.Key_Down)
    assert document.shown != ("CLAV",)


def test_tab_goes_from_the_methods_to_what_stands_below_them(window, qtbot):
    window.inspector.place.setFocus()
    way = []
    for _ in range(4):
        key(qtbot, focus(), Qt.Key.Key_Tab)
        way.append(focus())
    page = window.inspector.artifact
    assert way[:3] == [page.methods.buttons["auto"], page.methods.more, page.kind]


def test_tab_never_leaves_what_can_be_seen(window, qtbot):
    for _ in range(80):
        key(qtbot, focus(), Qt.Key.Key_Tab)
        corner = focus().mapTo(window, focus().rect().center())
        assert window.rect().contains(corner), focus()


def test_a_refused_name_stays_to_be_mended(window, qtbot):
    document = window.document
    told = []

    def type_a_taken_name():
        dialog = QApplication.activeModalWidget()
        line, problem = dialog.findChild(QLineEdit), dialog.findChildren(QLabel)[-1]
        qtbot.keyClicks(line, "T10")
        qtbot.keyClick(line, Qt.Key.Key_Return)
        told.extend([dialog.isVisible(), line.text(), problem.text()])
        qtbot.keyClicks(line, "a")
        qtbot.keyClick(line, Qt.Key.Key_Return)

    QTimer.singleShot(200, type_a_taken_name)
    key(qtbot, window, Qt.Key.Key_F2)
    assert told[:2] == [True, "T10"]
    assert "T10" in told[2]
    assert "T10a" in document.session.take.labels
    assert "CLAV" not in document.session.take.labels


@pytest.mark.parametrize("what", [Qt.Key.Key_Space, Qt.Key.Key_Return])
def test_the_button_that_tab_reached_is_pressed_and_nothing_plays(window, qtbot, what):
    lasso, speed = window.scene.buttons.lasso, window.transport.speed
    lasso.setFocus(Qt.FocusReason.TabFocusReason)
    qtbot.keyClick(window.windowHandle(), what)
    assert window.scene.buttons.tool == "lasso"
    assert not window.transport.playing
    speed.setFocus(Qt.FocusReason.TabFocusReason)
    qtbot.keyClick(window.windowHandle(), what)
    assert speed.view().isVisible()
    speed.hidePopup()
    assert not window.transport.playing


def test_after_a_click_on_a_button_the_space_bar_plays(window, qtbot):
    qtbot.mouseClick(window.inspector.decisions.accept, Qt.MouseButton.LeftButton)
    qtbot.keyClick(window.windowHandle(), Qt.Key.Key_Space)
    assert window.transport.playing
    qtbot.keyClick(window.windowHandle(), Qt.Key.Key_Space)


def test_lists_are_narrowed_down_from_where_the_hands_are(window, qtbot):
    qtbot.keyClick(window.windowHandle(), Qt.Key.Key_F, Qt.KeyboardModifier.ControlModifier)
    assert focus() is window.tree.filter
    window.queue.view.setFocus()
    qtbot.keyClick(window.windowHandle(), Qt.Key.Key_F, Qt.KeyboardModifier.ControlModifier)
    assert focus() is window.queue.filters.marker


def choose(view, qtbot, *entries):
    """Open a list's menu as the menu key does, and choose an entry by its words."""
    view.setFocus()
    view.customContextMenuRequested.emit(view.visualRect(view.currentIndex()).center())
    menu = QApplication.activePopupWidget()
    for text in entries:
        action = next(a for a in menu.actions() if a.text() == text)
        menu = action.menu() or menu
    action.trigger()
    QApplication.activePopupWidget().close()


def test_the_queue_is_sorted_from_its_menu_and_turned_round(window, qtbot):
    view, model = window.queue.view, window.queue.model
    frames = sorted(a.start for a in model.rows)
    assert [a.start for a in model.rows] != frames
    for expected in (frames, frames[::-1]):
        choose(view, qtbot, "Sort by", "Frames")
        assert [a.start for a in model.rows] == expected
        assert window.document.queue == tuple(a.id for a in model.rows)


def test_the_quality_of_markers_is_sorted_from_its_menu(window, qtbot):
    window.dock_layout.show("quality")
    qtbot.waitUntil(lambda: bool(window.quality.model.rows))
    choose(window.quality.view, qtbot, "Marker")
    names = [s.marker for s in window.quality.model.rows]
    assert names == sorted(names)
    choose(window.quality.view, qtbot, "Marker")
    assert [s.marker for s in window.quality.model.rows] == names[::-1]
