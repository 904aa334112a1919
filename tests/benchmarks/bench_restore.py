"""CPU time of restoring 5,000 poses of 17 joints, at 120 and at 30 Hz, and what an AMC holds of it.

python tests/benchmarks/bench_restore.py 01_11.amc

The recording is played to and fro until there are enough poses; as an AMC it is written as it is.
"""

from __future__ import annotations

import sys
import time

import numpy as np

import markermend as mm
from markermend.poses.inverse import inverse_kinematics
from markermend.poses.live import Live
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.prior import shipped_prior
from markermend.poses.restore import restore
from markermend.poses.simulated.noise import Noise, corrupt_pose
from markermend.poses.skeleton import forward_kinematics

POSES = 5000


def to_and_fro(pose: Pose, step: int) -> Pose:
    """So many poses, of every frame or every n-th."""
    there = np.arange(0, pose.frames, step)
    frames = np.resize(np.append(there, there[-2:0:-1]), POSES)
    return Pose(
        pose.positions[frames],
        pose.rotations[frames],
        pose.joints,
        pose.parents,
        pose.rate / step,
    )


def restoring_s(pose: Pose) -> float:
    """CPU time of one call, the better of two."""
    spent = []
    for _ in range(2):
        began = time.process_time()
        restore(pose, prior=shipped_prior())
        spent.append(time.process_time() - began)
    return min(spent)


def one_by_one_ms(pose: Pose) -> float:
    """CPU time of a pose as they come, without what it takes to begin."""
    whole = int(pose.seen.all(axis=1).argmax())
    first = slice(whole, whole + 1)
    live = Live(
        Pose(pose.positions[first], pose.rotations[first], pose.joints, pose.parents, pose.rate),
        shipped_prior(),
    )
    began = time.process_time()
    for frame in range(whole + 1, pose.frames):
        live(pose.positions[frame], pose.rotations[frame], pose.seen[frame])
    return 1000.0 * (time.process_time() - began) / (pose.frames - whole - 1)


def off_mm(pose: Pose) -> tuple[float, float, float]:
    """Mean distance from the truth once restored and once written, and CPU time of the latter."""
    damaged = corrupt_pose(pose, Noise(burst=max(round(0.25 * pose.rate), 1)), seed=1)
    told = restore(damaged, prior=shipped_prior()).pose
    began = time.process_time()
    placed = forward_kinematics(inverse_kinematics(told, pose.source), pose.rate)
    spent = time.process_time() - began
    restored, written = (
        float(np.linalg.norm(p.positions - pose.positions, axis=2).mean()) for p in (told, placed)
    )
    return restored, written, spent


def main() -> None:
    """Measure and print."""
    whole = mm.read_pose(sys.argv[1])
    pose = to_nuitrack(whole)
    for step, burst_s in ((1, 0.0), (1, 0.25), (4, 1.0)):
        clean = to_and_fro(pose, step)
        damaged = corrupt_pose(clean, Noise(burst=max(round(burst_s * clean.rate), 1)), seed=1)
        how = f"bursts of {burst_s:g} s" if burst_s else "frame by frame"
        sys.stdout.write(
            f"{POSES} poses at {clean.rate:g} Hz, {how}: {restoring_s(damaged):.2f} s;"
            f" one by one {one_by_one_ms(damaged):.2f} ms each\n"
        )
    restored, written, spent = off_mm(whole)
    sys.stdout.write(
        f"{whole.frames} poses of {len(whole.joints)} segments, bursts of 0.25 s: restored"
        f" {restored:.2f} mm off, as an AMC {written:.2f} mm, turned in {spent:.1f} s\n"
    )


if __name__ == "__main__":
    main()
