"""The 17 joints, normalisation and its inverse, and the noise of sensors."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from markermend.errors import DataError
from markermend.files.pose import read_pose
from markermend.poses import Pose
from markermend.poses.normal import bone_lengths, denormalise, normalise
from markermend.poses.nuitrack import JOINTS, PARENTS, mirrored, to_nuitrack, usual_name
from markermend.poses.quaternion import (
    between,
    inverse,
    multiply,
    signed_like,
    turn,
    unrolled,
    upright,
)
from markermend.poses.simulated.noise import Noise, corrupt, corrupt_pose
from markermend.poses.simulated.sensor import as_depth_sensor


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(read_pose(shared_data / "poses" / "02_01.amc"))


def same_turn(a, b):
    assert_allclose(np.abs(np.sum(a * b, axis=-1)), 1.0, atol=1e-12)


def test_joints_lie_where_they_should(walk):
    assert walk.joints == JOINTS
    assert len(JOINTS) == 17
    height = walk.positions[..., 1].mean(axis=0)
    at = dict(zip(JOINTS, height, strict=True))
    assert (
        at["head"] > at["collar"] > at["torso"] > at["waist"] > at["left_knee"] > at["left_ankle"]
    )
    lengths = dict(zip(JOINTS, bone_lengths(walk.positions, PARENTS), strict=True))
    assert 200 < lengths["left_wrist"] < 320
    assert 350 < lengths["right_knee"] < 480


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("JOINT_LEFT_SHOULDER", "left_shoulder"),
        ("ShoulderLeft", "left_shoulder"),
        ("l_shoulder", "left_shoulder"),
        ("RightKnee", "right_knee"),
        ("SpineBase", "waist"),
        ("head", "head"),
        ("LFHD", "LFHD"),
    ],
)
def test_names_of_other_systems(name, meant):
    assert usual_name(name) == meant


def test_missing_joint_is_named(walk):
    cut = Pose(walk.positions[:, :-1], walk.rotations[:, :-1], JOINTS[:-1], PARENTS[:-1], 120.0)
    with pytest.raises(DataError, match="right_ankle"):
        to_nuitrack(cut)


def test_normalisation_and_its_inverse(walk):
    features, normal = normalise(walk)
    assert_allclose(features[:, 0], np.tile([0, 0, 0, 0, 0, 0, 1.0], (walk.frames, 1)), atol=1e-12)
    assert_allclose(np.mean(bone_lengths(features[..., :3], PARENTS)[1:]), 1.0)
    positions, rotations = denormalise(features, normal)
    assert_allclose(positions, walk.positions, atol=1e-9)
    same_turn(rotations, walk.rotations)


def test_who_and_where_does_not_matter(walk):
    turned = np.array([0.1, 0.7, -0.2, 0.4])
    turned /= np.linalg.norm(turned)
    moved = walk.with_samples(
        1.3 * turn(turned, walk.positions) + [500.0, 0.0, -900.0], multiply(turned, walk.rotations)
    )
    assert_allclose(normalise(moved)[0][..., :3], normalise(walk)[0][..., :3], atol=1e-9)
    same_turn(normalise(moved)[0][..., 3:], normalise(walk)[0][..., 3:])


def test_bones_lie_along_their_axes(walk):
    features, _ = normalise(walk)
    for joint, child, axis in (
        ("right_shoulder", "right_elbow", [1, 0, 0]),
        ("left_shoulder", "left_elbow", [-1, 0, 0]),
        ("left_hip", "left_knee", [0, -1, 0]),
        ("neck", "head", [0, 1, 0]),
    ):
        i, j = JOINTS.index(joint), JOINTS.index(child)
        bone = features[:, j, :3] - features[:, i, :3]
        bone /= np.linalg.norm(bone, axis=1, keepdims=True)
        along = turn(features[:, i, 3:], np.array(axis, dtype=float))
        assert_allclose(along, bone, atol=1e-6)


def test_mirror_is_its_own_inverse_and_keeps_bones(walk):
    other = mirrored(walk)
    assert_allclose(
        bone_lengths(other.positions, PARENTS)[1:], bone_lengths(walk.positions, PARENTS)[1:]
    )
    assert_allclose(mirrored(other).positions, walk.positions)
    knee, hip = JOINTS.index("left_knee"), JOINTS.index("left_hip")
    bone = other.positions[:, knee] - other.positions[:, hip]
    local = turn(inverse(other.rotations[:, hip]), bone)
    assert np.ptp(local, axis=0).max() < 1e-6, "rotations must be mirrored as the positions are"


def test_quaternions(walk):
    flips = upright(walk.rotations)
    smooth = unrolled(flips)
    assert np.abs(np.diff(smooth, axis=0)).max() < 0.2
    a, b = np.array([[1.0, 2, 3]]), np.array([[-3.0, 1, 0.5]])
    aside = turn(between(a, b), a)
    assert_allclose(np.cross(aside, b), 0, atol=1e-12)
    assert_allclose(np.linalg.norm(aside), np.linalg.norm(a))


def test_signs_follow_what_is_known_and_hold_where_nothing_is(walk):
    signs = np.where(np.random.default_rng(3).random(walk.rotations.shape[:2]) < 0.5, -1.0, 1.0)
    given = signs[..., None] * walk.rotations
    known = np.ones(signs.shape, dtype=bool)
    known[:4, 2] = known[9:12, 2] = False
    followed = signed_like(walk.rotations, given, known)
    assert_allclose(followed[known], given[known])
    signs[:4, 2], signs[9:12, 2] = signs[4, 2], signs[8, 2]
    assert_allclose(followed, signs[..., None] * walk.rotations)


def test_noise_reproduces_the_papers_corrupted_poses(walk):
    features, _ = normalise(walk)
    features[..., 3:] = upright(features[..., 3:])
    both, occluded = corrupt(features, PARENTS, Noise(), seed=3)
    assert 0.10 < occluded[:, 1:].mean() < 0.125
    assert not occluded[:, 0].any()
    assert 0.060 < np.abs(both - features)[:, 1:].mean() < 0.085
    moved, _ = corrupt(features, PARENTS, Noise(occlusion=0.0), seed=3)
    assert_allclose(np.abs(moved - features)[:, 1:].mean(), 0.0127, atol=2e-4)
    frame, joint = np.argwhere(occluded & (np.arange(17) > 2))[0]
    assert both[frame, joint].tolist() == [0, 0, 0, 0, 0, 0, 1]
    assert both[frame, PARENTS[joint], 3:].tolist() == [0, 0, 0, 1]
    again, _ = corrupt(features, PARENTS, Noise(), seed=3)
    assert (again == both).all()


def test_bursts_and_limbs(walk):
    features, _ = normalise(walk)
    _, bursts = corrupt(features, PARENTS, Noise(burst=30), seed=1)
    starts = np.flatnonzero(np.diff(bursts[:, 3].astype(int)) == 1)
    stops = np.flatnonzero(np.diff(bursts[:, 3].astype(int)) == -1)
    assert all(stops[stops > start][0] - start >= 30 for start in starts if (stops > start).any())
    _, limbs = corrupt(features, PARENTS, Noise(burst=60, limbs=True), seed=5)
    elbow, wrist = JOINTS.index("left_elbow"), JOINTS.index("left_wrist")
    assert limbs[:, elbow].any()
    assert (limbs[:, elbow] == limbs[:, wrist]).all()


def test_corrupted_recording_knows_what_was_not_seen(walk):
    damaged = corrupt_pose(walk, Noise(), seed=0)
    assert 0.85 < damaged.seen.mean() < 0.92
    frame, joint = np.argwhere(~damaged.seen)[0]
    assert np.isnan(damaged.positions[frame, joint]).all()
    assert not damaged.turned[frame, PARENTS[joint]]


def test_simulated_sensor_is_another_body_at_30_hz(walk):
    other = as_depth_sensor(walk, seed=0)
    assert other.rate == 30.0
    assert (as_depth_sensor(walk, seed=0).positions == other.positions).all()
    for joint, parent in enumerate(PARENTS):
        # Where ours is rigid, the simulated one must be: an arm keeps its length.
        if JOINTS[joint] in ("left_elbow", "right_knee", "head"):
            bone = np.linalg.norm(other.positions[:, joint] - other.positions[:, parent], axis=1)
            assert np.ptp(bone) < 1e-6
    assert (
        np.abs(bone_lengths(other.positions, PARENTS) / bone_lengths(walk.positions, PARENTS) - 1)[
            1:
        ].max()
        > 0.05
    )
