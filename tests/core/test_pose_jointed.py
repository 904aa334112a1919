"""Bodies of which some joints are never seen or turned settle by the others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from recordings import seventeen_joints

import markermend.poses.restore as restoring
from markermend.poses.body.bending import LOCAL
from markermend.poses.body.jointed import jointed
from markermend.poses.filling.sides import Mirror
from markermend.poses.nuitrack import JOINTS
from markermend.poses.pose import Pose
from markermend.poses.prior import bending_of, shipped_prior
from markermend.poses.prior_learning import learn_recording
from markermend.poses.quaternion import lengths_of
from markermend.poses.restore import restore
from markermend.poses.simulated.noise import Noise, corrupt_pose

ENDS = ("head", "left_wrist", "right_wrist", "left_ankle", "right_ankle")


@pytest.fixture(scope="module")
def walk(shared_data):
    walk = seventeen_joints(shared_data, "02_04")["02_04"]
    slow = walk.positions[::4], walk.rotations[::4]
    return Pose(*slow, walk.joints, walk.parents, walk.rate / 4)


def places_of(*names):
    return [JOINTS.index(name) for name in names]


def unturned(pose, joints):
    rotations = pose.rotations.copy()
    rotations[:, joints] = np.nan
    return pose.with_samples(pose.positions, rotations, pose.confidence)


def unseen(pose, joints):
    confidence = pose.confidence.copy()
    confidence[:, joints] = 0.0
    return pose.with_samples(pose.positions, pose.rotations, confidence)


def test_joints_without_rotation_turn_with_their_parents(walk):
    every = np.ones(17, dtype=bool)
    turned = every.copy()
    turned[places_of(*ENDS)] = False
    others = bending_of(walk, shipped_prior())
    body = jointed(walk, every, turned, others)
    assert [
        walk.joints[joint]
        for joint, without in zip(body.joints, body.unturned, strict=True)
        if without
    ] == [JOINTS[j] for j in body.joints if JOINTS[j] in ENDS]
    random = np.random.default_rng(0)
    features = random.normal(size=(5, 17, 7))
    features[:, places_of(*ENDS), 3:] = np.nan
    some = body.of(features)
    wrist = body.joints.index(JOINTS.index("left_wrist"))
    assert_allclose(some[:, wrist, 3:], features[:, JOINTS.index("left_elbow"), 3:])
    assert not np.isnan(some).any()
    back = body.back(some + 1.0, features)
    assert np.isnan(back[:, places_of(*ENDS), 3:]).all()
    known = ~np.isnan(features)
    assert_allclose(back[known], features[known] + 1.0)
    # Others say nothing of turns that there are not, but where such joints are.
    told = body.others.told.reshape(-1, LOCAL)
    assert not told[wrist - 1, :3].any()
    assert told[wrist - 1, 3:].all()
    unsure = body.unsure(np.full((5, 17, 7), 0.5))
    assert (unsure[:, wrist, 3:] == 1.0).all()
    assert (unsure[:, wrist, :3] == 0.5).all()


def test_a_joint_never_seen_is_left_out_and_what_hangs_on_it_hangs_higher(walk):
    seen = np.ones(17, dtype=bool)
    seen[places_of("collar", "left_ankle")] = False
    body = jointed(walk, seen, seen, bending_of(walk, shipped_prior()))
    names = [JOINTS[joint] for joint in body.joints]
    assert "collar" not in names
    assert "left_ankle" not in names
    above = {name: names[body.parents[n]] for n, name in enumerate(names) if n}
    assert above["neck"] == above["left_shoulder"] == "torso"
    assert above["left_knee"] == "left_hip"
    told = body.others.told.reshape(-1, LOCAL)
    # What hangs elsewhere than in others' bodies, and what they have.
    assert not told[names.index("neck") - 1].any()
    assert told[names.index("left_knee") - 1].all()


def test_positions_alone_do_not_settle_so(walk):
    every = np.ones(17, dtype=bool)
    root = np.arange(17) == 0
    assert jointed(walk, every, root, None) is None
    few = root.copy()
    few[places_of("collar", "left_shoulder")] = True
    assert jointed(walk, every, few, None) is None
    assert jointed(walk, every, ~root | root, None) is not None


def test_frames_in_which_a_joint_is_hidden_that_was_ever_known(walk):
    every = np.ones(17, dtype=bool)
    turned = every.copy()
    turned[places_of("head")] = False
    body = jointed(walk, every, turned, None)
    seen, shown = np.ones((2, 6, 17), dtype=bool)
    shown[:, places_of("head")] = False
    assert not body.hidden(seen, shown).any()
    seen[2, 5] = shown[4, 6] = False
    assert np.flatnonzero(body.hidden(seen, shown)).tolist() == [2, 4]


@pytest.fixture(scope="module")
def damaged(walk):
    return corrupt_pose(walk, Noise(burst=30), seed=2)


@pytest.mark.parametrize("lacks", ["rotations of ends", "ankles"])
def test_what_sensors_lack_does_not_keep_a_body_from_settling(walk, damaged, lacks, monkeypatch):
    if lacks == "ankles":
        given = unseen(damaged, places_of("left_ankle", "right_ankle"))
    else:
        given = unturned(damaged, places_of(*ENDS))

    def off():
        restored = restore(given, prior=shipped_prior()).pose
        away = lengths_of(restored.positions - walk.positions)
        hidden = ~given.seen & ~np.isnan(away)
        return away[hidden].mean(), away[given.seen].mean()

    hidden, seen = off()
    monkeypatch.setattr(restoring, "jointed", lambda *_: None)
    unsettled = off()
    assert hidden < 0.95 * unsettled[0]
    assert seen < 0.95 * unsettled[1]


@pytest.mark.parametrize("lacks", ["all rotations", "rotations of ends"])
def test_the_other_side_tells_of_bodies_that_lack_rotations(walk, damaged, lacks, monkeypatch):
    given = unturned(damaged, range(17) if lacks == "all rotations" else places_of(*ENDS))

    def off():
        restored = restore(given, prior=shipped_prior()).pose
        return lengths_of(restored.positions - walk.positions)[~given.seen].mean()

    both = off()
    monkeypatch.setattr(Mirror, "of", lambda *_: None)
    assert both < 0.97 * off()


def test_a_mirror_of_some_columns_shows_them_as_the_whole_one_does():
    random = np.random.default_rng(3)
    twins = np.array([0, 2, 1, 4, 3, 5])
    whole = Mirror(twins, random.choice([-1.0, 1.0], 6).astype(np.float32))
    rows = random.normal(size=(4, 6)).astype(np.float32)
    kept = np.array([True, False, False, True, True, True])
    assert_allclose(whole.of(kept).image(rows[:, kept]), whole.image(rows)[:, kept])
    # Without its counterpart a column has no image.
    assert whole.of(np.array([True, True, False, True, True, True])) is None


def test_remembered_recordings_tell_of_bodies_that_lack_rotations(walk, damaged):
    prior = shipped_prior()
    own = learn_recording(walk, "walk")
    given = unturned(damaged, places_of(*ENDS))
    off = []
    for remembered in ((), own.remembered):
        learnt = replace(prior, remembered=remembered)
        restored = restore(given, prior=learnt).pose
        off.append(lengths_of(restored.positions - walk.positions)[~given.seen].mean())
    assert off[1] < 0.9 * off[0]
