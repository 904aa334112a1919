"""A file that the system asks to be opened."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QFileOpenEvent
from PySide6.QtWidgets import QApplication

from markermend_app.background.loading import proposed_place
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
