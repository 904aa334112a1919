"""Gaps of a skeleton's channels bridged in time, and how far off a bridge may be."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from markermend.poses.filling.bridging import bridged, bridging_error


def test_bridges_over_every_gap_follow_the_movement():
    t = np.linspace(0, 6, 200)
    values = np.stack([np.sin(t), np.cos(t)], axis=1)
    known = np.ones((200, 2), dtype=bool)
    known[20:26, 0] = known[50:51, 0] = known[60:63, :] = known[190:, 1] = False
    across = bridged(np.where(known, values, 99.0), known)
    assert (across[known] == values[known]).all()
    assert np.abs(across - values)[:190].max() < 4e-3
    assert (across[190:, 1] == values[189, 1]).all()


@pytest.mark.parametrize("gap", [(200, 215), (200, 260), (0, 12), (390, 400), (40, 360)])
def test_how_far_a_bridge_may_be_off_is_what_it_misses_of_such_movement(gap):
    t = np.arange(400) / 100
    told, missed = [], []
    for seed in range(40):
        shift = np.random.default_rng(seed).random(3) * 6
        path = 100 * np.sin(2 * np.pi * 0.6 * t[:, None] + shift)
        known = np.ones(400, dtype=bool)
        known[slice(*gap)] = False
        across = bridged(np.where(known[:, None], path, np.nan), np.repeat(known[:, None], 3, 1))
        error = bridging_error(np.where(known[:, None], path, np.pi), known)
        assert (error[known] == 0).all()
        told.append(error[~known])
        missed.append(np.sum((across - path)[~known] ** 2, axis=1))
    told, missed = np.sqrt(np.mean(np.square(told))), np.sqrt(np.mean(missed))
    # Where nearly all is hidden what is known does not tell that it goes to and fro.
    assert 0.5 < told / missed < (6.0 if gap == (40, 360) else 2.0)


def test_where_hardly_anything_is_known_a_bridge_may_be_off_by_what_was_gone():
    known = np.zeros(30, dtype=bool)
    known[[5, 20]] = True
    path = np.arange(30)[:, None] * [3.0, 4.0, 0.0]
    assert_allclose(bridging_error(path, known)[6:20], 5.0 * np.arange(1, 15))
    flickers = np.arange(30) % 8 < 4
    assert_allclose(bridging_error(path, flickers)[12:16], 5.0 * np.arange(1, 5))
    known[20] = False
    assert np.isnan(bridging_error(path, known)[~known]).all()
    assert np.isnan(bridging_error(path, np.zeros(30, dtype=bool))).all()
