"""Positions alone, bones kept: as least squares over the whole body has it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from markermend.poses.body.bones import Bones
from markermend.poses.body.stretching import _LENGTH, _step, stretched

# A root with a spine that carries two arms, and a leg.
PARENTS = (-1, 0, 1, 1, 2, 0, 5, 6)
ORDER = (0, 5, 6, 7, 1, 3, 2, 4)


def body(frames, seed=0):
    """(frames, joints, 3) poses whose bones have their lengths, and those."""
    random = np.random.default_rng(seed)
    lengths = np.array([np.nan, 1.0, 0.5, 0.5, 1.2, 0.4, 1.5, 1.4])
    places = np.zeros((frames, len(PARENTS), 3))
    for joint in ORDER[1:]:
        way = random.normal(size=(frames, 3))
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        places[:, joint] = places[:, PARENTS[joint]] + lengths[joint] * way
    return places, Bones(PARENTS, lengths, np.full((len(PARENTS), 3), np.nan))


def test_a_step_is_that_of_least_squares_over_the_whole_body():
    places, bones = body(4)
    random = np.random.default_rng(1)
    now = places + random.normal(scale=0.05, size=places.shape)
    away = random.normal(scale=0.1, size=places.shape)
    variance = random.uniform(0.001, 0.1, places.shape[:2])
    bones.lengths[3] = np.nan
    found = _step(now, away, variance, bones, ORDER)
    for frame in range(4):
        rows, wanted = [], []
        for joint in range(8):
            for axis in range(3):
                row = np.zeros(24)
                row[3 * joint + axis] = 1.0 / np.sqrt(variance[frame, joint])
                rows.append(row)
                wanted.append(away[frame, joint, axis] / np.sqrt(variance[frame, joint]))
        for joint, length in enumerate(bones.lengths):
            if np.isnan(length):
                continue
            bone = now[frame, joint] - now[frame, PARENTS[joint]]
            far = np.linalg.norm(bone)
            row = np.zeros(24)
            row[3 * joint : 3 * joint + 3] = bone / far / _LENGTH
            row[3 * PARENTS[joint] : 3 * PARENTS[joint] + 3] = -bone / far / _LENGTH
            rows.append(row)
            wanted.append((length - far) / _LENGTH)
        told = np.linalg.lstsq(np.array(rows), np.array(wanted), rcond=None)[0]
        assert_allclose(found[frame].ravel(), told, atol=1e-9)


def test_bones_get_their_length_and_what_is_sure_stays():
    places, bones = body(200)
    noisy = places + np.random.default_rng(2).normal(scale=0.02, size=places.shape)
    variance = np.full(places.shape[:2], 0.02**2)
    noisy[:, 0], variance[:, 0] = 0.0, 0.0
    noisy[:, 2], variance[:, 2] = places[:, 2], 0.0
    found = stretched(noisy, variance, bones, ORDER)
    assert (found[:, 0] == 0.0).all()
    assert_allclose(found[:, 2], places[:, 2], atol=1e-12)

    def far(some):
        ends = some[:, 1:] - some[:, list(PARENTS[1:])]
        return np.abs(np.linalg.norm(ends, axis=2) - bones.lengths[1:])

    assert far(found).mean() < 0.15 * far(noisy).mean()
    off, before = (np.linalg.norm(x - places, axis=2)[:, 3:] for x in (found, noisy))
    assert off.mean() < 0.9 * before.mean()


def test_a_joint_never_seen_takes_nothing_along():
    places, bones = body(20)
    bones.lengths[[6, 7]] = np.nan
    lost = places.copy()
    lost[:, 6] = np.nan
    found = stretched(lost, np.full(places.shape[:2], 0.01), bones, ORDER)
    assert np.isnan(found[:, 6]).all()
    assert_allclose(np.delete(found, 6, axis=1), np.delete(places, 6, axis=1), atol=1e-9)


@pytest.mark.parametrize("off", [0.05, 0.1])
def test_a_knee_between_hip_and_ankle_bends(off):
    """Filled on the line between both, as a mean of steps is, and their bones too long for it."""
    hip, knee, ankle = np.array([[0.0, 0.0, 0.0], [0.0, -0.9, 0.5], [0.0, -1.8, 0.0]])
    bones = Bones(
        (-1, 0, 1), np.array([np.nan, *[np.linalg.norm(knee)] * 2]), np.full((3, 3), np.nan)
    )
    filled = np.array([[hip, [0.0, -0.9, off], ankle]])
    variance = np.array([[0.0, 0.25**2, 0.01**2]])
    found = stretched(filled, variance, bones, (0, 1, 2))
    assert np.linalg.norm(found[0, 1] - knee) < 0.4 * np.linalg.norm(filled[0, 1] - knee)
    assert np.linalg.norm(found[0, 2] - ankle) < 0.02
