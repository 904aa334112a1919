"""The measures of single gaps, against numbers worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.bench.gap_measures import figures, half_sample_mode, measure, measures_table
from markermend.bench.gaps import GapCase, GapResult


def result(
    length: int,
    errors: tuple[float, ...],
    method: str = "linear",
    *,
    weights: int = 0,
    take: str = "take",
) -> GapResult:
    case = GapCase(take, "p", length, (), {})
    samples = (3 * length,) * len(errors)
    learnt = (weights,) * len(errors)
    return GapResult(case, method, 1.0, 1.0, 1.0, 1.0, 0.0, errors, samples, learnt)


def test_measures_are_those_of_the_single_gaps() -> None:
    (m,) = measure([result(10, (1.0, 2.0)), result(10, (3.0, 6.0))])
    assert (m.gaps, m.mean_mm, m.median_mm) == (4, 3.0, 2.5)
    assert m.rmse_mm == pytest.approx(np.sqrt(50 / 4))
    assert m.std_mm == pytest.approx(np.std([1, 2, 3, 6], ddof=1))
    assert m.iqr_mm == pytest.approx(2.0)
    # A straight line has nothing to tune, so that both criteria are n log MSE.
    assert m.aic == m.bic == pytest.approx(120 * np.log(12.5))


def test_criteria_punish_parameters_and_are_empty_where_their_number_is_unknown() -> None:
    (m,) = measure([result(10, (1.0, 2.0), "net", weights=7)])
    fit = 60 * np.log(2.5)
    assert m.aic == pytest.approx(fit + 14)
    assert m.bic == pytest.approx(fit + 7 * np.log(60))
    (unknown,) = measure([result(10, (1.0,), "auto")])
    assert np.isnan(unknown.aic)
    assert "–" in measures_table([unknown])[1]


def test_takes_can_be_measured_one_by_one() -> None:
    some = [result(10, (1.0, 2.0), take="a"), result(10, (5.0,), take="b")]
    assert [(m.take, m.gaps, m.mean_mm) for m in measure(some, by_take=True)] == [
        ("a", 2, 1.5),
        ("b", 1, 5.0),
    ]
    (together,) = measure(some)
    assert (together.take, together.gaps) == ("", 3)
    assert measures_table(measure(some, by_take=True))[1].startswith("a ")


def test_mode_lies_where_values_are_densest() -> None:
    assert half_sample_mode(np.array([0.0, 5.0, 5.1, 5.2, 20.0, 40.0])) == pytest.approx(
        5.1, abs=0.1
    )
    assert half_sample_mode(np.array([7.0])) == 7.0


def test_gaps_that_nothing_filled_have_no_measures() -> None:
    assert measure([result(10, ())]) == ()


def test_a_figure_has_a_curve_for_each_method() -> None:
    some = [result(n, (float(n),), m) for n in (10, 20) for m in ("linear", "auto")]
    drawn = figures(measure(some))
    assert list(drawn) == ["gaps-p.svg"]
    assert all(f">{m}</text>" in drawn["gaps-p.svg"] for m in ("linear", "auto"))
    assert figures(measure([result(10, (1.0,))])) == {}
