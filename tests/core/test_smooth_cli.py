"""Smoothing and its experiment from the command line."""

from __future__ import annotations

import csv
import shutil
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.bench.smooth import Truth, compare, hard_smoothed, kick
from markermend.bench.smooth_text import smooth_csv, truth_table
from markermend.cli import main
from markermend.errors import DataError
from markermend.smoothers import derivatives
from markermend.smoothers.table import derivatives_csv
from markermend.take import Take


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("smooth") / "take.c3d"
    take, _ = mm.simulate(duration_s=8.0, damaged=False)
    mm.write(take, path)
    return path


@pytest.fixture
def recording(written: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(written, tmp_path / "take.c3d"))


def test_smooth_writes_what_the_library_gives(
    recording: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = recording.with_name("out.c3d")
    assert main(["smooth", str(recording), "-o", str(out), "--list"]) == 0
    told = capsys.readouterr()
    assert "Smoothed: 53 markers" in told.out
    assert "LANK" in told.out
    expected = mm.smooth(mm.read(recording)).positions
    np.testing.assert_allclose(mm.read(out).positions, expected, atol=0.01)
    assert main(["smooth", str(recording), "-o", str(out)]) == 1


def test_derivatives_are_written_with_their_bands(
    recording: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, table = recording.with_name("out.c3d"), recording.with_name("motion.csv")
    words = ["smooth", str(recording), "-o", str(out), "--marker", "LANK", "RANK"]
    assert main([*words, "--derivatives", str(table)]) == 0
    take = mm.read(recording)
    found = derivatives(take, markers=["LANK", "RANK"])
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert len(rows) == 2 * take.frames
    row = rows[take.frames + 100]
    assert (row["marker"], int(row["frame"])) == ("RANK", take.first_frame + 100)
    assert float(row["time_s"]) == pytest.approx(100 / take.rate)
    for name, values in (
        ("position_mm", found.position),
        ("velocity_mm_s", found.velocity),
        ("acceleration_band_mm_s2", found.acceleration_band),
    ):
        told = [float(row[f"{axis}_{name}"]) for axis in "xyz"]
        assert told == pytest.approx(values[100, 1], rel=1e-5)
    capsys.readouterr()
    assert main([*words, "--method", "rts", "--derivatives", str(table), "--force"]) == 1
    assert "“auto” only" in capsys.readouterr().err


def test_a_missing_marker_has_empty_derivatives(recording: Path) -> None:
    take = mm.read(recording)
    positions = take.positions.copy()
    positions[50:80, 0] = np.nan
    holed = take.with_positions(positions, take.origin)
    text = derivatives_csv(derivatives(holed, markers=take.labels[:1]), holed)
    rows = list(csv.DictReader(text.splitlines()))
    assert [r["x_velocity_mm_s"] == "" for r in rows[48:82]] == [False] * 2 + [True] * 30 + [
        False
    ] * 2


def test_a_part_of_the_take_with_a_named_method(
    recording: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = recording.with_name("out.c3d")
    words = ["smooth", str(recording), "-o", str(out), "--method", "butterworth"]
    words += ["--set", "cutoff_hz=0.2", "order=1", "--marker", "LANK", "--frames", "101", "500"]
    assert main(words) == 0
    before, after = mm.read(recording), mm.read(out)
    changed = (before.positions != after.positions).any(axis=2)
    assert set(np.flatnonzero(changed.any(axis=0))) == {before.index("LANK")}
    assert np.flatnonzero(changed.any(axis=1)).min() >= 100
    assert np.flatnonzero(changed.any(axis=1)).max() < 500
    assert "lost more than 30 %" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--method", "nothing"], "choose one of auto, "),
        (["--method", "bspline", "--set", "degree"], "write NAME=VALUE"),
        (["--method", "bspline", "--set", "degree=x"], "it is a whole number"),
        (["--method", "bspline", "--set", "points=4"], "has no parameter “points”"),
        (["--method", "moving_average", "--set", "symmetric=perhaps"], "it is true or false"),
        (["--frames", "5000", "6000"], "Frames 5000 to 6000 are not all there; "),
    ],
)
def test_bad_usage_is_explained(
    recording: Path, capsys: pytest.CaptureFixture[str], words: list[str], why: str
) -> None:
    out = recording.with_name("out.c3d")
    assert main(["smooth", str(recording), "-o", str(out), *words]) == 1
    assert why in capsys.readouterr().err
    assert not out.exists()


def test_bench_prints_the_published_tables(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "smooth", "--published"]) == 0
    lines = capsys.readouterr().out.splitlines()
    row = next(line for line in lines if "past, 2" in line).split()
    assert float(row[-7]) == 28.12
    assert abs(float(row[-8]) - 28.12) < 1.0


def test_comparison_tells_every_method_and_the_ratio() -> None:
    whole = kick(markers=3)
    truth = Truth("kick", whole.positions[3000:4200], whole.rate)
    rows = compare([truth], noises_mm=[1.0], kinds=["white"])
    found = {(row.method, row.setting): row.acceleration_m_s2 for row in rows}
    assert found["nothing", ""] == pytest.approx(35.3, rel=0.02)
    assert found["auto", ""] < min(found["bspline", "oracle"], found["butterworth", "oracle"])
    assert found["auto", ""] < 0.85 * found["whittaker", ""]
    assert found["butterworth", "oracle"] <= found["butterworth", "cutoff_hz=6"]
    assert any("better oracle" in line for line in truth_table(rows))
    lines = list(csv.DictReader(smooth_csv(rows).splitlines()))
    assert len(lines) == len(rows)
    assert float(lines[0]["noise_mm"]) == 1.0


def test_a_take_of_gaps_has_no_truth() -> None:
    positions = np.zeros((50, 1, 3))
    positions[3] = np.nan
    with pytest.raises(DataError, match="seen all the time"):
        hard_smoothed(Take(positions, ("A",), 100.0), "it")
