"""The first picture of a take: what is loaded for it."""

from __future__ import annotations

import json
import subprocess
import sys

import markermend as mm
from markermend.simulation import simulate

FIRST_PAINT = """
import json, sys
from PySide6.QtCore import QSettings, QTimer
from markermend_app import settings

settings.store = lambda: QSettings({ini!r}, QSettings.Format.IniFormat)
from markermend_app.panels.overview.overview import Overview

paint = Overview.paintEvent


def painted(self, event):
    paint(self, event)
    if self.document.session is not None:
        heavy = sorted(m for m in ("scipy", "sklearn", "joblib", "pandas") if m in sys.modules)
        print(json.dumps(heavy), flush=True)
        Overview.paintEvent = paint
        window = self.window()
        QTimer.singleShot(0, window.close)


Overview.paintEvent = painted
from markermend_app.main import main

sys.exit(main([{take!r}]))
"""


def first_paint(take, ini):
    """What a process of its own has loaded when the take is first painted."""
    script = FIRST_PAINT.format(take=str(take), ini=str(ini))
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=120, check=False
    )
    assert done.stdout, done.stderr
    return json.loads(done.stdout.splitlines()[0])


def test_nothing_heavy_is_loaded_before_the_take_is_painted(tmp_path):
    take, _ = simulate(duration_s=3.0)
    path = tmp_path / "walk.c3d"
    mm.write(take, path)
    assert first_paint(path, tmp_path / "settings.ini") == []


LAZY = """
import markermend_app
import PySide6.QtWidgets
import pyqtgraph as pg

made = vars(pg.Qt.QtWidgets)
assert "QCalendarWidget" not in made, "all of Qt was made"
assert "QCalendarWidget" in dir(pg.Qt.QtWidgets)
assert len(dir(PySide6.QtWidgets)) > 100
assert pg.QtWidgets.QCalendarWidget is PySide6.QtWidgets.QCalendarWidget
assert "QCalendarWidget" in made
assert not hasattr(pg.QtWidgets, "QNothing")
"""


def test_pyqtgraph_finds_names_of_qt_when_it_asks_for_them():
    done = subprocess.run(
        [sys.executable, "-c", LAZY], capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr
