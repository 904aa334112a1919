"""Joints filled in the axes of what they hang on."""

from __future__ import annotations

import numpy as np
import pytest
from arms import hide

import markermend as mm
from markermend.poses.filling.hanging import by_parents
from markermend.poses.quaternion import lengths_of, turn, unit
from markermend.poses.restore import restore

FRAMES, RATE, PARENTS = 240, 60.0, (-1, 0, 1)
GAP = slice(100, 130)


def waving():
    """A forearm that swings about a fixed elbow, and a hand that hardly turns on it."""
    time = np.arange(FRAMES) / RATE
    half = 0.5 * np.stack([1.5 * np.sin(3.1 * time**1.2), 0.1 * np.sin(2.0 * time)], axis=1)
    features = np.zeros((FRAMES, 3, 7))
    features[..., 6] = 1.0
    features[:, 1:, 5], features[:, 1:, 6] = np.sin(half), np.cos(half)
    features[:, 2, 3:] = unit(
        np.stack([0 * time, 0 * time, np.sin(half.sum(axis=1)), np.cos(half.sum(axis=1))], axis=1)
    )
    features[:, 2, :3] = turn(features[:, 1, 3:], np.tile([0.0, 1.0, 0.0], (FRAMES, 1)))
    features[:, 1, :3] = 0.5
    features[:, 2, :3] += features[:, 1, :3]
    return features


def told(features, known, off, expected):
    given, variance = features.copy(), np.zeros(features.shape)
    given[~known, :3] += off
    variance[~known] = expected**2
    still = np.zeros((FRAMES, 1))
    return by_parents(given, variance, (known, known), PARENTS, range(3), RATE, still)


def test_what_hardly_moves_on_its_parent_is_told_by_it_where_the_body_is_less_sure():
    truth = waving()
    known = np.ones((FRAMES, 3), dtype=bool)
    known[GAP, 2] = False
    found, left = told(truth, known, 0.2, 0.2)
    assert lengths_of((found - truth)[GAP, 2, :3]).max() < 0.03
    assert (left[GAP, 2, :3] < 0.1 * 0.2**2).all()
    np.testing.assert_array_equal(found[known], truth[known])
    assert not left[known].any()
    # The surer the body is, the more of what it tells stays.
    surer, _ = told(truth, known, 0.2, 1e-7)
    assert lengths_of((surer - truth)[GAP, 2, :3]).min() > 0.1


def test_where_the_parent_was_never_turned_the_body_alone_tells():
    truth = waving()
    known = np.ones((FRAMES, 3), dtype=bool)
    known[GAP, 2] = False
    truth[:, 1, 3:] = np.nan
    given, variance = truth.copy(), np.zeros(truth.shape)
    variance[GAP, 2] = 0.1
    seen, turned = known, known & ~np.isnan(truth[..., 6])
    found, left = by_parents(
        given, variance, (seen, turned), PARENTS, range(3), RATE, np.zeros((FRAMES, 1))
    )
    np.testing.assert_allclose(found, truth, atol=1e-12)
    assert (left[GAP, 2] >= 0.1).all()
    assert not left[known].any()


@pytest.mark.parametrize(("joint", "mm_off"), [("lthumb", 12.0), ("rtoes", 20.0)])
def test_the_end_of_a_limb_is_told_by_it_where_no_prior_fits(shared_data, joint, mm_off):
    run = mm.read_pose(shared_data / "poses" / "02_03.amc")
    gap = slice(60, 100)
    found = restore(hide(run, gap, run.index(joint)))
    off = lengths_of(found.pose.positions - run.positions)[gap, run.index(joint)]
    assert off.mean() < mm_off
    assert off.mean() < 3.0 * found.error_mm[gap, run.index(joint)].mean()
