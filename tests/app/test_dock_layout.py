"""Where panels stand, and how large: put back by one action, whatever hands did to them."""

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
    return [window.docks[name].size() for name in BESIDE]


def test_the_layout_is_put_back_as_it_was_at_first(window):
    before = sizes(window)
    docks = window.docks
    window.resizeDocks([docks["markers"], docks["history"]], [300, 400], V)
    window.resizeDocks([docks["markers"], docks["scene"]], [400, 300], H)
    docks["inspector"].hide()
    assert sizes(window) != before
    window.actions_by_name["reset_layout"].trigger()
    assert sizes(window) == before
