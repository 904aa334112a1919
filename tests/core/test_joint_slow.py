"""Slow changes: whitening, the bank of shapes, trees as arrays, and drifts found end to end."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.detectors.joint import JointParams
from markermend.detectors.joint.bank import bank, scores, shape_of
from markermend.detectors.joint.drift import FEATURES, scan
from markermend.detectors.joint.slow import prepare, shipped_trees
from markermend.detectors.joint.slow_training import examples_of
from markermend.detectors.joint.trees import from_scikit, load_trees
from markermend.detectors.joint.whiten import whiten
from markermend.simulation import simulate_clean
from markermend.take import Take

LABELS = ("LFHD", "RFHD", "LBHD", "RBHD", "C7", "LSHO", "RSHO", "CLAV")


@pytest.fixture(scope="module")
def performer():
    return simulate_clean(duration_s=12.0, rate=120.0, seed=6)


def drifted(take, marker, axis, start, deviation):
    positions = take.positions.copy()
    positions[start : start + len(deviation), take.index(marker), axis] += deviation
    return Take(positions, take.labels, take.rate)


def red_noise(frames, seed=0):
    white = np.random.default_rng(seed).standard_normal(frames)
    red = np.zeros(frames)
    for t in range(2, frames):
        red[t] = 1.6 * red[t - 1] - 0.65 * red[t - 2] + 0.1 * white[t]
    return red, 0.1 * white


def test_whitening_recovers_the_innovations():
    red, white = red_noise(3000)
    w = whiten(red, np.zeros(3000), np.ones(3000, dtype=bool))
    assert np.corrcoef(w.error[100:], white[100:])[0, 1] > 0.98
    assert np.median(w.sigma) == pytest.approx(0.1, rel=0.15)
    lagged = [np.corrcoef(w.error[100:-k], w.error[100 + k :])[0, 1] for k in (1, 2, 3)]
    assert np.abs(lagged).max() < 0.1


@pytest.mark.parametrize("kind", ["sharp", "rounded", "hann"])
def test_the_bank_finds_its_own_shapes(kind):
    red, _ = red_noise(2000, seed=1)
    red[900:950] += 4.0 * shape_of(kind, 50)
    score, size = scores(whiten(red, np.zeros(2000), np.ones(2000, dtype=bool)))
    frame, best = np.unravel_index(np.abs(score).argmax(), score.shape)
    assert abs(frame - 900) <= 8
    assert abs(bank()[1][best][1] - 50) <= 12
    assert size[frame, best] == pytest.approx(4.0, rel=0.25)


def test_scores_of_pure_noise_are_standard_normal():
    red, _ = red_noise(4000, seed=2)
    score, _ = scores(whiten(red, np.zeros(4000), np.ones(4000, dtype=bool)))
    assert score[200:3600, 10].std() == pytest.approx(1.0, abs=0.2)


def test_shapes_have_height_one_and_end_at_nothing():
    for kind in ("sharp", "rounded", "hann"):
        for length in (22, 51, 100):
            shape = shape_of(kind, length)
            assert len(shape) == length
            assert shape.max() == pytest.approx(1.0, rel=0.01)
            assert (shape >= 0).all()
            assert max(shape[0], shape[-1]) < 0.15


def test_trees_agree_with_scikit_learn(tmp_path):
    from sklearn.ensemble import GradientBoostingClassifier

    rng = np.random.default_rng(0)
    rows = rng.standard_normal((600, 5))
    real = rows[:, 0] * rows[:, 1] + rows[:, 2] > 0.3
    model = GradientBoostingClassifier(n_estimators=30, max_depth=3, random_state=0)
    model.fit(rows, real)
    trees = from_scikit(model)
    assert np.allclose(trees.log_odds(rows), model.decision_function(rows))
    trees.save(tmp_path / "trees.npz")
    stored = load_trees(tmp_path / "trees.npz")
    assert np.allclose(stored.log_odds(rows), model.decision_function(rows))


def test_shipped_trees_fit_the_features():
    trees = shipped_trees()
    assert trees.feature.max() < len(FEATURES)
    assert np.isfinite(trees.log_odds(np.ones((3, len(FEATURES))))).all()


@pytest.mark.parametrize(("kind", "length"), [("sharp", 50), ("hann", 50)])
def test_a_drift_is_found_and_named(performer, kind, length):
    take = drifted(performer, "LBHD", 2, 700, 20.0 * shape_of(kind, length))
    found = mm.detect(take, method="joint", params=JointParams(jobs=1))
    (a,) = [a for a in found if a.kind is not Kind.GAP]
    assert (a.marker, a.axes, a.kind) == ("LBHD", "z", Kind.SLOW)
    assert abs(a.start - 700) <= 10
    assert abs(a.stop - 700 - length) <= 10
    assert a.amplitude_mm == pytest.approx(20.0, rel=0.3)
    assert "drifts" in a.why


def test_a_clean_performance_does_not_drift(performer):
    found = mm.detect(performer, method="joint", params=JointParams(jobs=1))
    assert [a for a in found if a.kind is Kind.SLOW] == []


def test_mending_undoes_steps_and_swaps(performer):
    head, other = performer.index("LFHD"), performer.index("RFHD")
    positions = performer.positions.copy()
    positions[300:360, 4, 1] += 15.0
    positions[600:640, [head, other]] = positions[600:640, [other, head]]
    take = Take(positions, performer.labels, performer.rate)
    sudden = [
        Artifact(take.labels[4], "y", 300, 360, Kind.STEP),
        Artifact("LFHD", "xyz", 600, 640, Kind.STEP, counterpart="RFHD"),
    ]
    ground = prepare(take, range(take.markers), sudden)
    assert np.abs(ground.positions - performer.positions).max() < 1.5
    assert ground.trusted.all()


def test_fast_takes_are_thinned():
    take = simulate_clean(duration_s=4.0, rate=240.0, seed=1, labels=LABELS)
    ground = prepare(take, range(take.markers), [])
    assert ground.thin == 2
    assert len(ground.positions) == take.frames // 2


def test_few_frames_or_markers_are_passed_over():
    short = simulate_clean(duration_s=1.5, seed=1, labels=LABELS)
    few = simulate_clean(duration_s=4.0, seed=1, labels=LABELS[:3])
    for take in (short, few):
        found = mm.detect(take, method="joint", params=JointParams(jobs=1, sensitivity=1.0))
        assert [a for a in found if a.kind is Kind.SLOW] == []


def test_examples_are_seeded_and_of_both_sorts():
    take = simulate_clean(duration_s=6.0, seed=3, labels=LABELS)
    first = examples_of(take, (), rounds=1, seed=1)
    again = examples_of(take, (), rounds=1, seed=1)
    assert all(np.array_equal(a, b) for a, b in zip(first, again, strict=True))
    features, real, weight = first
    assert features.shape == (len(real), len(FEATURES)) == (len(weight), len(FEATURES))
    assert 0 < real.sum() < len(real)


def test_a_marker_without_a_body_has_no_candidates():
    positions = np.full((600, 5, 3), np.nan)
    positions[:, 0] = np.cumsum(np.ones((600, 3)), axis=0)
    known = ~np.isnan(positions)
    assert len(scan(positions, 0, known[:, 0], known.all(axis=2)).candidates.axis) == 0
