"""How hidden joints hang on seen ones."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.poses import Pose
from markermend.poses.live import Live
from markermend.poses.quaternion import lengths_of
from markermend.poses.streaming import following
from markermend.poses.streaming.hanging import bones_more, with_bones

CHAIN = [(joint, joint - 1) for joint in range(1, 6)]


@pytest.mark.parametrize(
    ("hidden", "more"),
    [(set(), 0.0), ({5}, 0.0), ({3}, 0.0), ({0}, 0.0), ({4, 5}, 0.5), ({2, 3, 4}, 1 / 3)],
)
def test_bones_to_the_nearest_seen_joint_are_counted(hidden, more):
    assert bones_more(CHAIN, hidden) == pytest.approx(more)


def test_bones_that_carry_nothing_seen_come_out_whole():
    places = np.random.default_rng(1).normal(0.0, 200.0, (6, 3))
    lengths = [np.nan, 100.0, 250.0, 30.0, 200.0, 80.0]
    shown = [True, True, False, False, False, False]
    out = with_bones(places, CHAIN, lengths, shown)
    np.testing.assert_array_equal(out[:2], places[:2])
    np.testing.assert_allclose(lengths_of(np.diff(out, axis=0))[1:], lengths[2:])


@pytest.fixture(scope="module")
def walk(shared_data):
    """2.3 s of it at 30 Hz, all 31 joints."""
    pose = mm.read_pose(shared_data / "poses" / "03_01.amc")
    at = slice(0, 69 * 4, 4)
    return Pose(pose.positions[at], pose.rotations[at], pose.joints, pose.parents, pose.rate / 4)


def without_a_leg(pose, for_poses=9):
    """(poses, joints of it, 3) where a leg comes out that the last poses do not show."""
    first = Pose(pose.positions[:1], pose.rotations[:1], pose.joints, pose.parents, pose.rate)
    live, leg = Live(first), list(pose.hanging_on(pose.joints.index("lfemur")))
    seen = np.ones(pose.seen.shape, dtype=bool)
    seen[-for_poses:, leg] = False
    came = [live(*of)[0] for of in zip(pose.positions, pose.rotations, seen, strict=True)]
    return np.array(came)[-for_poses:], leg


def test_a_limb_goes_little_by_what_few_poses_told(walk, monkeypatch):
    came, leg = without_a_leg(walk)
    off = lengths_of(came - walk.positions[-9:])[:, leg].mean()
    monkeypatch.setattr(following, "_FEW_A_BONE", 0.0)
    assert off < 0.7 * lengths_of(without_a_leg(walk)[0] - walk.positions[-9:])[:, leg].mean()


def test_bones_of_a_hidden_limb_keep_their_lengths(walk):
    came, leg = without_a_leg(walk)
    parents = [walk.parents[joint] for joint in leg]
    there = lengths_of(walk.positions[0, leg] - walk.positions[0, parents])
    np.testing.assert_allclose(
        lengths_of(came[:, leg] - came[:, parents]), np.tile(there, (9, 1)), atol=1e-6
    )
