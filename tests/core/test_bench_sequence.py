"""What takes are like: measures of skurowski2021 against movements whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import pearsonr

from markermend.bench.gap_measures import measure
from markermend.bench.gaps import GapCase, GapResult
from markermend.bench.sequence import (
    MEASURES,
    correlate,
    correlate_measures,
    describe,
    entropy,
)
from markermend.bench.sequence_text import correlation_tables, sequence_table
from markermend.errors import DataError
from markermend.take import Take


def moving(*along: np.ndarray) -> Take:
    """Markers that move along x only."""
    positions = np.zeros((len(along[0]), len(along), 3))
    for m, x in enumerate(along):
        positions[:, m, 0] = x
    return Take(positions, tuple("ABCDEFGH"[: len(along)]), 100.0)


def test_derivatives_and_monotonicity_of_known_movements() -> None:
    t = np.arange(200) / 100.0
    # One marker at 2 m/s, falling coordinates counting as much as rising ones; one accelerating.
    found = describe(moving(-2000.0 * t, 500.0 * 3.0 * t**2))
    assert found.velocity == pytest.approx((2.0 + 3.0 * 1.99 / 2) / 2, rel=1e-2)
    assert found.acceleration == pytest.approx(1.5, rel=1e-6)
    assert found.jerk == pytest.approx(0.0, abs=1e-3)
    assert found.monotonicity == pytest.approx(2 / 6)
    assert found.stddev == pytest.approx(
        np.mean([x.std(ddof=1) for x in (2000 * t, 1500 * t**2)]) / 3
    )


def test_entropy_counts_the_bins_that_are_visited() -> None:
    assert entropy(np.full(50, 7.0)) == 0.0
    assert entropy(20.0 * np.arange(8.0) + 1.0) == pytest.approx(3.0)


def test_complexity_is_what_five_poses_leave() -> None:
    rng = np.random.default_rng(0)
    one_way = rng.normal(size=(400, 1, 1)) * np.ones((1, 4, 3))
    plain = describe(Take(one_way, tuple("ABCD"), 100.0))
    assert plain.complexity == pytest.approx(0.0, abs=1e-9)
    loose = describe(Take(rng.normal(size=(4000, 5, 3)), tuple("ABCDE"), 100.0))
    # Fifteen directions of equal variance: ten are left.
    assert loose.complexity == pytest.approx(10 / 15, abs=0.05)


def test_missing_samples_are_left_out() -> None:
    take = moving(np.arange(100.0), np.zeros(100))
    holed = take.positions.copy()
    holed[40:50, 1] = np.nan
    found = describe(Take(holed, take.labels, take.rate))
    assert found.velocity == pytest.approx(describe(take).velocity)
    with pytest.raises(DataError, match="all markers"):
        describe(Take(np.full((10, 1, 3), np.nan), ("A",), 100.0))


def results(take: str, error: float) -> GapResult:
    case = GapCase(take, "p", 10, (), {})
    return GapResult(case, "linear", error, error, 1.0, 1.0, 0.0, (error,), (30,), (0,))


def test_correlations_are_pearsons_over_takes() -> None:
    rng = np.random.default_rng(1)
    takes = {
        n: Take(s * rng.normal(size=(60, 3, 3)), tuple("ABC"), 100.0)
        for n, s in zip("uvwx", (1, 2, 4, 9), strict=True)
    }
    known = {name: describe(take) for name, take in takes.items()}
    errors = [1.0, 2.0, 2.5, 7.0]
    some = [results(*p) for p in zip(takes, errors, strict=True)]
    found = correlate(measure(some, by_take=True), known)
    assert [c.second for c in found] == list(MEASURES)
    velocity = next(c for c in found if c.second == "velocity")
    wanted = pearsonr(errors, [k.velocity for k in known.values()])
    assert (velocity.r, velocity.p) == pytest.approx((wanted.statistic, wanted.pvalue))
    pairs = correlate_measures(known)
    assert len(pairs) == len(MEASURES) * (len(MEASURES) - 1) // 2
    text = "\n".join([*sequence_table(known), *correlation_tables(found, pairs)])
    assert f"{velocity.r:.3f} ({velocity.p:.3f})" in text


def test_two_takes_cannot_be_correlated() -> None:
    known = {n: describe(moving(np.arange(50.0) ** 1.5, np.zeros(50))) for n in "ab"}
    with pytest.raises(DataError, match="three takes"):
        correlate_measures(known)
