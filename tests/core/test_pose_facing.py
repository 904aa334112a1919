"""Bodies of which no rotation is known are looked at as they face."""

from __future__ import annotations

import numpy as np
import pytest
from arms import arm
from numpy.testing import assert_allclose
from recordings import seventeen_joints
from scipy.spatial.transform import Rotation

from markermend.poses.body.facing import facing, sides_of
from markermend.poses.live import Live
from markermend.poses.nuitrack import mirrored
from markermend.poses.pose import Pose
from markermend.poses.prior import fitting, shipped_prior
from markermend.poses.quaternion import inverse, lengths_of, multiply, turn
from markermend.poses.restore import restore
from markermend.poses.simulated.noise import Noise, corrupt_pose


@pytest.fixture(scope="module")
def clips(shared_data):
    return seventeen_joints(shared_data, "01_08", "02_01", "02_04")


def without_turns(pose):
    return pose.with_samples(pose.positions, np.full(pose.rotations.shape, np.nan), pose.confidence)


def turned(pose, degrees, axis="y"):
    away = Rotation.from_euler(axis, degrees, degrees=True).as_quat()
    return pose.with_samples(turn(away, pose.positions), multiply(away, pose.rotations))


def test_a_root_is_turned_as_its_sides_and_spine_stand(clips):
    walk = clips["02_01"]
    faced = facing(without_turns(walk))
    alike = np.abs(np.sum(faced * walk.rotations[:, 0], axis=1))
    # Its own axes are along no bone, but its own at all times.
    between = np.degrees(2.0 * np.arccos(np.minimum(alike, 1.0)))
    assert between.max() < 20.0
    hip = walk.positions[:, walk.joints.index("left_hip")] - walk.positions[:, 0]
    assert (turn(inverse(faced), hip)[:, 0] > 50.0).all()
    away = Rotation.from_euler("zyx", [20.0, 100.0, 50.0], degrees=True).as_quat()
    moved = walk.with_samples(turn(away, walk.positions), walk.rotations)
    same = np.abs(np.sum(facing(moved) * multiply(away, faced), axis=1))
    assert_allclose(same, 1.0, atol=1e-9)


def test_a_frame_without_one_of_its_joints_tells_nothing(clips):
    walk = clips["02_01"]
    confidence = walk.confidence.copy()
    confidence[10:20, walk.joints.index("left_hip")] = 0.0
    confidence[30:35, walk.joints.index("left_knee")] = 0.0
    faced = facing(walk.with_samples(walk.positions, walk.rotations, confidence))
    unknown = np.isnan(faced).all(axis=1)
    assert np.flatnonzero(unknown).tolist() == list(range(10, 20))
    # Hips on one line with the spine tell no third direction.
    flat = walk.positions.copy()
    flat[:, walk.joints.index("torso")] = flat[:, walk.joints.index("left_hip")]
    flat[:, walk.joints.index("waist")] = flat[:, walk.joints.index("right_hip")]
    assert np.isnan(facing(walk.with_samples(flat, walk.rotations))).all()


@pytest.mark.parametrize(
    ("joints", "parents", "left"),
    [
        (("hips", "spine", "LeftUpLeg", "RightUpLeg"), (-1, 0, 0, 0), (2,)),
        (("root", "rfemur", "lfemur", "lowerback"), (-1, 0, 0, 0), (2,)),
        (("pelvis", "thigh.R", "thigh.L", "spine", "tail"), (-1, 0, 0, 0, 0), (2,)),
    ],
)
def test_sides_are_told_by_names(joints, parents, left):
    sides = sides_of(joints, parents)
    assert sides is not None
    assert sides.left == left
    assert {*sides.left, *sides.right, *sides.middle} == {1, 2, 3, *range(4, len(joints))}


def test_without_sides_or_a_spine_nothing_is_told():
    assert sides_of(("a", "b", "c"), (-1, 0, 0)) is None
    assert sides_of(("hips", "left_hip", "right_hip"), (-1, 0, 0)) is None
    assert np.isnan(facing(arm())).all()


@pytest.mark.parametrize("seen_as", ["it is", "from the side", "on its back", "in a mirror"])
def test_a_prior_tells_of_positions_alone_however_the_body_stands(clips, seen_as):
    walk = clips["02_01"]
    walk = {
        "it is": lambda pose: pose,
        "from the side": lambda pose: turned(pose, 100.0),
        "on its back": lambda pose: turned(pose, -90.0, "x"),
        "in a mirror": mirrored,
    }[seen_as](walk)
    damaged = without_turns(corrupt_pose(walk, Noise(displacement=0.0, burst=60), seed=4))
    fit = fitting(damaged, shipped_prior())
    assert fit is not None
    assert fit[1] == (seen_as == "in a mirror")
    restored = restore(damaged, prior=shipped_prior())
    off = lengths_of(restored.pose.positions - walk.positions)[~damaged.seen]
    assert off.mean() < 12.0
    assert np.isnan(restored.pose.rotations).all()
    expected = restored.error_mm[~damaged.seen]
    # Three seconds of somebody's walk do not show that there is nothing else.
    assert 0.6 < np.sqrt(np.mean(expected**2)) / np.sqrt(np.mean(off**2)) < 5.0


def from_the_side(pose):
    """The same, hidden and noisy at 30 Hz, by positions alone and from the side; and as it was."""
    pose = turned(pose, 100.0)
    slow = Pose(pose.positions[::4], pose.rotations[::4], pose.joints, pose.parents, pose.rate / 4)
    return without_turns(corrupt_pose(slow, Noise(burst=30), seed=2)), slow


def without_facing(monkeypatch):
    """Have the root stand in the axes of the room."""
    nothing = lambda pose: np.full((pose.frames, 4), np.nan)  # noqa: E731
    monkeypatch.setattr("markermend.poses.body.rooting.facing", nothing)
    monkeypatch.setattr("markermend.poses.streaming.following.facing", nothing)


def test_positions_alone_are_nearer_for_it(clips, monkeypatch):
    damaged, truth = from_the_side(clips["02_04"])

    def off():
        restored = restore(damaged, prior=shipped_prior()).pose
        return lengths_of(restored.positions - truth.positions)[~damaged.seen].mean()

    faced = off()
    without_facing(monkeypatch)
    assert faced < 0.85 * off()


def test_live_positions_alone_are_nearer_for_it(clips, monkeypatch):
    damaged, truth = from_the_side(clips["01_08"])

    def off():
        first = Pose(truth.positions[:1], damaged.rotations[:1], truth.joints, truth.parents, 30.0)
        live = Live(first, shipped_prior())
        given = zip(damaged.positions, damaged.rotations, damaged.seen, strict=True)
        poses = [live(*one) for one in given]
        assert all(np.isnan(turns).all() for _, turns in poses)
        places = np.array([places for places, _ in poses])
        return lengths_of(places - truth.positions)[~damaged.seen].mean()

    faced = off()
    without_facing(monkeypatch)
    assert faced < 0.85 * off()


def test_live_hips_that_come_late_tell_how_the_root_is_turned(clips):
    damaged, truth = from_the_side(clips["02_04"])
    hips = [truth.joints.index(f"{side}_hip") for side in ("left", "right")]
    legs = [j for j, name in enumerate(truth.joints) if name.split("_")[-1] in ("knee", "ankle")]
    arms = [truth.joints.index(f"{side}_wrist") for side in ("left", "right")]
    off = []
    for late in (0, 20):
        seen = truth.seen.copy()
        seen[:late, hips + legs] = False
        seen[40:60, arms] = False
        one = truth.positions[:1], damaged.rotations[:1], truth.joints, truth.parents, 30.0
        live = Live(Pose(*one, seen[:1].astype(float)), shipped_prior())
        given = zip(truth.positions, damaged.rotations, seen, strict=True)
        places = np.array([live(*pose)[0] for pose in given])
        assert live.joined.all()
        assert live.by_prior
        off.append(lengths_of(places - truth.positions)[40:60, arms].mean())
    assert off[1] < 1.3 * off[0]
