"""Skeleton recordings made clean, from file to file."""

from __future__ import annotations

import numpy as np
import pytest
from arms import arm, hide
from numpy.testing import assert_allclose
from scipy.ndimage import uniform_filter1d

import markermend as mm
from markermend.cli import main
from markermend.errors import DataError
from markermend.poses import Pose
from markermend.poses.body.bones import find_bones, keep_lengths, swing
from markermend.poses.faults.guessing import INFERRED
from markermend.poses.filling.bridging import bridged
from markermend.poses.normal import bone_lengths
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.quaternion import between, turn, unit
from markermend.poses.restore import denoise, restore
from markermend.poses.simulated.noise import Noise, corrupt_pose
from markermend.poses.smoothing import (
    _in_each_frame,
    _power,
    noise_level,
    smooth,
    smooth_again,
    smooth_bands,
)


def test_signs_of_rotations_come_back_as_they_were_recorded():
    pose = arm()
    signs = np.where(np.random.default_rng(4).random((400, 5, 1)) < 0.5, -1.0, 1.0)
    mixed = pose.with_samples(pose.positions, signs * pose.rotations, pose.confidence)
    assert_allclose(restore(mixed).pose.rotations, mixed.rotations, atol=1e-3)


def far(a, b):
    return np.sqrt(np.sum((a.positions - b.positions) ** 2, axis=2))


def test_a_root_that_was_never_seen_stays_so():
    pose = hide(arm(), slice(None), 0)
    told = restore(pose)
    assert not told.filled.any()
    assert np.isnan(told.pose.positions[:, 0]).all()
    assert_allclose(told.pose.positions[:, 1:], pose.positions[:, 1:], atol=1e-6)


def test_a_joint_that_flickers_is_restored_without_a_prior():
    pose = arm()
    hidden = hide(pose, np.arange(400) % 24 < 12, 4)
    told = restore(hidden)
    assert told.pose.seen.all()
    assert np.median(far(told.pose, pose)[:, 4][told.filled[:, 4]]) < 20.0


def test_noise_is_told_from_movement_and_taken_out():
    random = np.random.default_rng(1)
    t = np.arange(1200)[:, None] / 60
    drivers = np.sin(2 * np.pi * t * [0.4, 0.9, 1.7, 2.3] + [0, 1, 2, 3])
    clean = 0.4 * drivers @ random.normal(size=(4, 28))
    noisy = clean + random.normal(0, 0.02, clean.shape)
    known = np.ones(clean.shape, dtype=bool)
    # Rotations have three degrees of freedom in four numbers; these have four.
    places = np.arange(28) % 7 < 3
    assert_allclose(noise_level(noisy, known)[places], 0.02, rtol=0.12)
    assert noise_level(clean, known).max() < 1e-3
    calm = smooth(noisy, np.full(28, 0.02), 60.0)
    assert np.std(calm - clean) < 0.3 * 0.02
    assert np.abs(smooth(clean, np.full(28, 1e-4), 60.0) - clean).max() < 1e-3


def test_a_joint_that_is_hardly_known_has_the_noise_of_the_others():
    random = np.random.default_rng(6)
    t = np.arange(1200)[:, None] / 60
    clean = 0.4 * np.sin(2 * np.pi * t * [0.4, 0.9] + [0, 1]) @ random.normal(size=(2, 28))
    noisy = clean + random.normal(0, 0.02, clean.shape)
    known = np.ones(clean.shape, dtype=bool)
    known[:, 7:10] = (np.arange(1200) % 3 > 0)[:, None]
    assert_allclose(noise_level(noisy, known)[7:10], 0.02, rtol=0.12)


def test_smoothing_again_takes_bias_and_gaps_out_of_the_pilot():
    random = np.random.default_rng(3)
    t = np.arange(1200)[:, None] / 60
    drivers = np.sin(2 * np.pi * t * [0.4, 0.9, 1.7, 2.3] + [0, 1, 2, 3])
    clean = 0.4 * drivers @ random.normal(size=(4, 28))
    noise = np.full(28, 0.02)
    noisy = clean + random.normal(0, 0.02, clean.shape)
    hidden = random.random(clean.shape) < 0.15
    pilot = smooth(bridged(noisy, ~hidden), noise, 60.0)
    again = smooth_again(np.where(hidden, pilot, noisy), pilot, noise, 60.0)
    assert np.std(again - clean) < 0.9 * np.std(pilot - clean)
    # It need not believe a pilot that is wrong.
    assert np.std(smooth_again(noisy, 0.8 * clean, noise, 60.0) - clean) < 0.5 * 0.02


def test_each_pace_keeps_what_moves_together_at_it():
    random = np.random.default_rng(6)
    t = np.arange(1200) / 60
    slow, quick = np.sin(2 * np.pi * 0.4 * t), np.sin(2 * np.pi * 6.0 * t)
    together = random.normal(size=(2, 12))
    clean = 8.0 * np.outer(slow, together[0]) + 4.0 * np.outer(quick, together[1])
    noisy = clean + random.normal(size=clean.shape)
    assert_allclose(smooth_bands(1e4 * clean, 1e4 * clean, 60.0), 1e4 * clean, atol=2.0)
    found = smooth_bands(noisy, clean + 0.3 * random.normal(size=clean.shape), 60.0)
    assert np.std(found - clean) < 0.35
    short = smooth_bands(noisy[:9], clean[:9], 60.0)
    assert short.shape == (9, 12)
    assert np.isfinite(short).all()


@pytest.mark.parametrize("frames", [9, 25, 600, 601, 605])
def test_power_in_blocks_is_that_of_a_window_about_each_frame(frames):
    window = min(37, frames)
    still = np.full((frames, 2), 3.0, dtype=np.float32)
    told = _in_each_frame(_power(still, window), window, frames)
    assert_allclose(told, still**2, rtol=1e-6)
    wave = np.sin(np.arange(frames) / 40.0)[:, None].astype(np.float32)
    told = _in_each_frame(_power(wave, window), window, frames)
    wanted = uniform_filter1d(wave**2, window, axis=0, mode="nearest")
    assert told.shape == wave.shape
    assert np.abs(told - wanted).max() < 0.1
    # The last frames count, also where they make no whole block.
    loud = still.copy()
    loud[-1] = 300.0
    assert (_in_each_frame(_power(loud, window), window, frames)[-1] > 100.0).all()


def test_an_elbow_between_joints_that_are_seen_settles_where_this_arm_bends():
    pose = arm(frames=600, rate=30.0)
    hidden = slice(200, 230)
    restored = restore(hide(pose, hidden, 2)).pose
    assert far(restored, pose)[hidden, 2].mean() < 2.0
    assert far(restored, pose)[:, [1, 3, 4]].max() < 1e-6


def test_no_joint_that_was_filled_is_said_to_be_exact():
    pose = arm()
    hidden = slice(200, 260)
    # The first joint of the arm is fixed to the root.
    restored = restore(hide(pose, hidden, 1))
    error = restored.error_mm[hidden, 1]
    assert (error > 0.05).all()
    assert (far(restored.pose, pose)[hidden, 1] < 2 * error).all()


def test_a_bone_shorter_than_its_noise_allows_for_is_rigid_still():
    rng = np.random.default_rng(0)
    features = np.zeros((400, 2, 7))
    features[..., 6] = 1.0
    way = rng.normal(size=(400, 3))
    features[:, 1, :3] = 0.1 * way / np.linalg.norm(way, axis=1, keepdims=True)
    features[..., :3] += rng.normal(0.0, 0.02, (400, 2, 3))
    everywhere = np.ones((400, 2), dtype=bool)
    assert find_bones(features, everywhere, everywhere, (-1, 0), 0.02).lengths[1] == (
        pytest.approx(0.1, rel=0.15)
    )
    assert np.isnan(find_bones(features, everywhere, everywhere, (-1, 0), 0.002).lengths[1])


def test_bones_keep_their_length_and_rotations_follow():
    pose = arm()
    features = np.concatenate([pose.positions, pose.rotations], axis=2)
    seen = np.ones((400, 5), dtype=bool)
    bones = find_bones(features, seen, seen, pose.parents)
    assert_allclose(bones.lengths[1:], [300, 250, 200, 150], rtol=1e-9)
    assert_allclose(bones.places[2], [0, 250, 0], atol=1e-6)
    damaged = features.copy()
    damaged[100:150, 3, :3] += [30.0, -20.0, 10.0]
    seen[100:150, 3] = False
    damaged[..., :3] = keep_lengths(damaged[..., :3], seen, bones)
    assert (damaged[:100] == features[:100]).all()
    assert_allclose(
        bone_lengths(damaged[100:150, :, :3], pose.parents)[1:], bones.lengths[1:], rtol=0.02
    )
    swung = swing(damaged, ~seen[:, [1, 2, 3, 4, 4]], bones)
    bone = swung[100:150, 3, :3] - swung[100:150, 2, :3]
    pointing = turn(swung[100:150, 2, 3:], np.broadcast_to([0.0, 200.0, 0.0], bone.shape))
    assert_allclose(turn(between(pointing, bone), pointing), pointing, atol=1.0)


def test_clean_recordings_come_back():
    pose = arm()
    restored = restore(pose)
    assert far(restored.pose, pose).max() < 0.2
    assert not restored.filled.any()
    assert (restored.pose.confidence == 1).all()


def test_short_recordings_that_are_clean_come_back_and_noisy_ones_are_smoothed():
    # From frame to frame this body is anywhere: only bones tell its movement from noise.
    random = np.random.default_rng(4)
    pose = arm(frames=40)
    rotations = np.array(pose.rotations)
    rotations[:, 1:] = unit(rotations[:, 1:] + random.normal(0.0, 0.003, (40, 4, 4)))
    positions = np.array(pose.positions)
    for joint, length in ((2, 250.0), (3, 200.0), (4, 150.0)):
        bone = turn(rotations[:, joint - 1], np.broadcast_to([0.0, length, 0.0], (40, 3)))
        positions[:, joint] = positions[:, joint - 1] + bone
    lively = pose.with_samples(positions, rotations)
    assert far(restore(lively).pose, lively).max() < 1e-6
    positions[:, 1:] += random.normal(0.0, 10.0, (40, 4, 3))
    rotations[:, 1:] += random.normal(0.0, 0.04, (40, 4, 4))
    noise = restore(pose.with_samples(positions, rotations)).noise_mm[1:]
    assert ((noise > 5.0) & (noise < 20.0)).all()


def test_hidden_joints_are_filled_and_known_ones_stay():
    pose = arm()
    damaged = hide(hide(pose, slice(120, 150), 4), slice(250, 251), 4)
    restored = restore(damaged)
    error = far(restored.pose, pose)
    assert error[120:150, 4].max() < 40
    assert error[250, 4] < 3
    assert error[~restored.filled].max() < 0.5
    assert restored.filled.sum() == 31
    assert (restored.pose.confidence[120:150, 4] == INFERRED).all()
    assert restored.error_mm[135, 4] >= restored.error_mm[250, 4] > 0


def test_a_root_that_was_not_seen_is_bridged():
    pose = arm()
    restored = restore(hide(pose, slice(200, 206), 0))
    assert far(restored.pose, pose).max() < 10


def test_joints_never_seen_and_positions_alone():
    pose = hide(arm(), slice(None), 4)
    restored = restore(pose)
    assert np.isnan(restored.pose.positions[:, 4]).all()
    assert not np.isnan(restored.pose.positions[:, :4]).any()
    bare = Pose(arm().positions, np.full((400, 5, 4), np.nan), pose.joints, pose.parents, 100.0)
    clean = restore(hide(bare, slice(100, 110), 2)).pose
    assert far(clean, bare).max() < 10
    assert np.isnan(clean.rotations).all()


def test_what_a_joint_that_is_never_seen_hangs_on_keeps_the_rotations_it_was_given():
    pose = arm()
    told = restore(hide(hide(pose, slice(None), 4), slice(50, 60), 2))
    there = np.r_[0:50, 60:400]
    assert_allclose(told.pose.rotations[there, 3], pose.rotations[there, 3], atol=1e-9)
    assert np.isnan(told.pose.rotations[:, 4]).all()


def test_where_one_pose_was_seen_no_error_is_known_but_of_joints_beside_the_root():
    told = restore(hide(arm(60), np.r_[0:30, 31:60], slice(None)))
    assert np.isnan(told.error_mm[[0, -1], 0]).all()
    assert np.isfinite(told.error_mm[:, 1:]).all()


def test_noise_beside_a_joint_never_seen_is_taken_out():
    truth = arm()
    random = np.random.default_rng(5)
    shaken = truth.positions + random.normal(0, 5.0, truth.positions.shape)
    turned = truth.rotations + random.normal(0, 0.02, truth.rotations.shape)
    noisy = hide(truth.with_samples(shaken, turned), slice(None), 4)
    restored = restore(noisy).pose
    assert np.isnan(restored.positions[:, 4]).all()
    # The root stays as it was measured.
    assert far(restored, truth)[:, 1:4].mean() < 0.9 * far(noisy, truth)[:, 1:4].mean()


def test_rotations_that_are_all_one_are_taken_for_none_and_come_back():
    random = np.random.default_rng(2)
    pose = arm(120)
    noise = random.normal(0.0, 5.0, pose.positions.shape)
    noisy = pose.with_samples(pose.positions + noise, pose.rotations)
    noisy = hide(noisy, slice(40, 50), 4)
    turned = np.broadcast_to([0.0, 0.0, 0.0, 1.0], noisy.rotations.shape) * random.choice(
        [-1.0, 1.0], (120, 5, 1)
    )
    told = restore(noisy.with_samples(noisy.positions, turned, noisy.confidence))
    assert 3.0 < np.median(told.noise_mm[1:]) < 7.0
    none = np.full(noisy.rotations.shape, np.nan)
    without = restore(noisy.with_samples(noisy.positions, none, noisy.confidence))
    assert_allclose(told.pose.positions, without.pose.positions)
    assert (told.pose.rotations[noisy.seen] == turned[noisy.seen]).all()
    assert (np.abs(told.pose.rotations[..., 3]) == 1.0).all()
    assert np.isnan(without.pose.rotations).all()


def test_too_little_is_said():
    pose = arm(2)
    with pytest.raises(DataError, match="too short"):
        denoise(pose)


@pytest.mark.parametrize("noise", [Noise(burst=20), Noise(displacement=0.0, burst=20)])
def test_real_movement_is_restored(shared_data, noise):
    whole = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_05.amc"))
    truth = whole.with_samples(whole.positions[:600], whole.rotations[:600], whole.confidence[:600])
    damaged = corrupt_pose(truth, noise, seed=2)
    restored = restore(damaged)
    error = far(restored.pose, truth)
    hidden = restored.filled
    bridge_only = 60.0
    assert np.sqrt(np.mean(error[hidden] ** 2)) < 0.5 * bridge_only
    assert np.mean(error[hidden] < 3 * restored.error_mm[hidden]) > 0.85
    if noise.displacement:
        seen = damaged.seen.copy()
        seen[:, 0] = False
        assert np.mean(error[seen]) < 0.45 * np.mean(far(damaged, truth)[seen])


def test_three_ways_of_smoothing_are_nearer_than_the_last(shared_data, monkeypatch):
    whole = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_05.amc"))
    truth = whole.with_samples(whole.positions[:480], whole.rotations[:480], whole.confidence[:480])
    damaged = corrupt_pose(truth, Noise(burst=20), seed=2)
    by_three = restore(damaged).pose
    monkeypatch.setattr("markermend.poses.restore._BEFORE", 0.0)
    monkeypatch.setattr("markermend.poses.restore._AT_FIRST", 0.0)
    by_last = restore(damaged).pose
    seen = damaged.seen.copy()
    seen[:, 0] = False
    assert far(by_three, truth)[seen].mean() < 0.998 * far(by_last, truth)[seen].mean()


def test_command_line(tmp_path, capsys):
    source, target = tmp_path / "in.csv", tmp_path / "out.csv"
    mm.write_pose(hide(arm(), slice(120, 140), 3), source)
    assert main(["denoise", str(source), "-o", str(target), "--list"]) == 0
    assert "Filled: 20 of" in capsys.readouterr().out
    assert mm.read_pose(target).seen.all()
    assert main(["denoise", str(source), "-o", str(target)]) == 1
    assert "--force" in capsys.readouterr().err
    assert main(["denoise", str(source), "-o", str(tmp_path / "out.xyz")]) == 1
