"""A movement whose skeleton is not found: choosing it, so that whoever opens it next finds it."""

from __future__ import annotations

from pathlib import Path
from typing import IO

from PySide6.QtWidgets import QFileDialog, QWidget

from markermend.errors import ExportError, NoSkeletonError
from markermend.files.atomic import write_whole
from markermend_app.dialogs import ask as dialogs
from markermend_app.words import tr


def give_skeleton(window: QWidget, path: Path, error: NoSkeletonError) -> bool:
    """Ask for the skeleton of a movement and put a copy of it beside it; whether it has one now.

    Parameters
    ----------
    window : parent of what is asked
    path : the movement
    error : why none was found
    """
    if not dialogs.ask_skeleton(window, error):
        return False
    kinds = "ASF (*.asf *.ASF)"
    name, _ = QFileDialog.getOpenFileName(
        window, tr("Choose the skeleton of {0}").format(path.name), str(path.parent), kinds
    )
    if not name:
        return False

    def fill(file: IO[bytes]) -> None:
        file.write(Path(name).read_bytes())

    try:
        write_whole(path.with_suffix(".asf"), fill, backup=False)
    except (OSError, ExportError) as problem:
        dialogs.show_problem(window, problem)
        return False
    return True
