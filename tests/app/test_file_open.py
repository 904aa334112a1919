"""A file that the system asks to be opened."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QFileOpenEvent
from PySide6.QtWidgets import QApplication

from markermend_app.file_open import FileOpener


def test_a_double_clicked_file_is_opened(qapp: QApplication, tmp_path: Path) -> None:
    opened: list[Path] = []
    opener = FileOpener(opened.append, qapp)
    take = tmp_path / "walk 1.c3d"

    qapp.sendEvent(qapp, QFileOpenEvent(QUrl.fromLocalFile(str(take))))

    qapp.removeEventFilter(opener)
    assert opened == [take]
