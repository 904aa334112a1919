"""A file that the system asks to be opened."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QFileOpenEvent
from PySide6.QtWidgets import QApplication

from markermend_app import settings
from markermend_app.background.loading import proposed_place, takes_folder
from markermend_app.file_open import FileOpener
from markermend_resources import demo_take


def test_a_double_clicked_file_is_opened(qapp: QApplication, tmp_path: Path) -> None:
    opened: list[Path] = []
    opener = FileOpener(opened.append, qapp)
    take = tmp_path / "walk 1.c3d"

    qapp.sendEvent(qapp, QFileOpenEvent(QUrl.fromLocalFile(str(take))))

    qapp.removeEventFilter(opener)
    assert opened == [take]


def test_what_is_made_from_the_demo_goes_to_the_users_home_not_to_the_program(tmp_path):
    assert proposed_place(demo_take(), "_clean.c3d") == Path.home() / "demo_clean.c3d"
    assert proposed_place(tmp_path / "walk.c3d", "_report.html") == tmp_path / "walk_report.html"


def test_takes_are_looked_for_beside_the_last_one_opened_and_not_in_the_program(tmp_path):
    day = tmp_path / "day 1"
    day.mkdir()
    (day / "walk.c3d").touch()
    assert takes_folder(None) == Path()
    settings.add_recent(day / "walk.c3d")
    settings.add_recent(demo_take())
    assert takes_folder(None) == day
    assert takes_folder(demo_take()) == day
    assert takes_folder(tmp_path / "other.c3d") == tmp_path
