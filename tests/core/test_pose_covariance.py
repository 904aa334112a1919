"""Bridges over gaps, and how features move together within one."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from markermend.poses.filling.bridging import SIDE, around, bridge, straight
from markermend.poses.filling.covariance import (
    LENGTHS_S,
    averaged,
    deviations,
    learn,
    nearest_length,
    pooled,
)


@pytest.mark.parametrize("length", [1, 2, 7, 40])
def test_bridges_carry_straight_lines_over(length):
    line = 3.0 - 0.5 * np.arange(length + 2 * SIDE)
    beside = line[around(SIDE, SIDE + length)]
    for weights in (bridge(length), straight(length)):
        assert weights.shape == (length, 2 * SIDE)
        assert_allclose(weights @ beside, line[SIDE : SIDE + length], atol=1e-9)


def test_the_bridge_bends_with_the_movement_and_less_than_the_curve():
    path = np.arange(14.0) ** 2
    beside, inside = path[around(2, 12)], path[2:12]
    bent = np.abs(bridge(10) @ beside - inside).max()
    assert bent < 0.7 * np.abs(straight(10) @ beside - inside).max()


def test_lines_do_not_stray_and_short_recordings_have_no_windows():
    values = np.arange(60.0)[:, None] * [1.0, -2.0]
    assert_allclose(deviations(values, 9), 0, atol=1e-9)
    assert deviations(values[:5], 9).shape == (0, 2)


def test_what_moves_together_is_found_at_its_own_pace():
    random = np.random.default_rng(0)
    t = np.arange(4000) / 100
    slow, fast = np.sin(0.3 * t), np.sin(2 * np.pi * 3.1 * t)
    values = np.stack([slow + 0.2 * fast, slow - 0.2 * fast], axis=1)
    values += random.normal(0, 1e-3, values.shape)
    moments = learn(values, 100.0)

    def correlation(covariance):
        return covariance[0, 1] / np.sqrt(covariance[0, 0] * covariance[1, 1])

    assert correlation(moments.whole) > 0.8
    assert correlation(moments.within_s(0.25)) < -0.9
    assert LENGTHS_S[nearest_length(0.24)] == 0.25


def test_only_wanted_lengths_are_learnt_and_the_nearest_of_them_serves():
    values = np.random.default_rng(2).normal(size=(500, 3))
    some = learn(values, 100.0, [25])
    every = learn(values, 100.0)
    assert np.count_nonzero(some.counts) == 1
    assert (some.within_s(4.0) == some.within_s(0.25)).all()
    assert (some.within_s(0.25) == every.within_s(0.25)).all()


def test_a_prior_counts_for_its_weight():
    random = np.random.default_rng(1)
    prior = learn(random.normal(size=(3000, 2)), 100.0)
    alone = learn(10 * random.normal(size=(60, 2)), 100.0)
    little = pooled(alone, averaged([prior, prior], 3000.0))
    assert little.whole[0, 0] < 10
    assert alone.whole[0, 0] > 50
    assert_allclose(pooled(alone, averaged([prior], 1e-6)).whole, alone.whole)
    part = little.of(np.array([False, True]))
    assert part.within[5, 0, 0] == little.within[5, 1, 1]
