"""E2: flags held against reviewed lists, and what a repair added."""

from __future__ import annotations

import csv
import json
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.artifact_json import artifacts_of, document
from markermend.bench.e2 import Reviewed, Verdict, e2, judge
from markermend.cli import main
from markermend.detectors.joint import JointParams
from markermend.files import write
from markermend.simulation import simulate_clean
from markermend.take import Take

REVIEWED = Path(__file__).with_name("reviewed")
SUDDEN = {"joint": JointParams(slow=False)}


@pytest.fixture(scope="module")
def hurt():
    """A performer with a peak and a step."""
    clean = simulate_clean(duration_s=8.0, rate=120.0, seed=5)
    positions = clean.positions.copy()
    positions[300:302, 0, 1] += 20.0
    positions[500:540, 4, 2] -= 15.0
    return Take(positions, clean.labels, clean.rate)


def entry(take, marker, axes, start, stop, kind, **more):
    return Artifact(take.labels[marker], axes, start, stop, kind, **more)


def test_a_flag_is_judged_by_where_most_of_it_lies(hurt):
    sure = entry(hurt, 0, "yz", 300, 302, Kind.PEAK)
    doubtful = entry(hurt, 0, "x", 400, 420, Kind.STEP, confidence=0.5)

    def verdict(axes, start, stop, size=9.0, marker=0):
        flag = entry(hurt, marker, axes, start, stop, Kind.PEAK, amplitude_mm=size)
        return judge(flag, [sure, doubtful], 3.0, 1)

    assert verdict("xy", 300, 303) == (Verdict.APPROVED, [sure])
    assert verdict("x", 300, 303) == (Verdict.REJECTED, [])
    assert verdict("y", 300, 380) == (Verdict.REJECTED, [])
    assert verdict("y", 300, 303, marker=1) == (Verdict.REJECTED, [])
    assert verdict("x", 402, 410) == (Verdict.DOUBTFUL, [])
    assert verdict("y", 100, 103, size=1.0) == (Verdict.DOUBTFUL, [])


def test_either_marker_of_a_swap_is_on_the_list(hurt):
    a, b = hurt.labels[:2]
    listed = Artifact(a, "xyz", 100, 140, Kind.STEP, counterpart=b)
    found = Artifact(b, "xyz", 100, 140, Kind.STEP, amplitude_mm=90.0)
    assert judge(found, [listed], 0.0, 1)[0] is Verdict.APPROVED


def test_flags_and_misses_are_counted(hurt):
    listed = (
        entry(hurt, 0, "y", 300, 302, Kind.PEAK),
        entry(hurt, 7, "y", 600, 640, Kind.STEP),
    )
    (row,) = e2([Reviewed("hurt", hurt, listed)], methods=["joint"], params=SUDDEN)
    assert (row.listed, row.flags, row.approved, row.named) == (2, 2, 1, 1)
    assert (row.rejected, row.doubtful, row.missed, row.added) == (1, 0, 1, 0)


def test_what_a_repair_adds_is_counted(hurt):
    listed = (
        entry(hurt, 0, "y", 300, 302, Kind.PEAK),
        entry(hurt, 4, "z", 500, 540, Kind.STEP),
    )
    worse = hurt.positions.copy()
    worse[300:302, 0, 1] -= 20.0
    worse[700:703, 9, 0] += 30.0
    versions = {"hurt": [("by hand", Take(worse, hurt.labels, hurt.rate))]}
    raw, good, bad = e2(
        [Reviewed("hurt", hurt, listed)],
        methods=["joint"],
        params=SUDDEN,
        repairs=["pma"],
        repaired=versions,
    )
    assert (raw.approved, raw.missed) == (2, 0)
    assert (good.repair, good.flags, good.added) == ("pma", 0, 0)
    assert (bad.repair, bad.approved, bad.added) == ("by hand", 1, 1)


def test_the_command_writes_table_csv_and_figure(hurt, tmp_path, capsys):
    take = tmp_path / "hurt.c3d"
    write(hurt, take)
    listed = [entry(hurt, 0, "y", 300, 302, Kind.PEAK)]
    (tmp_path / "hurt.json").write_text(json.dumps(document(hurt, listed, "review", "0")))
    table, figure = tmp_path / "e2.csv", tmp_path / "e2.svg"
    words = ["bench", "e2", str(take), "--lists", str(tmp_path), "--no-slow", "--method", "joint"]
    outputs = ["--csv", str(table), "--figure", str(figure)]
    assert main([*words, "--repair", "linear", "--repaired", str(take), *outputs]) == 0
    rows = list(csv.DictReader(table.open()))
    assert [(r["repair"], r["approved"]) for r in rows] == [
        ("", "1"),
        ("linear", "0"),
        ("hurt", "1"),
    ]
    assert "missed" in capsys.readouterr().out
    assert "hurt, raw, joint" in "".join(ET.parse(figure).getroot().itertext())


def test_a_take_without_a_list_is_refused(hurt, tmp_path, capsys):
    take = tmp_path / "hurt.c3d"
    write(hurt, take)
    assert main(["bench", "e2", str(take), "--lists", str(tmp_path)]) == 1
    assert "hurt.json" in capsys.readouterr().err


@pytest.mark.parametrize(
    "name", ["bodies/03_rolling", "gait/test_walking", "props/walkingOptiTrack"]
)
def test_reviewed_lists_fit_their_takes(shared_data, name):
    take = mm.read(shared_data / f"{name}.c3d")
    values = json.loads((REVIEWED / f"{Path(name).name}.json").read_text("utf-8"))
    listed = artifacts_of(values)
    assert values["frames"] == take.frames
    assert len({a.id for a in listed}) == len(listed) > 30
    assert all(a.why for a in listed)
    assert all(np.isfinite(a.amplitude_mm) or "repeats" in a.why for a in listed)
    for a in listed:
        assert take.present[a.start : a.stop, take.index(a.marker)].any()
