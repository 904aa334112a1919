"""How far off restored joints are expected to be."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.bench.poses import Case, recorded
from markermend.poses.filling.expecting import left_of_noise, limbs_doubted
from markermend.poses.filling.gaps import Gap
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.restore import restore


def test_more_noise_is_left_the_fewer_frames_there_are():
    shares = [left_of_noise(rate) for rate in (1000.0, 120.0, 30.0, 5.0)]
    assert shares == sorted(shares)
    assert shares[1] == pytest.approx(0.35)
    assert left_of_noise(0.1) == 1.0


def test_whole_limbs_are_doubted_more_than_joints():
    arm, wrist = Gap(2, 9, np.arange(4, 25)), Gap(2, 9, np.arange(30, 37))
    brief = Gap(5, 7, np.arange(40, 61))
    more = limbs_doubted((10, 70), [arm, wrist, brief], 5)
    assert (more[2:9, 4:25] > 1.3).all()
    assert (more[:, 25:] == 1.0).all()
    assert (more[[0, 1, 9]] == 1.0).all()


def test_what_noise_is_left_at_30_hz_is_as_much_as_expected(shared_data):
    pose = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_05.amc"))
    truth = recorded(pose, Case("bursts", "displacements", slow=True))
    rng = np.random.default_rng(3)
    shaken = truth.positions + rng.normal(0.0, 4.0, truth.positions.shape)
    shaken[:, truth.order[0]] = truth.positions[:, truth.order[0]]
    restored = restore(truth.with_samples(shaken, truth.rotations, truth.confidence))
    off = np.linalg.norm(restored.pose.positions - truth.positions, axis=2)[:, 1:]
    said = restored.error_mm[:, 1:]
    assert np.sqrt(np.mean(said**2)) == pytest.approx(np.sqrt(np.mean(off**2)), rel=0.25)
