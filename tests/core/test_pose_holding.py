"""Joints and whole bodies that a sensor holds in one place."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import markermend as mm
from markermend.bench.poses import Case, recorded
from markermend.poses.faults.finding import CROSSED, FROZEN, REPEATED, mend_faults
from markermend.poses.nuitrack import LIMBS, to_nuitrack
from markermend.poses.prior import shipped_prior
from markermend.poses.quaternion import unit, unrolled
from markermend.poses.restore import restore
from markermend.poses.skeleton import forward_kinematics

EVERYBODY = tuple(range(17))


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_05.amc"))


@pytest.fixture(scope="module")
def angles(shared_data):
    return mm.read_pose(shared_data / "poses" / "02_01.amc")


def recording(walk, *, slow=False, noise_mm=0.0):
    pose = recorded(walk, Case("", "nothing", slow=slow))
    noise = np.random.default_rng(0).normal(0.0, noise_mm, pose.positions.shape)
    return pose.with_samples(pose.positions + noise, pose.rotations)


def hold(pose, joints, start, stop, *, turning=False):
    """The recording with joints where they were a frame before, and who was held when."""
    positions, rotations = np.array(pose.positions), np.array(pose.rotations)
    positions[start:stop, joints] = positions[start - 1, joints]
    if not turning:
        rotations[start:stop, joints] = rotations[start - 1, joints]
    truth = np.zeros(pose.seen.shape, dtype=bool)
    truth[start:stop, joints] = True
    return pose.with_samples(positions, rotations), truth


def flagged(pose, kind):
    faults = mend_faults(pose)[1]
    assert {fault.kind for fault in faults} <= {kind}
    mask = np.zeros(pose.seen.shape, dtype=bool)
    for fault in faults:
        mask[fault.start : fault.stop, fault.joint] = True
    return mask


@pytest.mark.parametrize("noise_mm", [0.0, 3.0])
@pytest.mark.parametrize("slow", [False, True])
@pytest.mark.parametrize("lasts_s", [0.1, 0.4])
def test_a_whole_pose_that_is_repeated_is_found(walk, slow, noise_mm, lasts_s):
    pose = recording(walk, slow=slow, noise_mm=noise_mm)
    start = pose.frames // 3
    broken, truth = hold(pose, EVERYBODY, start, start + round(lasts_s * pose.rate))
    np.testing.assert_array_equal(flagged(broken, REPEATED), truth)


@pytest.mark.parametrize("noise_mm", [0.0, 3.0])
@pytest.mark.parametrize("slow", [False, True])
@pytest.mark.parametrize(
    "joints",
    [[*LIMBS[0], *LIMBS[1], *LIMBS[2]], [0, 1, 2, 3, 4, *LIMBS[0], *LIMBS[3]]],
    ids=["three limbs", "eleven joints"],
)
def test_many_joints_that_are_held_are_found(walk, joints, slow, noise_mm):
    pose = recording(walk, slow=slow, noise_mm=noise_mm)
    start = pose.frames // 3
    broken, truth = hold(pose, joints, start, start + round(0.4 * pose.rate))
    np.testing.assert_array_equal(flagged(broken, FROZEN), truth)


@pytest.mark.parametrize("slow", [False, True])
def test_who_is_held_may_still_be_turning(walk, slow):
    pose = recording(walk, slow=slow, noise_mm=1.0)
    start = pose.frames // 3
    broken, truth = hold(pose, LIMBS[0], start, start + round(pose.rate), turning=True)
    np.testing.assert_array_equal(flagged(broken, FROZEN), truth)


def test_two_poses_are_enough_to_be_held(walk):
    slow = recording(walk, slow=True)
    broken, truth = hold(slow, LIMBS[2], 102, 104)
    np.testing.assert_array_equal(flagged(broken, FROZEN), truth)


def test_who_walks_through_repeated_poses_comes_back_nearer_to_the_truth(angles):
    whole = to_nuitrack(angles)
    broken, truth = hold(whole, EVERYBODY, 120, 168)
    off = [
        np.sqrt(np.sum((p.positions - whole.positions) ** 2, axis=2))[truth].mean()
        for p in (broken, restore(broken, prior=shipped_prior()).pose)
    ]
    assert off[1] < 0.3 * off[0]


def test_the_recording_that_repeats_a_pose_by_itself_is_told_of(shared_data):
    pose = mm.read_pose(shared_data / "poses" / "03_02.amc")
    # Walking at 8 mm a frame it stands still for 13, and is 114 mm away in the next.
    assert {(f.kind, f.start, f.stop) for f in mend_faults(pose)[1]} == {(REPEATED, 11, 24)}


def paused(pose, *, slows_s):
    """The recording with pauses to the last digit, into which everybody slows down."""
    slows, rests = max(round(slows_s * pose.rate), 1), round(0.3 * pose.rate)
    down = np.linspace(1.0, 0.0, slows + 2)[1:-1]
    once = np.concatenate([np.ones(round(pose.rate)), down, np.zeros(rests), down[::-1]])
    when = np.cumsum(np.tile(once, 1 + pose.frames // len(once)))
    when = when[when < pose.frames - 1]
    at = np.arange(pose.frames)
    positions = CubicSpline(at, pose.positions)(when)
    rotations = unit(CubicSpline(at, unrolled(pose.rotations))(when))
    return mm.Pose(positions, rotations, pose.joints, pose.parents, pose.rate)


@pytest.mark.parametrize("slow", [False, True])
@pytest.mark.parametrize("slows_s", [0.1, 0.3])
def test_who_pauses_is_not_held(walk, slow, slows_s):
    pose = paused(recording(walk, slow=slow), slows_s=slows_s)
    assert (np.diff(pose.positions, axis=0) == 0).all(axis=(1, 2)).sum() > 0.15 * pose.frames
    assert mend_faults(pose)[1] == ()


@pytest.mark.parametrize("times", [2, 3, 4])
@pytest.mark.parametrize("noise_mm", [0.0, 3.0])
def test_a_slow_recording_written_at_a_high_rate_is_not_held(walk, times, noise_mm):
    pose = recording(walk, slow=True, noise_mm=noise_mm)
    again = [np.repeat(a, times, axis=0) for a in (pose.positions, pose.rotations)]
    assert mend_faults(mm.Pose(*again, pose.joints, pose.parents, pose.rate * times))[1] == ()


@pytest.mark.parametrize("noise_mm", [0.0, 0.3, 1.0])
def test_what_is_written_to_the_millimetre_is_not_held_by_chance(walk, noise_mm):
    pose = recording(walk, noise_mm=noise_mm)
    assert mend_faults(pose.with_samples(np.round(pose.positions), pose.rotations))[1] == ()


def bent(pose, change):
    """The recording of a skeleton file whose channels were changed."""
    channels = {name: np.array(values) for name, values in pose.source.channels.items()}
    change(channels)
    movement = replace(pose.source, channels=channels)
    return replace(forward_kinematics(movement, pose.rate), source=movement)


@pytest.mark.parametrize("lasts", [6, 41])
def test_limbs_whose_angles_are_held_together_are_found_however_briefly(angles, lasts):
    limbs = ("lfemur", "ltibia", "lfoot"), ("lhumerus", "lradius"), ("rhumerus", "rradius")

    def keep(channels):
        for name in sum(limbs, ()):
            channels[name][100 : 100 + lasts] = channels[name][99]

    truth = np.zeros(angles.seen.shape, dtype=bool)
    for limb in limbs:
        truth[100 : 100 + lasts, angles.hanging_on(angles.index(limb[0]))] = True
    np.testing.assert_array_equal(flagged(bent(angles, keep), FROZEN), truth)


@pytest.mark.parametrize("rows", [slice(0, 40), slice(-40, None)])
@pytest.mark.parametrize("names", [("femur", "tibia", "foot"), ("humerus", "radius", "wrist")])
def test_angles_exchanged_up_to_an_end_are_exchanged_back(angles, names, rows):
    def exchange(channels):
        for name in names:
            left, right = channels["l" + name], channels["r" + name]
            left[rows], right[rows] = right[rows].copy(), left[rows].copy()

    mended, faults = mend_faults(bent(angles, exchange))
    start, stop, _ = rows.indices(angles.frames)
    assert {(f.kind, f.start, f.stop) for f in faults} == {(CROSSED, start, stop)}
    np.testing.assert_allclose(mended.positions, angles.positions, atol=1e-9)
