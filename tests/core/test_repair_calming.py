"""Predictions that tremble are smoothed as far as the marker moves smoothly; others are left."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.patch import Patch
from markermend.repairs.calming import calmed, jitter
from markermend.repairs.look_again import looked_at
from markermend.repairs.registry import Repair
from markermend.take import Take

FRAMES, START, STOP = 600, 200, 320


@pytest.fixture
def track() -> np.ndarray:
    """A smooth movement with noise of 0.1 mm."""
    t = np.arange(FRAMES)[:, None] / 100.0
    rng = np.random.default_rng(0)
    return 200 * np.sin(3 * t + np.arange(3)) + rng.normal(0, 0.1, (FRAMES, 3))


def calm(track: np.ndarray, values: np.ndarray, start: int = START) -> np.ndarray:
    seen = np.ones(FRAMES, dtype=bool)
    seen[start : start + len(values)] = False
    return calmed(values, np.where(seen[:, None], track, np.nan), seen, start, 0.1, 200)


def test_jitter_is_the_deviation_of_the_noise(track: np.ndarray) -> None:
    assert jitter(track) == pytest.approx(0.1, rel=0.2)
    assert np.isnan(jitter(track[:4]))


def test_what_trembles_no_more_than_the_marker_is_left_as_it_is(track: np.ndarray) -> None:
    values = track[START:STOP] + 5.0
    assert calm(track, values) is values


@pytest.mark.parametrize("start", [0, START, FRAMES - 120])
def test_jitter_goes_and_the_borders_join(track: np.ndarray, start: int) -> None:
    truth = track[start : start + 120]
    noisy = truth + np.random.default_rng(1).normal(0, 3.0, truth.shape)
    done = calm(track, noisy, start)
    assert (
        np.linalg.norm(done - truth, axis=1).mean()
        < 0.5 * np.linalg.norm(noisy - truth, axis=1).mean()
    )
    whole = track.copy()
    whole[start : start + 120] = done
    assert (
        np.abs(np.diff(whole, n=2, axis=0)).max() < 1.5 * np.abs(np.diff(track, n=2, axis=0)).max()
    )


def test_the_detector_finds_nothing_left_where_it_found_noise(track: np.ndarray) -> None:
    take = Take(track[:, None], ("A",), 100.0)
    noisy = track[START:STOP] + np.random.default_rng(1).normal(0, 3.0, (STOP - START, 3))

    def left(values: np.ndarray) -> object:
        return looked_at(take, Repair("x", (Patch("A", "xyz", START, STOP, values),))).leaves

    assert left(noisy)
    assert left(calm(track, noisy)) == ()
