"""How the joint detector's time and memory grow with frames and markers.

Run as ``python tests/benchmarks/bench_joint.py``; writes processor seconds on one core and the
largest memory of the process so far.
"""

from __future__ import annotations

import resource
import sys
import time

import numpy as np
from threadpoolctl import threadpool_limits

import markermend as mm
from markermend.detectors.joint import JointParams
from markermend.simulation import simulate_clean
from markermend.take import Take

RATE = 120.0
FRAMES = (1800, 3600, 7200, 14400)
MARKERS = (13, 26, 53, 106)


def performers(frames: int, markers: int) -> Take:
    """One simulated person after another, side by side, until there are enough markers."""
    people = [
        simulate_clean(duration_s=frames / RATE, rate=RATE, seed=n)
        for n in range(-(-markers // 53))
    ]
    positions = [p.positions + 2000.0 * n for n, p in enumerate(people)]
    labels = [f"P{n}:{label}" for n, p in enumerate(people) for label in p.labels]
    return Take(np.concatenate(positions, axis=1)[:, :markers], tuple(labels[:markers]), RATE)


def main() -> None:
    sizes = [(frames, 41) for frames in FRAMES] + [(1800, markers) for markers in MARKERS]
    for frames, markers in sizes:
        take, began = performers(frames, markers), time.process_time()
        with threadpool_limits(1):
            mm.detect(take, method="joint", params=JointParams(jobs=1, slow=False))
            sudden = time.process_time() - began
            mm.detect(take, method="joint", params=JointParams(jobs=1))
        both = time.process_time() - began - sudden
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        sys.stdout.write(
            f"{frames:6d} frames {markers:4d} markers: sudden {sudden:5.1f} s, "
            f"with slow changes {both:6.1f} s, {peak:5.0f} MB\n"
        )


if __name__ == "__main__":
    main()
