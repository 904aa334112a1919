"""Small takes with planted damage, documents on them, and settings that touch nobody's own."""

from __future__ import annotations

import gc
import shutil
from pathlib import Path

import numpy as np
import pytest
from driving import WAIT
from plots import Bench
from PySide6.QtCore import QCoreApplication, QEvent, QSettings

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.mesh import Group, Mesh, infer_mesh
from markermend.poses.nuitrack import JOINTS, to_nuitrack
from markermend.poses.simulated.breaking import break_pose
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app import settings
from markermend_app.background.garbage import YOUNG
from markermend_app.document import Document
from markermend_app.rows import Rows
from markermend_app.style import theme


@pytest.fixture(scope="module", autouse=True)
def quick_restoring(restored_once):
    """Windows restore the recordings of each other."""


@pytest.fixture(autouse=True)
def plots_of_the_smoothing_dialog(monkeypatch):
    """Make them when a dialog wants them; tests of that dialog let them be made ahead."""
    monkeypatch.setattr("markermend_app.verbs.smoothing.Smoothing._make_ahead", lambda self: None)


@pytest.fixture(autouse=True)
def own_settings(tmp_path, monkeypatch):
    """Keep settings of the tests in a folder of their own."""
    path = str(tmp_path / "settings.ini")
    monkeypatch.setattr(
        "markermend_app.settings.store", lambda: QSettings(path, QSettings.Format.IniFormat)
    )
    monkeypatch.setattr("markermend_app.settings._known", {})
    yield
    settings.settle()


@pytest.fixture(autouse=True)
def closed_windows_are_gone(qapp):
    """Delete what was closed: no event loop runs here that would, and the looks dress it all."""
    yield
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
    gc.collect(YOUNG)


@pytest.fixture(scope="module", autouse=True)
def garbage_is_collected_between_tests():
    """Collect as the app does, in this thread: a worker must not destroy what was a window."""
    gc.disable()
    yield
    gc.collect()
    gc.enable()


def walking_box(frames: int = 400, rate: float = 100.0) -> Take:
    """Two rigid bodies of four markers that swing against each other, with camera noise."""
    rng = np.random.default_rng(11)
    t = np.arange(frames) / rate
    corners = np.array([[0, 0, 0], [120, 0, 0], [0, 140, 0], [0, 0, 160]], dtype=float)
    turn = 0.4 * np.sin(2 * np.pi * 0.7 * t)
    cos, sin = np.cos(turn), np.sin(turn)
    spin = np.zeros((frames, 3, 3))
    spin[:, 0, 0], spin[:, 0, 1], spin[:, 1, 0], spin[:, 1, 1] = cos, -sin, sin, cos
    spin[:, 2, 2] = 1.0
    way = np.stack([300 * t, 60 * np.sin(2 * np.pi * t), 900 + 20 * np.cos(4 * np.pi * t)], axis=1)
    chest = way[:, None] + np.einsum("fij,mj->fmi", spin, corners)
    arm = way[:, None] + [0, 260, -100] + np.einsum("fji,mj->fmi", spin, corners)
    positions = np.concatenate([chest, arm], axis=1) + rng.normal(0, 0.1, (frames, 8, 3))
    labels = ("CLAV", "STRN", "C7", "T10", "LSHO", "LELB", "LWRA", "LWRB")
    return Take(positions, labels, rate, first_frame=101)


def damaged_box() -> tuple[Take, tuple[Artifact, ...]]:
    """The same with a gap, a peak, noise and a step; and where they are."""
    take = walking_box()
    positions = take.positions.copy()
    rng = np.random.default_rng(5)
    positions[60:90, 0] = np.nan
    positions[150, 5, 1] += 25.0
    positions[200:240, 2, 0] += rng.normal(0, 12, 40)
    positions[280:330, 6, 2] += 30.0
    truth = (
        Artifact("CLAV", "xyz", 60, 90, Kind.GAP, 1.0, why="not seen for 30 frames"),
        Artifact(
            "LELB", "y", 150, 151, Kind.PEAK, 0.95, 25.0, "sticks out by 25 mm for 1 frame (10 ms)"
        ),
        Artifact(
            "C7",
            "x",
            200,
            240,
            Kind.NOISE,
            0.9,
            12.0,
            "jitters by up to 12 mm for 40 frames (400 ms)",
        ),
        Artifact(
            "LWRA",
            "z",
            280,
            330,
            Kind.STEP,
            0.8,
            30.0,
            "jumps 30 mm in one frame and comes back 50 frames (500 ms) later",
        ),
    )
    return Take(positions, take.labels, take.rate, take.first_frame), truth


@pytest.fixture
def damaged():
    """A small damaged take and the artifacts in it."""
    return damaged_box()


@pytest.fixture
def mesh(damaged):
    """The body of the take in ``document``: no groups; tests of groups have their own."""
    return Mesh(damaged[0].labels, ())


@pytest.fixture
def document(tmp_path, damaged, mesh, qtbot):
    """A document with the damaged take open and its artifacts found."""
    take, found = damaged
    document = Document()
    document.open(open_session(take, folder=tmp_path), mesh)
    document.decisions.add_detected(found, "paper")
    yield document
    document.open(None, None)
    document.proposals.close()


@pytest.fixture
def scene(document, qtbot):
    """The 3D view of ``document``."""
    from markermend_app.panels.scene.scene import Scene

    scene = Scene(document)
    qtbot.addWidget(scene)
    scene.resize(500, 400)
    scene.show()
    scene.grab()
    return scene


def keep_quiet(window):
    """Let a window close without asking what becomes of unexported work."""
    if window.document.session is not None:
        window.document.session.mark_exported()


@pytest.fixture
def review(qtbot, tmp_path):
    """Open the real window on a take with these artifacts, the first one under review."""
    from markermend_app.window import MainWindow

    def start(take, artifacts):
        window = MainWindow()
        qtbot.addWidget(window, before_close_func=keep_quiet)
        window.show()
        window.activateWindow()
        qtbot.waitExposed(window)
        window.document.open(open_session(take, folder=tmp_path), infer_mesh(take))
        window.document.decisions.add_detected(artifacts, "truth")
        window.document.step(1)
        qtbot.waitUntil(lambda: not window.tree._anew.waiting)
        return window

    return start


@pytest.fixture
def at_gap(review, damaged):
    """The real window on the damaged take, its gap under review."""
    made = review(*damaged)
    gap = next(a for a in made.document.session.artifacts if a.kind is Kind.GAP)
    made.document.select(gap.id)
    return made


@pytest.fixture
def take_path(tmp_path, damaged):
    """The damaged take in a file."""
    path = tmp_path / "box.c3d"
    mm.write(damaged[0], path)
    return path


@pytest.fixture
def window(qtbot):
    """A real window; whatever is unexported at the end is kept without asking."""
    from markermend_app.window import MainWindow

    made = MainWindow()
    qtbot.addWidget(made, before_close_func=keep_quiet)
    made.show()
    made.activateWindow()
    qtbot.waitExposed(made)
    return made


@pytest.fixture
def reviewed(window, take_path, qtbot):
    """The window with the damaged take open and detected."""
    window.commands.open_path(take_path)
    qtbot.waitUntil(lambda: window.document.session is not None, timeout=WAIT)
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)
    qtbot.waitUntil(lambda: window.document.current is not None, timeout=WAIT)
    return window


@pytest.fixture
def open_plots(qtbot, tmp_path):
    """Open a take with artifacts in a panel."""
    from markermend_app.panels.plots.trajectories import TrajectoryPanel

    made = []

    def build(take: Take, artifacts=(), mesh=True) -> Bench:
        document = Document()
        document.open(open_session(take, folder=tmp_path), infer_mesh(take) if mesh else None)
        panel = TrajectoryPanel(document)
        qtbot.addWidget(panel)
        panel.resize(900, 600)
        panel.show()
        qtbot.waitExposed(panel)
        if artifacts:
            document.decisions.add_detected(artifacts, "test")
            document.set_queue(Rows([[a.id] for a in document.session.artifacts]))
        made.append((panel, document))
        return Bench(panel, document)

    yield build
    for panel, document in made:
        document.open(None, None)
        panel.predictions.close()
        document.proposals.close()


@pytest.fixture
def bench(open_plots, damaged):
    """The damaged box with its first marker shown."""
    take, artifacts = damaged
    bench = open_plots(take, artifacts)
    bench.document.show(["CLAV"])
    return bench


@pytest.fixture
def open_overview(qtbot, tmp_path):
    """Open a take in an overview."""
    from markermend_app.panels.overview.overview import Overview

    made = []

    def build(take: Take, artifacts=(), mesh=None, first=None) -> Overview:
        theme.watcher.theme = theme.LIGHT
        document = Document()
        document.open(open_session(take, folder=tmp_path), mesh)
        if artifacts:
            document.decisions.add_detected(artifacts, "test")
        panel = Overview(document, first)
        qtbot.addWidget(panel)
        panel.resize(692, 182)
        panel.show()
        qtbot.waitExposed(panel)
        made.append((document, panel))
        return panel

    yield build
    for document, panel in made:
        panel.levels.residuals.close()
        document.open(None, None)
        document.proposals.close()


@pytest.fixture
def overview(open_overview, damaged):
    """The damaged box, of two groups, in an overview."""
    take, artifacts = damaged
    labels = take.labels
    order = (4, 5, 6, 7), (0, 1, 2, 3)
    mesh = Mesh(labels, (Group("Arm", "", order[0]), Group("Trunk", "", order[1])))
    return open_overview(take, artifacts, mesh)


@pytest.fixture(scope="session")
def made_broken(shared_data, tmp_path_factory):
    """The file of ``broken``, made once."""
    walk = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))
    pose, _ = break_pose(walk, each=1, seed=4)
    confidence = np.array(pose.confidence)
    confidence[200:230, JOINTS.index("head")] = 0.0
    path = tmp_path_factory.mktemp("broken") / "sensor.csv"
    mm.write_pose(pose.with_samples(pose.positions, pose.rotations, confidence), path)
    return path


@pytest.fixture
def broken(made_broken, tmp_path):
    """A file of joints of which each fault has some, and one joint is not seen for a while."""
    return Path(shutil.copy(made_broken, tmp_path))


@pytest.fixture
def opened(window, broken, qtbot):
    """The window on the recording, searched."""
    window.commands.open_path(broken)
    qtbot.waitUntil(lambda: window.document.current is not None, timeout=3 * WAIT)
    return window
