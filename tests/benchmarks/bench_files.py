"""Reading and exporting a long take, side by side with ezc3d.

::

    python tests/benchmarks/bench_files.py [--minutes 10] [--rate 240] [--markers 60]

Each step runs in a process of its own, so that its memory is its own; each reading is repeated and
the best one counts. The file lies in the system's cache, as after copying a recording. On a busy
machine compare the processor's seconds (cpu), not the clock's.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import markermend as mm


def make_take(minutes: float, rate: float, markers: int) -> mm.Take:
    """Markers that wander smoothly through a room, with gaps in one sample in fifty."""
    rng = np.random.default_rng(0)
    frames = round(minutes * 60 * rate)
    time_s = np.arange(frames)[:, None] / rate
    positions = np.empty((frames, markers, 3))
    for axis in range(3):
        phases = rng.uniform(0, 2 * np.pi, markers)
        speeds = rng.uniform(0.1, 1.0, markers)
        positions[:, :, axis] = 1000 + 500 * np.sin(time_s * speeds + phases)
    for _ in range(frames * markers // 5000):
        start, marker = int(rng.integers(frames)), int(rng.integers(markers))
        positions[start : start + 100, marker] = np.nan
    residuals = np.where(np.isnan(positions[..., 0]), np.nan, 0.5).astype(np.float32)
    return mm.Take(positions, tuple(f"M{i:02d}" for i in range(markers)), rate, residuals=residuals)


def memory() -> dict[str, int]:
    """Private bytes now and peak resident bytes, of this process."""
    private = 0
    for line in Path("/proc/self/smaps_rollup").read_text().splitlines():
        if line.startswith("Private_"):
            private += 1024 * int(line.split()[1])
    return {"private": private, "peak": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss}


def timed(work: Callable[[], Any]) -> tuple[tuple[float, float], Any]:
    """Seconds of clock and processor that some work takes, and its result."""
    clock, processor = time.perf_counter(), time.process_time()
    result = work()
    return (time.perf_counter() - clock, time.process_time() - processor), result


def fastest(times: list[tuple[float, float]]) -> dict[str, float]:
    """Least seconds of clock and of processor."""
    return {"seconds": min(t[0] for t in times), "cpu": min(t[1] for t in times)}


def step_read(path: Path) -> dict[str, Any]:
    """Read with Markermend."""
    before, times = memory(), []
    for i in range(3):
        took, take = timed(lambda: mm.read(path))
        times.append(took)
        if i == 0:
            after = memory()
        del take
    used = {key: after[key] - before["private"] for key in ("private", "peak")}
    return {**fastest(times), **used}


def step_export(path: Path) -> dict[str, Any]:
    """Export with 1,000 samples changed."""
    take = mm.read(path)
    positions = take.positions.copy()
    rng = np.random.default_rng(1)
    rows, columns = rng.integers(take.frames, size=1000), rng.integers(take.markers, size=1000)
    positions[rows, columns] += 5.0
    changed = take.with_positions(positions, take.origin.copy())
    times = []
    for _ in range(3):
        took, _done = timed(lambda: mm.write(changed, path.with_name("export.c3d")))
        times.append(took)
    return fastest(times)


def step_ezc3d(path: Path) -> dict[str, Any]:
    """Read with ezc3d."""
    import ezc3d

    before = memory()
    took, points = timed(lambda: ezc3d.c3d(str(path))["data"]["points"])
    after = memory()
    assert points.size
    used = {key: after[key] - before["private"] for key in ("private", "peak")}
    return {**fastest([took]), **used}


STEPS = {"read": step_read, "export": step_export, "ezc3d": step_ezc3d}


def main() -> int:
    """Make the file, run each step in a process of its own, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--rate", type=float, default=240.0)
    parser.add_argument("--markers", type=int, default=60)
    parser.add_argument("--folder", type=Path, default=None)
    parser.add_argument("--step", choices=STEPS, help=argparse.SUPPRESS)
    parser.add_argument("--file", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.step:
        print(json.dumps(STEPS[options.step](options.file)))  # noqa: T201
        return 0
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        path = Path(folder) / "long.c3d"
        mm.write(make_take(options.minutes, options.rate, options.markers), path)
        size = path.stat().st_size
        found = {}
        for step in STEPS:
            command = [sys.executable, __file__, "--step", step, "--file", str(path)]
            environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
            done = subprocess.run(
                command, check=True, capture_output=True, text=True, env=environment
            )
            found[step] = json.loads(done.stdout)
    print(f"{size / 1e6:.0f} MB, {options.minutes:g} min at {options.rate:g} Hz")  # noqa: T201
    for step, figures in found.items():
        memory_text = (
            f"  private {figures['private'] / size:.2f} x  peak {figures['peak'] / size:.2f} x"
            if "private" in figures
            else ""
        )
        times = f"{figures['seconds']:.3f} s  cpu {figures['cpu']:.3f} s"
        print(f"{step:>8} {times}{memory_text}")  # noqa: T201
    ratio = found["ezc3d"]["cpu"] / found["read"]["cpu"]
    print(f"reading takes ezc3d {ratio:.1f} times as long (cpu)")  # noqa: T201
    return 0


if __name__ == "__main__":
    sys.exit(main())
