"""Each smoothing method against what is known of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import make_smoothing_spline
from scipy.signal import lfilter

from markermend.bench.smooth_paper import kick_rows, read_root, sine_rows
from markermend.errors import FileFormatError
from markermend.smoothers.bspline import fit_bspline
from markermend.smoothers.butterworth import analyse_residuals, filter_butterworth
from markermend.smoothers.colour import find_colour, whiten
from markermend.smoothers.kalman import filter_kalman
from markermend.smoothers.metrics import percent_less, sm1, sm2
from markermend.smoothers.moving_average import recursive_average, symmetric_average
from markermend.smoothers.penalised import innovations_filter, likeliest_cutoff, solve, weight_of
from markermend.smoothers.registry import Signals
from markermend.smoothers.rts import run_rts
from markermend.smoothers.whittaker import fit_whittaker
from markermend.smoothers.woltring import cross_validate, fit_spline


def _noisy(n: int = 400, seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    time = np.arange(n) / 100.0
    waves = np.stack([100 * np.sin(3 * time), 50 * np.sin(9 * time)], axis=1)
    return waves + rng.normal(0, [1.0, 0.3], (n, 2))


def test_metrics_as_written() -> None:
    signal = np.array([0.0, 1.0, -1.0, np.nan, 2.0, 2.0, 5.0])
    assert sm1(signal) == pytest.approx(1 + 2 + 0 + 3)
    assert sm2(signal) == pytest.approx(9 + 9)
    assert percent_less(np.array([4.0, 0.0]), np.array([3.0, 0.0])).tolist() == [25.0, 0.0]


def test_averages_by_hand() -> None:
    signal = np.array([[0.0], [3.0], [6.0], [0.0], [9.0]])
    np.testing.assert_allclose(symmetric_average(signal, 3)[:, 0], [0, 3, 3, 5, 9])
    found = recursive_average(signal, 2)[:, 0]
    np.testing.assert_allclose(found, [0, 1.5, 3.75, 1.875, 5.4375])
    np.testing.assert_allclose(recursive_average(signal + 7, 3), recursive_average(signal, 3) + 7)


def test_kalman_by_hand() -> None:
    found = filter_kalman(np.array([[0.0], [1.0], [1.0]]), 0.01, 0.01)[:, 0]
    # The gain is 1/2 at first; then E = 0.005 + 0.01·0.5 = 0.01 again.
    np.testing.assert_allclose(found, [0.0, 0.5, 0.75])


@pytest.mark.parametrize("degree", range(1, 6))
@pytest.mark.parametrize("points", [1, 7, 20, 35, 39, 40, 400])
def test_bspline_is_a_projection(degree: int, points: int) -> None:
    values = _noisy(40)
    found = fit_bspline(values, points, degree)
    np.testing.assert_allclose(fit_bspline(found, points, degree), found, atol=1e-6)
    if points >= 40:
        np.testing.assert_allclose(found, values, atol=1e-6)
    time = np.linspace(-1, 1, 40)[:, None]
    np.testing.assert_allclose(fit_bspline(time**degree, points, degree), time**degree, atol=1e-6)


def test_butterworth_halves_the_power_at_its_cutoff() -> None:
    time = np.arange(2000) / 100.0
    for cutoff in (2.0, 6.0, 12.0):
        wave = np.sin(2 * np.pi * cutoff * time)[:, None]
        gain = filter_butterworth(wave, 100.0, cutoff)[500:1500].std() / wave[500:1500].std()
        assert gain == pytest.approx(np.sqrt(0.5), abs=0.01)
    line = np.linspace(0, 50, 200)[:, None]
    np.testing.assert_allclose(filter_butterworth(line, 100.0, 6.0), line, atol=1e-9)


def test_residual_analysis_finds_noise_and_a_sensible_cutoff() -> None:
    found = analyse_residuals(_noisy(4000), 100.0)
    np.testing.assert_allclose(found.noise_mm, [1.0, 0.3], rtol=0.15)
    assert (found.chosen_hz > 1.0).all()
    assert (found.chosen_hz < 12.0).all()
    assert (np.diff(found.residual_mm, axis=0) < 1e-9).all()


def test_spline_as_scipy_has_it() -> None:
    values, frames = _noisy(), np.arange(400.0)
    for signal, penalty in zip(values.T, cross_validate(values), strict=True):
        own = fit_spline(signal[:, None], float(penalty))[:, 0]
        given = make_smoothing_spline(frames, signal, lam=float(penalty))(frames)
        np.testing.assert_allclose(own, given, atol=1e-8)
        chosen = make_smoothing_spline(frames, signal)(frames)
        np.testing.assert_allclose(own, chosen, atol=0.05)


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_solver_against_dense_equations(order: int) -> None:
    rng = np.random.default_rng(order)
    values = rng.normal(0, 1, 30)
    noise, motion = rng.uniform(0.5, 2, 30), rng.uniform(0.1, 10, 30 - order)
    difference = np.diff(np.eye(30), order, axis=0)
    left = np.diag(1 / noise) + difference.T @ np.diag(1 / motion) @ difference
    expected = np.linalg.solve(left, values / noise)
    np.testing.assert_allclose(solve(values, noise, motion, order), expected, atol=1e-9)


def test_solver_keeps_its_digits_far_from_the_origin() -> None:
    rng = np.random.default_rng(0)
    values = rng.standard_normal(4000)
    noise = np.ones(4000)
    motion = np.full(3996, 1 / float(weight_of(0.004, 4)))
    near, far = solve(values, noise, motion, 4), solve(values + 3000, noise, motion, 4)
    np.testing.assert_allclose(far - 3000, near, atol=1e-4)


@pytest.mark.parametrize("order", [2, 3, 4])
@pytest.mark.parametrize("cutoff", [0.004, 0.05, 0.3])
def test_innovations_have_the_spectrum_they_should(order: int, cutoff: float) -> None:
    weight = float(weight_of(cutoff, order))
    theta, spread = innovations_filter(weight, order)
    omega = np.linspace(0.2, np.pi, 50)
    z = np.exp(-1j * omega)
    response = np.abs(np.polyval(theta[::-1], z)) ** 2 * spread
    expected = (2 * np.sin(omega / 2)) ** (2 * order) + 1 / weight
    np.testing.assert_allclose(response, expected, rtol=1e-5)


def test_likelihood_finds_what_a_signal_was_made_with() -> None:
    rng = np.random.default_rng(2)
    n, order, cutoff = 20_000, 2, 0.06
    drive = rng.normal(0, np.sqrt(1 / float(weight_of(cutoff, order))), n)
    signal = np.cumsum(np.cumsum(drive)) + rng.standard_normal(n)
    found, noise = likeliest_cutoff(signal[:, None], 100.0, order)
    assert found[0] == pytest.approx(6.0, rel=0.05)
    assert noise[0] == pytest.approx(1.0, rel=0.02)


def test_rts_and_whittaker_are_nearly_the_same() -> None:
    values = _noisy(800)
    cutoffs, noise = likeliest_cutoff(values, 100.0, 3)
    jerk = noise / np.sqrt(weight_of(cutoffs / 100.0, 3)) * 100.0**2.5
    positions, velocities, accelerations = run_rts(values, 100.0, noise, jerk)
    difference = (positions - fit_whittaker(values, 100.0, 3))[50:-50]
    assert np.sqrt(np.mean(difference**2)) < 0.05
    speed = np.gradient(positions, axis=0) * 100.0
    assert np.abs(speed - velocities)[50:-50].max() < 0.1 * np.abs(velocities).max()
    change = np.gradient(velocities, axis=0) * 100.0
    assert np.abs(change - accelerations)[50:-50].max() < 0.1 * np.abs(accelerations).max()


def test_published_tables_come_out() -> None:
    for row in sine_rows():
        assert row.published_after is not None
        known = "500" in row.method or "200" in row.method
        assert row.after[0] == pytest.approx(row.published_after[0], rel=0.3 if known else 0.06)
        if not known:
            assert row.percent[1] == pytest.approx(row.published_percent[1], abs=1.5)


def test_hips_of_a_recorded_motion(shared_data: Path) -> None:
    root = read_root(shared_data / "poses" / "02_03.amc")
    assert root.shape[1] == 6
    rows = kick_rows([root])
    assert len(rows) == 24
    less = {row.method: row.percent[1] for row in rows if row.signal == "channel 3"}
    points = [less[f"B-spline, {m} control points"] for m in (598, 200, 100, 50, 25)]
    assert points == sorted(points)
    with pytest.raises(FileFormatError):
        read_root(shared_data / "poses" / "02.asf")


@pytest.mark.parametrize("colour", [0.0, 0.3, 0.5])
def test_colour_of_noise_is_seen_and_undone(colour: float) -> None:
    rng = np.random.default_rng(7)
    time = np.arange(4000)[:, None, None] / 120.0
    noise = lfilter([1.0], [1.0, -colour], rng.standard_normal((4000, 4, 3)), axis=0)
    signals = Signals.of(200 * np.sin(6 * time) + noise, 120.0)
    found = find_colour(signals)
    np.testing.assert_allclose(found, colour, atol=0.2)
    white = whiten(Signals.of(noise, 120.0), np.full(4, colour)).values[1:]
    assert abs(np.mean(white[1:] * white[:-1]) / np.mean(white**2)) < 0.03


def test_a_filtered_recording_has_no_colour() -> None:
    rng = np.random.default_rng(8)
    noise = rng.standard_normal((3000, 6))
    smoothed = filter_butterworth(noise, 100.0, 6.0).reshape(3000, 2, 3)
    assert find_colour(Signals.of(smoothed, 100.0)).tolist() == [0.0, 0.0]
