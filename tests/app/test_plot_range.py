"""Ranges that plots show."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend_app.panels.plots.range import time_range, value_range, whole_frames

number = st.floats(-1e6, 1e6)


@given(number, number, st.integers(1, 100_000))
def test_whole_frames_lie_on_the_take(a: float, b: float, frames: int):
    start, stop = whole_frames(min(a, b), max(a, b), frames)
    assert 0 <= start < stop <= frames


@given(number, number, st.integers(1, 100_000))
def test_time_lies_on_the_take(a: float, b: float, frames: int):
    low, high = time_range(min(a, b), max(a, b), frames)
    margin = max(1.0, 0.01 * frames)
    assert -0.5 - margin - 1e-6 <= low < high <= frames - 0.5 + margin + 1e-6


def test_one_wild_sample_does_not_flatten_the_rest():
    values = np.sin(np.linspace(0, 20, 2000)) * 50
    values[700] = 9_000
    low, high = value_range([values])
    assert low < -50
    assert 50 < high < 200


def test_a_peak_under_review_is_shown_in_full():
    values = np.sin(np.linspace(0, 20, 2000)) * 50
    low, high = value_range([values], [np.array([260.0, np.nan])])
    assert low < -50
    assert high > 260


def test_room_is_kept_for_the_strip_and_for_what_stands_still():
    plain = value_range([np.zeros(10)])
    assert plain[0] < -3
    assert plain[1] > 3
    lifted = value_range([np.zeros(10)], bottom=0.25)
    assert (0 - lifted[0]) / (lifted[1] - lifted[0]) == pytest.approx(0.25 + 0.75 * 0.5, abs=0.01)
    lowered = value_range([np.zeros(10)], bottom=0.25, top=0.25)
    assert (0 - lowered[0]) / (lowered[1] - lowered[0]) == pytest.approx(0.5, abs=0.01)
    assert lowered[1] > lifted[1] > plain[1] - 1e-9


def test_nothing_seen_has_no_range():
    assert value_range([]) is None
    assert value_range([np.full(5, np.nan)]) is None
