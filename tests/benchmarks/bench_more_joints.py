"""Bodies of 25 joints, restored with a prior of 17 that learnt from other people, and without one.

python tests/benchmarks/bench_more_joints.py 01_05.amc 02_05.amc 03_04.amc
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.arrays import FloatArray
from markermend.bench.poses import CASES, Case, damaged, recorded, unseen
from markermend.poses.live import Live
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior
from markermend.poses.restore import restore

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "helpers"))
from sensed_bodies import with_hands

SHORT_S = 8.0


def spoilt(pose: Pose, case: Case, seed: int) -> tuple[Pose, Pose]:
    """The truth, and what a sensor would have seen of it; the first pose whole."""
    truth = recorded(pose, case)
    noise = replace(case.noise(truth.rate), limbs=False)
    given = damaged(truth, noise, seed).seen_in(truth)
    first = np.arange(truth.frames) == 0
    positions, rotations = (
        np.where(first[:, None, None], right, own)
        for right, own in (
            (truth.positions, given.positions),
            (truth.rotations, given.rotations),
        )
    )
    confidence = np.where(first[:, None], 1.0, given.confidence)
    return truth, given.with_samples(positions, rotations, confidence)


def afterwards(truth: Pose, given: Pose, prior: Prior | None) -> FloatArray:
    """(n, 2) mm off and expected where joints were hidden."""
    restored = restore(given, prior=prior)
    off = np.linalg.norm(restored.pose.positions - truth.positions, axis=2)
    return np.stack([off, restored.error_mm], axis=-1)[restored.filled]


def as_it_comes(truth: Pose, given: Pose, prior: Prior | None) -> FloatArray:
    """The same, pose by pose; nothing is expected there."""
    first = given.positions[:1], given.rotations[:1]
    live = Live(Pose(*first, given.joints, given.parents, given.rate, given.confidence[:1]), prior)
    came = zip(given.positions, given.rotations, given.seen, strict=True)
    places = np.array([live(*pose)[0] for pose in came])
    off = np.linalg.norm(places - truth.positions, axis=2)[~given.seen]
    return np.stack([off, np.full(len(off), np.nan)], axis=-1)


def main() -> None:
    """Measure and print."""
    clips = {Path(name).stem: mm.read_pose(name) for name in sys.argv[1:]}
    priors = {name: prior for name, _, prior in unseen(clips)}
    tried = [
        (case, seconds, run)
        for case in CASES
        for seconds in (np.inf, SHORT_S)
        for run in (afterwards, as_it_comes)
        if (case.slow and case.burst_s and run is afterwards)
        or (case.burst_s == 0.25 and case.kind == "occlusions" and run is as_it_comes)
    ]
    for case, seconds, run in tried:
        for with_prior in (False, True):
            rows = []
            for n, (name, pose) in enumerate(clips.items()):
                body = with_hands(pose)
                some = slice(None if seconds == np.inf else round(seconds * pose.rate))
                samples = body.positions[some], body.rotations[some]
                body = Pose(*samples, body.joints, body.parents, pose.rate, body.confidence[some])
                truth, given = spoilt(body, case, n + 1)
                if given.seen.any(axis=0).all():
                    rows.append(run(truth, given, priors[name] if with_prior else None))
            off, expected = np.concatenate(rows).T
            said = "" if np.isnan(expected).all() else f", {np.sqrt(np.mean(expected**2)):.1f} said"
            sys.stdout.write(
                f"{case.name}, {case.kind}, {run.__name__}, {seconds:g} s at most,"
                f" {'with' if with_prior else 'no'} prior: {off.mean():.1f} mm off, root mean"
                f" square {np.sqrt(np.mean(off**2)):.1f}{said}\n"
            )
            sys.stdout.flush()


if __name__ == "__main__":
    main()
