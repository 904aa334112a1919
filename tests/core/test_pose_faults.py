"""Faults that a sensor does not tell of: simulated, found, mended."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.errors import DataError
from markermend.poses.breaking import KINDS, break_pose
from markermend.poses.faults import FROZEN, MISPLACED, SWAPPED, VANISHED, mend_faults
from markermend.poses.noise import Noise, corrupt_pose
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.prior import shipped_prior
from markermend.poses.restore import restore
from markermend.poses.sensor import as_depth_sensor


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_05.amc"))


def marked(faults, pose, kind=None):
    mask = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    for fault in faults:
        if kind in (None, fault.kind):
            mask[fault.start : fault.stop, fault.joint] = True
    return mask


def broken_at(breaks, pose, name=None):
    mask = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    for broken in breaks:
        if name in (None, KINDS[broken.kind]):
            mask[broken.start : broken.stop, list(broken.joints)] = True
    return mask


def test_clean_and_noisy_recordings_have_none(walk):
    sensor = as_depth_sensor(walk, seed=0)
    for pose in (walk, sensor, corrupt_pose(sensor, Noise(burst=10), seed=1)):
        mended, faults = mend_faults(pose)
        assert faults == ()
        assert mended is pose


@pytest.mark.parametrize("sensor", [False, True])
def test_every_kind_is_found(walk, sensor):
    pose = as_depth_sensor(walk, seed=0) if sensor else walk
    broken, truth = break_pose(pose, each=3, seed=1)
    mended, found = mend_faults(broken)
    for kind in (VANISHED, FROZEN, SWAPPED):
        assert (marked(found, pose, kind)[broken_at(truth, pose, kind)]).all(), kind
    there, flagged = broken_at(truth, pose, MISPLACED), marked(found, pose)
    assert flagged[there].mean() > 0.99
    assert (flagged & ~broken_at(truth, pose)).mean() < 0.0002
    swapped = broken_at(truth, pose, SWAPPED)
    np.testing.assert_allclose(mended.positions[swapped], pose.positions[swapped])


def test_restoring_mends_them(walk):
    broken, truth = break_pose(walk, each=3, seed=2)
    restored = restore(broken, prior=shipped_prior())

    def off(pose):
        far = np.sqrt(np.sum((pose.positions - walk.positions) ** 2, axis=2))
        return np.nanmean(far[broken_at(truth, walk)])

    assert off(restored.pose) < 0.15 * off(broken)
    assert {fault.kind for fault in restored.faults} == {VANISHED, FROZEN, SWAPPED, MISPLACED}


def test_an_arm_of_somebody_else_goes_with_its_elbow_and_a_lone_elbow_without_its_wrist(walk):
    elbow, wrist = walk.joints.index("left_elbow"), walk.joints.index("left_wrist")
    along = walk.positions[100:140, [elbow]] - walk.positions[100:140, [wrist]]
    for moved in ([elbow], [elbow, wrist]):
        positions = np.array(walk.positions)
        positions[100:140, moved] += along
        found = marked(mend_faults(walk.with_samples(positions, walk.rotations))[1], walk)
        expected = np.zeros(found.shape, dtype=bool)
        expected[100:140, moved] = True
        np.testing.assert_array_equal(found, expected)


def test_a_joint_that_jumps_to_the_other_side_has_not_changed_places(walk):
    left, right = walk.joints.index("left_hip"), walk.joints.index("right_hip")
    positions = np.array(walk.positions)
    positions[100:140, left] = positions[100:140, right] + 1.0
    _, faults = mend_faults(walk.with_samples(positions, walk.rotations))
    assert not marked(faults, walk, SWAPPED).any()


def test_a_body_at_rest_is_not_frozen(walk):
    positions = np.repeat(walk.positions[:1], 200, axis=0)
    rotations = np.repeat(walk.rotations[:1], 200, axis=0)
    rest = mm.Pose(positions, rotations, walk.joints, walk.parents, 120.0)
    assert mend_faults(rest)[1] == ()


def test_same_seed_same_faults(walk):
    one, other = (break_pose(walk, each=2, seed=5) for _ in range(2))
    assert (one[0].positions == other[0].positions).all()
    assert one[1] == other[1]


def test_too_short_a_recording_is_not_broken(walk):
    short = mm.Pose(walk.positions[:40], walk.rotations[:40], walk.joints, walk.parents, walk.rate)
    with pytest.raises(DataError, match="too short to be broken 5 times"):
        break_pose(short, each=1, seed=0)
