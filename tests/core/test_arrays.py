"""Operations on arrays that several rooms share."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.arrays import (
    deviation_of_seen,
    median_of_seen,
    quantile_of_seen,
    samples_of,
)
from markermend.take import Take
from markermend.vertical import up_axis


@pytest.mark.parametrize("rows", [1, 2, 7, 10])
def test_median_of_what_is_seen(rows: int) -> None:
    rng = np.random.default_rng(rows)
    values = rng.normal(size=(rows, 5, 3))
    values[rng.random(values.shape) < 0.3] = np.nan
    values[0] = 1.0  # something is seen everywhere, but in one column
    np.testing.assert_array_equal(median_of_seen(values), np.nanmedian(values, axis=0))
    values[:, 2, 1] = np.nan
    assert np.isnan(median_of_seen(values)[2, 1])
    assert np.isnan(median_of_seen(values)).sum() == 1


@pytest.mark.parametrize("rows", [1, 2, 7, 10])
@pytest.mark.parametrize("share", [0.0, 0.3, 0.75, 1.0])
def test_quantile_of_what_is_seen(rows: int, share: float) -> None:
    rng = np.random.default_rng(rows)
    values = rng.normal(size=(rows, 5, 3))
    values[rng.random(values.shape) < 0.3] = np.nan
    values[0] = 1.0
    wanted = np.nanquantile(values, share, axis=0)
    np.testing.assert_allclose(quantile_of_seen(values, share), wanted, rtol=1e-13)
    values[:, 2, 1] = np.nan
    assert np.isnan(quantile_of_seen(values, share)[2, 1])
    assert np.isnan(quantile_of_seen(values, share)).sum() == 1


def test_samples_of_some_markers_in_some_frames() -> None:
    positions = np.random.default_rng(0).normal(size=(20, 6, 3))
    frames, columns = np.array([3, 3, 19, 0]), np.array([5, 0, 2])
    found = samples_of(positions, frames, columns)
    np.testing.assert_array_equal(found, positions[frames][:, columns])


@pytest.mark.parametrize("frames", [1, 2, 7, 10, 400])
def test_deviation_of_what_is_seen(frames: int) -> None:
    rng = np.random.default_rng(frames)
    values = rng.normal(size=(4, 5, frames))
    values[rng.random(values.shape) < 0.3] = np.nan
    values[:, :, 0] = 1.0
    middle = np.nanmedian(values, axis=-1, keepdims=True)
    wanted = np.nanmedian(np.abs(values - middle), axis=-1)
    before = values.copy()
    np.testing.assert_array_equal(deviation_of_seen(values), wanted)
    np.testing.assert_array_equal(values, before)
    values[2, 1] = np.nan
    assert np.isnan(deviation_of_seen(values)[2, 1])
    assert np.isnan(deviation_of_seen(values)).sum() == 1


def test_what_points_up_is_guessed_for_every_take_by_itself() -> None:
    rng = np.random.default_rng(0)
    tall = rng.normal(size=(50, 6, 3)) + np.linspace(0.0, 1800.0, 6)[:, None] * [0.0, 0.0, 1.0]
    standing = Take(tall, tuple("abcdef"), 100.0)
    other = Take(tall[:, :, [0, 2, 1]], tuple("abcdef"), 100.0)
    assert [up_axis(take) for take in (standing, other, standing, other)] == [2, 1, 2, 1]
