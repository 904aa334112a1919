"""A root that is noisy comes out clean, and one that is not stays as it is."""

from __future__ import annotations

import numpy as np
import pytest
from recordings import seventeen_joints

from markermend.poses.body.calming import root_noise_mm
from markermend.poses.pose import Pose
from markermend.poses.quaternion import unit
from markermend.poses.restore import restore

MM = 5.0


@pytest.fixture(scope="module")
def clean(shared_data):
    pose = seventeen_joints(shared_data, "02_05")["02_05"]
    samples = pose.positions[:700], pose.rotations[:700]
    return Pose(*samples, pose.joints, pose.parents, pose.rate)


def noisy(pose, *, root=MM, others=MM, turned=0.0):
    """Noise on positions, and on rotations as many radians as its half."""
    random = np.random.default_rng(0)
    size = np.full(len(pose.joints), others)
    size[pose.order[0]] = root
    positions = pose.positions + random.normal(size=pose.positions.shape) * size[:, None]
    rotations = unit(pose.rotations + random.normal(0.0, turned, pose.rotations.shape))
    return pose.with_samples(positions, rotations, pose.confidence)


def off(a, b, joints):
    """Root mean square of distances, mm."""
    away = a.positions[:, joints] - b.positions[:, joints]
    return float(np.sqrt(np.mean(np.sum(away**2, axis=-1))))


def turned_off(a, b, joint):
    """Mean angle between rotations, in degrees."""
    same = np.abs(np.sum(a.rotations * b.rotations, axis=2))[:, joint].clip(0, 1)
    return float(np.degrees(2 * np.arccos(same).mean()))


def test_lengths_of_bones_tell_the_roots_noise_from_that_of_others(clean):
    assert root_noise_mm(clean) == 0.0
    assert root_noise_mm(noisy(clean)) == pytest.approx(MM, rel=0.15)
    assert root_noise_mm(noisy(clean, root=0.0)) == 0.0
    assert root_noise_mm(noisy(clean, others=0.0)) == pytest.approx(MM, rel=0.15)
    alone = clean.with_samples(clean.positions, clean.rotations, np.zeros_like(clean.confidence))
    assert root_noise_mm(alone) == 0.0


def test_a_noisy_root_comes_out_clean_and_says_how_far_off(clean):
    given = noisy(clean, turned=0.01)
    found = restore(given)
    root = clean.order[0]
    left, said = off(found.pose, clean, root), found.error_mm[0, root]
    assert left < 0.4 * off(given, clean, root)
    assert left < 1.2 * said < 1.6 * left
    assert found.noise_mm[root] == pytest.approx(MM, rel=0.15)
    # What hangs on it is held to a root that no longer shakes.
    hips = [clean.joints.index(name) for name in ("left_hip", "right_hip", "torso")]
    assert off(found.pose, clean, hips) < 0.4 * off(given, clean, hips)
    before, after = (turned_off(x, clean, root) for x in (given, found.pose))
    assert after < 0.6 * before


def test_a_root_without_noise_stays_where_it_is(clean):
    given = noisy(clean, root=0.0)
    found = restore(given)
    root = clean.order[0]
    assert off(found.pose, clean, root) < 1e-5
    assert found.error_mm[:, root].max() == found.noise_mm[root] == 0.0
