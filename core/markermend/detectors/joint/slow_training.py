"""Learn the confidence of slow changes from drifts put into clean takes, seeded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import overlap
from markermend.detectors.joint.bank import KINDS, LONGEST, SHORTEST, shape_of
from markermend.detectors.joint.detect import detect_joint
from markermend.detectors.joint.drift import Candidates, scan
from markermend.detectors.joint.params import JointParams
from markermend.detectors.joint.slow import Crowd, Ground, crowd_of, prepare, scan_all
from markermend.predictors.left_out import distance_spreads
from markermend.progress import Progress, quiet
from markermend.simulation import contaminate
from markermend.take import Take, is_unlabelled

AMPLITUDES_MM = (5.0, 10.0, 20.0)
MEAN_LENGTH, APART = 50, 150
SUDDEN, SHARE = (Kind.PEAK, Kind.NOISE, Kind.STEP), 0.05
OBLIQUE = 0.15
"""Share of drifts that go astray in a direction of their own, on all three axes."""
REAL = 0.5


@dataclass(frozen=True, eq=False)
class Examples:
    """Candidates with the truth.

    Attributes
    ----------
    features : (n, k)
    real : (n,) bool, whether half of it is a drift and half of that drift is it
    drift : (n,) int64 number of the drift it touches; −1 on the clean take
    drawn : (drifts, 3) each drift's mean amplitude in mm, its own, and its kind's number
    minutes : marker minutes of clean take looked at
    """

    features: FloatArray
    real: BoolArray
    drift: IntArray
    drawn: FloatArray
    minutes: float


def examples_of(
    take: Take, flaws: Sequence[Artifact], *, rounds: int, seed: int, jobs: int = 1
) -> Examples:
    """Measure candidates on a clean take and on damaged copies of it.

    Parameters
    ----------
    take : clean recording
    flaws : what is damaged in it already; left out
    rounds : damaged copies of each marker
    seed : same seed, same examples
    jobs : processes
    """
    from joblib import Parallel, delayed

    labels = [label for label in take.labels if not is_unlabelled(label)]
    markers = [take.index(label) for label in labels]
    ground = prepare(take, markers, flaws)
    with threadpool_limits(1):
        clean = scan_all(ground, jobs, quiet)
        crowd = crowd_of(clean, ground)
        spreads = distance_spreads(ground.positions, ground.trusted)
        seeds = np.random.SeedSequence(seed).spawn(rounds * len(markers))
        damaged = Parallel(n_jobs=jobs)(
            delayed(_damaged)(ground, m % len(markers), spreads, crowd, s)
            for m, s in enumerate(seeds)
        )
    parts = [
        (f.features, np.zeros(len(f), dtype=bool), np.full(len(f), -1))
        for f in (crowd.fill_in(one, m) for m, one in enumerate(clean))
    ]
    drawn: list[FloatArray] = []
    for features, real, drift, sizes in damaged:
        parts.append((features, real, drift + sum(len(d) for d in drawn)))
        drawn.append(sizes)
    features, real, drift = (np.concatenate(p) for p in zip(*parts, strict=True))
    minutes = crowd.minutes * len(markers)
    return Examples(features, real, drift, np.concatenate(drawn), minutes)


def suddenly_damaged(take: Take, seed: int) -> tuple[Take, list[Artifact]]:
    """Damage a take suddenly, and find that: what the search for slow changes starts from."""
    labels = [label for label in take.labels if not is_unlabelled(label)]
    damaged, _ = contaminate(
        take, share=SHARE, amplitude_mm=10.0, kinds=SUDDEN, markers=labels, seed=seed
    )
    with threadpool_limits(1):
        return damaged, detect_joint(damaged, JointParams(slow=False), None, quiet)


def _damaged(
    ground: Ground, marker: int, spreads: FloatArray, crowd: Crowd, seed: np.random.SeedSequence
) -> tuple[FloatArray, BoolArray, IntArray, FloatArray]:
    """Candidates that touch drifts put into one marker."""
    rng = np.random.default_rng(seed)
    positions, drifts, drawn = ground.positions.copy(), [], []
    kinds = list(KINDS)
    at = int(rng.integers(20, 20 + APART))
    while at + LONGEST < len(positions):
        spread_out = rng.random() < 0.25
        length = rng.integers(SHORTEST, LONGEST + 1) if spread_out else rng.poisson(MEAN_LENGTH)
        length = int(np.clip(length, SHORTEST, LONGEST))
        mean = float(rng.choice(AMPLITUDES_MM))
        size = abs(rng.normal(mean, 0.4 * mean))
        way = rng.standard_normal(3)
        if rng.random() >= OBLIQUE:
            way = np.eye(3)[rng.integers(3)] * rng.choice([-1.0, 1.0])
        way /= np.linalg.norm(way)
        kind = rng.choice([0, 0, 1, 2, 3])
        deviation = size * shape_of(kinds[kind], length)[:, None] * way
        positions[at : at + length, marker] += deviation
        drifts.append((at, at + length, np.abs(way) > 0.3))
        drawn.append((mean, size, kind, 3 * marker + int(np.abs(way).argmax()), at, length))
        at += length + APART
    one = scan(positions, marker, ground.known[:, marker], ground.trusted, spreads)
    judged = crowd.fill_in(one, marker, among=False)
    real, drift = _hits(judged, drifts)
    touched = drift >= 0
    return judged.features[touched], real[touched], drift[touched], np.array(drawn).reshape(-1, 6)


def _hits(
    candidates: Candidates, drifts: Sequence[tuple[int, int, BoolArray]]
) -> tuple[BoolArray, IntArray]:
    """Whether each candidate is one of the drifts, and which it touches, −1 for none."""
    real = np.zeros(len(candidates), dtype=bool)
    touched = np.full(len(candidates), -1)
    for i in range(len(candidates)):
        place = (int(candidates.start[i]), int(candidates.stop[i]))
        shares = [overlap(place, drift[:2]) for drift in drifts]
        if shares and max(shares) > 0:
            j = int(np.argmax(shares))
            touched[i] = j
            real[i] = shares[j] >= REAL and drifts[j][2][int(candidates.axis[i])]
    return real, touched
