"""Residuals and camera counts as evidence for jumps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from sudden import sudden

from markermend.detectors.joint import JointParams
from markermend.detectors.joint.witness import LARGEST_WEIGHT, ask
from markermend.simulation import contaminate, simulate_clean

PARAMS = JointParams(slow=False)


@pytest.fixture(scope="module")
def damaged():
    clean = simulate_clean(duration_s=12.0, rate=120.0, seed=15)
    return contaminate(clean, share=0.05, amplitude_mm=2.0, kinds=("peak", "step"), seed=5)


def residuals_of(take, seed):
    shape = take.positions.shape[:2]
    return np.random.default_rng(seed).uniform(0.45, 0.5, shape).astype(np.float32)


def with_changes(take, truth):
    """A take whose residual is larger, and whose cameras are fewer, wherever it is damaged."""
    residuals = residuals_of(take, 0)
    cameras = np.full(residuals.shape, 5, dtype=np.uint8)
    for a in truth:
        residuals[a.start : a.stop, take.index(a.marker)] = 1.5
        cameras[a.start : a.stop, take.index(a.marker)] = 3
    return residuals, cameras


def test_residuals_that_change_at_jumps_make_them_surer_and_are_told(damaged):
    take, truth = damaged
    residuals, cameras = with_changes(take, truth)
    without = sudden(replace(take, residuals=None))
    told = sudden(replace(take, residuals=residuals))
    found = [a for a in told if "residual changes there from 0.5 mm to 1.5 mm" in a.why]
    assert len(found) >= 0.9 * len(told)
    assert len(told) > len(without)
    by_id = {a.id: a for a in told}
    both = [(a, by_id[a.id]) for a in without if a.id in by_id]
    assert len(both) >= 0.9 * len(without)
    for old, new in both:
        odds = [a.confidence / (1 - a.confidence) for a in (old, new)]
        assert odds[1] <= odds[0] * (LARGEST_WEIGHT + 1e-6)
    assert sum(b.confidence > a.confidence for a, b in both) >= 0.9 * len(both)
    counted = sudden(replace(take, residuals=residuals, cameras=cameras))
    assert sum("3 cameras see it instead of 5" in a.why for a in counted) >= 0.9 * len(counted)


@pytest.mark.parametrize("residual", ["constant", "random"])
def test_residuals_that_know_nothing_change_nothing(damaged, residual):
    take, _ = damaged
    shape = take.positions.shape[:2]
    some = np.random.default_rng(1).uniform(0.2, 1.0, shape) if residual == "random" else 0.0
    silent = replace(take, residuals=np.full(shape, some, dtype=np.float32))
    without = sudden(replace(take, residuals=None))
    assert ask(silent, without) is None
    assert sudden(silent) == without


def test_few_jumps_tell_nothing_about_residuals(damaged):
    take, truth = damaged
    residuals, _ = with_changes(take, truth)
    few = [a for a in sudden(take) if a.confidence >= 0.9][:10]
    assert ask(replace(take, residuals=residuals), few) is None
