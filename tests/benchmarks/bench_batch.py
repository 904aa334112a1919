"""How a batch scales: beside the single-take command, with one and two workers, after kills.

::

    python tests/benchmarks/bench_batch.py [--takes 200] [--duration 60] [--slow] [--workers 1 2]

Simulated takes of 53 markers at 100 Hz are cleaned one by one with ``markermend clean``, each in a
process of its own; then as a batch with each number of workers; then once more while a worker is
killed. Told are seconds of the clock and of the processors, the most memory a worker had in the
first and in the last third of its takes, and whether all results are the same bytes. Compare the
clock's seconds only where nothing else runs.
"""

from __future__ import annotations

import argparse
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from joblib import Parallel, delayed

import markermend as mm
from markermend.batch import Recipe, find_takes, run_batch
from markermend.batch.pool import Message
from markermend.batch.sources import Source
from markermend.detectors import find_detector

PAGE_MB = resource.getpagesize() / 1e6 if sys.platform.startswith("linux") else 0.0


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--takes", type=int, default=200)
    parser.add_argument("--duration", type=float, default=60.0)
    parser.add_argument("--slow", action="store_true", help="look for slow changes too")
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--batches-only", action="store_true", help="no single takes, no kills")
    chosen = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as folder:
        shoot = Path(folder) / "shoot"
        shoot.mkdir()
        Parallel(n_jobs=-1)(
            delayed(make_take)(shoot / f"{seed:03}.c3d", chosen.duration, seed)
            for seed in range(chosen.takes)
        )
        print(f"{chosen.takes} takes of {chosen.duration:g} s")  # noqa: T201
        if not chosen.batches_only:
            with told("single-take command, one after the other", chosen.takes):
                one_by_one(shoot, Path(folder) / "single", slow=chosen.slow)
        parameters = find_detector("joint").params(slow=chosen.slow, jobs=1)
        recipe = Recipe(detector="joint", detector_params=parameters)
        results = []
        for workers in chosen.workers:
            out = Path(folder) / f"batch{workers}"
            with told(f"batch, {workers} workers", chosen.takes), memory() as sizes:
                run_batch(find_takes([shoot]), out, recipe, jobs=workers)
            print(f"    most memory of a worker: {flatness(sizes)}")  # noqa: T201
            results.append(contents(out))
        workers = chosen.workers[-1]
        with told("the same again with --resume: a task beside the work in it", chosen.takes):
            run_batch(find_takes([shoot]), out, recipe, jobs=workers, resume=True)
        if not chosen.batches_only:
            out = Path(folder) / "killed"
            with told(f"batch, {workers} workers, one killed", chosen.takes):
                run_batch(find_takes([shoot]), out, recipe, jobs=workers, listener=Killer())
            results.append(contents(out))
        print("all results the same bytes:", all(r == results[0] for r in results))  # noqa: T201
    return 0


def make_take(path: Path, duration_s: float, seed: int) -> None:
    """Write a damaged simulated take."""
    mm.write(mm.simulate(duration_s=duration_s, seed=seed)[0], path)


@contextmanager
def told(what: str, takes: int) -> Iterator[None]:
    """Print how long something took."""
    before, began = _processors(), time.monotonic()
    yield
    wall, cpu = time.monotonic() - began, _processors() - before
    print(  # noqa: T201
        f"{what}: {wall:.1f} s, {cpu:.1f} s of processors, {wall / takes:.2f} s a take", flush=True
    )


def one_by_one(shoot: Path, out: Path, *, slow: bool) -> None:
    """Clean each take by the command people use for one."""
    out.mkdir()
    for path in sorted(shoot.iterdir()):
        command = [
            sys.executable,
            "-m",
            "markermend",
            "clean",
            str(path),
            "-o",
            str(out / path.name),
        ]
        command += [
            "--report",
            str(out / f"{path.stem}.html"),
            "--json",
            str(out / f"{path.stem}.json"),
        ]
        subprocess.run(
            [*command, *([] if slow else ["--no-slow"])], check=True, stdout=subprocess.DEVNULL
        )


class Killer:
    """Kills a worker once, in the middle of the third take that is begun."""

    def __init__(self) -> None:
        self.begun = 0

    def __call__(self, message: Message, take: Source, overall: float) -> None:
        """Count, and kill."""
        self.begun += message.what == "started"
        if message.what == "progress" and self.begun >= 3 and message.share > 0.3:
            self.begun = -(10**9)
            os.kill(max(children()), getattr(signal, "SIGKILL", signal.SIGTERM))


def children() -> list[int]:
    """Processes that this one started, where the system tells (Linux)."""
    found = []
    for task in Path(f"/proc/{os.getpid()}/task").iterdir():
        found += [int(p) for p in (task / "children").read_text().split()]
    return [p for p in found if "spawn_main" in Path(f"/proc/{p}/cmdline").read_text()]


@contextmanager
def memory() -> Iterator[list[list[float]]]:
    """Sample the memory of all workers every half second, in MB."""
    samples: list[list[float]] = []
    stop = threading.Event()

    def look() -> None:
        while not stop.wait(0.5):
            sizes = []
            for pid in children():
                try:
                    sizes.append(int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE_MB)
                except OSError:
                    continue
            if sizes:
                samples.append(sizes)

    thread = threading.Thread(target=look)
    thread.start()
    yield samples
    stop.set()
    thread.join()


def flatness(samples: Sequence[Sequence[float]]) -> str:
    """The most memory in the first and in the last third."""
    third = max(len(samples) // 3, 1)
    first, last = (max(max(s) for s in part) for part in (samples[:third], samples[-third:]))
    return f"{first:.0f} MB at first, {last:.0f} MB at last"


def contents(folder: Path) -> dict[str, bytes]:
    """All files by path."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def _processors() -> float:
    """Seconds of the processors used by this process and those it waited for."""
    mine, theirs = (resource.getrusage(w) for w in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return mine.ru_utime + mine.ru_stime + theirs.ru_utime + theirs.ru_stime


if __name__ == "__main__":
    sys.exit(main())
