"""How far off a root comes out that is as noisy as the other joints, and how its body does.

python tests/benchmarks/bench_noisy_root.py 01_14.amc 02_06.amc 03_03.amc
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.arrays import BoolArray, FloatArray
from markermend.bench.poses import unseen
from markermend.poses.nuitrack import JOINTS
from markermend.poses.pose import Pose
from markermend.poses.quaternion import unit
from markermend.poses.restore import restore

HANGING = ("torso", "left_hip", "right_hip")
# Noise of each coordinate in mm, of each number of a rotation, and frames that are left out.
CASES = [
    (mm_, turned, step) for step in (1, 4) for mm_, turned in ((2, 0.004), (5, 0.01), (0, 0.0))
]


def off(a: Pose, b: Pose, joints: list[int] | BoolArray) -> float:
    """Root mean square of distances, mm."""
    away = a.positions[:, joints] - b.positions[:, joints]
    return float(np.sqrt(np.mean(np.sum(away**2, axis=2))))


def turned_off(a: Pose, b: Pose, root: int) -> float:
    """Root mean square of angles between rotations of a root, in degrees."""
    same = np.abs(np.sum(a.rotations[:, root] * b.rotations[:, root], axis=1)).clip(0, 1)
    return float(np.degrees(2 * np.sqrt(np.mean(np.arccos(same) ** 2))))


def main() -> None:
    """Measure and print."""
    clips = {Path(name).stem: mm.read_pose(name) for name in sys.argv[1:]}
    priors = list(unseen(clips))
    sys.stdout.write(
        "Hz, mm of noise | root: mm off, restored, expected | degrees off, restored |"
        " joints on it, mm off, restored | others | trembling of the root, true, noisy, restored\n"
    )
    for size, turned, step in CASES:
        rows = [measured(pose, prior, size, turned, step) for _, pose, prior in priors]
        told = " ".join(f"{v:.2f}" for v in np.mean([row for _, row in rows], axis=0))
        sys.stdout.write(f"{rows[0][0]:g}, {size} | {told}\n")
        sys.stdout.flush()


def measured(
    pose: Pose, prior: mm.poses.prior.Prior, size: float, turned: float, step: int
) -> tuple[float, FloatArray]:
    """Rate, and what is printed of one recording."""
    samples = pose.positions[::step], pose.rotations[::step]
    truth = Pose(*samples, pose.joints, pose.parents, pose.rate / step)
    random = np.random.default_rng(3)
    noisy = truth.with_samples(
        truth.positions + random.normal(0.0, size, truth.positions.shape),
        unit(truth.rotations + random.normal(0.0, turned, truth.rotations.shape)),
        truth.confidence,
    )
    restored = restore(noisy, prior=prior)
    root = truth.order[0]
    hanging = [truth.index(name) for name in HANGING]
    others = [
        truth.index(name) for name in JOINTS if name not in HANGING and truth.index(name) != root
    ]
    row = [
        off(noisy, truth, [root]),
        off(restored.pose, truth, [root]),
        float(restored.error_mm[0, root]),
        turned_off(noisy, truth, root),
        turned_off(restored.pose, truth, root),
        off(noisy, truth, hanging),
        off(restored.pose, truth, hanging),
        off(restored.pose, truth, others),
        *(
            float(np.linalg.norm(np.diff(p.positions[:, root], 2, axis=0), axis=1).mean())
            for p in (truth, noisy, restored.pose)
        ),
    ]
    return truth.rate, np.array(row)


if __name__ == "__main__":
    main()
