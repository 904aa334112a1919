"""What is hidden of a body settles where it can be."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.poses.quaternion import NO_TURN, matrices
from markermend.poses.streaming.articulation import Articulation

RATE = 120.0
SHOULDER, ELBOW, WRIST = 0, 1, 2
ABOVE = (-1, SHOULDER, ELBOW)
UNTURNED = np.array(NO_TURN)


def arms(count, seed=0):
    """(count, 21) an arm whose shoulder turns freely and whose elbow bends about one axis."""
    random = np.random.default_rng(seed)
    upper = Rotation.from_rotvec(random.normal(scale=0.3, size=(count, 3)))
    lower = upper * Rotation.from_rotvec(random.uniform(0.0, 2.0, (count, 1)) * [[0.0, 0.6, 0.8]])
    hand = lower * Rotation.from_rotvec([0.1, 0.2, 0.0])
    shoulder = np.tile([0.2, 0.0, 1.0], (count, 1))
    elbow = shoulder + upper.apply([1.0, 0.0, 0.0])
    wrist = elbow + lower.apply([0.9, 0.0, 0.0])
    joints = [
        np.hstack([place, turned.as_quat()])
        for place, turned in ((shoulder, upper), (elbow, lower), (wrist, hand))
    ]
    return np.hstack(joints)


def learnt(poses):
    body = Articulation(poses[0], ABOVE, RATE)
    for pose in poses[1:]:
        body.follow(pose, np.ones(len(pose), dtype=bool), UNTURNED)
    return body


def hide_wrist(pose, rng):
    """Without where the wrist is and how the lower arm is turned; both filled a little off."""
    filled = pose.copy().reshape(-1, 7)
    known = np.ones(filled.shape, dtype=bool)
    known[WRIST, :3] = known[ELBOW, 3:] = False
    filled[WRIST, :3] += rng.normal(scale=0.05, size=3)
    off = Rotation.from_rotvec(rng.normal(scale=0.1, size=3))
    filled[ELBOW, 3:] = (off * Rotation.from_quat(filled[ELBOW, 3:])).as_quat()
    return filled.ravel(), known.ravel()


def test_a_hidden_wrist_is_where_the_elbow_can_bend_it_to():
    body, rng = learnt(arms(600)), np.random.default_rng(1)
    before, after = [], []
    for pose in arms(200, seed=2):
        filled, known = hide_wrist(pose, rng)
        settled = body.follow(filled, known, UNTURNED)
        assert (settled[known] == filled[known]).all()
        np.testing.assert_allclose(np.linalg.norm(settled.reshape(-1, 7)[:, 3:], axis=1), 1.0)
        before.append(np.abs(filled - pose).mean())
        after.append(np.abs(settled - pose).mean())
    assert np.mean(after) < 0.65 * np.mean(before)


def test_a_pose_that_a_body_can_have_stays_nearly_as_it_is():
    body, poses = learnt(arms(600)), arms(50, seed=3)
    for pose in poses:
        _, known = hide_wrist(pose, np.random.default_rng(0))
        assert np.abs(body.follow(pose, known, UNTURNED) - pose).max() < 0.05


def test_one_pose_says_little():
    poses = arms(2, seed=4)
    body, rng = Articulation(poses[0], ABOVE, RATE), np.random.default_rng(5)
    filled, known = hide_wrist(poses[1], rng)
    settled = body.follow(filled, known, UNTURNED)
    assert 0.0 < np.abs(settled - filled).max() < 0.05


def test_rotations_that_are_none_end_nothing():
    poses = arms(3)
    body = Articulation(poses[0], ABOVE, RATE)
    none, known = poses[1].copy(), np.ones(21, dtype=bool)
    none[3:7] = 0.0
    known[14:17] = False
    assert np.isfinite(body.follow(none, known, UNTURNED)).all()
    assert np.isfinite(body.follow(poses[2], known, UNTURNED)).all()


def test_matrices_rotate_as_quaternions_do():
    turned = Rotation.random(20, random_state=1)
    np.testing.assert_allclose(matrices(turned.as_quat()), turned.as_matrix(), atol=1e-12)


def test_poses_that_come_at_twice_the_pace_teach_as_much():
    poses = np.repeat(arms(400), 2, axis=0)
    known = np.ones(poses.shape[1], dtype=bool)
    every, half = (Articulation(poses[0], ABOVE, RATE) for _ in range(2))
    for n, pose in enumerate(poses[2:]):
        every.follow(pose, known, UNTURNED)
        half.follow(pose, known, UNTURNED, counts=2 * (n % 2))
    filled, known = hide_wrist(arms(1, seed=7)[0], np.random.default_rng(1))
    settled = [body.follow(filled, known, UNTURNED) for body in (every, half)]
    assert np.abs(settled[0] - filled).max() > 0.02
    np.testing.assert_allclose(settled[1], settled[0], atol=2e-4)
