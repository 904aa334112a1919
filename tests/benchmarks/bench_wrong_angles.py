"""Angles of a skeleton file that jump for a while: how they come out, and what else an AMC changes.

python tests/benchmarks/bench_wrong_angles.py *.amc

An angle of a limb turns by 30 to 90 degrees for 0.02 to 0.5 s, up to ten times a recording; each is
restored by what other people's recordings teach. Told are how many are found; how far the joints
that it carried off were and are; how far off the angle is; and of how many other angles of the limb
an AMC has others than the file, and by how much: with and without letting joints keep their own.
Last, the same written as BVH files and read again.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.bench.poses import left_out
from markermend.cli.recordings import read_by_name
from markermend.poses import Pose, forward_kinematics
from markermend.poses import restore as restoring
from markermend.poses.inverse import inverse_kinematics
from markermend.poses.prior import Prior
from markermend.poses.quaternion import inverse, lengths_of, multiply
from markermend.poses.skeleton import TURNS, Movement

LIMBS = ("humerus", "radius", "wrist", "femur", "tibia")
TIMES, TURNED_DEG, LASTS_S, APART_S = 10, (30.0, 90.0), (0.02, 0.5), 0.7
CHANGED_DEG, SAME, LEAST_MM = 1e-6, 1e-9, 0.5


@dataclass(frozen=True)
class Damage:
    """One angle that is wrong for a while."""

    joint: int
    column: int
    rows: slice


def damaged(movement: Movement, rate: float, seed: int) -> tuple[Movement, list[Damage]]:
    """Turn angles away."""
    random = np.random.default_rng(seed)
    channels = {name: np.array(values) for name, values in movement.channels.items()}
    segments, found, start = movement.skeleton.segments, list[Damage](), round(APART_S * rate)
    while len(found) < TIMES:
        length = max(round(random.uniform(*LASTS_S) * rate), 1)
        name = random.choice(["l", "r"]) + random.choice(LIMBS)
        joint = movement.skeleton.names.index(name)
        turns = [k for k, dof in enumerate(segments[joint].dofs) if dof in TURNS]
        if start + length + APART_S * rate > movement.frames:
            break
        rows, column = slice(start, start + length), int(random.choice(turns))
        away = random.uniform(*TURNED_DEG) * random.choice([-1, 1])
        channels[name][rows, column] += away
        found.append(Damage(joint, column, rows))
        start += length + round(APART_S * rate)
    return replace(movement, channels=channels), found


def of_recording(truth: Pose, prior: Prior, seed: int) -> list[list[float]]:
    """A row of numbers for each angle that was turned."""
    movement = truth.source
    assert isinstance(movement, Movement)
    wrong, damage = damaged(movement, truth.rate, seed)
    given = forward_kinematics(wrong, truth.rate)
    done = restoring.restore(given, prior=prior)
    back = inverse_kinematics(done.pose, wrong)
    rows = []
    for one in damage:
        joints = list(truth.hanging_on(one.joint))
        came = came_back(truth, given, done, joints, one.rows)
        others, angle = [], 0.0
        for name in (truth.joints[j] for j in {*joints, truth.parents[one.joint]}):
            if name in back.channels:
                apart = np.abs(back.channels[name] - movement.channels[name])[one.rows]
                if name == truth.joints[one.joint]:
                    angle = apart[:, one.column].mean()
                    apart = np.delete(apart, one.column, axis=1)
                others.append(apart.ravel())
        beside = np.concatenate(others)
        rows.append([*came, angle, (beside > CHANGED_DEG).mean(), beside.mean()])
    return rows


def of_bvh(truth: Pose, prior: Prior, seed: int) -> list[list[float]]:
    """The same of a BVH: found, how far off joints were and are, and other joints turned anew."""
    movement = truth.source
    assert isinstance(movement, Movement)
    wrong, damage = damaged(movement, truth.rate, seed)
    right, given = (through_bvh(forward_kinematics(one, truth.rate)) for one in (movement, wrong))
    done = restoring.restore(given, prior=prior)
    rows = []
    for one in damage:
        joint = given.index(truth.joints[one.joint])
        below = list(given.hanging_on(joint))
        far = lengths_of((given.positions - right.positions)[one.rows][:, below])
        moved = [j for j, off in zip(below, far.mean(axis=0), strict=True) if off > LEAST_MM]
        if not moved:
            continue
        came = came_back(right, given, done, moved, one.rows)
        others = [j for j in below if j != joint]
        above = [given.parents[j] for j in others]
        before, after = (
            multiply(inverse(p.rotations[one.rows][:, above]), p.rotations[one.rows][:, others])
            for p in (given, done.pose)
        )
        apart = 1.0 - np.abs(np.sum(before * after, axis=2))
        rows.append([*came, float(np.nanmean(apart > SAME))])
    return rows


def came_back(
    truth: Pose, given: Pose, done: restoring.Restored, joints: list[int], rows: slice
) -> list[float]:
    """Whether joints were found, and how far off they were and are, in mm."""
    found = any(
        f.joint in joints and f.start < rows.stop and rows.start < f.stop for f in done.faults
    )
    away = (
        float(lengths_of((p.positions - truth.positions)[rows][:, joints]).mean())
        for p in (given, done.pose)
    )
    return [float(found), *away]


def through_bvh(pose: Pose) -> Pose:
    """A recording as a BVH has it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.bvh"
        mm.write_pose(pose, path)
        return mm.read_pose(path, rate=pose.rate)


def told(way: str, rows: list[list[float]]) -> str:
    """What came out, in a line."""
    found, before, after, angle, changed, by = np.mean(rows, axis=0)
    return (
        f"{way}: {len(rows)} angles, {found:.0%} found; joints {before:.1f} mm off, restored"
        f" {after:.1f}; the angle {angle:.2f}° off; others changed {changed:.0%}, by {by:.2f}°"
    )


def main() -> None:
    """Measure with and without, and print."""
    poses = read_by_name([Path(name) for name in sys.argv[1:]])
    known = [(name, prior) for name, _, prior, _ in left_out(poses, known_too=False)]
    ways = {"own angles kept": restoring.with_own_angles, "filled": lambda told, *_: told}
    for way, does in ways.items():
        restoring.with_own_angles = does
        rows = []
        for seed, (name, prior) in enumerate(known):
            rows += of_recording(poses[name], prior, seed)
        sys.stdout.write(told(way, rows) + "\n")
        restoring.with_own_angles = ways["own angles kept"]
    rows = []
    for seed, (name, prior) in enumerate(known):
        rows += of_bvh(poses[name], prior, seed)
    found, before, after, changed = np.mean(rows, axis=0)
    sys.stdout.write(
        f"BVH: {len(rows)} angles, {found:.0%} found; joints {before:.1f} mm off, restored"
        f" {after:.1f}; other joints turned anew {changed:.0%}\n"
    )


if __name__ == "__main__":
    main()
