"""Where panels stand, and how large: kept between starts, and put back by one action."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

BESIDE = ("markers", "history", "scene", "inspector", "queue")
H, V = Qt.Orientation.Horizontal, Qt.Orientation.Vertical


@pytest.fixture
def window(review, damaged):
    return review(*damaged)


def sizes(window):
    for _ in range(4):
        QApplication.processEvents()
    return [window.overview.size(), *(window.docks[name].size() for name in BESIDE)]


def raise_overview(window):
    middle = window.overview.parentWidget()
    middle.setSizes([middle.height() - 300, 300])


def test_the_layout_is_put_back_as_it_was_at_first(window):
    before = sizes(window)
    docks = window.docks
    window.resizeDocks([docks["markers"], docks["history"]], [300, 400], V)
    window.resizeDocks([docks["markers"], docks["scene"]], [400, 300], H)
    docks["inspector"].hide()
    raise_overview(window)
    assert sizes(window) != before
    window.actions_by_name["reset_layout"].trigger()
    assert sizes(window) == before


def test_the_overview_is_as_high_again_in_the_next_start(window, review, damaged):
    at_first = window.overview.height()
    raise_overview(window)
    sizes(window)
    before = window.overview.height()
    assert before > at_first + 100
    window.document.session.mark_exported()
    window.close()
    again = review(*damaged)
    sizes(again)
    assert again.overview.height() == pytest.approx(before, abs=10)
