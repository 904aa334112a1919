"""Angles of a skeleton file that jump away and back: found, and nothing else is changed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from acclaim import arm_and_leg

import markermend as mm
from markermend.poses.faults.finding import THROWN, mend_faults
from markermend.poses.faults.hinges import hinges_of
from markermend.poses.faults.thrown import thrown_off
from markermend.poses.faults.wrong_angles import with_own_angles
from markermend.poses.inverse import inverse_kinematics
from markermend.poses.prior import shipped_prior
from markermend.poses.quaternion import NO_TURN, inverse, multiply
from markermend.poses.restore import restore
from markermend.poses.skeleton import Skeleton, forward_kinematics

FRAMES, RATE = 240, 120.0


@pytest.fixture
def movement():
    """One who turns about meanwhile."""
    movement = arm_and_leg(FRAMES, swings=4)
    movement.channels["root"][:, 5] += np.linspace(0, 700, FRAMES)
    return movement


def turned(movement, name, column, rows, by):
    channels = {n: np.array(values) for n, values in movement.channels.items()}
    channels[name][rows, column] += by
    return replace(movement, channels=channels)


def found_in(movement):
    pose = forward_kinematics(movement, RATE)
    return {
        (pose.joints[j], *np.flatnonzero(column)[[0, -1]].tolist(), int(column.sum()))
        for j, column in enumerate(thrown_off(pose).T)
        if column.any()
    }


def test_a_limb_is_thrown_off_while_the_body_goes_on_and_found_to_the_frame(movement):
    assert found_in(movement) == set()
    rows = slice(100, 160)
    assert found_in(turned(movement, "fore", 0, rows, 60.0)) == {
        ("fore", 100, 159, 60),
        ("hand", 100, 159, 60),
    }
    one = turned(movement, "arm", 1, slice(30, 31), -40.0)
    assert found_in(one) == {(name, 30, 30, 1) for name in ("arm", "fore", "hand")}


def test_what_went_round_and_what_does_not_come_back_is_no_jump(movement):
    assert found_in(turned(movement, "arm", 0, slice(100, 160), 360.0)) == set()
    assert found_in(turned(movement, "arm", 0, slice(100, None), 50.0)) == set()
    assert found_in(turned(movement, "arm", 0, slice(60, 200), 50.0)) == set(), "over a second"


def test_jumps_that_an_angle_makes_all_the_time_are_its_way(movement):
    for first in range(10, FRAMES - 6, 12):
        movement = turned(movement, "hand", 1, slice(first, first + 5), 50.0)
    assert found_in(movement) == set()


def test_where_bones_are_not_rigid_nothing_is_found(movement):
    pose = forward_kinematics(turned(movement, "fore", 0, slice(100, 160), 60.0), RATE)
    positions = np.array(pose.positions)
    positions[50, 3] += 1.0
    assert not thrown_off(pose.with_samples(positions, pose.rotations)).any()


def test_a_bvh_comes_back_with_the_angles_of_one_joint_changed(movement, tmp_path):
    rows, poses = slice(100, 160), []
    for name, one in (("truth", movement), ("wrong", turned(movement, "fore", 0, rows, 60.0))):
        mm.write_pose(forward_kinematics(one, RATE), tmp_path / f"{name}.bvh")
        poses.append(mm.read_pose(tmp_path / f"{name}.bvh"))
    truth, given = poses
    # The bone of the forearm begins at its joint there, which stays.
    joints = [given.index("hand"), given.index("hand_end")]
    _, faults = mend_faults(given)
    assert {(f.kind, f.joint, f.start, f.stop) for f in faults} == {
        (THROWN, joint, 100, 160) for joint in joints
    }
    # Filling is a little off, and cannot tell how a hidden hand is turned.
    rotations = np.array(truth.rotations)
    rotations[rows, given.index("fore")] = rotations[rows, given.index("hand")] = NO_TURN
    told = truth.with_samples(truth.positions + np.array([0.0, 3.0, 0.0]), rotations)
    found = with_own_angles(told, given, faults)
    off = np.linalg.norm(found.positions - truth.positions, axis=2)[rows]
    assert off[:, joints].max() < 5.0
    turns, others = (hinges_of(p).turns[rows] for p in (given, truth))
    for name, changed in (("fore", True), ("hand", False)):
        joint, above = given.index(name), given.parents[given.index(name)]
        own = multiply(inverse(found.rotations[rows, above]), found.rotations[rows, joint])
        apart = np.abs(np.abs(np.sum(own * turns[:, joint], axis=1)) - 1.0).max()
        assert (apart > 1e-3) == changed
        assert np.abs(np.sum(own * others[:, joint], axis=1)).min() > 0.999


def test_joints_come_back_and_no_other_angle_is_changed(shared_data):
    truth = mm.read_pose(shared_data / "poses" / "02_05.amc")
    rows = slice(800, 830)
    wrong = turned(truth.source, "rradius", 0, rows, -70.0)
    given = forward_kinematics(wrong, truth.rate)
    arm = list(truth.hanging_on(truth.index("rradius")))
    faults = [(f.kind, f.joint, f.start, f.stop) for f in mend_faults(given)[1]]
    assert sorted(faults) == sorted((THROWN, joint, 800, 830) for joint in arm)
    told = restore(given, prior=shipped_prior())
    off = np.linalg.norm(told.pose.positions - truth.positions, axis=2)[rows][:, arm]
    assert off.max() < 15.0
    back = inverse_kinematics(told.pose, wrong)
    for name, values in wrong.channels.items():
        changed = np.argwhere(np.abs(back.channels[name] - values) > 1e-6)
        wanted = {(n, 0) for n in range(800, 830)} if name == "rradius" else set()
        assert set(map(tuple, changed.tolist())) == wanted
    assert np.abs(back.channels["rradius"] - truth.source.channels["rradius"]).max() < 8.0


def test_of_two_ways_that_disagree_more_is_expected(movement, monkeypatch):
    pose = forward_kinematics(movement.part(0, 40), RATE)
    hand, rows = pose.index("hand"), slice(10, 20)

    def elsewhere(told, *_):
        places = np.array(told.positions)
        places[rows, hand] += np.array([0.0, 60.0, 80.0])
        return told.with_samples(places, told.rotations)

    usual = restore(pose).error_mm
    monkeypatch.setattr("markermend.poses.restore.with_own_angles", elsewhere)
    told = restore(pose).error_mm
    np.testing.assert_allclose(told[rows, hand], np.hypot(usual[rows, hand], 100.0 / 2.0**0.5))
    told[rows, hand] = usual[rows, hand]
    np.testing.assert_array_equal(told, usual)


def test_where_other_angles_were_wrong_too_what_was_filled_stays(movement):
    segments = [
        replace(s, length=4.0 if s.name == "hand" else s.length) for s in movement.skeleton.segments
    ]
    movement = replace(movement, skeleton=Skeleton(tuple(segments), 50.0))
    truth, rows = forward_kinematics(movement, RATE), slice(100, 130)
    thrown = turned(movement, "fore", 0, rows, 30.0)
    # The hand's angle slides away, and does not jump.
    slid = turned(thrown, "hand", 1, rows, 170.0 * np.sin(np.linspace(0, np.pi, 30)))
    told = truth.with_samples(truth.positions, truth.rotations)
    for given, kept in (
        (forward_kinematics(thrown, RATE), True),
        (forward_kinematics(slid, RATE), False),
    ):
        _, faults = mend_faults(given)
        assert {f.kind for f in faults} == {THROWN}
        found = with_own_angles(told, given, faults)
        np.testing.assert_allclose(found.positions, truth.positions, atol=0.5)
        assert (found.positions != told.positions).any() == kept


def test_where_two_angles_are_wrong_at_a_time_what_was_filled_stays(movement):
    """A hand is so short that the arm alone seems to explain nearly all."""
    truth, fore = forward_kinematics(movement, RATE), slice(100, 160)
    thrown = turned(movement, "fore", 0, fore, 60.0)
    told = truth.with_samples(truth.positions + np.array([0.0, 3.0, 0.0]), truth.rotations)
    both = turned(thrown, "hand", 1, slice(120, 140), 40.0)
    for movement, kept in ((thrown, True), (both, False)):
        given = forward_kinematics(movement, RATE)
        found = with_own_angles(told, given, mend_faults(given)[1])
        hand = truth.index("hand")
        assert (found.positions != told.positions)[fore, hand].any() == kept


@pytest.mark.parametrize("bvh", [False, True])
def test_where_filling_is_far_off_for_a_time_angles_go_steadily_to_what_is_after(movement, bvh):
    truth, rows = forward_kinematics(movement, RATE), slice(100, 130)
    given = forward_kinematics(turned(movement, "fore", 0, rows, 60.0), RATE)
    given = replace(given, source=None) if bvh else given
    places, (fore, hand) = np.array(truth.positions), map(truth.index, ("fore", "hand"))
    away = np.zeros((FRAMES, 1, 1))
    away[100:112, 0, 0] = np.sin(np.linspace(0.0, np.pi, 12))
    places[:, [fore, hand]] += away * np.array([0.0, 400.0, 300.0])
    told = truth.with_samples(places, truth.rotations)
    found = with_own_angles(told, given, mend_faults(given)[1])
    turns = hinges_of(truth).turns[rows].copy()
    turns[:, fore] = hinges_of(truth).bridged(fore, rows)
    apart = np.abs(np.sum(hinges_of(found).turns[rows] * turns, axis=2)) - 1.0
    np.testing.assert_allclose(apart, 0.0, atol=1e-9)


def test_a_few_times_are_found_in_a_second_or_two(movement):
    twice = turned(
        turned(movement, "fore", 0, slice(60, 80), 60.0), "fore", 0, slice(150, 170), 60.0
    )
    assert found_in(twice) == {("fore", 60, 169, 40), ("hand", 60, 169, 40)}
    brief = turned(movement, "fore", 0, slice(50, 70), -50.0).part(0, 120)
    assert found_in(brief) == {("fore", 50, 69, 20), ("hand", 50, 69, 20)}


def test_a_source_that_is_another_recording_by_now_is_not_asked(movement):
    truth = forward_kinematics(movement, RATE)
    given = forward_kinematics(turned(movement, "fore", 0, slice(100, 160), 60.0), RATE)
    later = replace(given.source, channels={n: v[::-1] for n, v in given.source.channels.items()})
    _, faults = mend_faults(given)
    told = truth.with_samples(truth.positions + np.array([0.0, 3.0, 0.0]), truth.rotations)
    found = with_own_angles(told, replace(given, source=later), faults)
    hand = truth.index("hand")
    assert (found.positions != told.positions)[100:160, hand].any(), "bones tell, without the file"
    np.testing.assert_allclose(found.positions, truth.positions, atol=5.0)


def test_a_root_that_is_turned_wrongly_throws_nobody_off(movement):
    """Its own joints' angles jump to keep the body where it is."""
    pose = forward_kinematics(movement, RATE)
    rotations = np.array(pose.rotations)
    rotations[100:120, 0] = multiply(rotations[100:120, 0], np.array([0.0, 0.0, 0.5, 0.75**0.5]))
    assert not thrown_off(pose.with_samples(pose.positions, rotations)).any()


def test_of_a_joint_with_three_angles_the_others_keep_their_numbers(movement):
    truth, rows = forward_kinematics(movement, RATE), slice(100, 130)
    wrong = turned(movement, "arm", 1, rows, 50.0)
    given = forward_kinematics(wrong, RATE)
    told = truth.with_samples(truth.positions + np.array([0.0, 3.0, 0.0]), truth.rotations)
    found = with_own_angles(told, given, mend_faults(given)[1])
    arm = [truth.index(name) for name in ("arm", "fore", "hand")]
    positions, rotations = np.array(truth.positions), np.array(truth.rotations)
    positions[rows, arm], rotations[rows, arm] = (
        found.positions[rows, arm],
        found.rotations[rows, arm],
    )
    back = inverse_kinematics(truth.with_samples(positions, rotations), wrong)
    for name, values in wrong.channels.items():
        changed = np.argwhere(np.abs(back.channels[name] - values) > 1e-6)
        assert {column for _, column in changed.tolist()} == ({1} if name == "arm" else set())
