"""How the joint detector judges jumps, and which of them belong together."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.detectors.joint.jumps import Jumps
from markermend.detectors.joint.partners import find_partners
from markermend.detectors.joint.shapes import fit_of, judge
from markermend.detectors.joint.steps import pair_jumps


def test_fits_are_exact_for_a_polynomial_and_a_shape():
    frames = np.arange(40.0)
    signal = (1e4 + frames**3 / 50 - frames**2)[:, None]
    signal[20:23] += 7.0
    one = np.array([0])
    first, stop = np.array([0]), np.array([40])
    for frame in (20,):
        judged = judge(signal, one, np.array([frame]), 3, 6, first, stop)
        assert judged.size[0] == pytest.approx(7.0)
        assert judged.error[0] < 1e-5
    fit = fit_of(15, 6, 9)
    assert np.abs(fit.basis.T @ fit.basis - np.eye(7)).max() < 1e-12
    shape = np.zeros(15)
    shape[6:9] = 4.0
    assert fit.size @ (shape + np.linspace(-3, 9, 15) ** 5) == pytest.approx(4.0)
    assert fit.error == pytest.approx(np.linalg.norm(fit.size))


def test_pairs_are_opposite_and_never_overlap():
    def jump(frames, sizes):
        n = len(frames)
        return Jumps(
            np.zeros(n, dtype=np.int64),
            np.array(frames),
            np.zeros(n, dtype=np.int64),
            np.array(sizes, dtype=float),
            np.full(n, 20.0),
        )

    assert [p[:2] for p in pair_jumps(jump([10, 40], [5, -5]), 100.0)] == [(0, 1)]
    assert pair_jumps(jump([10, 40], [5, 5]), 100.0) == []
    assert pair_jumps(jump([10, 40], [5, -15]), 100.0) == []
    assert pair_jumps(jump([10, 900], [5, -5]), 100.0) == []
    assert [p[:2] for p in pair_jumps(jump([10, 900], [50, -20]), 100.0)] == [(0, 1)]
    # After a second strangers meet by chance: what comes back must be as large as what went.
    assert [p[:2] for p in pair_jumps(jump([10, 130], [5, -4.8]), 100.0)] == [(0, 1)]
    assert pair_jumps(jump([10, 130], [5, -3.6]), 100.0) == []
    assert [p[:2] for p in pair_jumps(jump([10, 60], [5, -3.6]), 100.0)] == [(0, 1)]
    both = pair_jumps(jump([10, 30, 50, 70], [5, 8, -8, -5]), 100.0)
    assert [p[:2] for p in both] == [(1, 2)]


def test_a_clear_edge_finds_its_faint_partner():
    rng = np.random.default_rng(0)
    signal = 0.05 * rng.standard_normal((600, 2))
    signal[520:565, 1] += 4.0
    signal[553:577, 1] += 0.5 * np.sin(np.arange(24) * 1.1) * np.hanning(24)
    one = Jumps(np.array([1]), np.array([520]), np.array([0]), np.array([4.0]), np.array([30.0]))
    seen = np.ones(signal.shape, dtype=bool)
    nobody = np.zeros((1, 0), dtype=np.int64)

    def partners(taken):
        return find_partners(one, [0], signal, signal, seen, nobody, 100.0, taken)

    ((i, frame, score),) = partners([])
    assert i == 0
    assert abs(frame - 565) <= 2
    assert 8.0 < score <= 30.0
    assert partners([(1, 530, 600)]) == []
    signal[565:, 1] += 4.0
    assert partners([]) == []


def test_an_edge_bent_by_a_kick_finds_its_partner_in_a_narrower_window():
    rng = np.random.default_rng(3)
    frames = np.arange(600)
    signal = 0.03 * rng.standard_normal((600, 1))
    signal[:, 0] += 60.0 * np.exp(-(((frames - 571) / 3.0) ** 2))
    signal[520:565, 0] += 4.0
    one = Jumps(np.array([0]), np.array([520]), np.array([0]), np.array([4.0]), np.array([30.0]))
    seen, nobody = np.ones(signal.shape, dtype=bool), np.zeros((1, 0), dtype=np.int64)
    ((_, frame, _),) = find_partners(one, [0], signal, signal, seen, nobody, 100.0, [])
    assert frame == 565


def test_an_edge_that_clearly_comes_back_elsewhere_is_no_partner():
    signal = 0.005 * np.random.default_rng(0).standard_normal((600, 2))
    signal[520:565, 1] += 4.0
    signal[565:, 1] += 1.15
    one = Jumps(np.array([1]), np.array([520]), np.array([0]), np.array([4.0]), np.array([8.5]))
    seen, nobody = np.ones(signal.shape, dtype=bool), np.zeros((1, 0), dtype=np.int64)
    assert find_partners(one, [0], signal, signal, seen, nobody, 100.0, []) == []


def test_an_edge_lost_in_a_kick_stands_out_beside_the_neighbours():
    rng = np.random.default_rng(1)
    frames = np.arange(600)
    kick = 60.0 * np.exp(-(((frames - 565) / 2.5) ** 2))
    motion = 100.0 * np.sin(frames[:, None] / [40.0, 55.0, 70.0])
    motion[:, 0] += kick
    rest = np.tile(motion, 5) + 0.03 * rng.standard_normal((600, 15))
    signal = rest.copy()
    signal[520:565, 0] += 4.0
    one = Jumps(np.array([0]), np.array([520]), np.array([0]), np.array([4.0]), np.array([30.0]))
    seen = np.ones(signal.shape, dtype=bool)
    neighbours = np.array([[1, 2, 3, 4]] * 5)
    alone = find_partners(one, [0], signal, rest, seen, neighbours[:, :0], 100.0, [])
    ((_, frame, score),) = find_partners(one, [0], signal, rest, seen, neighbours, 100.0, [])
    assert [f for _, f, _ in alone] != [565]
    assert frame == 565
    assert score > 8.0
