"""Keys and right clicks sent to the window as the desktop sends them, wherever the focus is."""

from __future__ import annotations

import pytest
from driving import answer_with
from plots import SHIFT, Bench
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from markermend_app.panels.markers.marker_model import NAME


@pytest.fixture
def window(at_gap):
    return at_gap


def press(window, key):
    QTest.keyClick(window.windowHandle(), key)


def sweep(window):
    window.trajectories.framing.set_view(0, 150)
    Bench(window.trajectories, window.document).drag(20, 40, keys=SHIFT)
    assert window.document.selection is not None


def test_esc_ends_choosing_then_the_tool_then_the_selection(window, qtbot):
    sweep(window)
    window.scene.buttons.lasso.click()
    press(window, Qt.Key.Key_K)
    assert window.references.choosing
    press(window, Qt.Key.Key_Escape)
    assert not window.references.choosing
    assert not window.actions_by_name["choose_references"].isChecked()
    assert "Click" not in window.status._said.whole
    assert window.scene.buttons.tool == "lasso"
    press(window, Qt.Key.Key_Escape)
    assert window.scene.buttons.tool == ""
    assert window.document.selection is not None
    press(window, Qt.Key.Key_Escape)
    assert window.document.selection is None


def test_esc_in_a_line_of_text_is_the_lines_own(window, qtbot):
    sweep(window)
    window.tree.filter.setFocus()
    qtbot.keyClicks(window.tree.filter, "LW")
    press(window, Qt.Key.Key_Escape)
    assert window.tree.filter.text() == ""
    press(window, Qt.Key.Key_Escape)
    assert window.tree.view.hasFocus()
    press(window, Qt.Key.Key_T)
    note = window.inspector.artifact.note
    qtbot.waitUntil(note.hasFocus)
    qtbot.keyClicks(note, "never mind")
    press(window, Qt.Key.Key_Escape)
    assert note.text() == ""
    assert window.document.current.note == ""
    assert window.document.selection is not None


def test_a_note_is_written_in_sight_however_small_the_panel_and_what_is_seen(window, qtbot):
    window.resize(1100, 620)
    sweep(window)
    assert window.inspector.page is window.inspector.selection
    press(window, Qt.Key.Key_T)
    note = window.inspector.artifact.note
    qtbot.waitUntil(note.hasFocus)
    assert not note.visibleRegion().isEmpty()
    qtbot.keyClicks(note, "wand in the way")
    press(window, Qt.Key.Key_Return)
    assert window.document.current.note == "wand in the way"
    press(window, Qt.Key.Key_N)
    # The next artifact is read from its top again.
    assert not window.inspector.artifact.title.visibleRegion().isEmpty()


def the_menu():
    """The context menu that is open, and what it offers to do."""
    menu = QApplication.activePopupWidget()
    assert isinstance(menu, QMenu)
    return menu, [a.objectName() for a in menu.actions() if a.objectName()]


def test_the_right_button_on_a_marker_in_the_tree_is_about_that_marker(window, qtbot):
    tree = window.tree
    index = tree._proxy.mapFromSource(tree._model.index_of("LSHO")).siblingAtColumn(NAME)
    at = tree.view.visualRect(index).center()
    tree.view.customContextMenuRequested.emit(at)
    menu, offered = the_menu()
    assert window.document.shown[0] == "LSHO"
    assert menu.actions()[0].text() == "LSHO"
    assert offered == ["rename_marker", "merge_marker", "smooth"]
    answer_with(qtbot, "HEAD")
    # The dialog that opens closes the menu.
    menu.actions()[2].trigger()
    assert "HEAD" in window.document.session.original.labels
    tree.view.customContextMenuRequested.emit(QPoint(20, tree.view.viewport().height() - 2))
    assert QApplication.activePopupWidget() is None


def test_the_right_button_on_a_marker_in_space_is_about_that_marker(window, qtbot):
    scene, document = window.scene, window.document
    scene.grab()
    x, y = scene._at[document.session.original.index("LWRB")]
    at = QPointF(x, y).toPoint()
    qtbot.mouseClick(scene, Qt.MouseButton.RightButton, pos=at)
    menu, offered = the_menu()
    menu.close()
    assert document.shown[0] == menu.actions()[0].text() == "LWRB"
    assert "rename_marker" in offered
