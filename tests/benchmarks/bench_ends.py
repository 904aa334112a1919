"""How far off limbs are that are not seen in the last poses, and are expected to be.

python tests/benchmarks/bench_ends.py *.amc
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.arrays import FloatArray
from markermend.bench.poses import unseen
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior
from markermend.poses.restore import restore

SECONDS, DRAWS = 4.0, 4
CASES = ((4, 1), (4, 3), (1, 2), (1, 6))
LIMBS = ("left_shoulder", "right_shoulder", "left_hip", "right_hip")


def main() -> None:
    """Measure and print."""
    clips = {Path(name).stem: mm.read_pose(name) for name in sys.argv[1:]}
    priors = list(unseen(clips))
    sys.stdout.write(
        "Hz, last poses unseen | restored, mm | expected | going straight on | standing still |"
        " within twice what is expected\n"
    )
    for step, length in CASES:
        rows = np.concatenate([measured(pose, prior, step, length) for _, pose, prior in priors])
        off, said, straight, still = np.sqrt(np.mean(rows**2, axis=0))
        within = 100 * np.mean(rows[:, 0] < 2 * rows[:, 1])
        rate = priors[0][1].rate / step
        sys.stdout.write(
            f"{rate:g}, {length} | {off:.1f} | {said:.1f} | {straight:.1f} | {still:.1f} |"
            f" {within:.0f} %\n"
        )
        sys.stdout.flush()


def measured(pose: Pose, prior: Prior, step: int, length: int) -> FloatArray:
    """(n, 4) mm: restored, expected, going straight on and standing still; of each joint hidden."""
    random, found = np.random.default_rng(1), []
    count = min(round(SECONDS * pose.rate), pose.frames)
    for _ in range(DRAWS):
        start = int(random.integers(0, pose.frames - count + 1))
        rows = slice(start, start + count, step)
        samples = pose.positions[rows], pose.rotations[rows]
        truth = Pose(*samples, pose.joints, pose.parents, pose.rate / step)
        limb = list(truth.hanging_on(truth.index(LIMBS[random.integers(len(LIMBS))])))
        shown = np.ones((truth.frames, len(truth.joints)))
        shown[-length:, limb] = 0.0
        restored = restore(truth.with_samples(*samples, shown), prior=prior)
        right = truth.positions[-length:, limb]
        last = truth.positions[-length - 1, limb]
        speed = last - truth.positions[-length - 2, limb]
        straight = last + np.arange(1, length + 1)[:, None, None] * speed
        ways = (restored.pose.positions[-length:, limb], straight, last)
        off, going, still = (np.linalg.norm(way - right, axis=2).ravel() for way in ways)
        found.append(np.stack([off, restored.error_mm[-length:, limb].ravel(), going, still], 1))
    return np.concatenate(found)


if __name__ == "__main__":
    main()
