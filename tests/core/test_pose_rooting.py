"""A root that was not seen, from what hangs on it."""

from __future__ import annotations

import numpy as np
import pytest
from arms import arm, hide
from scipy.spatial.transform import Rotation

import markermend as mm
from markermend.poses.body.rooting import rooted
from markermend.poses.channels import trusted_turns
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.prior import shipped_prior
from markermend.poses.quaternion import lengths_of, multiply, turn
from markermend.poses.restore import restore


@pytest.fixture(scope="module")
def run(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_03.amc"))


def hidden(pose, frames, joints=("waist",)):
    for joint in joints:
        pose = hide(pose, frames, pose.joints.index(joint))
    return pose


@pytest.mark.parametrize("frames", [slice(60, 70), slice(40, 140), slice(0, 40), slice(130, None)])
def test_what_hangs_on_a_root_tells_where_it_was_and_how_it_was_turned(run, frames):
    found = rooted(*seen_of(hidden(run, frames)))
    off = lengths_of(found.position - run.positions[:, 0])
    assert off[frames].max() < 15.0
    seen = np.ones(run.frames, dtype=bool)
    seen[frames] = False
    assert not off[seen].any()
    alike = np.abs(np.sum(found.rotation * run.rotations[:, 0], axis=1))[frames]
    assert np.degrees(2.0 * np.arccos(np.minimum(alike, 1.0))).max() < 6.0
    told = found.error_mm
    assert not told[seen].any()
    assert 0.3 < told[frames].mean() / off[frames].mean() < 5.0


def seen_of(pose):
    return pose, trusted_turns(pose)


@pytest.mark.parametrize("noise_mm", [3.0, 8.0])
def test_noise_is_not_carried_into_a_gap(run, noise_mm):
    random = np.random.default_rng(0)
    places = run.positions + random.normal(0.0, noise_mm, run.positions.shape)
    noisy = hidden(run.with_samples(places, run.rotations), slice(40, 140))
    found = rooted(*seen_of(noisy))
    off = lengths_of(found.position - run.positions[:, 0])[40:140]
    assert off.mean() < 2.5 * noise_mm
    assert 0.5 < found.error_mm[40:140].mean() / off.mean() < 3.0


def test_where_nothing_that_hangs_on_it_was_seen_a_root_is_bridged(run):
    gone = hidden(run, slice(60, 70), ("waist", "torso", "left_hip", "right_hip"))
    found = rooted(*seen_of(gone))
    off = lengths_of(found.position - run.positions[:, 0])[60:70]
    assert 0.5 < off.mean() < 30.0
    assert 0.3 < found.error_mm[60:70].mean() / off.mean() < 5.0


@pytest.fixture(scope="module")
def climb(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "01_08.amc"))


def test_where_nothing_that_hangs_on_it_was_seen_joints_further_away_tell(climb):
    around = ("waist", "torso", "left_hip", "right_hip")
    gaps = [slice(first, first + 60) for first in range(200, 2000, 200)]
    hidden_there = np.concatenate([np.r_[gap] for gap in gaps])
    offs = {}
    for further in (True, False):
        gone = climb
        for gap in gaps:
            gone = hidden(gone, gap, around if further else climb.joints)
        found = rooted(*seen_of(gone))
        offs[further] = lengths_of(found.position - climb.positions[:, 0])[hidden_there]
        expected = found.error_mm[hidden_there]
        assert 0.4 < expected.mean() / offs[further].mean() < 3.0
    assert offs[True].mean() < 0.8 * offs[False].mean()


def test_while_nobody_is_seen_a_root_goes_on_turning_as_it_did(run):
    for about in (0.0, 100.0, 180.0):
        away = Rotation.from_euler("y", about, degrees=True).as_quat()
        turned = run.with_samples(turn(away, run.positions), multiply(away, run.rotations))
        gone = hidden(turned, slice(60, 72), run.joints)
        found = rooted(*seen_of(gone))
        alike = np.abs(np.sum(found.rotation * turned.rotations[:, 0], axis=1))
        assert np.degrees(2.0 * np.arccos(np.minimum(alike, 1.0))).max() < 6.0
        told = restore(gone, prior=shipped_prior())
        off = lengths_of(told.pose.positions - turned.positions)[60:72]
        assert off.mean() < 25.0
        # Others are as far off as the root that they hang on, and more.
        expected = told.error_mm[60:72]
        assert (expected[:, 1:] >= expected[:, :1]).all()
        assert 0.5 < expected[:, 1:].mean() / off[:, 1:].mean() < 2.0


def test_without_rotations_it_goes_on_turning_as_joints_stood_around_it(run):
    away = Rotation.from_euler("y", 100.0, degrees=True).as_quat()
    places = turn(away, run.positions)
    unturned = run.with_samples(places, np.full(run.rotations.shape, np.nan))
    told = restore(hidden(unturned, slice(60, 72), run.joints), prior=shipped_prior())
    assert lengths_of(told.pose.positions - places)[60:72].mean() < 25.0


def test_of_one_joint_only_the_way_beside_tells_how_a_root_turned():
    pose = arm()
    found = rooted(*seen_of(hide(pose, slice(100, 120), 0)))
    assert lengths_of(found.position - pose.positions[:, 0])[100:120].max() < 25.0


@pytest.mark.parametrize("gone", [("left_hip", "right_hip"), ("torso",), ("right_hip",)])
def test_those_of_its_joints_that_are_seen_are_held_against_themselves(run, gone):
    away = Rotation.from_euler("y", 100.0, degrees=True).as_quat()
    turned = run.with_samples(turn(away, run.positions), multiply(away, run.rotations))
    found = rooted(*seen_of(hidden(turned, slice(60, 80), ("waist", *gone))))
    off = lengths_of(found.position - turned.positions[:, 0])
    assert off[60:80].max() < 15.0
    assert not off[:60].any()
    # Hips alone leave open how the root leans, which is expected, too.
    assert 0.3 < found.error_mm[60:80].mean() / off[60:80].mean() < 5.0
    alike = np.abs(np.sum(found.rotation * turned.rotations[:, 0], axis=1))[60:80]
    assert np.degrees(2.0 * np.arccos(np.minimum(alike, 1.0))).max() < 6.0


def test_of_very_many_sets_of_joints_the_rarest_are_taken_together(run, monkeypatch):
    monkeypatch.setattr("markermend.poses.body.rooting._MOST_PARTS", 1)
    some = hidden(hidden(run, slice(60, 80)), slice(60, 64), ("torso",))
    some = hidden(hidden(some, slice(64, 66), ("left_hip",)), slice(66, 67), run.joints)
    found = rooted(*seen_of(some))
    assert lengths_of(found.position - run.positions[:, 0])[60:80].max() < 40.0
    assert (found.error_mm[60:80] > 0).all()


def test_a_restored_body_stands_on_its_root(run):
    told = restore(hidden(run, slice(40, 140)), prior=shipped_prior())
    off = lengths_of(told.pose.positions - run.positions)
    assert off[40:140, 0].max() < 15.0
    assert off[:, 1:].max() < 1e-6
    assert told.filled[40:140, 0].all()


def test_a_root_that_is_never_seen_or_turned_is_at_rest(run):
    found = rooted(*seen_of(hidden(run, slice(None))))
    assert not found.position.any()
    assert np.isnan(found.error_mm).all()
