"""Processor time a painted frame takes: plots of a long take, and the view in space.

::

    python tests/benchmarks/bench_view.py plots [--minutes 10] [--rate 240] [--markers 60]
                                                [--rows x y z speed]
    python tests/benchmarks/bench_view.py scene [--markers 200]

The processor's milliseconds are told, not the clock's, so that a busy machine changes little. A
frame of the plots is a change of the range and everything painted; it has to take less than 16.7 ms
with one marker and less than 40 ms with five markers and 300 artifacts. A frame in space has to
take less than 33 ms with 200 markers, their segments and trails.
"""

from __future__ import annotations

import argparse
import os
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from PySide6.QtCore import QEvent, QEventLoop, QObject, QSettings
from PySide6.QtWidgets import QApplication, QWidget

from markermend.artifact import Artifact, Kind
from markermend.mesh import Mesh
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app import settings
from markermend_app.document import Document

FRAMES = 15


def make_take(frames: int, rate: float, markers: int) -> Take:
    """Markers that swing and tremble, with gaps."""
    rng = np.random.default_rng(0)
    time_s = np.arange(frames)[:, None] / rate
    positions = np.empty((frames, markers, 3))
    for axis in range(3):
        phase, pace = rng.uniform(0, 2 * np.pi, markers), rng.uniform(0.5, 5.0, markers)
        place = rng.uniform(-600, 600, markers)
        positions[:, :, axis] = place + 300 * np.sin(time_s * pace + phase)
    positions += rng.normal(0, 0.3, positions.shape)
    for marker in range(markers):
        for start in rng.integers(0, frames - 100, 60):
            positions[start : start + 80, marker] = np.nan
    residuals = np.where(np.isnan(positions[..., 0]), np.nan, 0.5).astype(np.float32)
    return Take(positions, tuple(f"M{i:03d}" for i in range(markers)), rate, residuals=residuals)


def make_artifacts(take: Take, number: int) -> tuple[Artifact, ...]:
    """Artifacts of every class on the first five markers."""
    rng = np.random.default_rng(1)
    made = {}
    for i in range(number):
        start, kind = int(rng.integers(0, take.frames - 300)), list(Kind)[i % len(Kind)]
        length = 1 if kind is Kind.PEAK else int(rng.integers(10, 200))
        a = Artifact(take.labels[i % 5], "xyz", start, start + length, kind, 0.9)
        made[a.id] = a
    return tuple(made.values())


def open_document(take: Take, folder: Path, mesh: Mesh | None = None) -> Document:
    """A review that touches nobody's settings."""
    settings.store = lambda: QSettings(str(folder / "s.ini"), QSettings.Format.IniFormat)
    document = Document()
    document.open(open_session(take, folder=folder), mesh)
    return document


class Paints(QObject):
    """Counts how often a widget is painted."""

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        self.count = 0
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Count, and let everything through."""
        self.count += event.type() == QEvent.Type.Paint
        return False


def per_frame(widget: QWidget, move: Callable[[int], None]) -> float:
    """Median processor milliseconds of a move and the painting that follows it."""
    paints, found = Paints(widget), []
    for i in range(FRAMES):
        before, painted = time.process_time(), paints.count
        move(i)
        # What stands beside the plots is painted in a turn of its own.
        while paints.count == painted:
            QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
        found.append(1000 * (time.process_time() - before))
    return statistics.median(found)


def bench_plots(options: argparse.Namespace, folder: Path) -> None:
    """Pan, zoom and move the cursor, with the overview following."""
    from markermend_app.panels.overview.overview import Overview
    from markermend_app.panels.plots.trajectories import TrajectoryPanel

    take = make_take(round(options.minutes * 60 * options.rate), options.rate, options.markers)
    document = open_document(take, folder)
    panel = TrajectoryPanel(document)
    panel.choose_rows(options.rows)
    panel.resize(1400, 900)
    panel.show()
    overview = Overview(document)
    overview.resize(1400, 130)
    overview.show()
    panel.view_changed.connect(overview.set_view)
    print(f"{take.frames} frames x {take.markers} markers at {take.rate:g} Hz, 1400 x 900")  # noqa: T201
    print(f"{'':22}{'pan 300 s':>11}{'pan 60 s':>11}{'pan 5 s':>11}{'zoom':>11}{'cursor':>11}")  # noqa: T201
    for markers, artifacts in ((1, 0), (1, 300), (5, 0), (5, 300)):
        document.decisions.remove([a.id for a in document.session.artifacts])
        if artifacts:
            document.decisions.add_detected(make_artifacts(take, artifacts), "bench")
        document.show(take.labels[:markers])
        QApplication.processEvents()
        cells = []
        for seconds in (300, 60, 5):
            span = seconds * take.rate
            step = span / 40

            def pan(i: int, span: float = span, step: float = step) -> None:
                panel.framing.set_view(1000 + i * step, 1000 + i * step + span)

            cells.append(per_frame(panel.canvas.viewport(), pan))

        def zoom(i: int) -> None:
            span = take.frames * 0.8**i
            panel.framing.set_view(take.frames / 3 - span / 3, take.frames / 3 + span / 2)

        cells.append(per_frame(panel.canvas.viewport(), zoom))
        panel.framing.set_view(1000, 1000 + 60 * take.rate)
        QApplication.processEvents()
        cells.append(per_frame(panel.canvas.viewport(), lambda i: document.go_to(2000 + 50 * i)))
        name = f"{markers} marker{'s' * (markers > 1)}, {artifacts} artifacts"
        print(f"{name:22}" + "".join(f"{c:8.1f} ms" for c in cells))  # noqa: T201
    document.open(None, None)
    panel.predictions.close()
    document.proposals.close()


def bench_scene(options: argparse.Namespace, folder: Path) -> None:
    """Play through a take in space."""
    from markermend_app.panels.scene.scene import Scene

    take = make_take(4800, options.rate, options.markers)
    pairs = tuple((i, i + 1) for i in range(options.markers - 1))
    document = open_document(take, folder, Mesh(take.labels, (), pairs))
    scene = Scene(document)
    scene.resize(900, 700)
    scene.show()
    document.decisions.add_detected(make_artifacts(take, 300), "bench")
    print(f"{take.markers} markers at {take.rate:g} Hz, 900 x 700")  # noqa: T201

    def play(i: int) -> None:
        document.go_to(1000 + 8 * i)

    for name, on in (("markers, segments", False), ("with trails", True)):
        scene.trails.setChecked(on)
        print(f"{name:22}{per_frame(scene, play):8.1f} ms")  # noqa: T201
    scene.labels.setChecked(True)
    print(f"{'with names too':22}{per_frame(scene, play):8.1f} ms")  # noqa: T201
    document.open(None, None)
    document.proposals.close()


def main() -> None:
    """Read the options and run."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("plots", "scene"))
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--rate", type=float, default=240)
    parser.add_argument("--markers", type=int)
    parser.add_argument("--rows", nargs="+", default=["x", "y", "z"], help="what the plots show")
    options = parser.parse_args()
    options.markers = options.markers or (60 if options.what == "plots" else 200)
    app = QApplication([])
    with tempfile.TemporaryDirectory() as folder:
        (bench_plots if options.what == "plots" else bench_scene)(options, Path(folder))
    app.quit()


if __name__ == "__main__":
    main()
