"""Learn the confidence of slow changes from drifts put into clean takes, seeded."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import overlap
from markermend.detectors.joint.bank import LONGEST, SHORTEST, shape_of
from markermend.detectors.joint.detect import detect_joint
from markermend.detectors.joint.drift import Candidates, Scan, scan
from markermend.detectors.joint.neighbours import nearest_markers
from markermend.detectors.joint.params import JointParams
from markermend.detectors.joint.slow import Ground, beside, prepare
from markermend.detectors.joint.trees import DEPTH, Trees, from_scikit
from markermend.progress import Progress, quiet
from markermend.simulation import contaminate
from markermend.take import Take, is_unlabelled

AMPLITUDES_MM = (5.0, 10.0, 20.0)
KINDS = ("sharp", "sharp", "rounded", "hann")
MEAN_LENGTH, APART = 50, 260
SUDDEN, SHARE = (Kind.PEAK, Kind.NOISE, Kind.STEP), 0.05
ECHOES = 2
"""Neighbours of a damaged marker that are looked at too, to learn what an echo is."""
REAL = 0.5
RARER = 40.0
"""Drifts in training are so many times as dense as in the takes people have."""


def examples_of(
    take: Take, flaws: Sequence[Artifact], *, rounds: int, seed: int
) -> tuple[FloatArray, BoolArray, FloatArray]:
    """Measure candidates on a clean take and on damaged copies of it.

    Parameters
    ----------
    take : clean recording
    flaws : what is damaged in it already; left out
    rounds : damaged copies of each marker
    seed : same seed, same examples

    Returns
    -------
    features : (n, 18)
    real : (n,) bool
    weight : (n,) how often each counts: false ones of the clean take once, others less
    """
    labels = [label for label in take.labels if not is_unlabelled(label)]
    markers = [take.index(label) for label in labels]
    ground = prepare(take, markers, flaws)
    neighbours = nearest_markers(take, markers)
    rng = np.random.default_rng(seed)
    with threadpool_limits(1):
        count = len(markers)
        clean = [
            scan(ground.positions, m, ground.known[:, m], ground.trusted) for m in range(count)
        ]
        rows, real, weight = [], [], []
        for m, one in enumerate(clean):
            judged = beside(one.candidates, [clean[n].loudness for n in neighbours[m]])
            rows.append(judged.features)
            real.append(np.zeros(len(judged.axis), dtype=bool))
            weight.append(np.ones(len(judged.axis)))
        for m in list(range(count)) * rounds:
            for features, hit in _damaged(ground, m, neighbours, clean, rng):
                rows.append(features)
                real.append(hit)
                weight.append(np.ones(len(hit)))
    return np.concatenate(rows), np.concatenate(real), np.concatenate(weight)


def suddenly_damaged(take: Take, seed: int) -> tuple[Take, list[Artifact]]:
    """Damage a take suddenly, and find that: what the search for slow changes starts from."""
    labels = [label for label in take.labels if not is_unlabelled(label)]
    damaged, _ = contaminate(
        take, share=SHARE, amplitude_mm=10.0, kinds=SUDDEN, markers=labels, seed=seed
    )
    with threadpool_limits(1):
        return damaged, detect_joint(damaged, JointParams(slow=False), None, quiet)


def _damaged(
    ground: Ground, marker: int, neighbours: IntArray, clean: Sequence[Scan], rng: Any
) -> list[tuple[FloatArray, BoolArray]]:
    """Candidates on a marker with drifts put in, and their echoes on some of its neighbours."""
    positions, drifts = ground.positions.copy(), []
    axis = int(rng.integers(3))
    at = int(rng.integers(20, 20 + APART))
    while at + LONGEST < len(positions):
        length = int(np.clip(rng.poisson(MEAN_LENGTH), SHORTEST, LONGEST))
        mean = float(rng.choice(AMPLITUDES_MM))
        size = abs(rng.normal(mean, 0.4 * mean)) * rng.choice([-1.0, 1.0])
        shape = shape_of(str(rng.choice(KINDS)), length)
        positions[at : at + length, marker, axis] += size * shape
        drifts.append((at, at + length))
        at += length + APART
    one = scan(positions, marker, ground.known[:, marker], ground.trusted)
    echoes = list(rng.permutation(neighbours[marker])[:ECHOES])
    heard = {int(n): scan(positions, int(n), ground.known[:, n], ground.trusted) for n in echoes}
    loudness = {int(n): heard.get(int(n), clean[n]).loudness for n in neighbours[marker]}
    judged = beside(one.candidates, list(loudness.values()))
    hit, touched = _hits(judged, drifts)
    true = hit & (judged.axis == axis)
    kept = touched
    out = [(judged.features[kept], true[kept])]
    for n, echo in heard.items():
        around = [one.loudness if k == marker else clean[k].loudness for k in neighbours[n]]
        judged = beside(echo.candidates, around)
        _, touched = _hits(judged, drifts)
        out.append((judged.features[touched], np.zeros(int(touched.sum()), dtype=bool)))
    return out


def _hits(candidates: Candidates, drifts: Sequence[tuple[int, int]]) -> tuple[BoolArray, BoolArray]:
    """Whether each candidate is one of the drifts, and whether it touches one at all."""
    shares = np.zeros((len(candidates.axis), max(len(drifts), 1)))
    for i in range(len(candidates.axis)):
        for j, drift in enumerate(drifts):
            shares[i, j] = overlap((int(candidates.start[i]), int(candidates.stop[i])), drift)
    best = shares.max(axis=1)
    return best >= REAL, best > 0


def fit_trees(features: FloatArray, real: BoolArray, weight: FloatArray, *, seed: int = 0) -> Any:
    """Fit boosted trees; returns scikit-learn's model, see :func:`to_trees`."""
    from sklearn.ensemble import GradientBoostingClassifier

    model = GradientBoostingClassifier(
        n_estimators=200,
        max_depth=DEPTH,
        learning_rate=0.08,
        subsample=0.6,
        min_samples_leaf=20,
        random_state=seed,
    )
    return model.fit(features, real, sample_weight=weight)


def to_trees(model: Any) -> Trees:
    """Turn a fitted model into arrays, its odds made those of takes as they come."""
    trees = from_scikit(model)
    bias = trees.bias - math.log(RARER)
    return Trees(trees.feature, trees.threshold, trees.left, trees.right, trees.value, bias)


def train_slow(
    takes: Sequence[tuple[Take, Sequence[Artifact]]],
    *,
    rounds: int = 2,
    seed: int = 0,
    progress: Progress | None = None,
) -> Trees:
    """Learn from clean takes.

    Parameters
    ----------
    takes : clean recordings, each with what is damaged in it already
    rounds : damaged copies of each marker
    seed : same takes and seed, same trees
    progress : told the share done; may raise ``Cancelled``
    """
    report = progress or quiet
    parts = []
    for i, (take, flaws) in enumerate(takes):
        report(i / len(takes), "drifting")
        parts.append(examples_of(take, flaws, rounds=rounds, seed=seed + i))
        report((i + 0.5) / len(takes), "drifting")
        worn, found = suddenly_damaged(take, seed + i)
        parts.append(examples_of(worn, [*flaws, *found], rounds=rounds, seed=seed + i))
    features, real, weight = (np.concatenate(p) for p in zip(*parts, strict=True))
    return to_trees(fit_trees(features, real, weight, seed=seed))
