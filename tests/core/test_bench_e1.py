"""E1: what is counted, and that it is the same on any number of processes."""

from __future__ import annotations

import csv
import io
import json
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind
from markermend.artifact_json import document
from markermend.bench.confusion import CLASSES, Confusion, class_map, confuse
from markermend.bench.e1 import COMPANIONS, Clean, e1
from markermend.bench.e1_svg import e1_figures, figure_names
from markermend.bench.e1_text import e1_csv, e1_table
from markermend.bench.events import count_events
from markermend.cli import main
from markermend.detectors import PaperParams
from markermend.detectors.baselines import hampel, moving_three_sigma
from markermend.errors import MethodError
from markermend.files import write
from markermend.simulation import simulate_clean
from markermend.take import Take


def take_of(positions):
    return Take(positions, tuple(f"M{i}" for i in range(positions.shape[1])), 100.0)


@pytest.fixture(scope="module")
def performer():
    return simulate_clean(duration_s=8.0, seed=3, labels=("LFHD", "RFHD", "LBHD", "RBHD", "C7"))


def test_measures_follow_their_equations():
    counts = np.zeros((5, 6), dtype=np.int64)
    counts[0, 0], counts[0, 1], counts[1, 1], counts[1, 0], counts[3, 1] = 900, 10, 60, 20, 30
    c = Confusion(counts)
    assert c.tpr("peak") == pytest.approx(60 / 80)
    assert c.fnr("peak") == pytest.approx(20 / 80)
    assert c.ppv("peak") == pytest.approx(60 / 100)
    assert c.fdr("peak") == pytest.approx(40 / 100)
    assert c.f("peak") == pytest.approx(60 / (60 + 0.5 * 60))
    tp, fp, fn, tn = 60, 40, 20, 900
    expected = (tp * tn - fp * fn) / np.sqrt(float((tp + fp) * (tp + fn) * (tn + fp) * (tn + fn)))
    assert c.mcc("peak") == pytest.approx(expected)
    assert c.flagged("step") == 1.0
    assert np.isnan(c.tpr("slow"))


def test_multiclass_measures_agree_with_scikit_learn():
    from sklearn.metrics import matthews_corrcoef

    rng = np.random.default_rng(0)
    true = rng.integers(0, 5, 500).astype(np.uint8)
    found = np.where(rng.random(500) < 0.7, true, rng.integers(0, 5, 500)).astype(np.uint8)
    c = confuse(true, found, np.ones(500, dtype=bool))
    assert c.mcc() == pytest.approx(matthews_corrcoef(true, found))
    assert c.f() == pytest.approx((true == found).mean())


def test_samples_left_out_are_not_counted():
    true = np.array([0, 1, 1, 0], dtype=np.uint8)
    found = np.array([0, 1, 0, 1], dtype=np.uint8)
    c = confuse(true, found, np.array([True, True, True, False]))
    assert c.counts.sum() == 3
    assert c.ppv("peak") == 1.0


def test_the_more_confident_flag_names_the_sample():
    take = take_of(np.zeros((50, 2, 3)))
    sure = Artifact("M1", "y", 10, 20, Kind.STEP, confidence=0.9)
    unsure = Artifact("M1", "xy", 15, 30, Kind.NOISE, confidence=0.3)
    gap = Artifact("M1", "xyz", 0, 50, Kind.GAP)
    codes = class_map(take, [sure, unsure, gap])
    assert (codes[10:20, 1, 1] == CLASSES.index("step")).all()
    assert (codes[20:30, 1, 1] == CLASSES.index("noise")).all()
    assert (codes[15:30, 1, 0] == CLASSES.index("noise")).all()
    assert not codes[:, 0].any()
    assert not codes[:, 1, 2].any()


def test_events_are_found_by_half_and_alarms_touch_nothing():
    take = take_of(np.zeros((600, 1, 3)))
    truth = [
        Artifact("M0", "x", 100, 120, Kind.STEP),
        Artifact("M0", "x", 300, 320, Kind.NOISE),
    ]
    found = [
        Artifact("M0", "x", 108, 121, Kind.STEP, confidence=0.95),
        Artifact("M0", "x", 300, 305, Kind.NOISE, confidence=0.55),
        Artifact("M0", "y", 100, 120, Kind.PEAK, confidence=0.15),
    ]
    damaged = class_map(take, truth) > 0
    nowhere = np.zeros_like(damaged)
    e = count_events(take, truth, found, class_map(take, found), damaged, nowhere)
    assert e.recall("step") == 1.0
    assert e.recall("noise") == 0.0
    assert e.alarms.tolist() == [0, 1, 0, 0, 0]
    assert e.alarms_per_minute == pytest.approx(10.0)
    assert e.real.tolist() == [0, 0, 0, 0, 0, 1, 0, 0, 0, 1]
    assert e.calibration_error == pytest.approx((0.15 + 0.45 + 0.05) / 3)


def test_the_same_on_any_number_of_processes(performer):
    def run(n_jobs):
        rows = e1(
            [Clean("performer", performer)],
            methods=["paper", "hampel 15"],
            params={"paper": PaperParams(slow=False)},
            shares=[0.05],
            amplitudes_mm=[10.0],
            simulations=2,
            n_jobs=n_jobs,
        )
        return [
            (r.take, r.method, r.confusion.counts.tolist(), r.events.real.tolist()) for r in rows
        ]

    assert run(1) == run(2)


def test_what_is_damaged_already_is_left_out(performer):
    flaw = Artifact("C7", "xyz", 0, performer.frames, Kind.SLOW)
    rows = e1(
        [Clean("performer", performer, (flaw,))],
        methods=["three-sigma 15"],
        shares=[0.05],
        amplitudes_mm=[10.0],
        simulations=1,
        n_jobs=1,
    )
    samples = performer.frames * 4 * 3
    for row in rows:
        assert row.confusion.counts.sum() + row.small.counts.sum() == samples


def test_table_and_csv_hold_every_setting(performer):
    rows = e1(
        [Clean("performer", performer)],
        methods=["paper"],
        params={"paper": PaperParams(slow=False)},
        shares=[0.05, 0.1],
        amplitudes_mm=[5.0],
        simulations=1,
        n_jobs=1,
    )
    assert [(r.share, r.amplitude_mm) for r in rows] == [(0, 0), (0.05, 5.0), (0.1, 5.0)]
    lines = list(csv.DictReader(io.StringIO(e1_csv(rows))))
    assert len(lines) == len(rows) * len(CLASSES)
    text = "\n".join(e1_table(rows))
    assert "performer, paper, 10%, 5 mm, simulations: 1" in text
    assert "untouched" in text


def test_figures_hold_every_matrix_and_calibration(performer):
    shares, amplitudes = [0.05, 0.1], [5.0]
    rows = e1(
        [Clean("a take", performer)],
        methods=["paper", "hampel 15"],
        params={"paper": PaperParams(slow=False)},
        shares=shares,
        amplitudes_mm=amplitudes,
        simulations=1,
        n_jobs=1,
    )
    figures = e1_figures(rows)
    assert set(figures) == set(figure_names(["a take"], shares, amplitudes))
    shown = list(ET.fromstring(figures["a_take-10-5mm.svg"]).itertext())
    assert {"paper", "hampel 15", "outlier"} <= set(shown)
    cells = [float(text) for text in shown if re.fullmatch(r"[0-9.]+", text)]
    assert len(cells) == 2 * 5 * 6
    assert sum(cells) == pytest.approx(2 * 5 * 100.0, abs=3.0)
    assert "perfect" in "".join(ET.fromstring(figures["calibration.svg"]).itertext())


def test_unknown_methods_are_named():
    with pytest.raises(MethodError, match="nonsense"):
        e1([], methods=["nonsense"])


def test_companions_flag_a_spike_and_nothing_missing():
    rng = np.random.default_rng(1)
    positions = np.cumsum(rng.standard_normal((300, 2, 3)), axis=0) * 0.1
    positions[150, 0, 1] += 40.0
    positions[200:210, 1] = np.nan
    for flag in (moving_three_sigma, hampel):
        flags = flag(positions, 31)
        assert flags[150, 0, 1]
        assert not flags[200:210, 1].any()
        with pytest.raises(MethodError, match="odd"):
            flag(positions, 30)
    assert len(COMPANIONS) == 8


def test_bench_e1_from_the_command_line(tmp_path, capsys, performer):
    path, table = tmp_path / "take.c3d", tmp_path / "out.csv"
    write(performer, path)
    flaw = Artifact("C7", "x", 10, 20, Kind.STEP)
    values = document(performer, [flaw], "review", "1")
    (tmp_path / "take.json").write_text(json.dumps(values))
    words = ["bench", "e1", str(path), "--flaws", str(tmp_path), "--no-slow", "--share", "0.05"]
    words += ["--amplitude", "10", "--simulations", "1", "--jobs", "1", "--csv", str(table)]
    assert main(words) == 0
    shown = capsys.readouterr().out
    assert "take, paper, 5%, 10 mm" in shown
    assert "take, joint, 5%, 10 mm" in shown
    rows = list(csv.DictReader(table.open()))
    untouched = sum(float(r["samples"]) for r in rows if float(r["share"]) == 0)
    assert untouched == 2 * (performer.frames * 15 - 10)
