"""People never learnt from, by sensors that do not tell everything: some rotations, or ankles.

python tests/benchmarks/bench_lacking.py 01_05.amc 02_05.amc 03_04.amc
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

import markermend as mm
from markermend.arrays import FloatArray
from markermend.bench.poses import CASES, Case, damaged, recorded, unseen
from markermend.poses.live import Live
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior
from markermend.poses.quaternion import multiply, turn
from markermend.poses.restore import restore

LACKING = ("nothing", "rotations of ends", "all rotations", "all rotations, turned away", "ankles")
AWAY = Rotation.from_euler("y", 140.0, degrees=True).as_quat()


def turned_away(pose: Pose) -> Pose:
    """The same in a room whose axes are others than those that the prior's people walked along."""
    return pose.with_samples(
        turn(AWAY, pose.positions), multiply(AWAY, pose.rotations), pose.confidence
    )


def without(pose: Pose, lacking: str) -> Pose:
    """What a sensor tells that lacks something."""
    rotations, confidence = pose.rotations.copy(), pose.confidence.copy()
    if lacking == "ankles":
        confidence[:, [j for j, name in enumerate(pose.joints) if name.endswith("ankle")]] = 0.0
    elif lacking != "nothing":
        ends = [j for j in range(len(pose.joints)) if j not in pose.parents]
        rotations[:, ends if lacking == "rotations of ends" else slice(None)] = np.nan
    return pose.with_samples(pose.positions, rotations, confidence)


def afterwards(given: Pose, prior: Prior) -> tuple[FloatArray, FloatArray]:
    """Positions, and how far off they are expected to be."""
    restored = restore(given, prior=prior)
    return restored.pose.positions, restored.error_mm


def as_it_comes(given: Pose, prior: Prior) -> tuple[FloatArray, FloatArray]:
    """The same, pose by pose; nothing is expected there."""
    first = given.positions[:1], given.rotations[:1]
    live = Live(Pose(*first, given.joints, given.parents, given.rate, given.confidence[:1]), prior)
    came = zip(given.positions, given.rotations, given.seen, strict=True)
    places = np.array([live(*pose)[0] for pose in came])
    return places, np.full(given.seen.shape, np.nan)


def measured(case: Case, lacking: str, clips: dict[str, tuple[Pose, Prior]], live: bool) -> str:
    """Mean distances from the truth where joints were hidden and seen, and what is expected."""
    rows = []
    for n, (pose, prior) in enumerate(clips.values()):
        truth = recorded(pose, case)
        truth = turned_away(truth) if lacking.endswith("away") else truth
        given = without(damaged(truth, case.noise(truth.rate), n + 1).seen_in(truth), lacking)
        places, expected = (as_it_comes if live else afterwards)(given, prior)
        off = np.linalg.norm(places - truth.positions, axis=2)
        there = ~np.isnan(off)
        rows.append(np.stack([off, expected, given.seen], axis=-1)[there])
    off, expected, seen = np.concatenate(rows).T
    hidden = seen == 0.0
    found = f"{off[hidden].mean():5.1f} mm hidden, {off[~hidden].mean():5.2f} seen"
    if live:
        return found
    true, told = (float(np.sqrt(np.mean(x[hidden] ** 2))) for x in (off, expected))
    return f"{found}; root mean squares {true:5.1f}, expected {told:5.1f}"


def main() -> None:
    """Measure and print."""
    recordings = {Path(name).stem: mm.read_pose(name) for name in sys.argv[1:]}
    clips = {name: (pose, prior) for name, pose, prior in unseen(recordings)}
    for case in CASES:
        live = case.burst_s == 0.25
        if live or (case.slow and case.burst_s):
            for lacking in LACKING:
                found = measured(case, lacking, clips, live)
                how = "as they come" if live else "afterwards"
                line = f"{case.name}, {case.kind}, {how}, lacking {lacking}: {found}"
                sys.stdout.write(line + "\n")
                sys.stdout.flush()


if __name__ == "__main__":
    main()
