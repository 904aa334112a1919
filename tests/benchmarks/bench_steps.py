"""CPU time of single steps on large takes, each beside what it may take.

::

    python tests/benchmarks/bench_steps.py

Steps of the engine, and what the panels do with thousands of artifacts. The processor's
milliseconds are told, not the clock's, so that a busy machine changes little; of three the best.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QApplication

from markermend.artifact import Artifact, Kind
from markermend.mesh import Group, Mesh, infer_mesh
from markermend.repairs import propose
from markermend.review.file import open_session
from markermend.simulation import simulate_clean
from markermend.smoothers import smooth
from markermend.take import Take
from markermend_app import settings
from markermend_app.document import Document
from markermend_app.later import _queue
from markermend_app.panels.overview.overview import Overview
from markermend_app.panels.quality import QualityPanel
from markermend_app.panels.queue.review_queue import ReviewQueue
from markermend_app.rows import Rows

PUBLISHED = "ffnn_lin", "ffnn_tanh", "msvd"
OPERATORS = "rigid", "pattern", "cyclic", "kalman"


def wandering(markers: int, frames: int) -> Take:
    """Markers that have nothing to do with each other, for which a mesh has to look longest."""
    rng = np.random.default_rng(0)
    walk = np.cumsum(rng.normal(0, 5, (frames, markers, 3)), axis=0)
    labels = tuple(f"M{i}" for i in range(markers))
    return Take(walk + rng.normal(0, 400, (markers, 3)), labels, 100.0)


def engine() -> Iterator[tuple[str, Callable[[], object], int]]:
    """What is done, how, and the milliseconds that it may take."""
    for markers, frames, limit in ((60, 10_000, 1000), (200, 500, 8000)):
        take = wandering(markers, frames)
        yield f"mesh, {markers} × {frames}", lambda t=take: infer_mesh(t), limit
    take = wandering(53, 2000)
    yield "smooth, 53 × 2000", lambda: smooth(take), 1000
    body = simulate_clean(duration_s=50, rate=100, seed=1)
    body = Take(body.positions[:, :41], body.labels[:41], body.rate)
    label = body.labels[20]
    positions = body.positions.copy()
    positions[2400:2500, 20] = np.nan
    holed = Take(positions, body.labels, body.rate)
    mesh = Mesh(body.labels, (Group("Body", "", tuple(range(body.markers))),))
    gap = Artifact(label, "xyz", 2400, 2500, Kind.GAP)
    for names, limit in ((PUBLISHED, 2000), (OPERATORS, 500)):
        for name in names:
            what = f"{name}, one gap, {body.markers} × {body.frames}"
            yield what, lambda n=name: propose(holed, gap, method=n, mesh=mesh), limit


def open_in(document: Document, take: Take, folder: Path, found: list[Artifact]) -> None:
    """Review a take in which these were found."""
    document.open(open_session(take, folder=folder), None)
    document.decisions.add_detected(found, "bench")
    settle()


def settle() -> None:
    """Let everything that waits for a turn of its own have it."""
    QApplication.processEvents()
    while _queue()._waiting:
        QApplication.processEvents()


def panels(folder: Path) -> Iterator[tuple[str, Callable[[], object], int]]:
    """The same of panels."""
    rng = np.random.default_rng(0)
    labels = tuple(f"M{i}" for i in range(60))
    take = Take(rng.normal(size=(36_000, 60, 3)), labels, 240.0)
    found = [Artifact(labels[i % 60], "x", 10 * i, 10 * i + 5, Kind.PEAK, 0.9) for i in range(3000)]
    document = Document()
    quality, queue = QualityPanel(document), ReviewQueue(document)
    queue.resize(900, 300)
    quality.show()
    queue.show()
    open_in(document, take, folder, found)
    yield "quality, 60 × 36000, 3000 artifacts", quality._count, 50
    pending = iter(document.queue[1200:])

    def reject() -> None:
        left = len(queue.model.rows)
        document.decisions.reject([next(pending)])
        settle()
        assert len(queue.model.rows) == left - 1

    yield "queue, one of 3000 rejected", reject, 300

    labels = tuple(f"M{i}" for i in range(40))
    take = Take(np.zeros((144_000, 40, 3)), labels, 240.0)
    found = [
        Artifact(m, "xyz", s, s + 30, Kind.NOISE) for m in labels for s in range(0, 140_000, 5_000)
    ]
    reviewed = Document()
    overview = Overview(reviewed)
    overview.resize(692, 182)
    overview.show()
    open_in(reviewed, take, folder, found)
    overview.grab()
    rest = iter(found)

    def accept() -> None:
        reviewed.set_queue(Rows([[a.id] for a in found]))
        reviewed.decisions.accept([next(rest).id])
        settle()
        overview.grab()

    yield "overview, 40 × 144000, 1120 artifacts", accept, 500


def best_ms(work: Callable[[], object]) -> float:
    """Milliseconds of the processor for the best of three calls, after one that warms up."""
    spent = []
    for _ in range(4):
        began = time.process_time()
        work()
        spent.append(1000 * (time.process_time() - began))
    return min(spent[1:])


def main() -> None:
    """Run all steps and print a table."""
    app = QApplication([])  # noqa: F841 - it ends with what holds it
    with tempfile.TemporaryDirectory() as folder:
        ini = str(Path(folder) / "s.ini")
        settings.store = lambda: QSettings(ini, QSettings.Format.IniFormat)
        for steps in (engine(), panels(Path(folder))):
            for what, work, limit in steps:
                print(f"{what:<42}{best_ms(work):8.0f} ms of {limit}", flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
