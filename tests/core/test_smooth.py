"""Smoothing a take: what every method keeps, and what the one without a knob promises."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import markermend as mm
from markermend.bench.smooth import kick, make_noise, performer
from markermend.bench.smooth_bands import hold
from markermend.errors import Cancelled, DataError, MethodError
from markermend.smoothers import SMOOTHERS, Signals, derivatives, smooth
from markermend.take import Event, Origin, Take

RATE = 120.0


def _take(frames: int = 360, markers: int = 3, seed: int = 0) -> Take:
    """Walk-like sines in noise, with a gap, a filled stretch and a marker never seen."""
    rng = np.random.default_rng(seed)
    time_s = np.arange(frames)[:, None, None] / RATE
    phase = rng.uniform(0, 6, (1, markers, 3))
    positions = 300 * np.sin(2 * np.pi * 0.9 * time_s + phase) + rng.normal(0, 0.5, phase.shape)
    positions = positions + rng.normal(0, 0.5, (frames, markers, 3))
    positions[100:130, 0] = np.nan
    positions[:, 2:] = np.nan
    origin = (~np.isnan(positions[:, :, 0])).astype(np.uint8)
    origin[200:240, 1:2] = Origin.FILLED
    return Take(positions, ("A", "B", "C")[:markers], RATE, origin=origin)


@pytest.mark.parametrize("method", SMOOTHERS)
def test_every_method_keeps_gaps_and_the_input(method: str) -> None:
    take = _take()
    before = take.positions.copy()
    result = smooth(take, method)
    np.testing.assert_array_equal(take.positions, before)
    np.testing.assert_array_equal(np.isnan(result.positions), np.isnan(before))
    assert (result.origin[:100, 0] == Origin.EDITED).mean() > 0.9
    assert (result.origin[200:240, 1] == Origin.FILLED).all()
    assert (result.origin[:, 2] == Origin.MISSING).all()
    again = smooth(take, method)
    np.testing.assert_array_equal(result.positions, again.positions)


# The adaptive one learns a marker's noise from all of its stretches.
@pytest.mark.parametrize("method", [m for m in SMOOTHERS if m != "auto"])
def test_nothing_is_smoothed_across_a_gap(method: str) -> None:
    take = _take()
    moved = take.positions.copy()
    moved[130:, 0] += 1000.0 * np.sin(np.arange(len(moved) - 130))[:, None]
    other = smooth(take.with_positions(moved, take.origin), method)
    same = smooth(take, method)
    np.testing.assert_array_equal(same.positions[:100, 0], other.positions[:100, 0])


@pytest.mark.parametrize("method", SMOOTHERS)
def test_moving_the_take_moves_the_result(method: str) -> None:
    take = _take()
    shift = np.array([1000.0, -2000.0, 500.0])
    other = smooth(take.with_positions(take.positions + shift, take.origin), method)
    found, expected = other.positions, smooth(take, method).positions + shift
    np.testing.assert_allclose(found, expected, atol=1e-4, equal_nan=True)


def test_auto_barely_crosses_a_gap() -> None:
    take = _take()
    moved = take.positions.copy()
    moved[130:, 0] += 500.0
    other = smooth(take.with_positions(moved, take.origin))
    np.testing.assert_allclose(smooth(take).positions[:100, 0], other.positions[:100, 0], atol=1e-6)


@pytest.mark.parametrize("kind", ["white", "coloured"])
def test_auto_keeps_a_kick_and_calms_standing(kind: str) -> None:
    truth = kick(markers=6)
    rng = np.random.default_rng(1)
    noisy = truth.positions + make_noise(truth.positions.shape, truth.rate, kind, rng)
    labels = tuple(f"M{i}" for i in range(6))
    found = smooth(Take(noisy, labels, truth.rate)).positions
    off = np.sqrt(np.mean((found - truth.positions) ** 2))
    assert off < (0.3 if kind == "white" else 0.6)
    lowest = int(truth.positions[0, :, 2].argmin())
    peak = truth.positions[3580:3680, lowest, 0].max()
    assert abs(found[3580:3680, lowest, 0].max() - peak) < 1.5
    jerk = np.diff(found[600:3000], 3, axis=0).std() / np.diff(noisy[600:3000], 3, axis=0).std()
    assert jerk < 0.02


@pytest.mark.parametrize("noise_mm", [0.3, 1.0, 3.0])
def test_auto_beats_one_weight_for_the_whole_take(noise_mm: float) -> None:
    truth = performer(markers=4)
    rng = np.random.default_rng(3)
    noisy = truth.positions + rng.normal(0, noise_mm, truth.positions.shape)
    signals = Signals.of(noisy, truth.rate)
    off = {}
    for method in ("auto", "whittaker"):
        error = SMOOTHERS[method].run(signals, SMOOTHERS[method].params()) - truth.positions
        sharp = np.diff(error, 2, axis=0)[12:-12]
        off[method] = np.sqrt(np.mean(error**2)), np.sqrt(np.mean(sharp**2, axis=0)).mean()
    assert off["auto"][0] < off["whittaker"][0]
    assert off["auto"][1] < 0.85 * off["whittaker"][1]


def test_bands_hold_two_thirds_of_the_errors() -> None:
    truth = performer(markers=5)
    rng = np.random.default_rng(4)
    noisy = truth.positions + rng.standard_normal(truth.positions.shape)
    labels = tuple(f"M{i}" for i in range(5))
    found = derivatives(Take(noisy, labels, truth.rate), markers=labels[1:])
    assert found.labels == labels[1:]
    exact = truth.positions[:, 1:]
    speed = np.gradient(exact, axis=0) * truth.rate
    for value, band, right in (
        (found.position, found.position_band, exact),
        (found.velocity, found.velocity_band, speed),
    ):
        inside = (np.abs(value - right) < band)[24:-24].mean()
        assert 0.58 < inside < 0.85
    assert abs(np.median(found.noise_mm) - 1.0) < 0.1


@pytest.mark.parametrize("noise_mm", [0.3, 3.0])
def test_wide_bands_hold_nine_in_ten_at_rest_and_in_motion(noise_mm: float) -> None:
    rows = hold([performer(seed=61, markers=5)], noises_mm=[noise_mm], kinds=["white"])
    assert [r.moment for r in rows] == ["rest", "motion"]
    for r in rows:
        assert min(r.position, r.velocity) > 0.8
        assert r.acceleration > 0.88


@pytest.mark.parametrize("noise_mm", [0.1, 1.0])
def test_the_band_of_acceleration_holds_a_kick_and_is_not_far_too_wide(noise_mm: float) -> None:
    truth = kick(markers=4)
    rng = np.random.default_rng(6)
    noisy = truth.positions + noise_mm * rng.standard_normal(truth.positions.shape)
    found = derivatives(Take(noisy, ("A", "B", "C", "D"), truth.rate))
    right = np.gradient(np.gradient(truth.positions, axis=0), axis=0) * truth.rate**2
    off = found.acceleration - right
    second = slice(round(29.8 * truth.rate), round(30.8 * truth.rate))
    assert (np.abs(off) < 1.645 * found.acceleration_band)[second].mean() > 0.87
    size = np.sqrt(np.mean(off[24:-24] ** 2, axis=0))
    assert (np.median(found.acceleration_band[24:-24], axis=0) < 4.0 * size).all()


def test_derivatives_leave_gaps_and_scraps_empty() -> None:
    take = _take()
    positions = take.positions.copy()
    positions[104:109, 0] = 1.0
    found = derivatives(take.with_positions(positions, take.origin))
    for values in (found.position, found.velocity_band, found.acceleration):
        assert np.isnan(values[100:130, 0]).all()
        assert np.isnan(values[:, 2]).all()
        assert np.isfinite(values[:100, 0]).all()


def test_a_selection_changes_nothing_else() -> None:
    take = _take()
    result = smooth(take, "butterworth", markers=["B"], start=50, stop=90, cutoff_hz=5.0)
    same = np.ones(take.positions.shape[:2], dtype=bool)
    same[50:90, 1] = False
    np.testing.assert_array_equal(result.positions[same], take.positions[same])
    assert (result.positions[50:90, 1] != take.positions[50:90, 1]).all()
    assert (result.origin[50:90, 1] == Origin.EDITED).all()


@pytest.mark.parametrize("damage", ["filled", "spike"])
def test_noise_is_told_by_good_samples(damage: str) -> None:
    rng = np.random.default_rng(5)
    time_s = np.arange(1200)[:, None, None] / RATE
    clean = 300 * np.sin(2 * np.pi * 0.9 * time_s + np.arange(3.0))
    positions = clean + rng.normal(0, 0.5, clean.shape)
    origin = np.full((1200, 1), Origin.MEASURED, dtype=np.uint8)
    if damage == "filled":
        positions[500:1100] = clean[500:1100]
        origin[500:1100] = Origin.FILLED
    else:
        positions[300] += 400.0
    noise = derivatives(Take(positions, ("A",), RATE, origin=origin)).noise_mm
    assert 0.4 < np.median(noise[:450]) < 0.6


def test_events_are_read_on_the_file_s_clock() -> None:
    from markermend.smoothers.run import _signals

    take = Take(np.zeros((50, 1, 3)), ("A",), 100.0, first_frame=11, events=(Event("Foot", 0.3),))
    assert _signals(take, np.array([0])).event_frames.tolist() == [20]


@settings(max_examples=25, deadline=None)
@given(
    frames=st.integers(1, 80),
    holes=st.lists(st.integers(0, 79), max_size=20),
    method=st.sampled_from(sorted(SMOOTHERS)),
    still=st.booleans(),
)
def test_any_take_can_be_smoothed(frames: int, holes: list[int], method: str, still: bool) -> None:
    rng = np.random.default_rng(frames)
    positions = np.zeros((frames, 2, 3)) if still else rng.normal(0, 10, (frames, 2, 3))
    for hole in holes:
        positions[hole % frames, hole % 2] = np.nan
    take = Take(positions, ("A", "B"), 100.0)
    result = smooth(take, method)
    np.testing.assert_array_equal(np.isnan(result.positions), np.isnan(positions))
    if still:
        np.testing.assert_allclose(np.nan_to_num(result.positions), 0.0, atol=1e-9)


def test_what_cannot_be_done_is_said() -> None:
    take = _take()
    with pytest.raises(MethodError, match="no smoother “nothing”"):
        smooth(take, "nothing")
    with pytest.raises(MethodError, match="has no parameter “cutoff”"):
        smooth(take, "butterworth", cutoff=6)
    with pytest.raises(MethodError, match="between 1 and 5"):
        smooth(take, "bspline", params={"degree": 7})
    with pytest.raises(MethodError, match="too high"):
        smooth(take, "butterworth", cutoff_hz=60)
    with pytest.raises(MethodError, match="odd"):
        smooth(take, "moving_average", window=4)
    with pytest.raises(DataError, match="no marker"):
        smooth(take, markers=["Z"])
    with pytest.raises(DataError, match="nothing to smooth"):
        smooth(take, start=20, stop=20)

    def stop(share: float, doing: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        smooth(take, progress=stop)


def test_real_gaps_stay(shared_data: Path) -> None:
    take = mm.read(shared_data / "gait" / "test_walking.c3d")
    result = smooth(take)
    np.testing.assert_array_equal(result.present, take.present)
    change = np.abs(result.positions - take.positions)
    assert np.nanmedian(change) < 0.3
    assert np.isfinite(result.positions[take.present]).all()


@pytest.mark.parametrize("method", SMOOTHERS)
def test_a_take_without_frames_stays_as_it_is(method: str) -> None:
    empty = Take(np.empty((0, 2, 3)), ("A", "B"), RATE)
    assert smooth(empty, method).positions.shape == (0, 2, 3)
    assert derivatives(empty).velocity.shape == (0, 2, 3)
