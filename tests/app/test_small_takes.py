"""Takes with hardly anything in them: every row, mode and look takes them as they are."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QPoint, QPointF

from markermend.artifact import Artifact, Kind
from markermend.mesh import Mesh
from markermend.review.file import open_session
from markermend.take import Analog, Take
from markermend_app.document import Document
from markermend_app.panels.overview.mode import MODES
from markermend_app.panels.overview.overview import Overview
from markermend_app.panels.plots.quantity import QUANTITIES
from markermend_app.panels.plots.trajectories import TrajectoryPanel
from markermend_app.panels.quality import QualityPanel
from markermend_app.panels.scene.scene import Scene

LABELS = ("A", "B", "C")


@pytest.fixture
def document(qtbot):
    document = Document()
    yield document
    document.open(None, None)
    document.proposals.close()


@pytest.fixture
def panels(qtbot, document):
    panels = TrajectoryPanel(document), Overview(document), Scene(document), QualityPanel(document)
    for panel in panels:
        qtbot.addWidget(panel)
        panel.resize(600, 400)
        panel.show()
    panels[0].choose_rows(list(QUANTITIES))
    yield panels
    panels[0].predictions.close()
    panels[1].levels.residuals.close()


@pytest.mark.parametrize(
    ("frames", "markers", "with_mesh"),
    [(0, 2, True), (1, 0, False), (1, 1, False), (1, 3, True), (60, 1, False), (60, 2, True)],
)
def test_everything_is_drawn(qtbot, tmp_path, document, panels, frames, markers, with_mesh):
    plots, overview, scene, quality = panels
    positions = np.full((frames, markers, 3), 5.0) + np.arange(markers)[None, :, None]
    take = Take(positions, LABELS[:markers], 100.0)
    links = tuple((i, i + 1) for i in range(markers - 1))
    mesh = Mesh(take.labels, (), links) if with_mesh else None
    document.open(open_session(take, folder=tmp_path), mesh)
    document.show(take.labels)
    scene.looks.ghost = scene.looks.lengths = True
    scene.looks.colours = "damage"
    plots.set_prediction_shown(True)
    if frames and markers:
        document.decisions.add_detected([Artifact("A", "x", 0, 1, Kind.PEAK, 0.9, 4.0)], "test")
        document.step(1)
    for mode in MODES:
        overview.mode.choose(mode)
        for panel in panels:
            panel.grab()
    document.go_to(frames)
    plots.framing.fit_all()
    plots.framing.zoom(0.5)
    if markers:
        qtbot.waitUntil(lambda: set(plots.predictions.known) == set(take.labels), timeout=20_000)
        qtbot.waitUntil(lambda: overview.levels.residuals.share is None, timeout=20_000)
    plots.canvas.scene().sigMouseMoved.emit(QPointF(300, 60))
    overview.describe(QPoint(300, 30))
    QCoreApplication.processEvents()
    for panel in panels:
        assert not panel.grab().isNull()
    assert len(quality.model.rows) == markers


def test_force_is_seen_in_a_file_without_markers(qtbot, tmp_path, document, panels):
    plots, overview = panels[:2]
    force = np.linspace(0, 900, 600, dtype=np.float32)[:, None]
    analog = Analog(force, ("Fz1",), ("N",), 1000.0)
    take = Take(np.zeros((60, 0, 3)), (), 100.0, analog=analog)
    document.open(open_session(take, folder=tmp_path), None)
    assert plots.empty.isVisible()
    assert "no markers" in plots.empty.accessibleName()
    assert overview.mode.isHidden()
    document.show_beside(["analog 0"])
    (row,) = plots.canvas.frames
    assert plots.canvas.isVisible()
    assert row.view.viewRange()[1][1] > 850
    QCoreApplication.processEvents()
    plots.canvas.scene().sigMouseMoved.emit(row.view.mapViewToScene(QPointF(30, 450)))
    assert plots.header.readout.text().endswith("Fz1 450.8 N")
    document.go_to(40)
    document.show_beside(())
    assert plots.empty.isVisible()
