"""Channels of a skeleton: joints come to where the recording has them, and the rest stays."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest
from acclaim import arm_and_leg
from scipy.spatial.transform import Rotation

import markermend as mm
from markermend.errors import Cancelled
from markermend.poses.inverse import how_far_off, inverse_kinematics
from markermend.poses.quaternion import multiply, turn
from markermend.poses.skeleton import Movement, Segment, Skeleton, forward_kinematics

FRAMES = 30


@pytest.fixture
def movement():
    return arm_and_leg(FRAMES)


def test_what_did_not_change_stays_to_the_last_bit(movement):
    pose = forward_kinematics(movement, 100.0)
    found = inverse_kinematics(pose, movement)
    for name, values in movement.channels.items():
        np.testing.assert_array_equal(found.channels[name], values)


def test_a_joint_that_was_moved_is_reached_and_the_others_stay(movement):
    """Only places are told, not how joints are turned."""
    pose = forward_kinematics(movement, 100.0)
    other = dict(movement.channels)
    other["arm"], other["fore"] = other["arm"].copy(), other["fore"].copy()
    other["arm"][10:20] += [8.0, -5.0, 6.0]
    other["fore"][10:20] += 10.0
    wanted = forward_kinematics(replace(movement, channels=other), 100.0)
    found = inverse_kinematics(replace(pose, positions=wanted.positions), movement)
    placed = forward_kinematics(found, 100.0)
    assert np.abs(placed.positions - wanted.positions).max() < 0.05
    for name in ("root", "leg"):
        np.testing.assert_array_equal(found.channels[name], movement.channels[name])
    for name, values in movement.channels.items():
        np.testing.assert_array_equal(found.channels[name][:10], values[:10])
        np.testing.assert_array_equal(found.channels[name][20:], values[20:])


def degrees_apart(one, two):
    same = np.minimum(np.abs(np.sum(one * two, axis=-1)), 1.0)
    return np.degrees(2.0 * np.arccos(same))


@pytest.mark.parametrize("count", [1, 2, 3])
def test_however_far_a_segment_bends_its_turns_come_back(count):
    """Euler angles cut to two tell another turn where the second is 90 degrees or more."""
    orders = list(permutations(("rx", "ry", "rz"), count))
    head = Segment("root", -1, (0.0, 0.0, 1.0), 0.0, dofs=("rx", "ry", "rz"))
    limbs = [
        Segment("".join(order), 0, (1.0, 0.0, 0.0), 2.0, (10.0, 20.0, 30.0), "xyz", order)
        for order in orders
    ]
    draw = np.random.default_rng(2)
    channels = {s.name: draw.uniform(-179, 179, (FRAMES, len(s.dofs))) for s in (head, *limbs)}
    movement = Movement(Skeleton((head, *limbs), 50.0), channels, FRAMES)
    pose = forward_kinematics(movement, 100.0)
    noise = Rotation.from_rotvec(draw.normal(0.0, 0.01, (pose.rotations[..., 0].size, 3)))
    noisy = multiply(pose.rotations, noise.as_quat().reshape(pose.rotations.shape))
    whole = multiply(np.array([0.0, 0.6, 0.0, 0.8]), pose.rotations)
    for rotations, off in ((whole, 1e-4), (noisy, 5.0)):
        found = inverse_kinematics(replace(pose, rotations=rotations), movement)
        again = forward_kinematics(found, 100.0)
        assert degrees_apart(again.rotations, rotations).max() < off


def test_a_recording_turned_as_a_whole_is_written_as_a_turn_of_the_root(shared_data):
    pose = mm.read_pose(shared_data / "poses" / "01_11.amc")
    about = np.array([0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5)])
    turned = pose.with_samples(
        turn(about, pose.positions), multiply(about, pose.rotations), pose.confidence
    )
    movement = inverse_kinematics(turned, pose.source)
    assert how_far_off(movement, turned).max() < 0.1
    for name, values in pose.source.channels.items():
        if name != "root":
            np.testing.assert_allclose(movement.channels[name], values, atol=1e-4)


def test_places_count_more_than_turns_that_do_not_fit_them(movement):
    pose = forward_kinematics(movement, 100.0)
    rotations = pose.rotations.copy()
    rotations[5:15, 2] = [0.0, 0.0, 0.0, 1.0]
    places = pose.positions.copy()
    places[5:15, 4] += 0.01
    found = inverse_kinematics(replace(pose, rotations=rotations, positions=places), movement)
    assert how_far_off(found, pose).max() < 0.5
    # Where no place was changed, only the turns can be meant.
    found = inverse_kinematics(replace(pose, rotations=rotations), movement)
    turned = forward_kinematics(found, 100.0).rotations
    np.testing.assert_allclose(turned[:, 2] * np.sign(turned[:, 2, 3:]), rotations[:, 2]
                               * np.sign(rotations[:, 2, 3:]), atol=1e-9)  # fmt: skip


def test_what_rigid_bones_cannot_reach_comes_as_near_as_they_can(movement):
    pose = forward_kinematics(movement, 100.0)
    places = pose.positions.copy()
    begin, end = places[12, 2], places[12, 3]
    places[12, 3] = end + 40.0 * (end - begin) / np.linalg.norm(end - begin)
    found = inverse_kinematics(replace(pose, positions=places), movement)
    assert 5.0 < how_far_off(found, replace(pose, positions=places)).max() < 30.0
    left = np.linalg.norm(places - forward_kinematics(found, 100.0).positions, axis=2)
    assert np.sum(left[12] ** 2) < 0.7 * 40.0**2
    assert left[:12].max() == left[13:].max() == 0.0


def test_an_unseen_joint_is_left_out_with_what_hangs_on_it(movement):
    pose = forward_kinematics(movement, 100.0)
    hidden, places = pose.confidence.copy(), pose.positions.copy()
    hidden[7, 3] = 0.0
    places[7, 1] += 1.0
    unseen = pose.with_samples(places, pose.rotations, hidden)
    found = inverse_kinematics(unseen, movement)
    assert np.isnan(found.channels["fore"][7]).all()
    assert np.isnan(found.channels["hand"][7]).all()
    assert np.isfinite(found.channels["arm"][7]).all()
    # The hand was seen, but cannot be told without the forearm.
    off = how_far_off(found, unseen)
    assert np.isinf(off).tolist() == [name == "hand" for name in unseen.joints]
    assert off[np.isfinite(off)].max() < 2.0


def test_any_recording_can_be_written_by_a_skeleton_of_another_length(movement):
    pose = forward_kinematics(movement, 100.0)
    other = movement.part(0, 4)
    found = inverse_kinematics(pose, other)
    assert found.frames == FRAMES
    # The leg is 5 mm longer than at rest, which no channel of the recording tells.
    assert 2.0 < how_far_off(found, pose).max() < 5.5


def test_it_tells_how_far_it_is_and_can_be_stopped(movement, monkeypatch):
    monkeypatch.setattr("markermend.poses.inverse.BLOCK", 10)
    pose = forward_kinematics(movement, 100.0)
    moved = replace(pose, positions=pose.positions + 1.0)
    told = []
    inverse_kinematics(moved, movement, progress=lambda share, _: told.append(share))
    assert told == [0.0, 10 / FRAMES, 20 / FRAMES]

    def stop(share: float, _: str) -> None:
        if share > 0.5:
            raise Cancelled

    with pytest.raises(Cancelled):
        inverse_kinematics(moved, movement, progress=stop)


def test_a_skeleton_without_a_movement_stays_as_it_is(movement):
    rest = Movement(movement.skeleton, {}, 1)
    pose = forward_kinematics(rest, 100.0)
    found = inverse_kinematics(replace(pose, positions=pose.positions + 5.0), rest)
    assert found.channels == {}


def test_what_was_filled_is_reached_by_its_own_angles_and_measured_ones_stay(movement):
    """How a joint that was filled is turned need not fit where it is."""
    pose = forward_kinematics(movement, 100.0)
    channels = {name: np.array(values) for name, values in movement.channels.items()}
    channels["fore"][10:20] = channels["hand"][10:20] = np.nan
    rotations = pose.rotations.copy()
    for name in ("fore", "hand"):
        part = rotations[10:20, pose.index(name)]
        rotations[10:20, pose.index(name)] = multiply(part, np.array([0.2, 0.1, 0.3, 0.86**0.5]))
    found = inverse_kinematics(
        replace(pose, rotations=rotations), replace(movement, channels=channels)
    )
    assert how_far_off(found, pose).max() < 0.5
    for name in ("root", "back", "arm", "leg"):
        np.testing.assert_array_equal(found.channels[name], movement.channels[name])


def test_angles_of_what_was_filled_go_on_in_as_many_rounds(movement):
    truth = {name: np.array(values) for name, values in movement.channels.items()}
    truth["root"][:, 3:] = np.linspace([166.0, -15.0, -178.0], [172.0, -18.0, -183.0], FRAMES)
    # A middle angle beyond 90 degrees is told otherwise, too.
    truth["arm"][:] = np.linspace([20.0, 110.0, 30.0], [25.0, 120.0, 50.0], FRAMES)
    truth["hand"] += 1090.0
    whole = replace(movement, channels=truth)
    pose = forward_kinematics(whole, 100.0)
    for rows in (slice(10, 20), slice(0, 8), slice(24, None)):
        gone = {name: np.array(values) for name, values in truth.items()}
        for name in ("root", "arm", "hand"):
            gone[name][rows] = np.nan
        found = inverse_kinematics(pose, replace(movement, channels=gone))
        for name, values in truth.items():
            np.testing.assert_allclose(found.channels[name], values, atol=1e-4)


def test_places_that_cannot_be_reached_turn_nothing_round_and_round(movement):
    pose = forward_kinematics(movement, 100.0)
    places, arm = pose.positions.copy(), [pose.index(name) for name in ("arm", "fore", "hand")]
    places[:, arm] += np.random.default_rng(0).normal(0.0, 400.0, (FRAMES, len(arm), 3))
    found = inverse_kinematics(replace(pose, positions=places), movement)
    for name in ("arm", "fore", "hand"):
        assert np.abs(found.channels[name] - movement.channels[name]).max() <= 180.0
    # With steps of any size it is 420 mm.
    away = np.linalg.norm(forward_kinematics(found, 100.0).positions - places, axis=2)
    assert np.sqrt(np.mean(away**2)) < 412.0
