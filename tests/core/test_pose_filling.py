"""Gaps of channels, filled from what moves with them and from time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from markermend.poses.filling.bridging import bridged
from markermend.poses.filling.filling import fill
from markermend.poses.filling.sides import Mirror


def test_movement_too_large_for_single_precision_is_filled_all_the_same():
    random = np.random.default_rng(3)
    values = np.cumsum(random.normal(size=(600, 4)), axis=0) @ random.normal(size=(4, 40)) * 1e4
    known = np.ones(values.shape, dtype=bool)
    known[300:330, 7] = False
    filled = fill(values, known, 100.0)
    assert np.isfinite(filled.values).all()
    off = np.abs(filled.values - values)[300:330, 7]
    assert off.mean() < 0.2 * np.ptp(values[:, 7])


def test_what_moves_with_others_is_filled_from_them():
    random = np.random.default_rng(0)
    t = np.arange(1500) / 100
    sources = np.cumsum(random.normal(size=(1500, 3)), axis=0)
    sources = np.stack([np.convolve(s, np.hanning(40) / 20, "same") for s in sources.T], axis=1)
    values = sources @ random.normal(size=(3, 8)) * 0.05
    known = np.ones(values.shape, dtype=bool)
    known[700:760, 2] = False
    filled = fill(np.where(known, values, np.pi), known, 100.0)
    error = np.abs(filled.values - values)[700:760, 2]
    time_alone = np.abs(bridged(values, known) - values)[700:760, 2]
    assert error.mean() < 0.3 * time_alone.mean()
    assert error.mean() < 3 * np.sqrt(filled.variance[700:760, 2]).mean()
    assert (filled.values[known] == values[known]).all()
    assert (filled.variance[known] == 0).all()
    assert len(t) == len(filled.values)


def test_single_frames_are_filled_from_what_moves_with_them():
    random = np.random.default_rng(2)
    # Nothing about time tells where this is next.
    values = random.normal(size=(800, 3)) @ random.normal(size=(3, 10)) * 0.01
    known = random.random(values.shape) > 0.1
    filled = fill(np.where(known, values, np.pi), known, 120.0)
    inner = ~known & (np.arange(800) > 2)[:, None] & (np.arange(800) < 797)[:, None]
    error = (filled.values - values)[inner]
    assert np.std(error) < 0.4 * np.std((bridged(values, known) - values)[inner])
    assert 0.5 < np.sqrt(np.mean(error**2 / filled.variance[inner])) < 2.0
    assert (filled.values[known] == values[known]).all()


def test_long_gaps_follow_quick_movement_that_slow_changes_hide():
    random = np.random.default_rng(10)
    t = np.arange(1800) / 60
    paces = [
        np.sin(2 * np.pi * hertz * t + np.cumsum(random.normal(0, 0.2, 1800)))
        for hertz in (1.3, 0.9)
    ]
    slow = np.cumsum(np.cumsum(random.normal(0, 0.0005, (1800, 6)), axis=0), axis=0)
    values = 0.3 * np.transpose(paces) @ random.normal(size=(2, 6)) + slow
    known = np.ones(values.shape, dtype=bool)
    for start in range(200, 1700, 300):
        known[start : start + 50, start // 300 % 6] = False
    off = np.abs(fill(values, known, 60.0).values - values)[~known]
    assert off.mean() < 0.11


def test_filling_again_starts_from_what_was_made_of_the_others():
    random = np.random.default_rng(5)
    sources = np.cumsum(random.normal(size=(900, 2)), axis=0)
    sources = np.stack([np.convolve(s, np.hanning(40) / 20, "same") for s in sources.T], axis=1)
    values = sources @ random.normal(size=(2, 6)) * 0.05
    known = np.ones(values.shape, dtype=bool)
    known[400:460, :4] = known[402:458, 4:] = False
    damaged = np.where(known, values, np.pi)
    first = fill(damaged, known, 100.0)
    assert first.lasting
    told = replace(first, values=np.where(np.arange(6) > 3, values, first.values))
    again = fill(damaged, known, 100.0, near=told)
    wrong = [np.std((f.values - values)[400:460, :4]) for f in (first, again)]
    assert wrong[1] < 0.5 * wrong[0]
    assert (again.values[known] == values[known]).all()


def test_gaps_that_last_begin_where_a_rough_look_ended():
    random = np.random.default_rng(6)
    values = np.cumsum(random.normal(0.0, 0.02, (300, 6)), axis=0)
    values[:, 0] += values[:, 1]
    known = np.ones(values.shape, dtype=bool)
    known[100:150, 0] = known[120:170, 1] = known[200:206, 2] = False
    begun = fill(values, known, 100.0, rough=True)
    told = replace(begun, values=np.where(np.arange(6) == 1, begun.values + 1.0, begun.values))
    plain, astray = (fill(values, known, 100.0, begun=by) for by in (begun, told))
    # What was made of the second channel tells of the first.
    assert np.abs((astray.values - plain.values)[100:150, 0]).max() > 0.05


def test_the_shorter_a_recording_the_less_sure_is_what_alike_moments_tell(monkeypatch):
    def told(moved, start, own, *_rest):
        shape = len(moved), own.targets.shape[1]
        return np.zeros(shape, dtype=np.float32), np.ones(shape, dtype=np.float32)

    monkeypatch.setattr("markermend.poses.filling.lasting.by_likeness", told)
    doubt = []
    for seconds in (4, 5, 40):
        values = np.sin(np.arange(60 * seconds)[:, None] * [0.05, 0.07, 0.11])
        known = np.ones(values.shape, dtype=bool)
        known[100:160, 0] = False
        doubt.append(fill(values, known, 60.0).variance[130, 0])
    assert_allclose(doubt, [3.0, 3.0, 1.25])


@pytest.mark.parametrize("length", [1, 11, 31])
def test_how_the_other_side_moves_is_expected_of_a_side_that_has_not_moved_yet(length):
    driver, right = np.random.default_rng(1).normal(size=(2, 300)) * [[1.0], [1.7]]
    right += driver
    driver[50], right[50] = 3.0, 0.0
    known = np.ones((300, 3), dtype=bool)
    known[50 - length // 2 : 51 + length // 2, 0] = False
    # The left side stands still wherever it is seen.
    values = np.stack([np.zeros(300), right, driver], axis=1)
    mirror = Mirror(np.array([1, 0, 2]), np.ones(3, dtype=np.float32))
    alone, told = (fill(values, known, 60.0, mirror=by).values[50, 0] for by in (None, mirror))
    assert abs(alone) < 0.01
    assert told > 0.2
