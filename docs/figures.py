"""Take the manual's pictures in the real window: ``.venv/bin/python docs/figures.py``.

Opens the demo take off screen, goes to one artifact of each class, and saves what the plots show.
"""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
PICTURES = (
    Path(__file__).resolve().parent.parent
    / "resources"
    / "markermend_resources"
    / "manual/pictures"
)
WIDTH, HEIGHT = 1500, 940


def main() -> int:
    """Save one picture a class; returns an exit code."""
    with tempfile.TemporaryDirectory() as folder:
        # Neither the layout of whoever runs this nor their reviews.
        os.environ["XDG_CONFIG_HOME"] = os.environ["XDG_DATA_HOME"] = folder
        return take_pictures(Path(folder))


def take_pictures(folder: Path) -> int:
    """Open the demo take in a folder and go through the classes."""
    from PySide6.QtCore import QSize
    from PySide6.QtWidgets import QApplication

    from markermend.artifact import Kind
    from markermend_app.style import theme
    from markermend_app.window import MainWindow
    from markermend_resources import demo_take

    app = QApplication(sys.argv[:1])
    theme.apply(app, "light")
    window = MainWindow()
    window.show()
    window.dock_layout.take_size(QSize(WIDTH, HEIGHT))
    document = window.document
    window.commands.open_path(Path(shutil.copy(demo_take(), folder)))
    settle(window)
    window.detecting.detect_slow()
    settle(window)
    session = document.session
    assert session is not None
    PICTURES.mkdir(exist_ok=True)
    missing = 0
    for kind in Kind:
        # The clearest one that is not tiny.
        found = [a for a in session.artifacts if a.kind is kind]
        if not found:
            print(f"The demo take shows no {kind}.", file=sys.stderr)
            missing += 1
            continue
        best = max(
            found, key=lambda a: (a.confidence, a.amplitude_mm if kind != "gap" else a.length)
        )
        document.select(best.id)
        settle(window)
        window.trajectories.grab().save(str(PICTURES / f"{kind}.png"))
    assert document.file is not None
    document.file.discard()
    document.open(None, None)
    window.close()
    return 1 if missing else 0


def settle(window: object) -> None:
    """Let the window finish what it does."""
    from PySide6.QtWidgets import QApplication

    calm, until = 0, time.monotonic() + 120
    while calm < 40 and time.monotonic() < until:
        QApplication.processEvents()
        time.sleep(0.01)
        document = window.document
        waiting = document.current is not None and document.proposal is None
        calm = 0 if window.lane.busy or waiting else calm + 1


if __name__ == "__main__":
    sys.exit(main())
