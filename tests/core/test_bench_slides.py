"""Markers that slide off and stay off, as an experiment."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.bench.slides import slides, slides_table
from markermend.errors import DataError, MethodError
from markermend.simulation import simulate_clean
from markermend.simulation.slides import slide_off
from markermend.take import Take


@pytest.fixture(scope="module")
def performer() -> Take:
    return simulate_clean(duration_s=20.0, rate=100.0, seed=5)


def test_a_marker_slides_by_what_was_asked_and_nothing_else_changes(performer: Take) -> None:
    away = np.array([0.0, 6.0, 8.0])
    take, truth = slide_off(performer, "LFHD", start=1000, frames=100, away_mm=away)
    moved = np.linalg.norm(take.positions - performer.positions, axis=2)
    column = performer.index("LFHD")
    assert np.allclose(moved[1100:, column], 10.0)
    assert moved[1050, column] == pytest.approx(5.0)
    moved[1000:, column] = 0.0
    assert not moved.any()
    assert (truth.start, truth.stop, truth.amplitude_mm) == (1000, performer.frames, 10.0)


def test_a_lone_marker_has_nothing_to_slide_on(performer: Take) -> None:
    lone = Take(performer.positions[:, :3], performer.labels[:3], performer.rate)
    with pytest.raises(DataError, match="three other markers"):
        slide_off(lone, lone.labels[0], start=0, frames=1, away_mm=np.ones(3))


def test_most_that_slide_are_found_and_no_others(performer: Take) -> None:
    untouched, slid = slides({"walk": performer}, sizes_mm=(30.0,), simulations=4, seed=1, n_jobs=1)
    assert (untouched.size_mm, untouched.found, untouched.others) == (0.0, 0, 0)
    assert slid.simulations == 4
    assert slid.found >= 2
    assert slid.others == 0
    assert abs(slid.late_s) < 2.0
    assert f"{slid.found} of 4" in slides_table((untouched, slid))[2]


def test_senseless_settings_are_refused(performer: Take) -> None:
    with pytest.raises(MethodError, match="At least one"):
        slides({"walk": performer}, simulations=0)
    with pytest.raises(MethodError, match="more than 0 mm"):
        slides({"walk": performer}, sizes_mm=(0.0,))
