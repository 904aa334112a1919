"""Foretelling a marker by fits that never saw the moment."""

from __future__ import annotations

import numpy as np

from markermend.predictors.cross_fit import BLOCK, left_out


def test_each_block_is_foretold_by_a_fit_without_it_and_those_beside_it():
    rng = np.random.default_rng(0)
    blocks, count = 6, 5
    both = rng.normal(size=(blocks, BLOCK, count + 3))
    weight = rng.random((blocks, BLOCK))
    ridges = np.full(count, 0.01), np.linspace(0.1, 1.0, count)
    said = left_out(both, weight, ridges)
    for one, ridge in zip(said, ridges, strict=True):
        for block in range(blocks):
            rest = np.abs(np.arange(blocks) - block) > 1
            rows, w = both[rest].reshape(-1, count + 3), weight[rest].reshape(-1)
            x, y = rows[:, :count], rows[:, count:]
            gram = (x * w[:, None]).T @ x + w.sum() * np.diag(ridge)
            fit = np.linalg.solve(gram, (x * w[:, None]).T @ y)
            np.testing.assert_allclose(one[block], both[block, :, :count] @ fit, atol=1e-10)
