"""Model averaging with and without its constraints."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.bench.constraints import _row, compare_constraints, constraints_table
from markermend.bench.gaps import GapCase, GapResult
from markermend.errors import DataError, MethodError
from markermend.simulation import simulate_clean
from markermend.simulation.markers import MARKER_SET


def result(error_mm: float) -> GapResult:
    case = GapCase("walk", "3 at once", 100, (), {}, None)
    return GapResult(case, "pma", error_mm, error_mm, 1.0, 0.0, 0.0)


def test_the_difference_is_judged_pair_by_pair_where_both_filled() -> None:
    on = tuple(result(e) for e in (1.0, 2.0, 3.0, np.nan))
    off = tuple(result(e) for e in (2.0, 3.5, 4.0, 9.0))
    row = _row(3, 1.0, on, off)
    assert (row.cases, row.on_mm) == (3, 2.0)
    assert row.off_mm == pytest.approx(9.5 / 3)
    assert row.t == pytest.approx(-7.0)
    assert row.p == pytest.approx(0.0198, abs=1e-3)
    assert "3 at once, 1 s" in constraints_table((row,))[1]


def test_both_ways_fill_the_same_gaps() -> None:
    take = simulate_clean(duration_s=25, rate=50, seed=1, labels=list(MARKER_SET)[::2])
    three, ten = compare_constraints({"walk": take}, simulations=2, seed=0)
    assert (three.cases, ten.cases) == (2, 2)
    assert three.on_mm != three.off_mm
    assert 0.0 <= three.p <= 1.0


def test_a_take_too_short_for_a_setting_is_told_before_any_work() -> None:
    take = simulate_clean(duration_s=3, rate=50, seed=1)
    with pytest.raises(DataError):
        compare_constraints({"walk": take}, simulations=1, seed=0)


def test_no_simulation_is_refused() -> None:
    with pytest.raises(MethodError, match="At least one"):
        compare_constraints({}, simulations=0, seed=0)
