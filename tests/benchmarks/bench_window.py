"""The window under an operator's hands: what it makes wait, and whether it grows.

::

    python tests/benchmarks/bench_window.py [--rounds 6] [--artifacts 40] [--long]

Each round opens a take, lets it be searched, and then does what half an hour of review does: steps
to artifacts and repairs, accepts, rejects and undoes them with the keys, zooms and pans with the
wheel, plays, turns the 3D view, and opens the next take. With ``--long`` one more take, 10 minutes
of 60 markers at 240 Hz with 300 intervals, is opened and reviewed in every round.

How long the event loop is held up is told by a timer of 10 ms. The clock's time holds what other
threads and processes took; the processor's time of the window's own thread does not. On a busy
machine only the latter means anything.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import (
    QEventLoop,
    QPoint,
    QPointF,
    QSettings,
    Qt,
    QTimer,
)
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.simulation import simulate
from markermend_app import settings

TARGET_STALL, TARGET_NEXT, TARGET_START, TARGET_GROWTH = 0.100, 0.050, 1.0, 0.10
PATIENCE_S, BEAT_S = 300.0, 0.010
LONG_FRAMES, LONG_MARKERS, LONG_RATE = 144_000, 60, 240.0


class Turns:
    """A heart that beats every 10 ms and notes when it was kept from it, and by what."""

    def __init__(self) -> None:
        self.doing = "start"
        self.clock: dict[str, list[float]] = defaultdict(list)
        self.processor: dict[str, list[float]] = defaultdict(list)
        self._last = time.perf_counter(), time.thread_time()
        self._timer = QTimer()
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._beat)
        self._timer.start(round(BEAT_S * 1000))

    def _beat(self) -> None:
        now = time.perf_counter(), time.thread_time()
        self.clock[self.doing].append(max(0.0, now[0] - self._last[0] - BEAT_S))
        self.processor[self.doing].append(now[1] - self._last[1])
        self._last = now


def private_bytes() -> int:
    """Memory of this process that is its own."""
    lines = Path("/proc/self/smaps_rollup").read_text().splitlines()
    return sum(1024 * int(line.split()[1]) for line in lines if line.startswith("Private_"))


def long_take() -> tuple[mm.Take, list[Artifact]]:
    """Ten minutes of 60 markers that wander smoothly, with 300 gaps; and these."""
    rng = np.random.default_rng(0)
    seconds = np.arange(LONG_FRAMES)[:, None] / LONG_RATE
    positions = np.empty((LONG_FRAMES, LONG_MARKERS, 3))
    for axis in range(3):
        phases, speeds = rng.uniform(0, 6, LONG_MARKERS), rng.uniform(0.1, 1.0, LONG_MARKERS)
        positions[:, :, axis] = 1000 + 500 * np.sin(seconds * speeds + phases)
    labels = tuple(f"M{i:02d}" for i in range(LONG_MARKERS))
    found = []
    for i, start in enumerate(np.linspace(500, LONG_FRAMES - 500, 300).astype(int).tolist()):
        positions[start : start + 60, i % LONG_MARKERS] = np.nan
        found.append(Artifact(labels[i % LONG_MARKERS], "xyz", start, start + 60, Kind.GAP, 0.9))
    return mm.Take(positions, labels, LONG_RATE), found


def wait(milliseconds: int) -> None:
    """Let the window work, waiting as it does for the operator."""
    loop = QEventLoop()
    QTimer.singleShot(milliseconds, loop.quit)
    loop.exec()


def spin(until: Callable[[], bool], least_s: float = 0.0) -> None:
    """Let the window work until something has come about."""
    begun = time.monotonic()
    while not until() or time.monotonic() - begun < least_s:
        if time.monotonic() - begun > PATIENCE_S:
            raise SystemExit("the window did not get there")
        wait(5)


class Operator:
    """Drives a window by keys, wheel and mouse."""

    def __init__(self, window, turns: Turns) -> None:
        self.window, self.document, self.turns = window, window.document, turns
        self.next_clock: list[float] = []
        self.next_processor: list[float] = []
        self.waited: list[bool] = []

    def key(self, key: Qt.Key, held: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier) -> None:
        """Press a key."""
        QTest.keyClick(self.window, key, held)

    def open(self, path: Path, found: list[Artifact] | None = None) -> None:
        """Open a take and wait until its first artifact is shown with its repair."""
        self.turns.doing = "open"
        settings.remember("detect_on_open", found is None)
        if self.document.file is not None:
            # The next take is the same to the last byte, and a review follows its take.
            self.document.file.discard()
        self.document.open(None, None)
        self.window.commands.open_path(path)
        spin(lambda: self.document.session is not None and self.document.mesh is not None)
        if found is not None:
            self.document.add_detected(found, "planted")
            self.document.step(1)
        spin(lambda: not self.window.lane.busy and self.document.current is not None)
        spin(self.proposed)

    def proposed(self) -> bool:
        """Whether the repair of the current artifact is there."""
        return self.document.current is None or self.document.proposal is not None

    def decide(self, count: int) -> None:
        """Repair, accept and reject one artifact after the other, looking at each for a moment."""
        keys = (Qt.Key.Key_F, Qt.Key.Key_F, Qt.Key.Key_A, Qt.Key.Key_F, Qt.Key.Key_R)
        for i in range(min(count, len(self.document.queue) - 1)):
            self.turns.doing = "decide"
            clock, processor = time.perf_counter(), time.thread_time()
            self.key(keys[i % len(keys)])
            self.waited.append(not self.proposed())
            QApplication.processEvents()
            self.next_clock.append(time.perf_counter() - clock)
            self.next_processor.append(time.thread_time() - processor)
            self.turns.doing = "look"
            spin(self.proposed, 0.3)
        self.turns.doing = "undo and redo"
        for _ in range(5):
            self.key(Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
            spin(self.proposed, 0.02)
        for _ in range(5):
            self.key(Qt.Key.Key_Y, Qt.KeyboardModifier.ControlModifier)
            spin(self.proposed, 0.02)

    def wheel(self, steps: int, held: Qt.KeyboardModifier) -> None:
        """Turn the wheel over the plots."""
        view = self.window.trajectories.canvas.viewport()
        at = QPointF(view.width() / 2, view.height() / 3)
        event = QWheelEvent(
            at,
            QPointF(view.mapToGlobal(at.toPoint())),
            QPoint(),
            QPoint(0, 120 * steps),
            Qt.MouseButton.NoButton,
            held,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(view, event)
        wait(16)

    def look_around(self) -> None:
        """Zoom, pan, play, and turn the body."""
        none, ctrl = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier
        self.turns.doing = "zoom and pan"
        self.key(Qt.Key.Key_0, ctrl)
        for steps in [1] * 12 + [-1] * 12:
            self.wheel(steps, none)
        for steps in (1, 1, -1, -1):
            self.wheel(steps, ctrl)
        self.turns.doing = "play"
        self.key(Qt.Key.Key_Space)
        spin(lambda: True, 1.5)
        self.key(Qt.Key.Key_Space)
        self.turns.doing = "turn the body"
        scene, left = self.window.scene, Qt.MouseButton.LeftButton
        QTest.mousePress(scene, left, none, QPoint(60, 60))
        for x in range(60, 160, 5):
            QTest.mouseMove(scene, QPoint(x, 60 + x // 4))
            wait(16)
        QTest.mouseRelease(scene, left, none, QPoint(160, 100))
        self.turns.doing = "switch the view"
        for key in (Qt.Key.Key_B, Qt.Key.Key_L, Qt.Key.Key_B, Qt.Key.Key_L):
            self.key(key)
            wait(50)


def first_paint(path: Path, folder: Path) -> tuple[float, float]:
    """Seconds of clock and processor from the command to the take's first picture; best of 5."""
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "app"))
    from test_start import FIRST_PAINT

    script = FIRST_PAINT.format(take=str(path), ini=str(folder / "start.ini"))
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    environment["PYTHONPYCACHEPREFIX"] = str(folder / "compiled")
    clocks, processors = [], []
    for _ in range(6):
        begun = time.perf_counter()
        process = subprocess.Popen(
            [sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, env=environment
        )
        assert process.stdout is not None
        line = process.stdout.readline()
        clocks.append(time.perf_counter() - begun)
        process.wait()
        processors.append(float(line.split('"cpu":')[1].strip(" }\n")))
    return min(clocks[1:]), min(processors[1:])


def told(name: str, value: float, target: float, unit: str = "ms", factor: float = 1e3) -> None:
    """Print a figure beside its target."""
    good = "ok" if value <= target else "TOO MUCH"
    print(f"{name:<44} {value * factor:9.1f} {unit}  target {target * factor:g} {unit}  {good}")  # noqa: T201


def main() -> int:
    """Run the rounds and print what they took."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=6)
    parser.add_argument("--artifacts", type=int, default=40, help="decided in each take")
    parser.add_argument("--long", action="store_true", help="a take of ten minutes in each round")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["XDG_DATA_HOME"] = name
        take, _ = simulate(duration_s=60.0, rate=100.0)
        mm.write(take, folder / "walk.c3d")
        clock, processor = first_paint(folder / "walk.c3d", folder)
        print(f"first picture of 60 s, {take.markers} markers")  # noqa: T201
        told("  clock", clock, TARGET_START)
        told("  processor", processor, TARGET_START)

        store = QSettings(str(folder / "settings.ini"), QSettings.Format.IniFormat)
        settings.store = lambda: store  # type: ignore[assignment]
        from markermend_app.main import SWITCH_S
        from markermend_app.style import theme
        from markermend_app.window import MainWindow

        app = QApplication([])
        sys.setswitchinterval(SWITCH_S)
        theme.apply(app, "light")
        window = MainWindow()
        window.show()
        window.activateWindow()
        turns = Turns()
        operator = Operator(window, turns)
        long, planted = long_take() if options.long else (None, [])
        if long is not None:
            mm.write(long, folder / "long.c3d")
        memory = []
        for i in range(options.rounds):
            for j in range(2):
                path = folder / f"walk{i}{j}.c3d"
                path.write_bytes((folder / "walk.c3d").read_bytes())
                operator.open(path)
                operator.decide(options.artifacts)
                operator.look_around()
            if long is not None:
                path = folder / f"long{i}.c3d"
                path.write_bytes((folder / "long.c3d").read_bytes())
                operator.open(path, planted)
                operator.document.show([f"M{k:02d}" for k in range(5)])
                operator.look_around()
                operator.decide(options.artifacts)
                path.unlink()
            memory.append(private_bytes())
            print(f"round {i + 1}: {memory[-1] / 1e6:.0f} MB", flush=True)  # noqa: T201
        if operator.document.session is not None:
            operator.document.session.mark_exported()
        window.close()
    for doing in turns.clock:
        own, whole = turns.processor[doing], turns.clock[doing]
        over = sum(t > TARGET_STALL for t in own)
        print(  # noqa: T201
            f"{doing:<16} {len(own):5d} beats, longest wait {max(own) * 1e3:6.1f} ms processor, "
            f"{max(whole) * 1e3:6.1f} ms clock, {over} over {TARGET_STALL * 1e3:g} ms processor"
        )
    told("longest wait, processor", max(map(max, turns.processor.values())), TARGET_STALL)
    told("longest wait, clock", max(map(max, turns.clock.values())), TARGET_STALL)
    for label, values in (
        ("clock", operator.next_clock),
        ("processor", operator.next_processor),
    ):
        told(f"next artifact, median, {label}", float(np.median(values)), TARGET_NEXT)
        told(f"next artifact, 95 of 100, {label}", float(np.percentile(values, 95)), TARGET_NEXT)
    told(
        "next artifact whose repair was not there yet",
        float(np.mean(operator.waited)),
        0.05,
        "%",
        100,
    )
    if len(memory) > 2:
        # The first round fills what is kept for good.
        told(
            "growth of memory since the second round",
            memory[-1] / memory[1] - 1,
            TARGET_GROWTH,
            "%",
            100,
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
