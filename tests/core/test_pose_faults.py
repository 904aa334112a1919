"""Faults that a sensor does not tell of: simulated, found, mended."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import markermend as mm
from markermend.bench.poses import Case, recorded
from markermend.errors import DataError
from markermend.poses.faults.finding import (
    CARRIED,
    CROSSED,
    FROZEN,
    MISPLACED,
    SWAPPED,
    VANISHED,
    mend_faults,
)
from markermend.poses.nuitrack import to_nuitrack, twins
from markermend.poses.prior import shipped_prior
from markermend.poses.quaternion import turn, unit
from markermend.poses.restore import restore
from markermend.poses.simulated.breaking import HOLDS, KINDS, break_pose
from markermend.poses.simulated.noise import Noise, corrupt_pose
from markermend.poses.simulated.sensor import as_depth_sensor
from markermend.poses.skeleton import forward_kinematics


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


def test_what_jumps_next_to_the_other_side_has_not_changed_places_with_what_hangs_on_it(walk):
    # The knee then hangs nearer to where the other hip's would, and went nowhere.
    hip = walk.joints.index("left_hip")
    positions = np.array(walk.positions)
    positions[184:243, hip] += (18.0, -30.0, 276.0)
    found = marked(mend_faults(walk.with_samples(positions, walk.rotations))[1], walk)
    expected = np.zeros(found.shape, dtype=bool)
    expected[184:243, hip] = True
    np.testing.assert_array_equal(found, expected)


def swapped_from(pose, joint, frames):
    """The recording with a joint, and all that hangs on it, swapped with the other side's."""
    limb = [joint]
    for below in pose.order:
        if pose.parents[below] in limb:
            limb.append(below)
    here = limb + [twins(pose.joints)[j] for j in limb]
    there = here[len(limb) :] + limb
    positions, rotations = np.array(pose.positions), np.array(pose.rotations)
    positions[frames, here] = pose.positions[frames, there]
    rotations[frames, here] = pose.rotations[frames, there]
    return pose.with_samples(positions, rotations), here


@pytest.mark.parametrize("slow", [False, True])
@pytest.mark.parametrize("whole", [False, True])
def test_a_limb_is_swapped_back_from_whichever_joint_on(shared_data, whole, slow):
    pose = mm.read_pose(shared_data / "poses" / "02_01.amc")
    pose = pose if whole else to_nuitrack(pose)
    pose = recorded(pose, Case("", "nothing", slow=slow))
    frames = np.arange(pose.frames // 3, pose.frames // 2)[:, None]
    for joint, other in enumerate(twins(pose.joints)):
        if other > joint:
            swapped, limb = swapped_from(pose, joint, frames)
            mended, faults = mend_faults(swapped)
            np.testing.assert_array_equal(mended.positions, pose.positions)
            np.testing.assert_allclose(mended.rotations, pose.rotations, atol=1e-12)
            expected = np.zeros(pose.seen.shape, dtype=bool)
            expected[frames, limb] = True
            np.testing.assert_array_equal(marked(faults, pose, SWAPPED), expected)
            np.testing.assert_array_equal(marked(faults, pose), expected)


def test_sides_are_told_by_any_usual_names(walk):
    names = {"hip": "UpLeg", "knee": "Leg", "ankle": "Foot", "elbow": "ForeArm", "wrist": "Hand"}

    def mixamo(joint):
        side, _, rest = joint.rpartition("_")
        return f"mixamorig:{side.capitalize()}{names.get(rest, rest.capitalize())}"

    named = replace(walk, joints=tuple(mixamo(joint) for joint in walk.joints))
    frames = np.arange(100, 150)[:, None]
    swapped, limb = swapped_from(named, named.index("mixamorig:LeftUpLeg"), frames)
    mended, faults = mend_faults(swapped)
    np.testing.assert_array_equal(mended.positions, walk.positions)
    assert {named.joints[fault.joint] for fault in faults} == {named.joints[j] for j in limb}


def test_a_person_who_turns_is_not_swapped_where_nobody_says_how_joints_are_turned(shared_data):
    pose = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_04.amc"))
    angle = np.linspace(0.0, 2.0 * np.pi, pose.frames)
    about = np.stack([0 * angle, np.sin(angle / 2), 0 * angle, np.cos(angle / 2)], axis=1)
    positions = turn(about[:, None], pose.positions)
    rotations = np.tile((0.0, 0.0, 0.0, 1.0), (pose.frames, len(pose.joints), 1))
    assert mend_faults(pose.with_samples(positions, rotations))[1] == ()


@pytest.mark.parametrize("zero", [False, True])
def test_of_a_root_that_jumps_nothing_else_is_lost(walk, zero):
    root, positions = walk.order[0], np.array(walk.positions)
    positions[60:70, root] = 0.0 if zero else positions[60:70, root] + (0.0, 500.0, 0.0)
    broken = walk.with_samples(positions, walk.rotations)
    mended, faults = mend_faults(broken)
    assert [(f.joint, f.start, f.stop) for f in faults] == [(root, 60, 70)]
    others = [j for j in range(len(walk.joints)) if j != root]
    np.testing.assert_array_equal(mended.positions[:, others], walk.positions[:, others])
    restored = restore(broken, prior=shipped_prior()).pose
    off = np.sqrt(np.sum((restored.positions - walk.positions)[60:70] ** 2, axis=2))
    assert off[:, root].max() < 20.0
    assert off[:, others].max() < 2.0


def test_whoever_jumps_is_wrong_wherever_bones_happen_to_reach(walk):
    random, right, tries = np.random.default_rng(3), 0, 40
    walk = walk.with_samples(walk.positions[:600], walk.rotations[:600])
    for _ in range(tries):
        joint, start = int(random.integers(1, len(walk.joints))), int(random.integers(2, 500))
        away = random.normal(size=3)
        positions = np.array(walk.positions)
        positions[start : start + 50, joint] += away / np.sqrt(away @ away) * 300.0
        found = marked(mend_faults(walk.with_samples(positions, walk.rotations))[1], walk)
        expected = np.zeros(found.shape, dtype=bool)
        expected[start : start + 50, joint] = True
        right += np.array_equal(found, expected)
        assert not (found & ~expected).any()
    assert right >= 0.95 * tries


def test_a_joint_that_is_somewhere_else_in_every_frame_is_wrong_in_all_of_them(walk):
    slow = recorded(walk, Case("30 Hz", "nothing", slow=True))
    random = np.random.default_rng(5)
    for _ in range(40):
        joint, start = int(random.integers(1, len(walk.joints))), int(random.integers(2, 400))
        away = random.normal(size=(15, 3))
        positions = np.array(slow.positions)
        positions[start : start + 15, joint] += 400.0 * unit(away)
        found = marked(mend_faults(slow.with_samples(positions, slow.rotations))[1], slow)
        assert found[start : start + 15, joint].all()
        assert not np.delete(found, joint, axis=1).any()


def test_one_frame_is_enough_to_be_found(walk):
    wrist, positions = walk.joints.index("left_wrist"), np.array(walk.positions)
    bone = positions[300, wrist] - positions[300, walk.parents[wrist]]
    aside = np.cross(bone, (0.0, 1.0, 0.0))
    # So far to the side its bone changes by an eighth, less than those of real sensors may.
    positions[300, wrist] += aside / np.sqrt(aside @ aside) * 0.52 * np.sqrt(bone @ bone)
    found = marked(mend_faults(walk.with_samples(positions, walk.rotations))[1], walk)
    assert np.argwhere(found).tolist() == [[300, wrist]]


def test_a_joint_that_is_away_for_most_of_the_time_is_not_taken_for_where_it_belongs(walk):
    head, positions = walk.joints.index("head"), np.array(walk.positions[:180])
    positions[40:140, head, 1] += 1200.0
    broken = walk.with_samples(positions, walk.rotations[:180], np.ones(positions.shape[:2]))
    found = marked(mend_faults(broken)[1], walk)
    assert found[40:140, head].all()
    assert found.sum() == 100
    told = restore(broken, prior=shipped_prior()).pose
    assert np.abs(told.positions[:, head] - walk.positions[:180, head]).max() < 60.0


def test_a_joint_that_is_never_in_its_place_is_left_where_it_is(walk):
    head, positions = walk.joints.index("head"), np.array(walk.positions[:180])
    random = np.random.default_rng(0)
    positions[:, head] += random.normal(size=(180, 3)) * np.linspace(400, 3000, 180)[:, None]
    broken = walk.with_samples(positions, walk.rotations[:180], np.ones(positions.shape[:2]))
    mended, _ = mend_faults(broken)
    assert mended.seen[:, head].any()


@pytest.fixture(scope="module")
def angles(shared_data):
    return mm.read_pose(shared_data / "poses" / "02_01.amc")


def bent(pose, change):
    """The recording of a skeleton file whose channels were changed."""
    channels = {name: np.array(values) for name, values in pose.source.channels.items()}
    change(channels)
    movement = replace(pose.source, channels=channels)
    return replace(forward_kinematics(movement, pose.rate), source=movement)


def test_a_limb_whose_angles_stand_still_is_frozen_with_all_that_hangs_on_it(angles):
    def hold(channels):
        for name in ("lfemur", "ltibia", "lfoot"):
            channels[name][100:141] = channels[name][99]

    broken = bent(angles, hold)
    limb = angles.hanging_on(angles.index("lfemur"))
    _, faults = mend_faults(broken)
    assert [(f.kind, f.joint, f.start, f.stop) for f in faults] == [
        (FROZEN, joint, 100, 141) for joint in limb
    ]
    off = np.sqrt(np.sum((broken.positions - angles.positions) ** 2, axis=2))[100:141, limb]
    restored = restore(broken, prior=shipped_prior()).pose
    left = np.sqrt(np.sum((restored.positions - angles.positions) ** 2, axis=2))[100:141, limb]
    assert left.mean() < 0.35 * off.mean()


def test_a_limb_that_stands_still_before_it_first_moves_is_left(angles):
    def hold(channels):
        for name in ("lfemur", "ltibia", "lfoot"):
            channels[name][:80] = channels[name][80]

    assert mend_faults(bent(angles, hold))[1] == ()


def test_where_one_limb_alone_moves_the_others_are_not_held(angles):
    # Slower and slower up to where they stand, and back to where they would be the same way.
    when = np.arange(angles.frames, dtype=float)
    when[60:181] = 90.0 + 30.0 * np.interp(when[60:181], (60, 90, 150, 180), (-1, 0, 0, 1)) ** 3
    when[90:151] = 90.0

    def hold(channels):
        for name, values in channels.items():
            if name not in ("rfemur", "rtibia", "rfoot"):
                moved = CubicSpline(np.arange(angles.frames), values)(when)
                values[60:181] = moved[60:181]
                values[181:] = moved[180]

    assert not marked(mend_faults(bent(angles, hold))[1], angles, FROZEN).any()


@pytest.mark.parametrize("names", [("femur", "tibia", "foot"), ("humerus", "radius", "wrist")])
def test_angles_of_left_and_right_are_swapped_back(angles, names):
    def exchange(channels):
        for name in names:
            left, right = channels["l" + name], channels["r" + name]
            left[200:226], right[200:226] = right[200:226].copy(), left[200:226].copy()

    mended, faults = mend_faults(bent(angles, exchange))
    assert {(f.kind, f.start, f.stop) for f in faults} == {(CROSSED, 200, 226)}
    np.testing.assert_allclose(mended.positions, angles.positions, atol=1e-9)
    np.testing.assert_allclose(mended.rotations, angles.rotations, atol=1e-9)


def test_a_spike_of_an_angle_is_found_and_filled(angles):
    def turn_up(channels):
        channels["lhumerus"][260, 0] += 70.0

    broken = bent(angles, turn_up)
    arm = angles.hanging_on(angles.index("lhumerus"))
    found = marked(mend_faults(broken)[1], angles)
    assert np.argwhere(found).tolist() == [[260, joint] for joint in sorted(arm)]
    restored = restore(broken, prior=shipped_prior()).pose
    off = np.sqrt(np.sum((restored.positions - angles.positions)[260] ** 2, axis=1))
    assert off.max() < 5.0


def test_a_body_that_is_carried_off_comes_back_as_it_is(angles):
    def carry(channels):
        channels["root"][300:311, 0] += 10.0

    broken = bent(angles, carry)
    assert np.abs(broken.positions - angles.positions).max() > 500.0
    mended, faults = mend_faults(broken)
    assert {(f.kind, f.start, f.stop) for f in faults} == {(CARRIED, 300, 311)}
    assert mended.seen.all()
    assert np.abs(mended.positions - angles.positions).max() < 10.0
    own, true = (p.positions - p.positions[:, [angles.order[0]]] for p in (mended, angles))
    np.testing.assert_allclose(own, true, atol=1e-9)
    # It stands where a bridge has it, which no joint knows any better than the others.
    told = restore(broken, prior=shipped_prior())
    off = np.sqrt(np.sum((told.pose.positions - angles.positions) ** 2, axis=2))[300:311]
    error = told.error_mm[300:311]
    assert (error > 0).all()
    assert 0.3 < error.mean() / off.mean() < 3.0


@pytest.mark.parametrize("gap", [slice(150, 162), slice(100, 160), slice(0, 12)])
def test_how_far_a_hidden_root_may_be_off_is_told(angles, gap):
    root, seen = angles.order[0], angles.seen.copy()
    seen[gap, root] = False
    hidden = angles.with_samples(angles.positions, angles.rotations, seen.astype(float))
    told = restore(hidden, prior=shipped_prior())
    off = np.sqrt(np.sum((told.pose.positions - angles.positions) ** 2, axis=2))
    assert 0.5 < told.error_mm[gap, root].mean() / off[gap, root].mean() < 3.0
    assert not np.delete(told.error_mm[:, root], np.r_[gap]).any()


@pytest.mark.parametrize("name", ["01_01", "02_01", "02_09", "03_01", "03_03"])
def test_clean_skeleton_files_have_no_faults(shared_data, name):
    pose = mm.read_pose(shared_data / "poses" / f"{name}.amc")
    assert mend_faults(pose)[1] == ()


def test_a_body_at_rest_is_not_frozen(walk):
    positions = np.repeat(walk.positions[:1], 200, axis=0)
    rotations = np.repeat(walk.rotations[:1], 200, axis=0)
    rest = mm.Pose(positions, rotations, walk.joints, walk.parents, 120.0)
    assert mend_faults(rest)[1] == ()


@pytest.mark.parametrize("at", [0.0, 900.0])
def test_a_root_that_others_are_measured_from_is_not_frozen(walk, at):
    nothing = np.full(walk.rotations.shape, np.nan)
    beside = walk.with_samples(walk.positions - walk.positions[:, :1] + at, nothing)
    assert not restore(beside).faults
    # One that goes on afterwards is.
    places = walk.positions.copy()
    places[20:60, 0] = places[20, 0]
    (fault,) = restore(walk.with_samples(places, nothing)).faults
    assert (fault.kind, fault.joint, fault.start, fault.stop) == (FROZEN, 0, 21, 60)


def test_same_seed_same_faults(walk):
    for what in (KINDS, HOLDS):
        one, other = (break_pose(walk, each=2, seed=5, what=what) for _ in range(2))
        assert (one[0].positions == other[0].positions).all()
        assert one[1] == other[1]
        assert {broken.kind for broken in one[1]} == set(what)


def test_too_short_a_recording_is_not_broken(walk):
    short = mm.Pose(walk.positions[:40], walk.rotations[:40], walk.joints, walk.parents, walk.rate)
    with pytest.raises(DataError, match="too short to be broken 5 times"):
        break_pose(short, each=1, seed=0)
