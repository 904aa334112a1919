"""Slow changes: whitening, bands, and the scores of the bank of shapes."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import firwin

from markermend.detectors.joint.bands import clipped, filters, split
from markermend.detectors.joint.bank import KINDS, bank, local_level, scores, shape_of
from markermend.detectors.joint.views import BODY, VIEWS, Views, see
from markermend.detectors.joint.whiten import whiten


def red_noise(frames, seed=0):
    white = np.random.default_rng(seed).standard_normal(frames)
    red = np.zeros(frames)
    for t in range(2, frames):
        red[t] = 1.6 * red[t - 1] - 0.65 * red[t - 2] + 0.1 * white[t]
    return red, 0.1 * white


def test_whitening_recovers_the_innovations():
    red, white = red_noise(3000)
    w = whiten(red, np.zeros((3000, 0)), np.ones(3000, dtype=bool))
    assert np.corrcoef(w.error[100:], white[100:])[0, 1] > 0.98
    assert np.median(w.sigma) == pytest.approx(0.1, rel=0.15)
    lagged = [np.corrcoef(w.error[100:-k], w.error[100 + k :])[0, 1] for k in (1, 2, 3)]
    assert np.abs(lagged).max() < 0.1


def scored(red):
    white = whiten(red, np.zeros((len(red), 0)), np.ones(len(red), dtype=bool))
    parts, weight = split(white.error)
    return scores(clipped(parts, weight), weight, white.habit)


@pytest.mark.parametrize("kind", list(KINDS))
def test_the_bank_finds_its_own_shapes(kind):
    red, _ = red_noise(2000, seed=1)
    red[900:950] += 4.0 * shape_of(kind, 50)
    score = scored(red)
    frame, best = np.unravel_index(np.abs(score).argmax(), score.shape)
    assert abs(frame - 900) <= 8
    assert abs(bank()[1][best][1] - 50) <= 12


@pytest.mark.parametrize("length", [50, 51])
def test_in_a_smoothed_recording_kinks_are_found_to_the_frame(length):
    smooth = np.convolve(np.random.default_rng(5).standard_normal(2000), np.hanning(9), "same")
    smooth += 0.002 * np.random.default_rng(6).standard_normal(2000)
    smooth[900 : 900 + length] += 15.0 * shape_of("sharp", length)
    score = np.abs(scored(smooth))[200:1800]
    frame, best = np.unravel_index(score.argmax(), score.shape)
    assert (frame, bank()[1][best]) == (700, ("sharp", length))


def test_scores_of_pure_noise_are_standard_normal():
    red, _ = red_noise(4000, seed=2)
    assert scored(red)[200:3600, 10].std() == pytest.approx(1.0, abs=0.2)


def test_bands_add_up_and_weigh_by_their_own_noise():
    assert filters().sum(axis=0) == pytest.approx(np.eye(41)[20], abs=1e-12)
    assert filters()[0] == pytest.approx(firwin(41, 1 / 12), abs=1e-12)
    rng = np.random.default_rng(0)
    hiss, slow = rng.standard_normal(4000), np.sin(np.arange(4000) / 12.0)
    calm, loud = split(hiss)[1], split(hiss + 20 * slow)[1]
    assert np.median(calm, axis=1) == pytest.approx(1.15, rel=0.3)
    assert np.median(loud[0]) < 0.02 * np.median(calm[0])
    assert np.median(loud[3]) == pytest.approx(np.median(calm[3]), rel=0.1)


def test_the_level_around_is_a_quantile_of_what_counts_there():
    rng = np.random.default_rng(5)
    score = np.abs(rng.standard_normal((700, 9))) + np.linspace(0.5, 4.0, 700)[:, None]
    score[-150:] = 0.0
    some, level = score[::10, ::3], local_level(score)
    for t in (0, 75, 300, 675):
        before = some[max(t - 250, 0) // 10 : max(t - 60, 0) // 10]
        after = some[(t + 60) // 10 : (t + 250) // 10]
        counts = np.sort(np.concatenate([before, after]).ravel())
        counts = counts[counts > 0]
        assert level[t] == pytest.approx(max(counts[int(0.8 * len(counts))] / 1.28, 0.7))
    assert (local_level(np.zeros((400, 3))) == 1.0).all()


def test_scores_are_those_of_the_exact_filters():
    frames, shapes = 1200, bank()[0]
    rng = np.random.default_rng(3)
    error = rng.standard_normal(frames) * np.linspace(0.5, 2.0, frames)
    habit = np.tile([1.0, -1.4, 0.5, -0.05, 0, 0, 0, 0, 0], (frames, 1))
    parts, weight = split(error)
    each = (VIEWS, 3, 1, 1)
    views = Views(
        np.tile(parts, each),
        np.tile(weight, each),
        np.tile(habit, each),
        np.tile(parts, (3, 1, 1)),
        np.zeros((frames, 3)),
        np.zeros((frames, 3)),
    )
    at = np.arange(0, 1000, 7)
    for n in (5, 20, 50, 80):
        exact = see(views, BODY, np.zeros(len(at), int), at, np.tile(shapes[:, n], (len(at), 1)))
        assert scores(parts, weight, habit)[at, n] == pytest.approx(exact.score, rel=0.15, abs=0.2)


def test_shapes_have_height_one_and_end_at_nothing():
    for kind in KINDS:
        for length in (22, 51, 100):
            shape = shape_of(kind, length)
            assert len(shape) == length
            assert shape.max() == pytest.approx(1.0, rel=0.01)
            assert (shape >= 0).all()
            assert max(shape[0], shape[-1]) < 0.15
