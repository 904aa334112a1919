"""What moves fast tells something else than where a body is; nothing bends where looks change."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

import markermend as mm
from markermend.arrays import FloatArray, IntArray
from markermend.poses.body.bending import _less_turned
from markermend.poses.body.settling import _groups
from markermend.poses.filling.borders import Borders
from markermend.poses.filling.covariance import learn
from markermend.poses.filling.paces import lengths_of_paces, paces_of
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.prior import shipped_prior
from markermend.poses.restore import restore
from markermend.poses.simulated.noise import Noise, corrupt_pose

RATE = 120.0


def swaying() -> FloatArray:
    """Two channels that are one where a body is slow; of what shakes one the other has a tenth."""
    rng = np.random.default_rng(4)
    t = np.arange(2400) / RATE
    slow = sum(np.sin(f * t + p) for f, p in rng.uniform(0.5, 2.0, (6, 2)))
    shakes = 0.5 * np.sin(2 * np.pi * 9.0 * t) * np.sin(1.3 * t)
    return np.stack([slow + shakes, slow + 0.1 * shakes], axis=1)


def test_each_pace_is_regressed_by_itself() -> None:
    values = swaying()
    poses = values.astype(np.float32)
    moments = learn(values, RATE, lengths_of_paces(RATE))
    paces = paces_of(poses, RATE, moments)
    seen, hidden = np.array([0]), np.array([1])
    by = np.zeros((2, 1), dtype=np.float32)
    by[0] = 1.0
    told = paces.regressed(by, seen, hidden, np.zeros(1, dtype=np.float32))
    found = told.tell(poses, paces.moved), poses @ by
    off, off_alike = (np.abs(x[:, 0] - values[:, 1]).mean() for x in found)
    assert off < 0.5 * off_alike
    # What a channel that is hidden does itself tells nothing.
    assert_array_equal(told.faster.reshape(-1, 2, 1)[:, 1], 0.0)


def test_paces_and_what_is_slower_are_the_whole() -> None:
    poses = swaying().astype(np.float32)
    for rate in (5.0, 30.0, 240.0):
        moved = paces_of(poses, rate, learn(poses, rate, lengths_of_paces(rate))).moved
        assert moved.shape == (len(poses), 4)
        slower = poses - moved.reshape(len(poses), 2, 2).sum(axis=1)
        wobbles = [np.abs(np.diff(x, 2, axis=0)).mean() for x in (slower, poses)]
        # Of five poses a second none is faster than a moment.
        assert (wobbles[0] < 0.9 * wobbles[1]) == (rate > 5.0)
    still = np.ones((200, 2), dtype=np.float32)
    assert_allclose(paces_of(still, RATE, learn(still, RATE)).moved, 0.0, atol=1e-6)


def counted(frames: IntArray, *, fading: bool) -> tuple[FloatArray, FloatArray]:
    """(frames, groups) how much each group counts in each frame, and how that changes."""
    groups = _groups(frames, RATE, fading=fading)
    share = np.zeros((len(frames), len(groups.firsts)))
    for n, (rows, shares) in enumerate(zip(groups.rows, groups.shares, strict=True)):
        np.add.at(share[:, n], rows, shares)
    assert_allclose(share.sum(axis=1), 1.0)
    return share, np.abs(np.diff(share, axis=0)).max(axis=1)


def test_groups_of_frames_take_over_from_each_other() -> None:
    whole = np.arange(47)
    assert counted(whole, fading=False)[1].max() == 1.0
    assert counted(whole, fading=True)[1].max() < 0.3
    # Frames 20 to 29 are not among them: what is on one side knows nothing of the other.
    apart = np.concatenate([np.arange(20), np.arange(30, 47)])
    share, change = counted(apart, fading=True)
    assert change[19] == 1.0
    assert not share[:20, 2:].any()
    assert not share[20:, :2].any()


def test_a_filled_limb_moves_no_more_jerkily_than_a_true_one(shared_data: Path) -> None:
    pose = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_05.amc"))
    truth = pose.with_samples(pose.positions, pose.rotations)
    damaged = corrupt_pose(truth, Noise(displacement=0.0, burst=120, limbs=True), seed=2)
    hidden = ~damaged.seen
    restored = restore(damaged, prior=shipped_prior()).pose

    def jerks(positions: FloatArray) -> FloatArray:
        third = np.linalg.norm(np.diff(positions, 3, axis=0), axis=2)
        inside = hidden[:-3] & hidden[1:-2] & hidden[2:-1] & hidden[3:]
        return np.asarray(np.sort(third[inside]))

    ours, true = jerks(restored.positions), jerks(truth.positions)
    assert np.sqrt(np.mean(ours**2)) < np.sqrt(np.mean(true**2))


def test_looks_at_moments_take_over_from_each_other_without_a_bend() -> None:
    path = np.zeros((400, 3), dtype=np.float32)
    whole = np.zeros(120)
    for place, part, share in Borders(path, 100, 220, RATE).looks():
        whole[part] += share
        there = place - part.start
        assert share[there] == 1.0
        # Straight shares would change by a sixteenth in each frame, also beside the place.
        assert np.abs(np.diff(share[max(there - 1, 0) : there + 2])).max() < 0.02
    assert_allclose(whole, 1.0)


def test_what_is_turned_by_half_a_turn_is_not_drawn_back() -> None:
    angles = np.array([0.0, 1.0, 1.9, 2.6, 3.1, np.pi])
    away = np.zeros((len(angles), 6))
    away[:, 1], away[:, 4] = angles, 0.3
    less = _less_turned(away)
    assert_array_equal(less[:3], away[:3])
    assert less[3, 1] < away[3, 1]
    # Just beyond, the same turn is one the other way round.
    assert_allclose(less[4:, 1], 0.0, atol=0.15)
    assert_array_equal(less[:, 4], away[:, 4])
