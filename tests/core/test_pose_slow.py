"""Recordings with few poses a second, and noise that rotations have no part in."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.prior import shipped_prior
from markermend.poses.restore import restore


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "03_01.amc"))


def every(pose, step):
    some = slice(None, None, step)
    samples = pose.positions[some], pose.rotations[some]
    return Pose(*samples, pose.joints, pose.parents, pose.rate / step, pose.confidence[some])


@pytest.mark.parametrize("step", [4, 8, 12, 16])
def test_clean_recordings_come_back_as_they_were_however_slow(walk, step):
    truth = every(walk, step)
    restored = restore(truth, prior=shipped_prior())
    np.testing.assert_allclose(restored.pose.positions, truth.positions, atol=1e-6)
    assert not restored.noise_mm.max() > 0.1


@pytest.mark.parametrize("step", [4, 8])
def test_noise_of_positions_goes_where_rotations_are_exact(walk, step):
    truth = every(walk, step)
    shaken = truth.positions + np.random.default_rng(2).normal(0.0, 4.0, truth.positions.shape)
    shaken[:, truth.order[0]] = truth.positions[:, truth.order[0]]
    restored = restore(
        truth.with_samples(shaken, truth.rotations, truth.confidence), prior=shipped_prior()
    )
    off, was = (
        np.sqrt(np.mean((places - truth.positions) ** 2))
        for places in (restored.pose.positions, shaken)
    )
    assert off < 0.6 * was
    joints = np.arange(len(truth.joints)) != truth.order[0]
    assert np.median(restored.noise_mm[joints]) == pytest.approx(4.0, rel=0.4)
