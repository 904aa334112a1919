"""The window under an operator's hands: what it makes wait, and whether it grows.

::

    python tests/benchmarks/bench_window.py [--minutes 30] [--artifacts 40] [--long]

Each round opens a take, lets it be searched, and then does what half an hour of review does: steps
to artifacts and repairs, accepts, rejects and undoes them with the keys, compares methods, zooms
and pans with the wheel, plays, turns the 3D view, shows several markers in five rows, finds things
by the palette, smooths, marks and cuts ranges by hand, exports, reports, and opens the next take.
With ``--long`` one more take, 10 minutes of 60 markers at 240 Hz with 300 intervals, is opened and
reviewed in every round.

How long the event loop is held up is told by a timer of 10 ms. The clock's time holds what other
threads and processes took; the processor's time of the window's own thread does not. On a busy
machine only the latter means anything. Of every wait it is told where the window's thread was, and
what the host of a virtual machine took away of its processors meanwhile: then even a thread's own
time is longer than its work.

A machine that is shared with others is not always as fast: after each round it is told how long a
fixed piece of work takes, by which figures of different days can be compared.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from hands import Operator
from heart import STALL_S, Turns
from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QApplication

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.memory import keep_memory
from markermend.simulation import simulate
from markermend_app import settings

TARGET_NEXT, TARGET_START, TARGET_GROWTH, TARGET_UNREADY = 0.050, 1.0, 0.10, 0.05
TARGET_WHEEL, TARGET_WHEEL_LONG = 1 / 60, 1 / 25
LONG_FRAMES, LONG_MARKERS, LONG_RATE = 144_000, 60, 240.0


def private_bytes() -> int:
    """Memory of this process that is its own."""
    lines = Path("/proc/self/smaps_rollup").read_text().splitlines()
    return sum(1024 * int(line.split()[1]) for line in lines if line.startswith("Private_"))


def fixed_work() -> float:
    """Seconds of processor that always the same work takes: the speed of the machine as it is."""
    spent = []
    for _ in range(5):
        begun = time.thread_time()
        sum(i * i for i in range(1_000_000))
        spent.append(time.thread_time() - begun)
    return float(np.median(spent))


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
    print(f"{name:<50} {value * factor:9.1f} {unit}  target {target * factor:g} {unit}  {good}")  # noqa: T201


def one_round(operator: Operator, path: Path, artifacts: int, planted: list[Artifact]) -> None:
    """Review a take from opening it to its report."""
    operator.open(path, planted or None)
    if planted:
        operator.document.show([f"M{k:02d}" for k in range(5)])
    operator.look_around()
    operator.decide(artifacts)
    operator.compare()
    operator.go_back_and_forth(20)
    operator.find("gap")
    operator.find("zoom in")
    operator.change_overview()
    operator.show_more()
    operator.work_by_hand()
    operator.smooth()
    operator.write()


def run_rounds(
    operator: Operator,
    takes: list[tuple[str, list[Artifact]]],
    folder: Path,
    options: argparse.Namespace,
    memory: list[int],
) -> None:
    """Review the takes until the time is over; what the process holds goes into ``memory``."""
    turns = operator.turns
    begun = time.monotonic()
    while time.monotonic() - begun < 60 * options.minutes:
        for kind, planted in takes:
            path = folder / f"{kind}{len(memory)}.c3d"
            path.write_bytes((folder / f"{kind}.c3d").read_bytes())
            turns.skip()
            one_round(operator, path, options.artifacts, planted)
            path.unlink()
        memory.append(private_bytes())
        passed = (time.monotonic() - begun) / 60
        print(  # noqa: T201
            f"round {len(memory)}, {passed:.1f} min: {memory[-1] / 1e6:.0f} MB, "
            f"{sum(s.processor > STALL_S for s in turns.stalls)} waits over "
            f"{STALL_S * 1e3:g} ms processor, {np.mean(operator.waited):.1%} not ready, "
            f"fixed work {fixed_work() * 1e3:.0f} ms",
            flush=True,
        )


def tell(operator: Operator, turns: Turns, memory: list[int]) -> None:
    """Print what the rounds took, beside what they may take."""
    for doing in turns.clock:
        own, whole = turns.processor[doing], turns.clock[doing]
        print(  # noqa: T201
            f"{doing:<22} {len(own):6d} beats, longest wait {max(own) * 1e3:6.1f} ms processor, "
            f"{max(whole) * 1e3:7.1f} ms clock"
        )
    for unit in ("processor", "clock"):
        over = [s for s in turns.stalls if getattr(s, unit) > STALL_S]
        stolen = sum(s.stolen > 0 for s in over)
        print(  # noqa: T201
            f"{len(over)} waits over {STALL_S * 1e3:g} ms by the {unit}, "
            f"{stolen} of them while the host took processors away"
        )
        for stall in sorted(over, key=lambda s: -getattr(s, unit))[:30]:
            print(f"  {stall}")  # noqa: T201
    told("longest wait, processor", max(map(max, turns.processor.values())), STALL_S)
    own = [s.processor for s in turns.stalls if not s.stolen]
    told("the same while the host took nothing away", max(own, default=0.0), STALL_S)
    told("longest wait, clock", max(map(max, turns.clock.values())), STALL_S)
    for label, values in (
        ("clock", operator.next_clock),
        ("processor", operator.next_processor),
    ):
        told(f"next artifact, median, {label}", float(np.median(values)), TARGET_NEXT)
        told(f"next artifact, 95 of 100, {label}", float(np.percentile(values, 95)), TARGET_NEXT)
    unready = float(np.mean(operator.waited))
    told("next artifact whose repair was not there yet", unready, TARGET_UNREADY, "%", 100)
    for (markers, rows), seconds in sorted(operator.wheeled.items()):
        target = TARGET_WHEEL if markers == 1 else TARGET_WHEEL_LONG
        name = f"a turn of the wheel, {markers} marker{'s' * (markers > 1)}, {rows} rows"
        told(f"{name}, median", float(np.median(seconds)), target)
    if len(memory) > 2:
        # The first round fills what is kept for good.
        growth = memory[-1] / memory[1] - 1
        told("growth of memory since the second round", growth, TARGET_GROWTH, "%", 100)


def main() -> int:
    """Run the rounds and print what they took."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=30, help="rounds are begun until then")
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

        settings.store = lambda: QSettings(str(folder / "s.ini"), QSettings.Format.IniFormat)
        from markermend_app.background.garbage import Collector
        from markermend_app.main import SWITCH_S
        from markermend_app.style import theme
        from markermend_app.window import MainWindow

        keep_memory()
        app = QApplication([])
        sys.setswitchinterval(SWITCH_S)
        Collector(app)
        theme.apply(app, "light")
        window = MainWindow()
        window.show()
        window.activateWindow()
        turns = Turns()
        operator = Operator(window, turns, folder)
        takes: list[tuple[str, list[Artifact]]] = [("walk", []), ("walk", [])]
        if options.long:
            long, planted = long_take()
            mm.write(long, folder / "long.c3d")
            takes.append(("long", planted))
            del long
            turns.skip()
        memory: list[int] = []
        try:
            run_rounds(operator, takes, folder, options, memory)
        finally:
            tell(operator, turns, memory)
        if operator.document.session is not None:
            operator.document.session.mark_exported()
        window.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
