"""How far off joints come out that were hidden for half a second, of skeletons that no prior fits.

python tests/benchmarks/bench_no_prior.py 01_11.amc 02_02.amc

Ten single joints of each recording, none beside another at the same time, and then whole limbs.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.arrays import BoolArray
from markermend.poses.pose import Pose
from markermend.poses.restore import restore

HIDDEN_S, SHARE = 0.5, 0.2
JOINTS = 10
LIMBS = ("lfemur", "rhumerus", "lradius", "rclavicle", "rtibia")
SHORT_S = 5.0


def hidden(pose: Pose, limbs: bool) -> BoolArray:
    """(frames, joints) bool."""
    random = np.random.default_rng(1)
    length = int(min(HIDDEN_S * pose.rate, SHARE * pose.frames))
    wrong = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    names = (n for n in LIMBS for _ in range(max(1, pose.frames // (8 * length))))
    chosen = [pose.hanging_on(pose.index(name)) for name in names]
    if not limbs:
        chosen = [(j,) for j in random.permutation(pose.order[1:])[:JOINTS].tolist()]
    for joints in chosen:
        start = int(random.integers(length // 2, pose.frames - 3 * length // 2))
        frames = slice(start, start + length)
        beside = [*joints, *(max(pose.parents[j], 0) for j in joints)]
        beside += [j for j, parent in enumerate(pose.parents) if parent in joints]
        if limbs or not wrong[frames, beside].any():
            wrong[frames, list(joints)] = True
    return wrong


def off(pose: Pose, wrong: BoolArray) -> tuple[float, float]:
    """Mean distance from the truth in mm, and mean angle in degrees, of what was hidden."""
    given = pose.with_samples(pose.positions, pose.rotations, np.where(wrong, 0.0, 1.0))
    found = restore(given).pose
    away = np.linalg.norm(found.positions - pose.positions, axis=2)[wrong]
    alike = np.abs(np.sum(found.rotations * pose.rotations, axis=2))[wrong]
    return float(away.mean()), float(np.degrees(2.0 * np.arccos(np.minimum(alike, 1.0))).mean())


def main() -> None:
    """Measure and print."""
    poses = {Path(name).stem: mm.read_pose(name) for name in sys.argv[1:]}
    for limbs in (False, True):
        rows = {name: off(pose, hidden(pose, limbs)) for name, pose in poses.items()}
        short = [row for n, row in rows.items() if poses[n].frames < SHORT_S * poses[n].rate]
        for name, some in (("all", list(rows.values())), (f"under {SHORT_S:g} s", short)):
            if some:
                mm_off, degrees = np.mean(some, axis=0)
                what = "limbs" if limbs else "single joints"
                sys.stdout.write(f"{what}, {name}: {mm_off:.1f} mm, {degrees:.1f} degrees\n")


if __name__ == "__main__":
    main()
