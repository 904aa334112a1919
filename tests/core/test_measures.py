"""Speed, acceleration, distances and segment lengths against what calculus says."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.measures import acceleration, differing, distance, measure_lengths, speed

RATE = 100.0


def falling() -> np.ndarray:
    """A marker thrown: constant speed along x, falling along z, mm."""
    t = np.arange(50) / RATE
    return np.stack([2000 * t, np.zeros(50), 1000 - 9810 / 2 * t**2], axis=1)


def test_speed_is_that_of_a_thrown_marker() -> None:
    t = np.arange(50) / RATE
    found = speed(falling(), RATE)
    expected = np.hypot(2.0, 9.81 * t)
    # The central difference of a parabola is exact; the ends are half a frame off.
    np.testing.assert_allclose(found[1:-1], expected[1:-1], rtol=1e-9)
    np.testing.assert_allclose(found[[0, -1]], expected[[0, -1]], atol=9.81 / RATE)


def test_speed_beside_a_gap_is_one_sided_and_inside_unknown() -> None:
    way = np.stack([np.arange(10) * 10.0, np.zeros(10), np.zeros(10)], axis=1)
    way[4:6] = np.nan
    way[8] = np.nan
    found = speed(way, RATE)
    np.testing.assert_allclose(found[[0, 1, 2, 3, 6, 7]], 1.0)
    assert np.isnan(found[[4, 5, 8, 9]]).all()


def test_acceleration_is_gravity_and_unknown_beside_a_gap() -> None:
    way = falling()
    way[20] = np.nan
    found = acceleration(way, RATE)
    known = ~np.isnan(found)
    assert not known[[0, 19, 20, 21, 49]].any()
    assert known.sum() == 45
    np.testing.assert_allclose(found[known], 9.81, rtol=1e-6)


@pytest.mark.parametrize("frames", [0, 1, 2])
def test_short_trajectories_have_no_derivatives_but_no_errors(frames: int) -> None:
    way = np.zeros((frames, 3))
    assert speed(way, RATE).shape == acceleration(way, RATE).shape == (frames,)
    assert np.isnan(acceleration(way, RATE)).all()


def test_a_spike_stands_out_in_acceleration() -> None:
    way = falling()
    way[30, 1] += 20.0
    assert np.nanargmax(acceleration(way, RATE)) == 30


def test_distance_knows_what_is_missing() -> None:
    a, b = np.zeros((3, 3)), np.array([[3.0, 4, 0], [0, 0, 2], [np.nan] * 3])
    np.testing.assert_array_equal(distance(a, b), [5.0, 2.0, np.nan])


def test_versions_differ_where_values_do_or_one_is_missing() -> None:
    a = np.zeros((4, 3))
    b = a.copy()
    a[1:3], b[2:4, :] = np.nan, np.nan
    b[0, 2] = 1e-3
    assert differing(a, b).tolist() == [True, True, False, True]


def test_lengths_off_are_found_and_only_these() -> None:
    rng = np.random.default_rng(3)
    positions = np.zeros((400, 4, 3))
    positions[:, 1, 0], positions[:, 2, 1] = 300, 400
    positions += rng.normal(0, 0.5, positions.shape)
    positions[:, 3] = np.nan
    positions[100:140, 1, 0] += 60
    positions[200, 0] = np.nan
    lengths = measure_lengths(positions, np.array([[0, 1], [0, 2], [1, 2], [0, 3]]))
    np.testing.assert_allclose(lengths.usual[:3], [300, 400, 500], atol=1)
    assert np.isnan(lengths.usual[3])
    assert lengths.off(positions[50]).tolist() == [False] * 4
    assert lengths.off(positions[120]).tolist() == [True, False, True, False]
    assert lengths.off(positions[200]).tolist() == [False] * 4


def test_no_links_are_no_trouble() -> None:
    lengths = measure_lengths(np.zeros((5, 2, 3)), np.zeros((0, 2), dtype=np.int64))
    assert lengths.off(np.zeros((2, 3))).shape == (0,)
