"""How far off restored joints are, and are expected to be, of people who were not learnt from.

python tests/benchmarks/bench_pose_bands.py 01_05.amc 02_05.amc 03_04.amc
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.arrays import FloatArray
from markermend.bench.poses import CASES, Case, damaged, recorded, unseen
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior
from markermend.poses.restore import restore


def measured(pose: Pose, prior: Prior, case: Case, seed: int) -> dict[bool, FloatArray]:
    """(joints, 2) mm off and expected, of joints that were hidden and of those that were seen."""
    truth = recorded(pose, case)
    given = damaged(truth, case.noise(truth.rate), seed).seen_in(truth)
    restored = restore(given, prior=prior)
    off = np.linalg.norm(restored.pose.positions - truth.positions, axis=2)
    both = np.stack([off, restored.error_mm], axis=-1)
    return {
        hidden: both[(restored.filled == hidden) & (restored.error_mm > 0)]
        for hidden in (True, False)
    }


def main() -> None:
    """Measure and print."""
    clips = {Path(name).stem: mm.read_pose(name) for name in sys.argv[1:]}
    seeds = {name: 1 + n for n, name in enumerate(clips)}
    priors = list(unseen(clips))
    sys.stdout.write("case, joints | off, mm | expected, mm | within it | within twice it\n")
    for case in CASES:
        if case.sensor or case.kind == "nothing":
            continue
        rows = [measured(pose, prior, case, seeds[name]) for name, pose, prior in priors]
        for hidden, what in ((True, "hidden"), (False, "seen")):
            off, expected = np.concatenate([row[hidden] for row in rows]).T
            if case.kind == ("displacements" if hidden else "occlusions"):
                continue
            away, said = (np.sqrt(np.mean(x**2)) for x in (off, expected))
            shares = " | ".join(f"{100 * np.mean(off < k * expected):.0f} %" for k in (1, 2))
            name = f"{case.name}, {case.kind}, {what}"
            sys.stdout.write(f"{name} | {away:.1f} | {said:.1f} | {shares}\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
