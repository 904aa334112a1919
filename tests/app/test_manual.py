"""The manual in its window: the right page, links, words."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt, QUrl
from PySide6.QtWidgets import QWidget

from markermend_app.manual import FRONT, PAGES, Manual, page_about


@pytest.fixture
def manual(qtbot) -> Manual:
    """The manual, open at its front page."""
    manual = Manual()
    qtbot.addWidget(manual)
    manual.show()
    manual.show_page(FRONT)
    return manual


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
    assert shown == ["Smoothing"]

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
