"""Joints that join poses as they come once they are seen, and those that never are."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.errors import DataError
from markermend.poses import Pose
from markermend.poses.live import Live
from markermend.poses.normal import normalise
from markermend.poses.nuitrack import mirrored, to_nuitrack
from markermend.poses.prior import bending_of, fitting, shipped_prior
from markermend.poses.simulated.noise import Noise, corrupt_pose
from markermend.poses.streaming.following import Following
from markermend.poses.streaming.joining import Kept, widened, widened_mean

LEG = ("hip", "knee", "ankle")


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))


@pytest.fixture(scope="module")
def seen(walk):
    """What bursts leave."""
    return np.array(corrupt_pose(walk, Noise(displacement=0.0, burst=30), seed=3).seen)


def at(pose, *joints):
    return [pose.index(joint) for joint in joints]


def legs_of(pose):
    return at(pose, *(f"{side}_{joint}" for side in ("left", "right") for joint in LEG))


def one(pose, seen, frame=0):
    rows = slice(frame, frame + 1)
    return Pose(
        pose.positions[rows],
        pose.rotations[rows],
        pose.joints,
        pose.parents,
        pose.rate,
        seen[rows].astype(float),
    )


def run(pose, seen, prior=None):
    """Positions and rotations of all poses but the first, in which what is hidden is NaN."""
    live = Live(one(pose, seen), prior)
    shown = one(pose, seen).with_samples(pose.positions, pose.rotations, seen.astype(float))
    places, turns = zip(
        *(live(shown.positions[t], shown.rotations[t], seen[t]) for t in range(1, pose.frames)),
        strict=True,
    )
    return np.array(places), np.array(turns)


def off(places, pose):
    return np.linalg.norm(places - pose.positions[1:], axis=2)


@pytest.mark.parametrize("prior", [None, shipped_prior()])
def test_legs_that_are_never_seen_stay_so_and_the_rest_is_filled(walk, seen, prior):
    seen = seen.copy()
    seen[0] = True
    whole, _ = run(walk, seen, prior)
    legs = legs_of(walk)
    seen[:, legs] = False
    places, _ = run(walk, seen, prior)
    assert np.isnan(places[:, legs]).all()
    rest = ~seen[1:]
    rest[:, legs] = False
    assert off(places, walk)[rest].mean() < 1.3 * off(whole, walk)[rest].mean()


def test_a_prior_serves_without_the_legs(walk, seen):
    legs = legs_of(walk)
    seen = seen.copy()
    seen[:, legs], seen[0] = False, True
    seen[0, legs] = False
    rest = ~seen[1:]
    rest[:, legs] = False
    assert Live(one(walk, seen), shipped_prior()).by_prior
    told, untold = (off(run(walk, seen, p)[0], walk)[rest].mean() for p in (shipped_prior(), None))
    assert told < 0.9 * untold


@pytest.mark.parametrize(("prior", "most"), [(None, 250.0), (shipped_prior(), 150.0)])
def test_an_arm_that_comes_later_joins(walk, prior, most):
    arm = at(walk, "left_shoulder", "left_elbow", "left_wrist")
    seen = np.ones(walk.positions.shape[:2], dtype=bool)
    seen[:60, arm] = seen[120:150, arm] = False
    places, turns = run(walk, seen, prior)
    assert np.isnan(places[:59, arm]).all()
    assert np.isnan(turns[:59, arm]).all()
    assert np.isfinite(places[59:]).all()
    np.testing.assert_array_equal(places[59:119], walk.positions[60:120])
    assert 0.0 < off(places, walk)[119:149, arm].max() < most


def test_joints_join_one_by_one(walk):
    seen = np.ones(walk.positions.shape[:2], dtype=bool)
    wrist, elbow = at(walk, "left_wrist", "left_elbow")
    seen[:40, elbow], seen[:80, wrist], seen[100:110, [elbow, wrist]] = False, False, False
    live = Live(one(walk, seen), shipped_prior())
    joined = []
    for t in range(1, walk.frames):
        live(walk.positions[t], walk.rotations[t], seen[t])
        joined.append(int(live.joined.sum()))
    assert joined == [15] * 39 + [16] * 40 + [17] * (walk.frames - 80)
    # How a joint is turned nobody knows while what hangs on it was never seen: as it came.
    _, turns = run(walk, seen, shipped_prior())
    np.testing.assert_array_equal(turns[40:79, elbow], walk.rotations[41:80, elbow])


def test_it_begins_with_the_root_and_a_bone(walk):
    seen = np.zeros(walk.positions.shape[:2], dtype=bool)
    root, torso, hand = at(walk, "waist", "torso", "left_wrist")
    seen[5:, hand], seen[10:, root], seen[20:, torso] = True, True, True
    live, begun = Live(one(walk, seen), shipped_prior()), []
    for t in range(1, walk.frames):
        places, turns = live(walk.positions[t], walk.rotations[t], seen[t])
        np.testing.assert_array_equal(places, walk.positions[t])
        np.testing.assert_array_equal(turns, walk.rotations[t])
        begun.append(live.begun)
    assert begun.index(True) == 19
    assert np.flatnonzero(live.joined).tolist() == [root, torso, hand]


def test_joints_in_one_place_are_no_bone(walk):
    seen = np.zeros(walk.positions.shape[:2], dtype=bool)
    seen[:, :2] = True
    pose = walk.with_samples(np.ones_like(walk.positions), walk.rotations)
    live = Live(one(pose, seen), shipped_prior())
    assert not live.begun
    live(pose.positions[1], pose.rotations[1], seen[1])
    live(walk.positions[2], walk.rotations[2], seen[2])
    assert live.begun


def test_left_hands_join_alike(walk, seen):
    seen = seen.copy()
    legs = legs_of(walk)
    seen[0], seen[:60, legs] = True, False
    right, _ = run(walk, seen, shipped_prior())
    left, _ = run(mirrored(walk), seen, shipped_prior())
    np.testing.assert_allclose(left * [-1.0, 1.0, 1.0], right, atol=1e-6)


def test_a_body_that_is_whole_at_first_is_filled_as_ever(walk, seen):
    seen = seen.copy()
    seen[0] = True
    places, turns = run(walk, seen, shipped_prior())
    first = one(walk, seen)
    fit = fitting(first, shipped_prior())
    following = Following(first, fit[0], None, bending_of(first, shipped_prior()))
    for t in range(1, walk.frames):
        where, turned = following(walk.positions[t], walk.rotations[t], seen[t])
        np.testing.assert_allclose(where, places[t - 1], atol=1e-9)
        np.testing.assert_allclose(turned[seen[t]], turns[t - 1][seen[t]], atol=1e-12)


def test_it_starts_from_one_pose(walk):
    with pytest.raises(DataError, match="one pose, not 343"):
        Live(walk)


def test_what_was_learnt_is_gone_on_with(walk, seen, monkeypatch):
    prior = shipped_prior()
    legs, late = legs_of(walk), 170
    seen = seen.copy()
    seen[0], seen[:late, legs], seen[late, legs] = True, False, True
    after = ~seen[1:]
    after[:late] = False
    kept = off(run(walk, seen, prior)[0], walk)[after].mean()
    monkeypatch.setattr(
        "markermend.poses.live.Following", lambda a, b, _, c: Following(a, b, None, c)
    )
    anew = off(run(walk, seen, prior)[0], walk)[after].mean()
    assert kept < 0.95 * anew


def test_those_that_join_go_with_the_others_as_is_usual():
    random = np.random.default_rng(1)
    half = random.normal(size=(6, 9))
    usual, mean = half @ half.T, random.normal(size=6)
    kept = Kept(np.array([0, 2, 5]), np.array([3, 1, 0]))
    learnt, before = np.zeros((4, 4)), np.zeros(4)
    before[kept.before] = mean[kept.now]
    learnt[np.ix_(kept.before, kept.before)] = usual[np.ix_(kept.now, kept.now)]
    # What is as usual stays so.
    np.testing.assert_allclose(widened(learnt, usual, kept, 0.0), usual, atol=1e-9)
    np.testing.assert_allclose(widened_mean(before, mean, usual, kept, 0.0), mean, atol=1e-9)
    # Who moves twice as far takes those that join along, as does who is elsewhere.
    wide = widened(4.0 * learnt, usual, kept, 0.1)
    assert np.linalg.eigvalsh(wide).min() > 0.0
    weights = np.linalg.solve(
        usual[np.ix_(kept.now, kept.now)] + 0.1 * np.eye(3), usual[np.ix_(kept.now, [1, 3, 4])]
    )
    np.testing.assert_allclose(
        wide[np.ix_(kept.now, [1, 3, 4])], 4.0 * usual[np.ix_(kept.now, kept.now)] @ weights
    )
    moved = widened_mean(before + 1.0, mean, usual, kept, 0.1)
    np.testing.assert_allclose(moved[[1, 3, 4]], mean[[1, 3, 4]] + weights.sum(axis=0))
    # Nothing is known of who joins: nothing is told.
    alone = widened(learnt, np.zeros((6, 6)), kept, 0.1)
    assert (alone[[1, 3, 4]] == 0).all()


def test_a_limb_that_is_never_seen_leaves_the_root_its_axes(walk, seen):
    whole = np.ones(walk.seen.shape)
    _, normal = normalise(walk)
    whole[:, legs_of(walk)] = 0.0
    _, without = normalise(walk.with_samples(walk.positions, walk.rotations, whole))
    np.testing.assert_array_equal(without.offset[0], normal.offset[0])
