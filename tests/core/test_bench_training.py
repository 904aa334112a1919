"""Learning from less and from more: the same gaps, criteria as published, table, CSV, figures."""

from __future__ import annotations

import csv
import io
import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from markermend.bench.criteria import aic, bic
from markermend.bench.training import study_training
from markermend.bench.training_text import (
    figure_names,
    training_csv,
    training_figures,
    training_table,
)
from markermend.cli import main
from markermend.errors import DataError
from markermend.repairs.skurowski2021.recurrent import count_weights
from markermend.simulation import simulate_clean
from markermend.take import Take


@pytest.fixture(scope="module")
def person() -> Take:
    return simulate_clean(duration_s=20.0, rate=50.0, seed=3)


@pytest.fixture(scope="module")
def rows(person: Take):
    return study_training(
        {"person": person},
        methods=["linear", "ffnn_lin"],
        lengths=[20, 50],
        train_s=[3.0, 15.0, 40.0],
        simulations=4,
    )


def test_criteria_are_those_of_the_paper():
    assert aic(100, math.e, 7) == pytest.approx(100.0 + 14.0)
    assert bic(100, math.e, 7) == pytest.approx(100.0 + 7 * math.log(100))
    assert aic(100, 0.0, 7) == -math.inf
    assert math.isnan(bic(0, float("nan"), 7))


@pytest.mark.parametrize(
    ("kind", "plain", "dense"),
    # Table 4 of skurowski2021 for 30 inputs; for BiLSTM what its formula gives.
    [("lstm", 22_023, 22_355), ("gru", 16_563, 16_895), ("bilstm", 44_043, 44_675)],
)
def test_weights_are_counted_as_the_paper_does(kind, plain, dense):
    assert count_weights(kind, 30) == plain
    assert count_weights(kind, 30, dense=True) == dense


def test_the_same_gaps_are_filled_from_every_window_that_fits(rows):
    assert {r.train_s for r in rows} == {3.0, 15.0}
    assert len(rows) == 2 * 2 * 2
    for length in (20, 50):
        tested = {r.samples for r in rows if r.length == length}
        assert len(tested) == 1
        # A line needs nothing but its ends: the window does not matter to it.
        line = [r.mse for r in rows if r.length == length and r.method == "linear"]
        assert line[0] == line[1]
    for r in rows:
        assert r.gaps == 4
        assert r.aic == pytest.approx(r.samples * math.log(r.mse) + 2 * r.weights)


def test_a_network_keeps_its_weights_and_learns_from_its_window(rows):
    network = [r for r in rows if r.method == "ffnn_lin" and r.length == 50]
    assert network[0].weights == network[1].weights > 100
    assert network[1].mse != network[0].mse
    assert all(r.weights == 0 for r in rows if r.method == "linear")


def test_table_csv_and_figures_hold_what_was_measured(rows):
    assert len(training_table(rows)) == len(rows) + 1
    read = list(csv.DictReader(io.StringIO(training_csv(rows))))
    assert [float(r["mse"]) for r in read] == pytest.approx([r.mse for r in rows], rel=1e-5)
    figures = training_figures(rows)
    assert tuple(figures) == figure_names("person", [20, 50])
    for text in figures.values():
        words = "".join(ET.fromstring(text).itertext())
        assert "ffnn_lin" in words


def test_a_take_too_short_for_any_window_is_refused(person):
    with pytest.raises(DataError, match="40 s"):
        study_training(
            {"person": person}, methods=["linear"], lengths=[20], train_s=[40.0], simulations=1
        )


def test_the_command_writes_table_csv_and_figures(person, tmp_path, capsys):
    import markermend as mm

    mm.write(person, tmp_path / "person.c3d")
    options = ["--method", "linear", "--length", "20", "--train", "3", "--simulations", "1"]
    files = ["--csv", str(tmp_path / "out.csv"), "--figures", str(tmp_path)]
    assert main(["bench", "training", str(tmp_path / "person.c3d"), *options, *files]) == 0
    assert "linear" in capsys.readouterr().out
    assert len((tmp_path / "out.csv").read_text().splitlines()) == 2
    assert (tmp_path / "person-training-20-aic.svg").exists()
    assert np.isfinite(float((tmp_path / "out.csv").read_text().splitlines()[1].split(",")[6]))
