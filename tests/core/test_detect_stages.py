"""Each stage on signals whose damage is known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from markermend.artifact import Kind
from markermend.detectors.channels import judged, spread
from markermend.detectors.finding import Finding, confidence, overlap
from markermend.detectors.highpass import (
    differential,
    median_high_pass,
    savgol_high_pass,
    scaled,
    scaled_odd,
)
from markermend.detectors.morphology import closing, dilate, erode, opening, top_hat
from markermend.detectors.noise import absorb_peaks, find_noise
from markermend.detectors.params import PaperParams
from markermend.detectors.peaks import find_peaks
from markermend.detectors.slow import hysteresis
from markermend.detectors.steps import find_derivate_pairs, find_steps
from markermend.errors import MethodError
from markermend.predictors.bridging import bridge

RATE = 100.0
DEFAULT = PaperParams(confirm=True)
PUBLISHED = PaperParams()
FRAMES = 1000

signals = arrays(
    np.float64,
    st.tuples(st.integers(1, 60), st.integers(1, 3)),
    elements=st.floats(-1e3, 1e3),
)
sizes = st.integers(0, 6).map(lambda n: 2 * n + 1)


@pytest.fixture
def clean() -> np.ndarray:
    """Six channels of smooth motion with a tenth of a millimetre of noise."""
    rng = np.random.default_rng(5)
    t = np.arange(FRAMES)[:, None] / RATE
    motion = 60 * np.sin(2 * np.pi * (0.3 + 0.1 * np.arange(6)) * t + np.arange(6))
    return motion + rng.normal(0, 0.1, (FRAMES, 6))


@pytest.fixture
def seen() -> np.ndarray:
    return np.ones((FRAMES, 6), dtype=bool)


@given(signals, sizes)
def test_morphology_keeps_its_order(x: np.ndarray, size: int) -> None:
    assert (erode(x, size) <= x).all()
    assert (dilate(x, size) >= x).all()
    assert (opening(x, size) <= x).all()
    assert (closing(x, size) >= x).all()
    assert (top_hat(x, size) >= 0).all()
    np.testing.assert_array_equal(opening(opening(x, size), size), opening(x, size))
    np.testing.assert_array_equal(erode(x, size), -dilate(-x, size))


@given(arrays(np.bool_, st.tuples(st.integers(1, 80), st.just(1))), sizes)
def test_binary_morphology_agrees_with_grey(x: np.ndarray, size: int) -> None:
    grey = x.astype(float)
    for operation in (erode, dilate, opening, closing, top_hat):
        result = operation(x, size)
        assert result.dtype == np.bool_
        np.testing.assert_array_equal(result, operation(grey, size) == 1)


def test_top_hat_keeps_what_is_narrower_than_the_element() -> None:
    x = np.zeros((40, 1), dtype=bool)
    x[5:8] = True
    x[20:27] = True
    np.testing.assert_array_equal(np.flatnonzero(top_hat(x, 5)), [5, 6, 7])


def test_high_passes_remove_what_they_should() -> None:
    ramp = np.arange(200.0)[:, None]
    assert np.abs(median_high_pass(ramp, 19)[10:-10]).max() == 0
    quintic = (np.linspace(-1, 1, 200) ** 5)[:, None]
    assert np.abs(savgol_high_pass(quintic, 5, 13)).max() < 1e-12
    jump = np.repeat([0.0, 5.0], 100)[:, None]
    assert savgol_high_pass(differential(jump), 5, 13)[100, 0] == pytest.approx(3.6, abs=0.1)


@pytest.mark.parametrize(("rate", "frames", "odd"), [(100, 20, 19), (120, 24, 23), (250, 50, 47)])
def test_lengths_scale_with_the_rate(rate: float, frames: int, odd: int) -> None:
    assert scaled(20, rate) == frames
    assert scaled_odd(19, rate) == odd


def test_windows_stay_long_enough_for_their_polynomial() -> None:
    assert scaled_odd(13, 25, least=7) == 7
    assert scaled_odd(13, 25, least=8) == 9


def test_clean_motion_has_nothing(clean: np.ndarray, seen: np.ndarray) -> None:
    for stage in (find_peaks, find_noise, find_steps):
        assert stage(clean, seen, RATE, DEFAULT) == []


@pytest.mark.parametrize("size", [-40.0, -12.0, 12.0, 40.0])
@pytest.mark.parametrize("length", [1, 2, 4])
def test_a_peak_is_found_to_the_frame(
    clean: np.ndarray, seen: np.ndarray, size: float, length: int
) -> None:
    clean[400 : 400 + length, 2] += size
    (found,) = find_peaks(clean, seen, RATE, DEFAULT)
    assert (found.channel, found.start, found.stop) == (2, 400, 400 + length)
    assert found.amplitude_mm == pytest.approx(abs(size), abs=0.15 * abs(size) + 1)
    assert found.ratio > 1


def test_heavy_noise_is_found_whole(clean: np.ndarray, seen: np.ndarray) -> None:
    clean[300:360, 4] += np.random.default_rng(1).normal(0, 10, 60)
    (found,) = find_noise(clean, seen, RATE, DEFAULT)
    assert found.channel == 4
    assert overlap((found.start, found.stop), (300, 360)) > 0.85


@pytest.mark.parametrize("length", [22, 34, 60, 150])
@pytest.mark.parametrize("size", [-100.0, 6.0])
def test_a_step_is_found_to_the_frame_and_is_no_noise(
    clean: np.ndarray, seen: np.ndarray, length: int, size: float
) -> None:
    clean[300 : 300 + length, 0] += size
    if length > 25:
        assert find_noise(clean, seen, RATE, DEFAULT) == []
    (found,) = find_steps(clean, seen, RATE, DEFAULT)
    assert (found.channel, found.start, found.stop) == (0, 300, 300 + length)
    assert found.amplitude_mm == pytest.approx(abs(size), rel=0.1)


def test_a_jump_that_never_comes_back_is_no_step(clean: np.ndarray, seen: np.ndarray) -> None:
    clean[300:, 0] += 20
    assert find_steps(clean, seen, RATE, DEFAULT) == []


def test_two_left_over_peaks_are_no_step(clean: np.ndarray, seen: np.ndarray) -> None:
    clean[300, 0] += 20
    clean[400, 0] += 20
    assert find_steps(clean, seen, RATE, DEFAULT) == []


def test_pairs_take_the_largest_first_and_never_cross() -> None:
    at = np.array([10, 40, 70, 100, 400])
    change = np.array([9.0, -10.0, 10.0, -9.5, -10.0])
    assert find_derivate_pairs(at, change, 20, 200) == [(1, 2)]
    assert find_derivate_pairs(at[:2], change[:2], 40, 200) == []
    assert find_derivate_pairs(at[[0, 2]], change[[0, 2]], 20, 200) == []
    assert find_derivate_pairs(at[[0, 1]], np.array([9.0, -3.0]), 20, 200) == []


def test_gap_edges_are_not_judged(clean: np.ndarray, seen: np.ndarray) -> None:
    clean[400:410, 0] += 50
    seen[380:400, 0] = False
    seen[410:430, 0] = False
    whole = bridge(clean, seen)
    for stage in (find_peaks, find_noise, find_steps):
        assert all(f.channel != 0 for f in stage(whole, seen, RATE, DEFAULT))
    assert not judged(seen)[378:403, 0].any()
    assert judged(seen)[404:408, 0].all()


def test_spread_looks_at_valid_samples_only() -> None:
    x = np.array([[1.0], [-1.0], [1000.0]])
    assert spread(x, np.array([[True], [True], [False]]))[0] == 1.0
    assert spread(x, np.zeros((3, 1), dtype=bool))[0] == 0.0


@settings(max_examples=40)
@given(st.floats(0.5, 30), st.integers(0, 2**16))
def test_what_is_found_does_not_depend_on_where_the_origin_is(shift: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    x = np.cumsum(rng.normal(0, 1, (300, 1)), axis=0)
    x[150] += 40
    seen = np.ones_like(x, dtype=bool)
    here = find_peaks(x, seen, RATE, DEFAULT)
    there = find_peaks(x + 8 * shift, seen, RATE, DEFAULT)
    assert [(f.start, f.stop) for f in here] == [(f.start, f.stop) for f in there]


def test_as_published_thresholds_scale_with_the_signal(clean: np.ndarray, seen: np.ndarray) -> None:
    clean[500, 3] += 15
    small = find_peaks(clean, seen, RATE, PUBLISHED)
    large = find_peaks(4 * clean, seen, RATE, PUBLISHED)
    assert [(f.channel, f.start, f.stop) for f in small] == [
        (f.channel, f.start, f.stop) for f in large
    ]
    assert large[0].ratio == pytest.approx(small[0].ratio)
    assert large[0].amplitude_mm == pytest.approx(4 * small[0].amplitude_mm)


def test_hysteresis_grows_tops_to_their_base() -> None:
    x = np.zeros(200)
    x[20:100] = 1.0
    x[40:70] = 4.0
    x[120:190] = 1.0
    x[150:155] = 4.0
    np.testing.assert_array_equal(hysteresis(x, 3.0, 0.5, 20, 50), [[20, 100]])
    assert len(hysteresis(x, 3.0, 0.5, 31, 50)) == 0
    assert len(hysteresis(x, 3.0, 0.5, 20, 81)) == 0


def test_noise_absorbs_the_peaks_beside_it() -> None:
    def at(channel: int, start: int, stop: int, kind: Kind) -> Finding:
        return Finding(channel, start, stop, kind, 2.0, 5.0)

    peaks = [at(0, 98, 99, Kind.PEAK), at(0, 300, 301, Kind.PEAK), at(1, 110, 111, Kind.PEAK)]
    joined = absorb_peaks(peaks, [at(0, 100, 150, Kind.NOISE)], RATE, DEFAULT)
    assert joined == [peaks[1], peaks[2], at(0, 98, 150, Kind.NOISE)]


def test_confidence_is_one_half_at_the_threshold_and_grows() -> None:
    assert confidence(1.0, Kind.PEAK) == 0.5
    values = [confidence(r, Kind.PEAK) for r in np.linspace(1, 50, 30)]
    assert values == sorted(values)
    assert values[-1] < 1
    assert confidence(1e9, Kind.SLOW) < 0.5


@pytest.mark.parametrize("bad", [{"peak_k": -1.0}, {"savgol_order": 0}, {"noise_length": 1}])
def test_parameters_outside_their_range_are_refused(bad: dict[str, float]) -> None:
    with pytest.raises(MethodError, match=next(iter(bad))):
        PaperParams(**bad)  # type: ignore[arg-type]
