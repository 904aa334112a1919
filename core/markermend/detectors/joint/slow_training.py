"""Learn the confidence of slow changes from drifts put into clean takes, seeded."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import overlap
from markermend.detectors.joint.bank import KINDS, LONGEST, SHORTEST, shape_of
from markermend.detectors.joint.detect import detect_joint
from markermend.detectors.joint.drift import Candidates, scan
from markermend.detectors.joint.judge import LIKELY, Judge, evidence, is_sharp, quiet_levels
from markermend.detectors.joint.measures import FEATURES
from markermend.detectors.joint.params import JointParams
from markermend.detectors.joint.refilled import Spot, unevenness
from markermend.detectors.joint.slow import (
    RATE,
    Crowd,
    Ground,
    crowd_of,
    prepare,
    scan_all,
    spots_of,
)
from markermend.detectors.joint.trees import Trees, from_scikit
from markermend.files.pose import read_pose
from markermend.predictors.cross_fit import distance_spreads
from markermend.progress import Progress, quiet
from markermend.simulation import contaminate
from markermend.simulation.dress import dress
from markermend.take import Take, is_unlabelled

DENSITY = 0.2
"""Drifts a marker and minute that confidence reckons with."""
RAISED = 20.0
"""Drifts count so many times as often in learning; their odds are set right afterwards."""
FOLDS, MODELS, TREES = 4, 3, 120
RISING = (
    *("score", "reweighted", "raw score", "without a part", "without a band"),
    *("weakest view", "t gain", "over spread", "explained", "quieter"),
)
FALLING = ("chi²", "left over", "sets out", "stops", "crowd", "take crowd")
MARKERS, LEAST_S = (12, 81), 6.0
AMPLITUDES_MM = (5.0, 10.0, 20.0)
MEAN_LENGTH, APART = 50, 150
SUDDEN, SHARE = (Kind.PEAK, Kind.NOISE, Kind.STEP), 0.05
OBLIQUE = 0.15
"""Share of drifts that go astray in a direction of their own, on all three axes."""
REAL = 0.5
EVEN = 1000.0
"""What all candidates of a take weigh together in learning, so that long takes do not rule."""


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
    ground : the clean take
    tracks : (copies, frames, 3) mm, the damaged marker of each copy
    spots : where each candidate is
    copy : (n,) int64 the copy it is on; −1 for the clean take
    """

    features: FloatArray
    real: BoolArray
    drift: IntArray
    drawn: FloatArray
    minutes: float
    ground: Ground
    tracks: FloatArray
    spots: tuple[Spot, ...]
    copy: IntArray


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
    shown = [crowd.fill_in(one, m) for m, one in enumerate(clean)]
    parts = [(f.features, np.zeros(len(f), dtype=bool), np.full(len(f), -1)) for f in shown]
    spots = [spot for m, one in enumerate(shown) for spot in spots_of(one, m)]
    copy = [np.full(len(spots), -1)]
    drawn: list[FloatArray] = []
    for number, one in enumerate(damaged):
        parts.append((one.features, one.real, one.drift + sum(len(d) for d in drawn)))
        drawn.append(one.drawn)
        spots += one.spots
        copy.append(np.full(len(one.spots), number))
    features, real, drift = (np.concatenate(p) for p in zip(*parts, strict=True))
    return Examples(
        features,
        real,
        drift,
        np.concatenate(drawn),
        crowd.minutes * len(markers),
        ground,
        np.stack([one.track for one in damaged]),
        tuple(spots),
        np.concatenate(copy),
    )


def suddenly_damaged(take: Take, seed: int) -> tuple[Take, list[Artifact]]:
    """Damage a take suddenly, and find that: what the search for slow changes starts from."""
    labels = [label for label in take.labels if not is_unlabelled(label)]
    damaged, _ = contaminate(
        take, share=SHARE, amplitude_mm=10.0, kinds=SUDDEN, markers=labels, seed=seed
    )
    with threadpool_limits(1):
        return damaged, detect_joint(damaged, JointParams(slow=False), None, quiet)


@dataclass(frozen=True, eq=False)
class _Copy:
    """Candidates that touch drifts put into one marker; fields as in :class:`Examples`."""

    features: FloatArray
    real: BoolArray
    drift: IntArray
    drawn: FloatArray
    track: FloatArray
    spots: list[Spot]


def _damaged(
    ground: Ground, marker: int, spreads: FloatArray, crowd: Crowd, seed: np.random.SeedSequence
) -> _Copy:
    """Put drifts into one marker."""
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
    return _Copy(
        judged.features[touched],
        real[touched],
        drift[touched],
        np.array(drawn).reshape(-1, 6),
        positions[:, marker].copy(),
        [spot for spot, touches in zip(spots_of(judged, marker), touched, strict=True) if touches],
    )


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


def collect_slow(
    takes: Iterable[tuple[Take, Sequence[Artifact]]],
    *,
    rounds: int,
    seed: int,
    jobs: int = -1,
    count: int = 0,
    progress: Progress | None = None,
) -> list[Examples]:
    """Measure candidates on several takes, on every other one after it was suddenly damaged.

    Parameters
    ----------
    takes : clean recordings, each with what is damaged in it already
    rounds : damaged copies of each marker
    seed : same takes and seed, same examples
    jobs : processes, a take each
    count : of takes, for the progress
    progress : told after each take; may raise ``Cancelled``
    """
    from joblib import Parallel, delayed

    report, collected = progress or quiet, []
    calls = (
        delayed(_one_take)(take, flaws, rounds, seed + i, i % 2 == 1)
        for i, (take, flaws) in enumerate(takes)
    )
    results = Parallel(n_jobs=jobs, return_as="generator", pre_dispatch="2*n_jobs")(calls)
    try:
        for examples in results:
            collected.append(examples)
            report(len(collected) / max(count, len(collected)), "drifting")
    finally:
        results.close()
    return collected


def _one_take(
    take: Take, flaws: Sequence[Artifact], rounds: int, seed: int, worn: bool
) -> Examples:
    """Examples of one take, as it is or after it was suddenly damaged."""
    if worn:
        take, found = suddenly_damaged(take, seed)
        flaws = [*flaws, *found]
    return examples_of(take, flaws, rounds=rounds, seed=seed)


def dressed(folder: Path, sets: int, seed: int) -> Iterator[Take]:
    """Skeleton recordings of a folder under marker sets of 12 to 80 markers, one after another.

    Parameters
    ----------
    folder : with AMC files and their ASF
    sets : marker sets for each recording; those shorter than six seconds are passed over
    seed : same seed, same takes
    """
    for number in range(sets):
        for i, path in enumerate(sorted(folder.glob("*.amc"))):
            pose = read_pose(path)
            if len(pose.positions) >= LEAST_S * pose.rate:
                one = seed + 1000 * number + i
                markers = int(np.random.default_rng(one).integers(*MARKERS))
                yield dress(pose, markers=markers, seed=one)


def fit_slow(takes: Sequence[Examples], *, seed: int = 0) -> Judge:
    """Learn confidence from the examples of several takes.

    Parameters
    ----------
    takes : examples of each take, two at least
    seed : same examples and seed, same judge

    Returns
    -------
    Judge whose confidence holds where :data:`DENSITY` drifts come on a marker and minute. How the
    trees may be believed on a take that was not learned from is found by leaving takes out.
    """
    read: list[FloatArray] = []
    truth: list[BoolArray] = []
    weight: list[FloatArray] = []
    for fold in range(min(FOLDS, len(takes))):
        trees = _boosted([take for k, take in enumerate(takes) if k % FOLDS != fold], seed)
        for take in takes[fold::FOLDS]:
            odds = trees.log_odds(take.features)
            levels = quiet_levels(odds[take.drift < 0], take.minutes)
            likely = np.flatnonzero(odds > LIKELY)
            sharp, uneven = is_sharp(take.features[likely]), _unevenness(take, likely)
            read.append(evidence(odds[likely], sharp, levels, uneven))
            truth.append(take.real[likely])
            weight.append(_weights(take)[likely])
    weights = _reading(np.concatenate(read), np.concatenate(truth), np.concatenate(weight))
    return Judge(_boosted(takes, seed), weights)


def _unevenness(examples: Examples, rows: IntArray) -> FloatArray:
    """How unlike drifts some candidates are, beside their frames as filled, (n,)."""
    ground, uneven = examples.ground, np.zeros(len(rows))
    positions, last = ground.positions, -1
    with threadpool_limits(1):
        for n, row in enumerate(rows):
            spot, copy = examples.spots[row], int(examples.copy[row])
            if copy != last:
                positions, last = ground.positions.copy(), copy
                positions[:, spot.marker] = examples.tracks[copy]
            uneven[n] = unevenness(positions, ground.trusted, RATE, spot)
    return uneven


def _boosted(takes: Sequence[Examples], seed: int) -> Trees:
    """Trees of several seeds, averaged."""
    return from_scikit([_boost(takes, seed + n) for n in range(MODELS)])


def _weights(examples: Examples) -> FloatArray:
    """How often each candidate comes for once that the clean take is seen."""
    drifts = max(len(examples.drawn), 1)
    return np.where(examples.drift >= 0, DENSITY * examples.minutes / drifts, 1.0)


def _boost(takes: Sequence[Examples], seed: int) -> Any:
    """One fitted ``HistGradientBoostingClassifier``."""
    from sklearn.ensemble import HistGradientBoostingClassifier

    features = np.concatenate([take.features for take in takes])
    real = np.concatenate([take.real for take in takes])
    raised = [_weights(take) * np.where(take.drift >= 0, RAISED, 1.0) for take in takes]
    weight = np.concatenate([w * EVEN / w.sum() for w in raised])
    slopes = [(name in RISING) - (name in FALLING) for name in FEATURES]
    model = HistGradientBoostingClassifier(
        max_iter=TREES,
        learning_rate=0.12,
        max_depth=4,
        min_samples_leaf=40,
        l2_regularization=5.0,
        max_features=0.5,
        monotonic_cst=slopes,
        early_stopping=False,
        random_state=seed,
    )
    return model.fit(features, real, sample_weight=weight)


def _reading(evidence: FloatArray, real: BoolArray, weight: FloatArray) -> FloatArray:
    """Weights of 1 and of the evidence by which log odds become true on what was left out."""
    from sklearn.linear_model import LogisticRegression

    model = LogisticRegression(C=1e6, max_iter=1000).fit(evidence, real, sample_weight=weight)
    return np.concatenate([model.intercept_, model.coef_[0]])
