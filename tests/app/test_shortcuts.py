"""One table of actions: keys, presets, the sheet that changes them, and the palette."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QIcon, QKeySequence
from PySide6.QtWidgets import QMenu, QMessageBox

from markermend.artifact import Status
from markermend.review.file import open_session
from markermend_app import settings
from markermend_app.actions import palette, shortcuts
from markermend_app.actions.elsewhere import elsewhere
from markermend_app.actions.shortcut_sheet import ShortcutSheet
from markermend_app.actions.synonyms import SYNONYMS
from markermend_app.actions.table import ACTIONS


@pytest.fixture
def window(review, damaged):
    """A window with a take under review."""
    return review(*damaged)


def press(qtbot, window, key, held=Qt.KeyboardModifier.NoModifier):
    qtbot.keyClick(window, key, held)


def test_no_preset_gives_a_key_twice(qapp):
    for name in shortcuts.PRESETS:
        shortcuts.use_preset(name)
        assert shortcuts.conflicts(shortcuts.table()) == {}


def test_no_preset_takes_the_last_key_of_an_action(qapp):
    keyed = {spec.name for spec in ACTIONS if spec.keys}
    for name in shortcuts.PRESETS:
        shortcuts.use_preset(name)
        assert {action for action, keys in shortcuts.table().items() if keys} == keyed


def test_presets_name_actions_there_are_and_keys_qt_knows():
    names = {spec.name for spec in ACTIONS}
    for keys in shortcuts.PRESETS.values():
        assert set(keys) <= names
        for had in keys.values():
            assert all(QKeySequence(key).toString() for key in had)


def test_a_changed_key_works_at_once_and_the_old_one_no_longer(window, qtbot):
    document = window.document
    first = document.current.id
    shortcuts.change("accept", ("Y",))
    press(qtbot, window, Qt.Key.Key_A)
    assert document.session.artifact(first).status is Status.PENDING
    press(qtbot, window, Qt.Key.Key_Y)
    assert document.session.artifact(first).status is Status.ACCEPTED
    assert "(Y)" in window.actions_by_name["accept"].toolTip()
    assert "(Y)" in window.trajectories.buttons.accept.toolTip()


def test_who_had_a_key_loses_it_to_who_takes_it(qapp):
    shortcuts.change("accept", ("R",))
    keys = shortcuts.table()
    assert keys["accept"] == ("R",)
    assert keys["reject"] == ()
    shortcuts.restore("reject")
    assert shortcuts.table()["reject"] == ("R",)
    assert shortcuts.table()["accept"] == ()


def test_an_action_restored_hands_back_the_key_it_had_taken(qapp):
    before = shortcuts.table()
    shortcuts.change("accept", ("R",))
    shortcuts.restore("accept")
    assert shortcuts.table() == before
    assert not shortcuts.own()


def test_hints_name_the_keys_that_hold_and_the_menu_where_there_is_none(window, damaged, tmp_path):
    window.document.session.mark_exported()
    window.document.open(open_session(damaged[0], folder=tmp_path / "new"), None)
    shortcuts.change("detect", ("Ctrl+D",))
    shortcuts.change("play", ("Ctrl+L",))
    assert window.queue._hint.text().startswith("Nothing found yet. Ctrl+D looks")
    assert window.transport.play.toolTip() == "Play (Ctrl+L)"
    shortcuts.change("detect", ())
    assert "Review › Detect artifacts looks" in window.queue._hint.text()


def test_spoilt_settings_leave_the_table(qapp, monkeypatch):
    monkeypatch.setattr("markermend_app.settings.text", lambda name, default: "[not json")
    assert shortcuts.table()["accept"] == ("A",)


def test_the_motive_hand_repairs_with_i(window, qtbot):
    document = window.document
    shortcuts.use_preset("motive")
    first = document.current.id
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=20_000)
    press(qtbot, window, Qt.Key.Key_F)
    assert document.session.artifact(first).status is Status.PENDING
    press(qtbot, window, Qt.Key.Key_I)
    assert document.session.artifact(first).status is Status.REPAIRED


def test_the_queue_takes_changed_keys_for_many_rows(window, qtbot):
    shortcuts.change("reject", ("X",))
    window.queue.view.selectAll()
    window.queue.view.setFocus()
    qtbot.keyClick(window.queue.view, Qt.Key.Key_X)
    assert len(window.document.session.with_status(Status.REJECTED)) == 4


def test_the_sheet_shows_every_action_and_warns_before_it_takes_a_key(qtbot, window):
    sheet = ShortcutSheet(window)
    qtbot.addWidget(sheet)
    sheet.show()
    listed = {item.data(0, Qt.ItemDataRole.UserRole) for item in sheet._items()}
    assert {spec.name for spec in ACTIONS} <= listed
    sheet.select("accept")
    qtbot.keyClick(sheet.keys, Qt.Key.Key_R)
    assert "Reject" in sheet.warning.text()
    assert shortcuts.table()["reject"] == ("R",)
    qtbot.mouseClick(sheet.set, Qt.MouseButton.LeftButton)
    assert shortcuts.table()["accept"] == ("R",)
    assert shortcuts.table()["reject"] == ()


def test_the_sheet_finds_by_name_and_by_key(qtbot, window):
    sheet = ShortcutSheet(window)
    qtbot.addWidget(sheet)
    sheet.filter.setText("ctrl+s")
    shown = [i.data(0, Qt.ItemDataRole.UserRole) for i in sheet._items() if not i.isHidden()]
    assert "export" in shown
    assert "accept" not in shown
    # As others call it.
    sheet.filter.setText("fill")
    shown = [i.data(0, Qt.ItemDataRole.UserRole) for i in sheet._items() if not i.isHidden()]
    assert "repair" in shown
    assert sheet._nothing.label.isHidden()
    sheet.filter.setText("zzz")
    assert not sheet._nothing.label.isHidden()


def test_a_preset_chosen_in_the_sheet_stays(qtbot, window):
    sheet = ShortcutSheet(window)
    qtbot.addWidget(sheet)
    place = sheet.preset.findData("qtm")
    sheet.preset.setCurrentIndex(place)
    sheet.preset.activated.emit(place)
    assert shortcuts.preset() == "qtm"
    assert window.actions_by_name["next"].shortcut() == QKeySequence("Ctrl+Right")


@pytest.mark.parametrize("answer", [QMessageBox.StandardButton.No, QMessageBox.StandardButton.Yes])
def test_a_preset_asks_before_it_takes_away_keys_chosen_by_hand(qtbot, window, monkeypatch, answer):
    shortcuts.change("note", ("Ctrl+J",))
    monkeypatch.setattr(QMessageBox, "question", lambda *_: answer)
    sheet = ShortcutSheet(window)
    qtbot.addWidget(sheet)
    place = sheet.preset.findData("qtm")
    sheet.preset.setCurrentIndex(place)
    sheet.preset.activated.emit(place)
    taken = answer == QMessageBox.StandardButton.Yes
    assert (shortcuts.preset() == "qtm") is taken
    assert (shortcuts.table()["note"] == ("Ctrl+J",)) is not taken
    assert sheet.preset.currentData() == shortcuts.preset()


def test_every_action_stands_in_a_menu_with_its_key(window):
    def below(menu):
        for action in menu.actions():
            yield action
            if action.menu():
                yield from below(action.menu())

    shown = {a.objectName() for a in below(window.menuBar())}
    assert {spec.name for spec in ACTIONS} <= shown
    assert all(isinstance(menu, QMenu) for menu in window.menus.values())


@pytest.mark.parametrize(
    ("wanted", "text", "fits"),
    [
        ("rep all", "Review: Repair all accepted", True),
        ("all rep", "Review: Repair all accepted", True),
        ("zmin", "View: Zoom in", True),
        ("xyzzy", "View: Zoom in", False),
        ("", "View: Zoom in", True),
    ],
)
def test_what_fits_a_search(wanted, text, fits):
    assert (palette.score(wanted, text) is not None) == fits


def test_words_go_before_scattered_letters():
    assert palette.score("acc", "Review: Accept") > palette.score("acc", "A crazy chance")
    assert palette.score("in", "View: Zoom in") > palette.score("in", "Time: Rewind")


def opened_palette(window, qtbot):
    press(qtbot, window, Qt.Key.Key_K, Qt.KeyboardModifier.ControlModifier)
    (found,) = window.findChildren(palette.Palette)
    return found


def test_the_palette_finds_by_the_words_of_operators(window):
    firsts = {
        "analog": "View: Choose plots…",
        "force": "View: Choose plots…",
        "undo": "Edit: Undo",
        "fill": "Review: Repair",
        "spline": "Review: Repair method: Cubic spline",
        "butterworth": "By hand: Smooth…",
        "dark mode": "View: Dark theme",
        "threads": "Edit: Preferences…",
        "hotkeys": "Help: Keyboard and mouse…",
        "save": "File: Export repaired take…",
        "hip centre": "File: Joint centres…",
        "trails": "3D view: Trails of all markers",
        "speed": "Plots: Speed",
        "quality": "View: Panels: Quality",
    }
    found = [*palette.entries(window.actions_by_name, window.document), *elsewhere(window)]
    assert {wanted: palette.ranked(wanted, found)[0].text for wanted in firsts} == firsts


def test_the_palette_lists_artifacts_as_the_queue_does(qtbot, window):
    document = window.document
    found = palette.entries(window.actions_by_name, document)
    names = [entry.text for entry in palette.ranked("frames lelb", found)]
    assert not names
    assert palette.ranked("frame lelb", found)[0].text == "Peak on LELB, frame 251"
    # A gap is what is looked for, rather than what would make one of the artifact under review.
    assert palette.ranked("gap", found)[0].text == "Gap on CLAV, frames 161–190"
    same = [palette.Entry(f"Gap on {m}", "", QIcon(), True, bool) for m in ("LONGER", "SHORT")]
    assert palette.ranked("gap", same) == same


def test_letters_far_apart_find_nothing():
    assert palette.score("undo", "Measure the distance to: board: board:behind") is None


def test_other_words_are_of_actions_there_are():
    assert set(SYNONYMS) <= {spec.name for spec in ACTIONS}


def test_the_palette_shows_channels_panels_and_recent_takes(window, qtbot, take_path):
    settings.add_recent(take_path)
    window.docks["quality"].hide()
    found = {entry.text: entry for entry in elsewhere(window)}
    found["View: Panels: Quality"].do()
    assert window.docks["quality"].isVisible()
    assert window.docks["quality"].isAncestorOf(window.focusWidget())
    found["Plots: Speed"].do()
    assert "speed" in window.trajectories.chosen
    assert take_path.name in found
    assert "3D view: Axis that points up: Z" in found


def test_the_palette_runs_an_action(window, qtbot):
    found = opened_palette(window, qtbot)
    first = window.document.current.id
    qtbot.keyClicks(found.line, "reject")
    qtbot.keyClick(found.line, Qt.Key.Key_Return)
    assert window.document.session.artifact(first).status is Status.REJECTED


def test_the_palette_jumps_to_markers_and_artifacts(window, qtbot):
    found = opened_palette(window, qtbot)
    qtbot.keyClicks(found.line, "t10")
    qtbot.keyClick(found.line, Qt.Key.Key_Return)
    assert window.document.shown == ("T10",)
    qtbot.waitUntil(lambda: not window.findChildren(palette.Palette))
    # The platform of these tests does not give the keyboard back after a popup.
    window.actions_by_name["palette"].trigger()
    (found,) = window.findChildren(palette.Palette)
    qtbot.keyClicks(found.line, "step lwra")
    qtbot.keyClick(found.line, Qt.Key.Key_Return)
    assert window.document.current.marker == "LWRA"


def test_the_palette_offers_every_action_and_does_nothing_that_is_disabled(window, qtbot):
    entries = palette.entries(window.actions_by_name, window.document)
    texts = [e.text for e in entries]
    for spec in ACTIONS:
        if spec.name != "palette":
            assert any(window.actions_by_name[spec.name].text() in t for t in texts)
    found = opened_palette(window, qtbot)
    qtbot.keyClicks(found.line, "redo")
    qtbot.keyClick(found.line, Qt.Key.Key_Return)
    assert found.isVisible()
    qtbot.keyClick(found.line, Qt.Key.Key_Escape)


def test_the_palette_paints_texts_keys_and_what_cannot_be_done_apart(window, qtbot):
    found = opened_palette(window, qtbot)
    qtbot.keyClicks(found.line, "redo")
    view = found.list
    assert view.item(0).text() == "Edit: Redo"
    # A widget in every row would keep the window from opening the palette at once.
    assert not any(view.itemWidget(view.item(i)) for i in range(view.count()))
    row = view.visualItemRect(view.item(0))

    def painted(entry: palette.Entry):
        view.item(0).setData(Qt.ItemDataRole.UserRole, entry)
        return view.viewport().grab(row).toImage()

    entry = view.item(0).data(Qt.ItemDataRole.UserRole)
    assert not entry.usable
    assert entry.aside
    images = [painted(e) for e in (entry, replace(entry, usable=True), replace(entry, aside=""))]
    images.append(painted(replace(entry, text="Edit: Undo")))
    assert all(a != b for a, b in combinations(images, 2))


def test_an_action_is_found_and_given_a_key_by_keys_alone(qtbot, window):
    sheet = ShortcutSheet(window)
    qtbot.addWidget(sheet)
    sheet.show()
    qtbot.waitUntil(sheet.filter.hasFocus)
    qtbot.keyClicks(sheet.filter, "all accepted")
    qtbot.keyClick(sheet.filter, Qt.Key.Key_Down)
    assert sheet._name() == "repair_accepted"
    qtbot.keyClick(sheet.tree, Qt.Key.Key_Return)
    assert sheet.keys.hasFocus()
    qtbot.keyClick(sheet.keys, Qt.Key.Key_G)
    qtbot.keyClick(sheet.keys, Qt.Key.Key_Tab)
    assert sheet.set.hasFocus()
    qtbot.keyClick(sheet.set, Qt.Key.Key_Space)
    assert shortcuts.table()["repair_accepted"] == ("G",)
    assert sheet.isVisible()


def test_the_palette_says_when_nothing_fits(qtbot, window):
    qtbot.keyClick(window, Qt.Key.Key_K, Qt.KeyboardModifier.ControlModifier)
    (found,) = window.findChildren(palette.Palette)
    qtbot.keyClicks(found.line, "zqzq")
    assert [found.list.item(i).text() for i in range(found.list.count())] == [
        "Nothing fits these letters."
    ]
    assert found.list.currentRow() == -1
    qtbot.keyClick(found, Qt.Key.Key_Return)
    assert found.isVisible()
    found.line.clear()
    assert found.list.currentRow() == 0
    assert found.list.count() > 10
    found.close()
