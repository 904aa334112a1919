"""Noise taken out of poses as they come, as far as bones show that there is some."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from recordings import seventeen_joints
from scipy.spatial.transform import Rotation

from markermend.poses.live import Live
from markermend.poses.pose import Pose
from markermend.poses.prior import shipped_prior
from markermend.poses.quaternion import lengths_of
from markermend.poses.simulated.noise import Noise, corrupt_pose
from markermend.poses.streaming.bracing import Bracing
from markermend.poses.streaming.shaking import Shaking
from markermend.poses.streaming.steadying import Steadying
from markermend.poses.streaming.tracking import Tracking

NOISE_MM, NOISE_RAD = 3.87, 0.031


@pytest.fixture(scope="module")
def walk(shared_data):
    return seventeen_joints(shared_data, "02_01")["02_01"]


@pytest.fixture(scope="module")
def noisy(walk):
    return corrupt_pose(walk, Noise(occlusion=0.0), seed=1)


def steadied(pose, steadying):
    every = zip(pose.positions, pose.rotations, pose.seen, strict=True)
    poses = [steadying(*one) for one in every]
    return np.array([places for places, _ in poses]), np.array([turns for _, turns in poses])


def angles(turns, truth):
    alike = np.abs(np.sum(turns * truth.rotations, axis=2))
    return 2.0 * np.arccos(np.minimum(alike, 1.0))


def test_noisy_joints_come_nearer_and_clean_ones_go_through(walk, noisy):
    places, turns = steadied(noisy, Steadying(walk.parents, walk.rate))
    off, before = (lengths_of(x - walk.positions)[60:].mean() for x in (places, noisy.positions))
    assert off < 0.7 * before
    turned, was = (angles(x, walk)[60:].mean() for x in (turns, noisy.rotations))
    assert turned < 0.7 * was
    assert_allclose(np.sum(turns**2, axis=2), 1.0, atol=1e-9)
    # Rotations come out with the signs that they came with.
    assert (np.sum(turns * noisy.rotations, axis=2) > 0).all()
    places, turns = steadied(walk, Steadying(walk.parents, walk.rate))
    assert (places == walk.positions).all()
    assert (turns == walk.rotations).all()


def test_positions_alone_come_nearer(walk, noisy):
    bare = noisy.with_samples(
        noisy.positions, np.full(noisy.rotations.shape, np.nan), noisy.confidence
    )
    places, turns = steadied(bare, Steadying(walk.parents, walk.rate))
    off, before = (lengths_of(x - walk.positions)[60:].mean() for x in (places, noisy.positions))
    assert off < 0.72 * before
    assert np.isnan(turns).all()


def test_what_is_hidden_comes_back_where_it_is(walk, noisy):
    steadying = Steadying(walk.parents, walk.rate)
    elbow = walk.joints.index("left_elbow")
    seen = noisy.seen.copy()
    seen[100:160, elbow] = False
    odd = noisy.positions.copy()
    odd[100:160, elbow] = 5e3
    given = zip(odd, noisy.rotations, seen, strict=True)
    places = np.array([steadying(*one)[0] for one in given])
    # Of what is not seen nothing is said.
    assert (places[100:160, elbow] == 5e3).all()
    assert lengths_of(places - walk.positions)[160:170, elbow].max() < 15.0


def test_what_jumps_is_followed_at_once():
    random = np.random.default_rng(0)
    true = np.repeat([0.0, 500.0], 100)
    tracking = Tracking((1,), 60.0)
    every = np.ones(1, dtype=bool)
    noise = np.array([4.0])
    found = np.array(
        [tracking.follow(np.array([x + random.normal(0, 2.0)]), every, noise)[0] for x in true]
    )
    assert np.abs(found - true).max() < 8.0
    assert np.abs(found - true)[150:].mean() < 1.0


def test_a_constant_speed_is_followed_without_delay():
    random = np.random.default_rng(1)
    true = 5.0 * np.arange(300.0)
    tracking = Tracking((1,), 60.0)
    every, noise = np.ones(1, dtype=bool), np.array([9.0])
    found = np.array(
        [tracking.follow(np.array([x + random.normal(0, 3.0)]), every, noise)[0] for x in true]
    )
    late = (found - true)[100:]
    assert abs(late.mean()) < 0.8
    assert late.std() < 2.0


@pytest.mark.parametrize("rate", [120, 30])
def test_bones_tell_how_noisy_a_sensor_is(walk, rate, shared_data):
    long = seventeen_joints(shared_data, "02_05")["02_05"]
    step = 120 // rate
    some = Pose(long.positions[::step], long.rotations[::step], long.joints, long.parents, rate)
    steadying = Steadying(some.parents, rate)
    shaking = steadying._shaking
    steadied(corrupt_pose(some, Noise(occlusion=0.0), seed=2), steadying)
    assert shaking.noise_mm == pytest.approx(NOISE_MM, rel=0.15)
    assert shaking.noise_rad == pytest.approx(NOISE_RAD, rel=0.35)


def test_rotations_without_noise_are_left_and_pull_nothing_away(walk):
    places = walk.positions + np.random.default_rng(5).normal(0.0, 3.0, walk.positions.shape)
    given = walk.with_samples(places, walk.rotations)
    out, turns = steadied(given, Steadying(walk.parents, walk.rate))
    # Few bones may shake by chance as rotations would.
    assert np.mean((turns != given.rotations).any(axis=(1, 2))) < 0.05
    off, before = (lengths_of(x - walk.positions)[60:] for x in (out, places))
    assert off.mean() < 0.75 * before.mean()
    assert off.max() < before.max()


@pytest.mark.parametrize("until", ["frozen at first", "clean at first", "noisy at first"])
def test_noise_that_begins_or_ends_is_noticed(walk, noisy, until):
    places, turns = noisy.positions.copy(), noisy.rotations.copy()
    if until == "frozen at first":
        places[:5], turns[:5] = places[0], turns[0]
    elif until == "clean at first":
        places[:100], turns[:100] = walk.positions[:100], walk.rotations[:100]
    else:
        places[100:], turns[100:] = walk.positions[100:], walk.rotations[100:]
    given = walk.with_samples(places, turns)
    out, turned = steadied(given, Steadying(walk.parents, walk.rate))
    if until == "noisy at first":
        assert (out[200:] == walk.positions[200:]).all()
        assert (turned[200:] == given.rotations[200:]).all()
    else:
        off, before = (lengths_of(x - walk.positions)[220:].mean() for x in (out, places))
        assert off < 0.75 * before


def test_of_few_poses_no_noise_is_told(noisy):
    shaking = Shaking(2)
    random = np.random.default_rng(3)
    unturned = np.full((2, 3), np.nan)
    for _ in range(23):
        shaking.look(random.normal(300.0, 5.0, 2), unturned, unturned)
    assert shaking.noise_mm == 0.0
    for _ in range(100):
        shaking.look(random.normal(300.0, 5.0, 2), unturned, unturned)
    assert shaking.noise_mm == pytest.approx(5.0 / np.sqrt(2.0), rel=0.3)
    assert shaking.noise_rad == 0.0


def test_bones_that_were_learnt_brace_a_pose(walk, noisy):
    joints = np.arange(1, 17)
    parents = np.array(walk.parents)[1:]
    bracing = Bracing(joints, parents, 17)
    seen = np.ones(17, dtype=bool)
    hidden = walk.joints.index("left_knee")
    seen[hidden] = False

    def bones(pose):
        return lengths_of(pose[joints] - pose[parents])

    off = []
    for frame in range(walk.frames):
        places, turns = noisy.positions[frame], noisy.rotations[frame]
        braced, turned = bracing.braced(places, turns, seen, seen, NOISE_MM)
        if frame < 24:
            assert braced is places
        else:
            assert (braced[hidden] == places[hidden]).all()
            assert (turned[hidden] == turns[hidden]).all()
            both = (braced, turned), (places, turns)
            off.append(
                [
                    (
                        np.abs(bones(x) - bones(walk.positions[frame])).mean(),
                        lengths_of(x - walk.positions[frame]).mean(),
                    )
                    for x, _ in both
                ]
            )
        own = Rotation.from_quat(turns[parents]).inv().apply(places[joints] - places[parents])
        bracing.learn(bones(places), own)
    after, before = np.mean(off, axis=0)
    assert after[0] < 0.5 * before[0]
    assert after[1] < 0.9 * before[1]


def test_a_bone_that_changes_its_length_braces_nothing():
    bracing = Bracing(np.array([1]), np.array([0]), 2)
    random = np.random.default_rng(4)
    both, turns = np.ones(2, dtype=bool), np.tile([0.0, 0.0, 0.0, 1.0], (2, 1))
    for _ in range(100):
        bone = np.array([[random.normal(300.0, 30.0), 0.0, 0.0]])
        bracing.learn(bone[:, 0], bone)
    places = np.array([[0.0, 0.0, 0.0], [350.0, 0.0, 0.0]])
    assert (bracing.braced(places, turns, both, both, 1.0)[0] == places).all()


def test_hidden_joints_are_nearer_where_what_is_seen_is_steadied(walk, monkeypatch):
    damaged = corrupt_pose(walk, Noise(burst=30), seed=3)

    def off():
        live = Live(
            Pose(walk.positions[:1], walk.rotations[:1], walk.joints, walk.parents, 120.0),
            shipped_prior(),
        )
        given = zip(damaged.positions, damaged.rotations, damaged.seen, strict=True)
        places = np.array([live(*one)[0] for one in given])
        away = lengths_of(places - walk.positions)[60:]
        return away[~damaged.seen[60:]].mean(), away[damaged.seen[60:]].mean()

    hidden, seen = off()
    monkeypatch.setattr(Steadying, "__call__", lambda _, places, turns, *__: (places, turns))
    raw = off()
    assert hidden < 0.97 * raw[0]
    assert seen < 0.75 * raw[1]


def test_bones_of_very_different_lengths_tell_a_number():
    """The long one's noise is of turns, the short ones' is not."""
    rng, lengths = np.random.default_rng(0), np.array([400.0, 400.0, 20.0, 20.0])
    shaking, sizes = Shaking(4), np.array([12.0, 12.0, 0.0, 0.0])
    for _ in range(60):
        ends = rng.normal(size=(2, 4, 3)) * sizes[:, None] + [1.0, 0.0, 0.0] * lengths[:, None]
        shaking.look(lengths + rng.normal(scale=4.0, size=4), *ends)
    assert np.isfinite([shaking.noise_mm, shaking.noise_rad]).all()
