"""What stands in the window before there is much to see: nothing open, or work under way."""

from __future__ import annotations

import threading

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton

from markermend.take import Analog, Take
from markermend_app import settings
from markermend_app.panels.plots.nothing import why_empty


def test_work_is_said_to_be_cancelled_once_it_has_stopped(window, qtbot):
    status, begun, go = window.status, threading.Event(), threading.Event()

    def work(progress):
        begun.set()
        go.wait(10)
        progress(0.5, "on")

    window.lane.submit("Work", work, pytest.fail, pytest.fail)
    qtbot.waitUntil(lambda: begun.is_set() and status._cancel.isVisible())
    qtbot.mouseClick(status._cancel, Qt.MouseButton.LeftButton)
    assert status._doing.text() == "Stopping…"
    assert not status._cancel.isEnabled()
    assert status._said.whole == ""
    go.set()
    qtbot.waitUntil(lambda: status._said.whole == "Cancelled.")
    assert not status._doing.isVisible()
    window.lane.submit("More", lambda progress: None, lambda _: None, pytest.fail)
    qtbot.waitUntil(lambda: status._cancel.isEnabled() and not window.lane.busy)


def test_recent_takes_stand_in_one_column_and_namesakes_are_told_apart(window, qtbot, tmp_path):
    for name in ("monday/walk.c3d", "tuesday/walk.c3d", "a_long_name_of_a_take.c3d"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.touch()
        settings.add_recent(path)
    window.welcome.hide()
    window.welcome.show()
    links = [b for b in window.welcome.findChildren(QPushButton) if b.isFlat()]
    assert {"monday/walk.c3d", "tuesday/walk.c3d"} < {link.text() for link in links}
    qtbot.waitUntil(lambda: len({link.width() for link in links}) == 1)


def test_a_file_without_markers_sends_nobody_to_channels_it_lacks():
    bare = Take(np.zeros((5, 0, 3)), (), 100.0)
    assert "channels" not in why_empty(bare)[1]
    analog = Analog(np.zeros((5, 1), dtype=np.float32), ("Fz",), ("N",), 100.0)
    forces = Take(bare.positions, (), 100.0, analog=analog)
    assert "channels" in why_empty(forces)[1]
