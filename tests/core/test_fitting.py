"""Whose samples may be whose: receivers, donors, and those that changed places."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.review.fitting import donors, exchangers, receivers
from markermend.take import Take


def a_take():
    """A, B and C stand 100 mm apart; A has a gap that *1 fills, *2 is seen far from it."""
    positions = np.zeros((60, 5, 3))
    positions[:, 1, 0], positions[:, 2, 0] = 100.0, 200.0
    positions[:, 3:] = np.nan
    positions[20:30, 3] = [0.0, 4.0, 0.0]
    positions[22:28, 4] = [70.0, 0.0, 0.0]
    positions[20:30, 0] = np.nan
    return Take(positions, ("A", "B", "C", "*1", "*2"), 100.0)


def test_donors_are_the_unlabelled_trajectories_in_a_markers_gap_nearest_first():
    assert donors(a_take(), "A") == (("*1", pytest.approx(4.0)), ("*2", pytest.approx(70.0)))
    assert donors(a_take(), "B") == ()


def test_receivers_are_those_that_are_missing_there_named_ones_first():
    assert receivers(a_take(), "*2", 0, 60) == (("A", pytest.approx(70.0)),)
    assert [label for label, _ in receivers(a_take(), "B", 0, 10)] == ["*2", "*1"]


def test_who_changed_places_is_the_one_whose_exchange_leaves_no_jump():
    take = a_take()
    positions = take.positions.copy()
    positions[40:50, [1, 2]] = positions[40:50, [2, 1]]
    found = exchangers(take.with_positions(positions, take.origin), "B", 40, 50)
    assert found[0] == ("C", pytest.approx(0.0))
    assert found[1] == ("A", pytest.approx(200.0))
    assert [mm for _, mm in found[2:]] == [np.inf, np.inf]


def test_a_range_from_the_first_frame_to_the_last_has_no_edges():
    assert exchangers(a_take(), "B", 0, 60)[0][1] == 0.0
