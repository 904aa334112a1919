"""What is told of a smoothed marker: spectra, residual analysis, %SM1."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.smoothers import inspect, percent_sm1
from markermend.smoothers.butterworth import filter_butterworth

RATE, NOISE = 100.0, 0.5


@pytest.fixture
def swing():
    """A swing of 2 Hz with white noise, missing for a while."""
    rng = np.random.default_rng(2)
    t = np.arange(3000) / RATE
    way = 40.0 * np.sin(2 * np.pi * 2.0 * t)[:, None] * [1.0, 0.5, 0.2]
    positions = way + rng.normal(0.0, NOISE, (3000, 3))
    positions[700:720] = np.nan
    return positions


def test_power_adds_up_to_the_variance_and_the_peak_is_the_swing(swing):
    found = inspect(swing, swing, RATE)
    step = found.frequencies_hz[1]
    # The longest stretch is the one behind the gap.
    assert found.before.sum(axis=0) * step == pytest.approx(np.var(swing[720:], axis=0), rel=0.1)
    assert found.frequencies_hz[found.before[:, 0].argmax()] == pytest.approx(2.0, abs=step)
    high = found.before[found.frequencies_hz > 20]
    assert high.mean() == pytest.approx(2 * NOISE**2 / RATE, rel=0.1)


def test_what_a_filter_takes_is_gone_from_the_spectrum_after(swing):
    after = swing.copy()
    after[720:] = filter_butterworth(swing[720:], RATE, 6.0)
    found = inspect(swing, after, RATE)
    high = found.frequencies_hz > 20
    assert (found.after[high].mean(axis=0) < 1e-3 * found.before[high].mean(axis=0)).all()
    assert found.residuals.noise_mm == pytest.approx(NOISE, rel=0.15)


def test_a_few_frames_have_no_spectrum():
    positions = np.full((100, 3), np.nan)
    assert inspect(positions, positions, RATE) is None
    positions[10:20] = 0.0
    assert inspect(positions, positions, RATE) is None
    positions[10:26] = np.random.default_rng(0).normal(size=(16, 3))
    assert inspect(positions, positions, RATE) is not None


def test_percent_sm1_is_the_share_of_the_way_that_went():
    before = np.array([0.0, 2.0, 0.0, np.nan, 5.0, 7.0])[:, None]
    after = np.array([0.0, 1.0, 0.0, np.nan, 5.0, 6.0])[:, None]
    assert percent_sm1(before, after) == pytest.approx([50.0])
    assert percent_sm1(np.zeros((4, 1)), np.zeros((4, 1))) == [0.0]
