"""Start the app: ``python -m markermend_app [TAKE...] [--screenshot PNG]``."""

from __future__ import annotations

import argparse
import logging
import os
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from markermend_app.window import MainWindow

# Two BLAS threads on few cores are many times slower than one, and NumPy reads this on import.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

SCREENSHOT_LIMIT_S, SETTLED_ROUNDS = 120.0, 30
SWITCH_S = 0.0005

log = logging.getLogger("markermend")


def main(arguments: Sequence[str] | None = None) -> int:
    """Open the window, with a take when one is named; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m markermend_app",
        description="Open the window, with the takes to review when some are named.",
    )
    parser.add_argument(
        "takes",
        metavar="TAKE",
        nargs="*",
        type=Path,
        help="a take (C3D, TRC, CSV) or skeleton recording (CSV, AMC, BVH) to open; several, "
        "a folder or a batch's review.json to review",
    )
    parser.add_argument(
        "--screenshot", type=Path, metavar="PNG", help="open, detect, save a picture and leave"
    )
    parser.add_argument(
        "--theme", choices=("light", "dark", "contrast", "system"), help="look of this start"
    )
    chosen = parser.parse_args(arguments)
    missing = next((take for take in chosen.takes if not take.exists()), None)
    if missing is not None:
        print(f"markermend: there is no file {missing}", file=sys.stderr)  # noqa: T201
        return 1
    problem = no_display()
    if problem:
        print(f"markermend: {problem}", file=sys.stderr)  # noqa: T201
        return 1

    from PySide6.QtWidgets import QApplication

    from markermend.memory import keep_memory
    from markermend_app import languages, settings
    from markermend_app.background.garbage import Collector
    from markermend_app.file_open import FileOpener
    from markermend_app.style import theme
    from markermend_app.window import MainWindow

    keep_memory()
    app = QApplication.instance() or QApplication(sys.argv[:1])
    assert isinstance(app, QApplication)
    app.setApplicationName("Markermend")
    # Beside a worker the window waits this long, each time, before it may go on.
    sys.setswitchinterval(SWITCH_S)
    Collector(app)
    app.setDesktopFileName("markermend")
    languages.install(app)
    theme.apply(app, chosen.theme or settings.text("theme", "system"))
    window = MainWindow()
    if sys.platform == "darwin":
        # Nobody else is told in this way, and the filter costs every event of the app.
        FileOpener(window.commands.open_path, app)
    _report_crashes(window)
    window.show()
    if chosen.screenshot is not None:
        return take_screenshot(window, next(iter(chosen.takes), None), chosen.screenshot)
    if chosen.takes:
        window.open_paths([take.absolute() for take in chosen.takes])
    elif not settings.flag("tour_seen", False):
        window.actions_by_name["tour"].trigger()
    code = app.exec()
    settings.settle()
    return code


def no_display() -> str:
    """Why no window can be shown here, or empty; Qt itself would abort the process."""
    if not sys.platform.startswith("linux"):
        return ""
    if os.environ.get("QT_QPA_PLATFORM", "") not in ("", "xcb", "wayland"):
        return ""
    if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
        return ""
    return "there is no display here; use “markermend clean TAKE -o OUT” to work without a window"


def take_screenshot(window: MainWindow, take: Path | None, target: Path) -> int:
    """Open a take, detect unless it is under review already, save a picture and leave.

    Waits for the first repair to be proposed.
    """
    from PySide6.QtWidgets import QApplication

    from markermend.errors import MarkermendError
    from markermend.mesh import infer_mesh
    from markermend.progress import quiet
    from markermend_app.background.loading import load
    from markermend_app.dock_layout import ROOMY

    window.dock_layout.take_size(ROOMY)
    document = window.document
    fresh = False
    try:
        if take is not None:
            file = load(take.absolute(), quiet)
            document.open(file, infer_mesh(file.session.original))
            fresh = document.session is not None and not document.session.begun
        if fresh:
            window.detecting.detect()
        else:
            document.step(1)
    except MarkermendError as error:
        print(f"markermend: {error}", file=sys.stderr)  # noqa: T201
        window.close()
        return 1
    until = time.monotonic() + SCREENSHOT_LIMIT_S
    settled = 0
    # Some rounds more after the work is done, so that everything is laid out and painted.
    while settled < SETTLED_ROUNDS and time.monotonic() < until:
        QApplication.processEvents()
        time.sleep(0.01)
        waiting = document.current is not None and document.proposal is None
        settled = 0 if window.lane.busy or waiting else settled + 1
    saved = window.grab().save(str(target))
    # A review that was there before stays as it was.
    if document.file is not None and fresh:
        document.file.discard()
    document.open(None, None)
    window.close()
    if not saved:
        print(f"markermend: the picture could not be saved to {target}", file=sys.stderr)  # noqa: T201
    return 0 if saved else 1


def _report_crashes(window: MainWindow) -> None:
    """Show what nobody caught as one sentence with details, and keep running."""
    from markermend_app.dialogs.ask import show_problem

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        log.error("unexpected", exc_info=(kind, error, trace))
        if isinstance(error, Exception) and threading.current_thread() is threading.main_thread():
            show_problem(window, error)

    sys.excepthook = hook
