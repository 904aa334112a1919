"""A body settles where its noisy joints and the way it is built agree."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from markermend.poses.body import settling
from markermend.poses.body.bending import find_bends
from markermend.poses.body.settling import settle, settle_in_time
from markermend.poses.quaternion import turn, unit
from markermend.poses.solving import solved

PARENTS = (-1, 0, 1, 2)


def chain(frames=200):
    """Three joints that turn about z alone, on bones of constant length."""
    t = np.linspace(0, 6, frames)
    angles = np.cumsum([np.sin(t + k) for k in range(3)], axis=0)
    features = np.zeros((frames, 4, 7))
    features[..., 6] = 1.0
    for k in range(3):
        half = 0.5 * angles[k]
        features[:, k + 1, 5], features[:, k + 1, 6] = np.sin(half), np.cos(half)
        bone = np.broadcast_to([0.0, 1.0, 0.2], (frames, 3))
        features[:, k + 1, :3] = features[:, k, :3] + turn(features[:, k, 3:], bone)
    return features


def test_true_poses_stay_and_noisy_ones_come_nearer():
    truth = chain()
    variance = np.full(truth.shape, 0.01**2)
    assert_allclose(settle(truth, variance, truth, PARENTS, range(4), 60.0), truth, atol=5e-4)
    noisy = truth.copy()
    noisy[:, 1:] += np.random.default_rng(0).normal(0, 0.01, noisy[:, 1:].shape)
    noisy[..., 3:] = unit(noisy[..., 3:])
    # The sign of a quaternion says nothing about the pose, and stays as it was given.
    noisy[50:, 2, 3:] *= -1.0
    settled = settle(noisy, variance, noisy, PARENTS, range(4), 60.0)
    assert (np.sum(settled[..., 3:] * noisy[..., 3:], axis=2) > 0.99).all()
    settled[50:, 2, 3:] *= -1.0
    noisy[50:, 2, 3:] *= -1.0
    assert np.abs(settled - truth).mean() < 0.85 * np.abs(noisy - truth).mean()


def test_limbs_do_not_turn_with_a_root_that_shakes():
    truth = chain()
    shaking = np.random.default_rng(2).normal(0, 0.02, (200, 3))
    truth[:, 0, 3:] = unit(np.append(shaking, np.ones((200, 1)), axis=1))
    # The first joint sits on the root, and shakes with it; how it is turned does not.
    bone = np.broadcast_to([0.0, 1.0, 0.2], (200, 3))
    truth[:, 1:, :3] += (turn(truth[:, 0, 3:], bone) - bone)[:, None]
    bends = find_bends(truth, PARENTS, range(4))
    assert bends.at.shape[1] == 2
    assert_allclose(bends.features(bends.at, truth), truth, atol=5e-4)
    step, at = 1e-5, np.arange(0, 200, 20)
    for n in range(2):
        moved = bends.at[at].copy()
        moved[:, n] += step
        change = bends.features(moved, truth[at]) - bends.features(bends.at[at], truth[at])
        told = next(bends.slopes(at, len(at)))[..., n].reshape(len(at), 3, 7)
        assert_allclose(change[:, 1:] / step, told, atol=2e-3)


def test_what_is_hardly_known_follows_the_rest():
    truth = chain()
    features, variance = truth.copy(), np.full(truth.shape, 1e-6)
    features[80:90, 3, :3] += 0.3
    variance[80:90, 3, :3] = 0.1
    settled = settle(features, variance, truth, PARENTS, range(4), 60.0)
    assert np.abs(settled - truth)[80:90, 3].max() < 0.01


def test_what_single_precision_cannot_tell_is_told_in_double(monkeypatch):
    truth = chain()
    noisy, variance = truth + 1e-4 * np.sin(np.arange(truth.size)).reshape(truth.shape), 1e-8
    given = noisy, np.full(truth.shape, variance), truth, PARENTS, range(4), 60.0
    settled = settle(*given)

    def fails_in_single(system, right):
        if system.dtype == np.float32:
            raise np.linalg.LinAlgError
        return solved(system, right)

    monkeypatch.setattr(settling, "solved", fails_in_single)
    assert_allclose(settle(*given), settled, atol=1e-6)


def test_joints_smoothed_in_time_come_nearer_than_each_pose_by_itself():
    truth = chain(400)
    variance = np.full(truth.shape, 0.02**2)
    noisy = truth.copy()
    noisy[:, 1:] += np.random.default_rng(1).normal(0, 0.02, noisy[:, 1:].shape)
    unmeasured = np.s_[100:130, 3, :3]
    pilot = settle(noisy, variance, truth, PARENTS, range(4), 60.0)
    noisy[unmeasured] = pilot[unmeasured]
    noisy[50:, 2, 3:] *= -1.0
    found = settle_in_time(noisy, variance, pilot, PARENTS, range(4), 60.0)
    assert (np.sum(found[..., 3:] * noisy[..., 3:], axis=2) > 0.9).all()
    found[50:, 2, 3:] *= -1.0
    assert np.abs(found - truth).mean() < 0.65 * np.abs(pilot - truth).mean()
    assert np.abs(found - truth)[unmeasured].mean() < 0.7 * np.abs(pilot - truth)[unmeasured].mean()


def test_a_body_that_never_bends_stays():
    still = np.tile(chain()[:1], (50, 1, 1))
    variance = np.full(still.shape, 0.01**2)
    assert_allclose(settle(still, variance, still, PARENTS, range(4), 60.0), still, atol=1e-12)
    assert_allclose(
        settle_in_time(still, variance, still, PARENTS, range(4), 30.0), still, atol=1e-12
    )
