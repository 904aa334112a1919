"""Predictors compared: known distributions are recognised, drifts stay where they should."""

from __future__ import annotations

import csv
import io
from xml.etree import ElementTree

import numpy as np
import pytest

from markermend.bench.predictors import PREDICTORS, study_predictors
from markermend.bench.predictors_svg import predictor_figures
from markermend.bench.predictors_text import predictors_csv, predictors_table
from markermend.bench.residuals import (
    EDGES,
    correlation_matrix,
    correlations,
    densities,
    shape_of,
)
from markermend.cli import main
from markermend.errors import MethodError
from markermend.files import write
from markermend.mesh import infer_mesh
from markermend.simulation import simulate_clean

LABELS = ("LFHD", "RFHD", "LBHD", "RBHD", "C7", "T10", "CLAV", "STRN")
QUICK = ("polynomial", "polynomial with own past", "network, 45 steps", "local regression")


@pytest.fixture(scope="module")
def performer():
    return simulate_clean(duration_s=10.0, seed=3, labels=LABELS)


@pytest.fixture(scope="module")
def study(performer):
    return study_predictors(
        {"head": performer}, names=QUICK, orders=(1, 4), lags=(0, 3), markers=3, n_jobs=1
    )


def test_laplace_and_normal_residuals_are_told_apart():
    rng = np.random.default_rng(0)
    laplace = shape_of(rng.laplace(0.0, 2.0, (20_000, 3)))
    normal = shape_of(rng.normal(0.0, 2.0, (20_000, 3)))
    assert laplace.laplace_share == 1.0
    assert normal.laplace_share == 0.0
    assert laplace.b_mm == pytest.approx(2.0, rel=0.03)
    assert laplace.b_likely_mm == pytest.approx(2.0, rel=0.03)
    assert normal.sigma_mm == pytest.approx(2.0, rel=0.03)
    # Minus the entropies of the two distributions.
    assert laplace.laplace == pytest.approx(-np.log(2 * 2.0 * np.e), abs=0.02)
    assert normal.normal == pytest.approx(-0.5 * np.log(2 * np.pi * np.e * 4.0), abs=0.02)
    assert laplace.laplace_likely >= laplace.laplace
    for shape, expected in ((normal, densities()[0]), (laplace, densities()[1])):
        share = shape.counts / shape.counts.sum()
        assert len(share) == len(EDGES) - 1
        assert np.abs(share - expected).max() < 0.01


def test_missing_and_constant_residuals_are_passed_over():
    residual = np.full((50, 3), np.nan)
    residual[:, 1] = 0.0
    residual[10:20, 2] = 1.0
    shape = shape_of(residual)
    assert shape.coordinates == 1
    assert shape.counts.sum() == 10
    assert np.isnan(shape_of(residual[:, :2]).sigma_mm)


def test_correlation_is_numpys_and_bridges_gaps():
    rng = np.random.default_rng(1)
    signals = rng.standard_normal((400, 3)) @ rng.standard_normal((3, 5)) + 900.0
    assert correlation_matrix(signals) == pytest.approx(np.corrcoef(signals.T))
    signals[50:120, 1] = np.nan
    signals[:, 4] = 7.0
    seen = ~np.isnan(signals[:, 1])
    expected = np.corrcoef(signals[seen, 1], signals[seen, 2])[0, 1]
    matrix = correlation_matrix(signals)
    assert matrix[1, 2] == pytest.approx(expected)
    assert np.isnan(matrix[4]).all()


def test_markers_of_a_group_move_together_most():
    take = simulate_clean(duration_s=12.0, seed=1)
    rows = {(r.quantity, r.relation): r for r in correlations("t", take, infer_mesh(take))}
    for axis in "xyz":
        within, between = (
            rows[f"velocity {axis}", relation] for relation in ("same group", "other groups")
        )
        assert within.mean > between.mean
        assert within.strong > between.strong


def test_order_and_lags_fit_better_the_more_there_are(study):
    sigma = {(row.order, row.lags): row.sigma_mm for row in study.sweep}
    assert sigma[4, 0] < sigma[1, 0]
    assert sigma[1, 3] < sigma[1, 0]
    assert all(row.held_out_mm > row.sigma_mm for row in study.sweep if row.order == 4)


def test_own_past_is_precise_and_follows_the_drift(study):
    rows = {row.predictor: row for row in study.predictors}
    own, loose = rows["polynomial with own past"], rows["polynomial"]
    assert own.shape.sigma_mm < loose.shape.sigma_mm
    assert own.kept < 0.03
    assert loose.kept > 0.1
    # The fit with least freedom lets most of the drift stand.
    assert loose.kept < rows["local regression"].kept <= 1.05
    assert all(row.held_out_mm > row.shape.sigma_mm for row in study.predictors)


def test_the_same_on_any_number_of_processes(performer):
    one, two = (
        study_predictors({"t": performer}, names=QUICK[2:], orders=(2,), lags=(1,), markers=2,
                         n_jobs=n)
        for n in (1, 2)
    )  # fmt: skip
    assert one.sweep == two.sweep
    for a, b in zip(one.predictors, two.predictors, strict=True):
        assert (a.shape.sigma_mm, a.held_out_mm, a.kept) == (
            b.shape.sigma_mm,
            b.held_out_mm,
            b.kept,
        )


def test_tables_and_figures_hold_what_was_measured(study):
    lines = list(csv.DictReader(io.StringIO(predictors_csv(study))))
    kept = {line["series"]: float(line["value"]) for line in lines if line["position"] == "kept"}
    assert kept == {r.predictor: pytest.approx(r.kept, rel=1e-4) for r in study.predictors}
    for name in (*QUICK, "normal", "laplace"):
        shares = [
            float(line["value"])
            for line in lines
            if line["table"] == "histogram" and line["series"] == name
        ]
        assert sum(shares) == pytest.approx(1.0, abs=1e-3)
    text = "\n".join(predictors_table(study))
    assert all(name in text for name in QUICK)
    figures = predictor_figures(study)
    assert set(figures) == {
        "head-order-lags.svg",
        "head-histogram.svg",
        "head-correlation.svg",
    }
    assert sum(line["table"] == "matrix" for line in lines) == len(LABELS) ** 2
    assert all(
        float(line["value"]) == pytest.approx(1.0)
        for line in lines
        if line["table"] == "matrix" and line["series"] == line["position"]
    )
    for drawing in figures.values():
        assert ElementTree.fromstring(drawing).tag.endswith("svg")
        assert "nan" not in drawing


def test_wrong_settings_are_named(performer):
    for wrong in ({"names": ["x"]}, {"orders": [0]}, {"lags": [-1]}):
        with pytest.raises(MethodError, match="local regression"):
            study_predictors({"t": performer}, **wrong)
    assert set(QUICK) < set(PREDICTORS)


def test_bench_predictors_from_the_command_line(tmp_path, capsys, performer):
    path, table = tmp_path / "take.c3d", tmp_path / "out.csv"
    write(performer, path)
    words = ["bench", "predictors", str(path), "--order", "1", "--lags", "0", "--markers", "1"]
    words += ["--jobs", "1", "--csv", str(table), "--figures"]
    figures = tmp_path / "figures" / "new"
    assert main([*words, str(path / "no")]) == 1
    assert "“" + str(path) + "” is a file" in capsys.readouterr().err
    assert not table.exists()
    words.append(str(figures))
    assert main(words) == 0
    assert "take, predictors on 1 markers" in capsys.readouterr().out
    assert (figures / "take-histogram.svg").exists()
    assert table.read_text().startswith("table,take,series,position,value")
    assert main(words) == 1
