"""Where a recording begins or ends with something that is not seen, it goes on as it went."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from recordings import seventeen_joints

from markermend.poses.filling.ends import gone_on
from markermend.poses.pose import Pose
from markermend.poses.prior import shipped_prior
from markermend.poses.restore import restore

RATE = 30.0


@pytest.fixture(scope="module")
def walk(shared_data):
    pose = seventeen_joints(shared_data, "03_01")["03_01"]
    samples = pose.positions[::4], pose.rotations[::4]
    return Pose(*samples, pose.joints, pose.parents, pose.rate / 4)


def ways(frames=200):
    """(frames, 2) two numbers that go smoothly."""
    t = np.arange(frames) / RATE
    return np.stack([np.sin(3 * t), 2 * np.cos(2 * t)], axis=1)


def test_what_is_told_but_for_a_slow_difference_is_followed():
    told = ways()
    values = told + 0.5 + 0.001 * np.arange(200)[:, None]
    values[50:60] = np.nan
    known = ~np.isnan(values[:-8, 0])
    onwards, squared = gone_on(values[:-8], told, known, 8, RATE)
    assert np.abs(onwards - values[-8:]).max() < 0.01
    assert squared.shape == (8, 2)
    assert np.sqrt(squared).max() < 0.01


def test_where_nothing_tells_speed_lasts_for_a_while():
    values = ways()
    told = np.random.default_rng(0).normal(size=values.shape)
    onwards, squared = gone_on(values[:-3], told, np.ones(197, dtype=bool), 3, RATE)
    off = np.abs(onwards - values[-3:])
    still = np.abs(values[-4] - values[-3:])
    assert (off < 0.5 * still).all()
    assert (np.diff(squared, axis=0) > 0).all()


def test_what_only_trembles_stands():
    values = np.random.default_rng(1).normal(size=(200, 1))
    onwards, squared = gone_on(values, None, np.ones(200, dtype=bool), 5, RATE)
    assert_allclose(onwards, np.broadcast_to(values[-1], (5, 1)))
    assert_allclose(squared, 2.0, rtol=0.3)


def test_too_little_to_try_it_is_said():
    assert gone_on(ways(8), None, np.ones(8, dtype=bool), 2, RATE) is None


@pytest.mark.parametrize("prior", [shipped_prior(), None], ids=["prior", "alone"])
@pytest.mark.parametrize("last", [False, True])
def test_a_leg_not_seen_in_the_first_or_last_poses_is_where_it_goes(walk, last, prior):
    leg = [walk.joints.index(f"right_{name}") for name in ("hip", "knee", "ankle")]
    still_mm, off_mm, said_mm = [], [], []
    for middle in range(48, walk.frames, 12):
        rows = slice(0, middle) if last else slice(walk.frames - middle, None)
        samples = walk.positions[rows], walk.rotations[rows]
        truth = Pose(*samples, walk.joints, walk.parents, walk.rate)
        at, beside = (-1, -2) if last else (0, 1)
        shown = np.ones((truth.frames, len(walk.joints)))
        shown[at, leg] = 0.0
        found = restore(truth.with_samples(*samples, shown), prior=prior)
        away = found.pose.positions[at, leg] - truth.positions[at, leg]
        off_mm.append(np.linalg.norm(away, axis=1))
        said_mm.append(found.error_mm[at, leg])
        made = truth.positions[beside, leg] - truth.positions[at, leg]
        still_mm.append(np.linalg.norm(made, axis=1))
    still, off, said = (np.sqrt(np.mean(np.square(x))) for x in (still_mm, off_mm, said_mm))
    assert off < 0.6 * still
    assert 0.7 * off < said < 3.0 * off
