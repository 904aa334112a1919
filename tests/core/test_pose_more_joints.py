"""Bodies that have joints besides those that a prior knows: hands, feet, faces."""

from __future__ import annotations

import numpy as np
import pytest
from sensed_bodies import with_hands

import markermend as mm
from markermend.bench.poses import CASES, damaged
from markermend.poses.filling.covariance import Moments, pooled
from markermend.poses.live import Live
from markermend.poses.normal import FEATURES
from markermend.poses.nuitrack import JOINTS, to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.prior import fitting
from markermend.poses.prior_learning import learn_prior
from markermend.poses.restore import restore

LEG = ("hip", "knee", "ankle", "foot")


@pytest.fixture(scope="module")
def clips(shared_data):
    return [mm.read_pose(shared_data / "poses" / name) for name in ("02_05.amc", "03_04.amc")]


@pytest.fixture(scope="module")
def prior(clips):
    return learn_prior([clips[1]])


@pytest.fixture(scope="module")
def body(clips):
    return with_hands(clips[0])


def test_a_prior_tells_of_the_joints_that_it_knows_in_the_size_of_its_own_bones(body, prior):
    fit = fitting(body, prior)
    assert fit is not None
    moments, left_handed = fit
    assert not left_handed
    names = [name for name in body.joints if name != body.joints[body.order[0]]]
    told = moments.told.reshape(-1, FEATURES)[:, 0]
    assert [n for n, known in zip(names, told, strict=True) if known] == list(JOINTS[1:])
    alone, _ = fitting(to_nuitrack(body), prior)
    assert alone.told is None
    # Bones of hands are short, so beside them others count for more.
    scale = moments.mean[moments.told].reshape(-1, FEATURES)[:, :3] / np.where(
        alone.mean.reshape(-1, FEATURES)[:, :3] == 0, 1.0, alone.mean.reshape(-1, FEATURES)[:, :3]
    )
    assert np.ptp(scale) < 1e-6
    assert scale.mean() > 1.1


def test_a_body_that_lacks_a_joint_of_the_prior_does_not_fit(body, prior):
    kept = [j for j, name in enumerate(body.joints) if name != "left_ankle"]
    kept = [j for j in kept if body.joints[j] != "left_foot"]
    parents = [kept.index(body.parents[j]) if body.parents[j] >= 0 else -1 for j in kept]
    less = Pose(
        body.positions[:, kept],
        body.rotations[:, kept],
        tuple(body.joints[j] for j in kept),
        tuple(parents),
        body.rate,
        body.confidence[:, kept],
    )
    assert fitting(less, prior) is None


def test_what_is_not_told_of_moves_with_the_rest_as_the_recording_has_it():
    rng = np.random.default_rng(1)
    rows = rng.normal(size=(500, 3))
    rows[:, 2] = 2.0 * rows[:, 1]
    own = Moments(np.zeros(3), rows.T @ rows / 500, np.stack([np.eye(3)]), 500.0, np.ones(1))
    wide = np.diag([4.0, 9.0, 0.0])
    told = np.array([True, True, False])
    others = Moments(np.zeros(3), wide, wide[None], 500.0, np.ones(1), told)
    both = pooled(own, others).whole
    assert both[1, 1] == pytest.approx(0.5 * (own.whole[1, 1] + 9.0))
    assert both[1, 2] == pytest.approx(2.0 * both[1, 1], rel=0.01)
    assert np.linalg.eigvalsh(both).min() > -1e-9


def test_a_prior_of_fewer_joints_brings_hidden_joints_nearer(body, prior):
    short = slice(0, round(5 * body.rate), 4)
    samples = body.positions[short], body.rotations[short], body.confidence[short]
    truth = Pose(*samples[:2], body.joints, body.parents, body.rate / 4, samples[2])
    (case,) = (c for c in CASES if c.slow and c.kind == "occlusions")
    seen = damaged(truth, case.noise(truth.rate), seed=5).seen_in(truth).seen
    seen[0] = True
    given = truth.with_samples(truth.positions, truth.rotations, seen.astype(float))
    off = {}
    for learnt in (None, prior):
        restored = restore(given, prior=learnt)
        away = np.linalg.norm(restored.pose.positions - truth.positions, axis=2)
        off[learnt is not None] = away[~given.seen].mean()
        if learnt is not None:
            said = restored.error_mm[restored.filled]
            assert 0.4 < np.sqrt(np.mean(away[restored.filled] ** 2) / np.mean(said**2)) < 2.5
    assert off[True] < 0.9 * off[False]


def test_live_a_prior_of_fewer_joints_brings_hidden_joints_nearer(prior, shared_data):
    body = with_hands(mm.read_pose(shared_data / "poses" / "01_05.amc"))
    rng, frames = np.random.default_rng(2), round(4 * body.rate)
    confidence = np.ones(body.confidence.shape)
    for start in range(60, frames, 60):
        confidence[start : start + 30, rng.permutation(np.arange(1, 25))[:3]] = 0.0
    given = body.with_samples(body.positions, body.rotations, confidence)
    off = {}
    for learnt in (None, prior):
        first = body.positions[:1], body.rotations[:1]
        live = Live(Pose(*first, body.joints, body.parents, body.rate, np.ones((1, 25))), learnt)
        assert live.by_prior == (learnt is not None)
        places = np.array(
            [live(given.positions[n], given.rotations[n], given.seen[n])[0] for n in range(frames)]
        )
        away = np.linalg.norm(places - body.positions[:frames], axis=2)
        off[learnt is not None] = away[~given.seen[:frames]].mean()
    assert off[True] < 0.9 * off[False]


def test_legs_that_join_late_leave_the_prior_in_the_size_of_the_body(prior, shared_data):
    body = with_hands(mm.read_pose(shared_data / "poses" / "03_03.amc"))
    legs = [j for j, name in enumerate(body.joints) if name.split("_")[-1] in LEG]
    covariances = []
    for first in (0, 10):
        seen = np.ones(body.seen.shape, dtype=bool)
        seen[:first, legs] = False
        one = body.positions[:1], body.rotations[:1], body.joints, body.parents, body.rate
        live = Live(Pose(*one, seen[:1].astype(float)), prior)
        for n in range(11):
            live(body.positions[n], body.rotations[n], seen[n])
        # What moves most, in mm: the body measures in other units before its legs come.
        scale = live._following._scale**2
        covariances.append(scale * np.diagonal(live._following._levels._covariance))
    wide = covariances[0] > np.quantile(covariances[0], 0.8)
    np.testing.assert_allclose(covariances[1][wide], covariances[0][wide], rtol=0.25)
