"""The manual in its window: the right page, links, words."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QScrollArea, QWidget

import markermend_app
from markermend_app.actions.shortcut_sheet import ShortcutSheet
from markermend_app.dialogs.manual import FRONT, PAGES, Manual, page_about
from markermend_app.dialogs.preferences import Preferences
from markermend_app.style import theme
from markermend_resources import manual_folder


@pytest.fixture
def manual(qtbot) -> Manual:
    """The manual, open at its front page."""
    manual = Manual()
    qtbot.addWidget(manual)
    manual.show()
    manual.show_page(FRONT)
    return manual


def test_keys_turn_the_text_at_once(manual: Manual) -> None:
    assert manual.focusWidget() is manual.text


def test_links_and_back(manual: Manual) -> None:
    manual.text.anchorClicked.emit(QUrl("repairs.md"))
    assert manual.page == "repairs.md"
    assert "Local regression" in manual.text.toPlainText()
    assert manual.contents.currentItem().text(0).startswith("What puts it right")

    manual.back()
    assert manual.page == FRONT


def test_a_link_goes_to_the_heading(manual: Manual) -> None:
    manual.show_page("files.md#the-review")
    assert manual.text.textCursor().block().text() == "The review"


def test_a_link_to_nowhere_changes_nothing(manual: Manual) -> None:
    manual.show_page("nowhere.md")
    assert manual.page == FRONT


def test_finding_words_narrows_the_contents_and_goes_there(manual: Manual, qtbot) -> None:
    qtbot.keyClicks(manual.finder, "woltring")
    shown = [
        item.text(0)
        for i in range(manual.contents.topLevelItemCount())
        if not (item := manual.contents.topLevelItem(i)).isHidden()
    ]
    assert shown == ["Smoothing", "Methods"]

    qtbot.keyClick(manual.finder, Qt.Key.Key_Return)
    assert manual.page == "smoothing.md"
    assert manual.text.textCursor().selectedText() == "Woltring"


def test_help_is_about_the_panel_one_is_in(qtbot) -> None:
    panel = QWidget()
    qtbot.addWidget(panel)
    panel.setObjectName("inspector")
    inner = QWidget(panel)

    assert page_about(inner) == PAGES["inspector"]
    assert page_about(None) == FRONT


def test_the_manuals_key_works_in_dialogs(qtbot) -> None:
    for dialog, page in (
        (Preferences(), "window.md#preferences"),
        (ShortcutSheet(), "window.md#keys"),
    ):
        qtbot.addWidget(dialog)
        with qtbot.waitActive(dialog):
            dialog.show()
            dialog.activateWindow()
        qtbot.keyClick(dialog, Qt.Key.Key_F1)
        manual = dialog.findChild(Manual)
        assert manual.isVisible()
        assert manual.page == page
        # The heading stands at the top, or the page ends below it.
        scroll = manual.text.verticalScrollBar()
        assert manual.text.cursorRect().top() < 40 or scroll.value() == scroll.maximum()


def test_every_dialog_of_the_window_has_a_page() -> None:
    folder = Path(markermend_app.__file__).parent
    found = {
        name
        for path in folder.rglob("*.py")
        for name in re.findall(r"^class (\w+)\(QDialog\)", path.read_text("utf-8"), re.MULTILINE)
    }
    assert found - set(PAGES) == {"Palette"}, "the palette closes as soon as another window is used"


def test_preferences_need_no_scrolling_to_the_side(qapp, qtbot) -> None:
    theme.apply(qapp, "light")
    page = Preferences()
    qtbot.addWidget(page)
    page.show()
    qtbot.waitExposed(page)
    scroll = page.findChild(QScrollArea)
    assert scroll.widget().width() <= scroll.viewport().width()
    assert scroll.widget().minimumSizeHint().width() <= scroll.viewport().width()


def test_pictures_are_no_wider_than_the_page(manual: Manual, qtbot) -> None:
    manual.show_page("artifacts.md")
    side = manual.text.horizontalScrollBar()
    for width in (980, 700, 980, 1600):
        manual.resize(width, 760)
        qtbot.waitUntil(lambda wide=width: manual.width() == wide)
        assert side.maximum() == 0
    widths = {piece.charFormat().toImageFormat().width() for piece in manual.text._pictures()}
    natural = QImage(str(manual_folder() / "pictures" / "gap.png")).width()
    assert natural in widths
