"""Expected errors without others' recordings, from what is hidden where it is known."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.poses.filling.trials import enough_around, hidden_in, trials_of
from markermend.poses.restore import restore


def test_trials_are_known_and_never_two_at_a_time():
    filled = np.zeros((400, 5), dtype=bool)
    filled[100:130, (1, 2)] = True
    filled[110:150, 4] = True
    filled[200:202, 3] = True
    trials = trials_of(filled, 100.0)
    assert [(t.stop - t.start, t.joints) for t in trials[:2]] == [(30, (1, 2)), (40, (4,))]
    hidden = hidden_in(trials, 400, 5)
    assert not (hidden & filled).any()
    assert hidden.any(axis=1).sum() == sum(t.stop - t.start for t in trials) <= 100


def test_few_gaps_are_tried_elsewhere_too():
    filled = np.zeros((900, 2), dtype=bool)
    filled[20:70, 0] = True
    trials = trials_of(filled, 100.0)
    assert [(t.stop - t.start, t.joints) for t in trials] == [(50, (0,))] * 4
    assert np.ptp([t.start for t in trials]) > 600


def test_without_room_shorter_gaps_are_tried():
    filled = np.zeros((100, 2), dtype=bool)
    filled[20:70, 0] = True
    (trial,) = trials_of(filled, 100.0)
    assert (trial.start, trial.stop, trial.joints) == (72, 98, (0,))
    assert trials_of(filled[10:80], 100.0) == ()
    flickers = np.zeros((60, 2), dtype=bool)
    flickers[np.arange(60) % 16 < 14, 0] = True
    assert trials_of(flickers, 100.0) == ()
    assert trials_of(filled[:0], 100.0) == ()


def test_of_a_limb_there_is_no_room_to_try_as_long_errors_are_no_smaller_than_true(shared_data):
    pose = mm.read_pose(shared_data / "poses" / "02_03.amc")
    bones = ("humerus", "radius", "wrist", "hand", "fingers", "thumb")
    arm = [pose.index(f"l{bone}") for bone in bones]
    confidence = np.ones(pose.seen.shape)
    confidence[55:115, arm] = 0.0
    restored = restore(pose.with_samples(pose.positions, pose.rotations, confidence))
    away = np.linalg.norm(restored.pose.positions - pose.positions, axis=2)[55:115, arm]
    assert np.sqrt(np.mean(away**2)) > 30.0
    assert np.mean(away < 2.0 * restored.error_mm[55:115, arm]) > 0.9


def test_of_a_long_recording_the_surroundings_are_enough():
    filled = np.zeros((9000, 2), dtype=bool)
    assert enough_around(filled) == slice(0, 9000)
    filled[4000:4060, 1] = True
    assert enough_around(filled) == slice(3029, 5029)
    assert enough_around(filled[3950:]) == slice(0, 2000)
    assert enough_around(filled[3000:4500]) == slice(0, 1500)


def test_a_root_that_was_not_seen_says_nothing_of_others(shared_data):
    pose = mm.read_pose(shared_data / "poses" / "03_01.amc")
    pose = pose.with_samples(pose.positions[:250], pose.rotations[:250], np.ones((250, 31)))
    expected = []
    for unseen in (False, True):
        confidence = pose.confidence.copy()
        confidence[150:153, pose.index("lhand")] = 0.0
        confidence[60:100, 0] = 0.0 if unseen else 1.0
        given = pose.with_samples(pose.positions, pose.rotations, confidence)
        expected.append(restore(given).error_mm[151, pose.index("lhand")])
    assert expected[1] == pytest.approx(expected[0], rel=0.2)


def test_without_a_prior_expected_errors_are_of_the_size_of_the_true_ones(shared_data):
    pose = mm.read_pose(shared_data / "poses" / "03_01.amc")
    rng, true, expected = np.random.default_rng(5), [], []
    for joint in ("ltoes", "head", "lthumb", "rfingers"):
        j, start = pose.index(joint), int(rng.integers(60, 300))
        confidence = np.ones(pose.seen.shape)
        confidence[start : start + 60, j] = 0.0
        restored = restore(pose.with_samples(pose.positions, pose.rotations, confidence))
        away = restored.pose.positions - pose.positions
        true.append(np.mean(np.sum(away[start : start + 60, j] ** 2, axis=1)))
        expected.append(np.mean(restored.error_mm[start : start + 60, j] ** 2))
    ratio = np.sqrt(np.array(true) / expected)
    assert 0.3 < np.median(ratio) < 1.7
    assert np.count_nonzero(ratio > 3) <= 1


def test_of_what_was_hardly_seen_no_less_is_expected_than_time_would_miss(shared_data):
    pose = mm.read_pose(shared_data / "poses" / "02_01.amc")
    samples = pose.positions[100:340:4], pose.rotations[100:340:4]
    arm = list(pose.hanging_on(pose.index("rhumerus")))
    confidence = np.ones((60, len(pose.joints)))
    confidence[8:52, arm] = 0.0
    truth = mm.Pose(*samples, pose.joints, pose.parents, pose.rate / 4)
    restored = restore(truth.with_samples(*samples, confidence))
    away = np.linalg.norm(restored.pose.positions - truth.positions, axis=2)[8:52, arm]
    said = restored.error_mm[8:52, arm]
    assert np.sqrt(np.mean(away**2)) > 50.0
    assert 0.8 < np.sqrt(np.mean(said**2) / np.mean(away**2)) < 8.0
    # An arm is no further off than it is long.
    assert said.max() < 900.0
