"""CPU time of repairs: one long gap, a take with many gaps, and growth with the take's length.

python tests/benchmarks/bench_repair.py
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np

from markermend.artifact import Artifact, Kind
from markermend.repairs import evidence_for, fill, find_gaps, propose_from, repair_all
from markermend.simulation import simulate_clean
from markermend.take import Take

RATE, MARKERS, GAPS = 100.0, 41, 200
FRAMES = (1250, 2500, 5000, 10000)


def performance(frames: int) -> Take:
    """A simulated person with 41 markers."""
    take = simulate_clean(duration_s=frames / RATE, rate=RATE, seed=1)
    return Take(take.positions[:, :MARKERS], take.labels[:MARKERS], RATE)


def with_gaps(take: Take, count: int) -> Take:
    """Hide gaps of 2 to 100 frames, most of them short, anywhere."""
    rng = np.random.default_rng(3)
    positions = take.positions.copy()
    for _ in range(count):
        length = int(np.exp(rng.uniform(np.log(2), np.log(100))))
        start = int(rng.integers(1, take.frames - length - 1))
        positions[start : start + length, rng.integers(MARKERS)] = np.nan
    return Take(positions, take.labels, take.rate)


def cpu_s(work: Callable[[], object]) -> float:
    """CPU time of one call, after another that warms up; the better of three."""
    work()
    spent = []
    for _ in range(3):
        began = time.process_time()
        work()
        spent.append(time.process_time() - began)
    return min(spent)


def tell(line: str) -> None:
    """Print a line."""
    sys.stdout.write(line + "\n")


def main() -> None:
    """Measure and print."""
    take = performance(5000)
    gap = Artifact(take.labels[20], "xyz", 2000, 2100, Kind.GAP)
    evidence = evidence_for(take, [gap])
    for method in ("auto", "local_regression", "kalman", "spline", "pma", "ffnn_lin", "ffnn_tanh"):
        spent = cpu_s(lambda name=method: propose_from(evidence, gap, method=name))
        tell(f"one gap of 100 frames, {method:<17}{1000 * spent:7.0f} ms")
    holed = with_gaps(take, GAPS)
    gaps = find_gaps(holed)
    whole: dict[str, Callable[[], object]] = {
        "auto": lambda: fill(holed),
        "pma": lambda: fill(holed, method="pma"),
        "pma, errors measured": lambda: repair_all(holed, gaps, method="pma"),
    }
    for what, work in whole.items():
        began = time.process_time()
        work()
        tell(f"{len(gaps)} gaps, {what:<21}{time.process_time() - began:6.1f} s")
    for frames in FRAMES:
        holed = with_gaps(performance(frames), 40)
        began = time.process_time()
        fill(holed)
        spent = time.process_time() - began
        per_gap = 1000 * spent / len(find_gaps(holed))
        tell(f"{frames:>6} frames, 40 gaps {spent:6.2f} s, {per_gap:5.0f} ms each")


if __name__ == "__main__":
    main()
