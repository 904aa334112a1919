"""E3: errors as published, only what is named changes, the same on any number of processes."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import replace

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind, damage_mask
from markermend.bench.e1 import Clean
from markermend.bench.e3 import e3, reconstruct, rmse
from markermend.bench.e3_paper import published
from markermend.bench.e3_text import e3_csv, e3_table
from markermend.bench.told import Told, beside_truth, mean_told
from markermend.cli import main
from markermend.detectors import find_detector
from markermend.errors import MethodError
from markermend.files import write
from markermend.patch import Patch
from markermend.repairs import Repair
from markermend.simulation import contaminate, simulate_clean
from markermend.take import Take

HEAD = ("LFHD", "RFHD", "LBHD", "RBHD", "C7", "T10")


@pytest.fixture(scope="module")
def performer():
    return simulate_clean(duration_s=12.0, seed=3, labels=HEAD)


def by_way(rows):
    return {(row.located, row.method, row.share, row.kind): row for row in rows}


def test_distorted_errors_are_the_published_ones():
    take = simulate_clean(duration_s=32.0, seed=1)
    assert take.positions.shape == (3200, 53, 3)
    rows = by_way(
        e3([Clean("person", take)], detectors=(), repairers=("spline",), kinds=["peak"],
           simulations=2, n_jobs=1)
    )  # fmt: skip
    for share, printed in ((0.05, 0.191), (0.1, 0.270), (0.2, 0.382)):
        row = rows["distorted", "", share, "peak"]
        assert row.rmse_mm == pytest.approx(printed, rel=0.1)
        assert row.rmse_mm == pytest.approx(row.published_mm, rel=0.1)
        assert rows["perfect", "spline", share, "peak"].rmse_mm < 0.1 * row.rmse_mm


def test_perfect_classification_helps_and_a_detector_no_more_than_that(performer):
    fast = {"joint": find_detector("joint").params(slow=False, jobs=1)}
    rows = by_way(
        e3([Clean("head", performer)], detectors=("joint",), params=fast, kinds=["peak", "step"],
           repairers=("linear", "spline", "ffnn", "auto"), shares=(0.05,), simulations=1, n_jobs=1)
    )  # fmt: skip
    for kind, methods in (("peak", ("linear", "spline", "auto")), ("step", ("ffnn", "auto"))):
        distorted = rows["distorted", "", 0.05, kind].rmse_mm
        for method in methods:
            perfect = rows["perfect", method, 0.05, kind].rmse_mm
            assert perfect <= distorted
            assert rows["joint", method, 0.05, kind].rmse_mm >= 0.9 * perfect
    # Of what the published methods leave of a step, ours leaves less.
    assert (
        rows["perfect", "auto", 0.05, "step"].rmse_mm
        < rows["perfect", "linear", 0.05, "step"].rmse_mm
    )


@pytest.mark.parametrize("method", ["linear", "savgol", "spline", "ffnn", "auto"])
def test_only_the_named_samples_change(performer, method):
    damaged, truth = contaminate(performer, share=0.05, kinds=["noise"], seed=5)
    gap = Artifact("C7", "xyz", 5, 9, Kind.GAP)
    result, repairs = reconstruct(damaged, (*truth, gap), method)
    assert len(repairs) == (0 if method == "ffnn" else len(truth))
    inside = damage_mask(performer, truth)
    changed = result.positions != damaged.positions
    assert not (changed & ~inside).any()
    assert changed[inside].mean() > 0.9


def test_what_repairs_tell_is_held_against_the_truth():
    truth = Take(np.zeros((20, 2, 3)), ("A", "B"), 100.0)
    counted = np.ones(truth.positions.shape, dtype=bool)
    counted[12, 1, 0] = False
    values = np.full((4, 1), 2.0)
    values[2:] = 9.0

    def repaired(axes, values, band_mm):
        return Repair("x", (Patch("B", axes, 10, 14, values),), error_mm=1.5, band_mm=band_mm)

    (one,) = beside_truth([repaired("x", values, np.full(4, 1.3))], truth, counted)
    assert one == Told((2.0 + 2.0 + 9.0) / 3, 1.5, 2 / 3)
    (three,) = beside_truth(
        [repaired("xyz", np.tile(values, 3) / np.sqrt(3), np.full(4, 1.3))], truth, counted
    )
    assert three.held == 0.0  # what holds 2 mm on one axis does not on three
    unsaid = replace(repaired("x", values, np.ones(4)), band_mm=None)
    assert beside_truth([unsaid, Repair("x")], truth, counted) == []
    assert mean_told([one, Told(1.0, 0.5, 0.0)]).expected_mm == 1.0
    assert math.isnan(mean_told([]).off_mm)


def test_usual_repairs_tell_their_error(performer):
    rows = by_way(
        e3([Clean("head", performer)], detectors=(), repairers=("auto", "linear"), kinds=["noise"],
           shares=(0.05,), simulations=2, n_jobs=1)
    )  # fmt: skip
    usual = rows["perfect", "auto", 0.05, "noise"]
    assert usual.repairs >= 2
    assert 0.3 < usual.told.off_mm / usual.told.expected_mm < 2.0
    assert usual.told.held > 0.6
    assert rows["perfect", "linear", 0.05, "noise"].repairs == 0
    text = "\n".join(e3_table(list(rows.values())))
    assert "noise, auto (perfect)" in text
    assert "linear (perfect)  " not in text.split("What repairs tell")[1]


def test_rmse_leaves_out_what_is_not_there():
    a = np.zeros((4, 1, 3))
    b = np.full((4, 1, 3), 2.0)
    b[3] = np.nan
    counted = np.ones(a.shape, dtype=bool)
    counted[0] = False
    take, other = (Take(p, ("M",), 100.0) for p in (a, b))
    assert rmse(other, take, counted) == 2.0
    assert math.isnan(rmse(other, take, np.zeros(a.shape, dtype=bool)))


def test_the_same_on_any_number_of_processes(performer):
    one, two = (
        e3([Clean("head", performer)], detectors=(), repairers=("linear", "auto"), kinds=["noise"],
           shares=(0.05,), simulations=3, seed=7, n_jobs=n)
        for n in (1, 2)
    )  # fmt: skip
    assert [(r.rmse_mm, r.spread_mm) for r in one] == [(r.rmse_mm, r.spread_mm) for r in two]


def test_only_flags_of_the_planted_class_are_reconstructed(performer, monkeypatch):
    wrong = Artifact("C7", "x", 100, 300, Kind.SLOW)
    monkeypatch.setattr("markermend.bench.e3.detect", lambda *_, **__: (wrong,))
    errors = {
        every: [
            r.rmse_mm
            for r in e3([Clean("head", performer)], detectors=("joint",), repairers=("linear",),
                        kinds=["peak"], shares=(0.05,), simulations=1, all_classes=every, n_jobs=1)
            if r.located != "perfect"
        ]
        for every in (False, True)
    }  # fmt: skip
    distorted, classified = errors[False]
    assert classified == distorted
    assert errors[True][1] != distorted


def test_published_figures_are_those_of_the_tables():
    assert published(0.05, "distorted", "", "slow") == 0.10129
    assert published(0.05, "classified", "spline", "noise") == 0.68692
    assert published(0.1, "perfect", "ffnn", "peak") == 0.02785
    assert published(0.2, "classified", "ffnn", "slow") == 0.20549
    assert math.isnan(published(0.2, "perfect", "auto", "slow"))
    assert math.isnan(published(0.3, "distorted", "", "slow"))


@pytest.mark.parametrize(
    "wrong", [{"kinds": ["gap"]}, {"detectors": ["x"]}, {"repairers": ["x"]}, {"simulations": 0}]
)
def test_wrong_settings_are_named(wrong):
    with pytest.raises(MethodError):
        e3([], **wrong)


def test_bench_e3_from_the_command_line(tmp_path, capsys, performer):
    path, table = tmp_path / "take.c3d", tmp_path / "out.csv"
    write(performer, path)
    words = ["bench", "e3", str(path), "--method", "joint", "--no-slow", "--repair", "linear"]
    words += ["--kind", "peak", "step", "--share", "0.05", "--simulations", "1", "--jobs", "1"]
    assert main([*words, "--csv", str(table)]) == 0
    shown = capsys.readouterr().out
    assert "take, 5% damaged, simulations: 1" in shown
    assert "0.19065" in shown
    assert "linear (joint)" in shown
    lines = list(csv.DictReader(table.open()))
    assert [line["located"] for line in lines] == ["distorted", "perfect", "joint"] * 2
    assert float(lines[0]["rmse_mm"]) > float(lines[1]["rmse_mm"])


def test_tables_hold_every_way(performer):
    rows = e3([Clean("head", performer)], detectors=(), repairers=("linear",), shares=(0.05,),
              simulations=1, n_jobs=1)  # fmt: skip
    assert len(list(csv.DictReader(io.StringIO(e3_csv(rows))))) == len(rows) == 8
    head, first, second = e3_table(rows)[1:4]
    assert head.split() == ["peak", "paper", "noise", "paper", "step", "paper", "slow", "paper"]
    assert first.split()[0] == "distorted"
    assert second.split()[:2] == ["linear", "(perfect)"]
