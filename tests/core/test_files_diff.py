"""What differs between two files, and what a file holds."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.cli.diff import render, to_dict
from markermend.files import diff
from markermend.files.diff import compare
from markermend.files.info import describe_file
from markermend.files.restructure import relabel
from markermend.take import Take


@pytest.fixture
def source(shared_data: Path) -> Path:
    return shared_data / "gait/Capture0002.c3d"


def test_same_file_is_the_same(source: Path) -> None:
    found = compare(source, source)
    assert found.identical
    assert (found.samples, found.parameters, found.bytes) == ((), (), ())
    assert "byte for byte" in render(found)


def test_every_kind_of_sample_change(source: Path, tmp_path: Path) -> None:
    take = mm.read(source)
    positions = take.positions.copy()
    gap_frame, gap_marker = np.argwhere(~take.present)[0]
    moved = next(m for m in range(take.markers) if take.present[10:22, m].all())
    positions[10:15, moved, 1] += 4.5
    positions[20, moved] = np.nan
    positions[gap_frame, gap_marker] = 1.0, 2.0, 3.0
    mm.write(take.with_positions(positions, take.origin.copy()), tmp_path / "out.c3d")
    found = compare(source, tmp_path / "out.c3d")
    first = take.first_frame
    changes = {(s.marker, s.axes, s.start, s.stop, s.change) for s in found.samples}
    assert changes == {
        (take.labels[moved], "y", first + 10, first + 15, "moved"),
        (take.labels[moved], "xyz", first + 20, first + 21, "removed"),
        (take.labels[gap_marker], "xyz", first + gap_frame, first + gap_frame + 1, "filled"),
    }
    assert max(s.largest_mm for s in found.samples) == pytest.approx(4.5, abs=1e-3)
    assert found.parameters == ()
    assert {b.part for b in found.bytes} == {"frames"}
    assert found.differing_bytes == sum(b.stop - b.start for b in found.bytes)
    text = render(found)
    assert "moved by up to 4.5 mm" in text
    assert "Parameters: none" in text


def test_parameters_and_parts(source: Path, tmp_path: Path) -> None:
    take = mm.read(source)
    mm.write(relabel(take, {take.labels[0]: "OTHER"}), tmp_path / "out.c3d")
    found = compare(source, tmp_path / "out.c3d")
    assert found.samples == ()
    assert found.renamed == ((take.labels[0], "OTHER"),)
    assert {p.name for p in found.parameters} == {"POINT:LABELS"}
    assert "parameters" in {b.part for b in found.bytes}
    assert "OTHER" in render(found, most=1)


def test_samples_of_renamed_markers_are_compared(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    positions = rng.normal(0, 100, (40, 3, 3)).astype(np.float32).astype(np.float64)
    mm.write(Take(positions, ("A", "B", "*1"), 100.0), tmp_path / "a.c3d")
    changed = positions.copy()
    changed[10:13, 0, 2] += 8.0
    changed[:, 2] = rng.normal(0, 100, (40, 3))
    mm.write(Take(changed, ("LFHD", "B", "C"), 100.0), tmp_path / "b.c3d")
    found = compare(tmp_path / "a.c3d", tmp_path / "b.c3d")
    assert found.renamed == (("A", "LFHD"),)
    assert [(s.marker, s.axes, s.start, s.stop) for s in found.samples] == [("A", "z", 11, 14)]
    (markers,) = (p for p in found.parameters if p.name == "markers")
    assert (markers.before, markers.after) == ("*1", "C")
    assert "Renamed: A → LFHD" in render(found)


def test_files_of_different_kinds(shared_data: Path, tmp_path: Path) -> None:
    source = shared_data / "trc/exampleFormat.trc"
    mm.write(mm.read(source), tmp_path / "out.csv")
    found = compare(source, tmp_path / "out.csv")
    assert found.samples == ()
    assert found.parameters == ()
    assert not found.identical
    assert render(found).endswith("Bytes: not listed, since the files are of different formats")


def test_text_is_compared_line_by_line(tmp_path: Path) -> None:
    take, longer = Take(np.full((6, 1, 3), 9.5), ("A",), 100.0), tmp_path / "longer.csv"
    mm.write(take, tmp_path / "a.csv")
    positions = take.positions.copy()
    # A longer number moves all bytes behind it.
    positions[[1, 2, 4]] = 1234.5
    mm.write(Take(positions, ("A",), 100.0), tmp_path / "b.csv")
    found = compare(tmp_path / "a.csv", tmp_path / "b.csv")
    text = (tmp_path / "a.csv").read_text().splitlines()
    head = len(text) - 6
    assert found.lines is not None
    assert (found.lines.lines, found.lines.differing) == (len(text), 3)
    assert found.lines.runs == ((head + 2, head + 4), (head + 5, head + 6))
    assert found.bytes == ()
    told = render(found)
    assert f"a.csv and b.csv: 3 of {len(text)} lines differ." in told
    assert f"Lines: 2\n  {head + 2}–{head + 3}\n  {head + 5}" in told
    assert to_dict(found)["lines"]["runs"][1] == {"start": head + 5, "stop": head + 6}
    longer.write_text("\n".join([*text, text[-1].replace(text[-1].split(",")[0], "7", 1), ""]))
    for pair in ((tmp_path / "a.csv", longer), (longer, tmp_path / "a.csv")):
        assert compare(*pair).lines is None
        assert to_dict(compare(*pair))["lines"] is None


def test_describe_file(shared_data: Path) -> None:
    told = describe_file(mm.read(shared_data / "gait/PiG_Motion-FlatFoot-Full.c3d"))
    assert json.loads(json.dumps(told)) == told
    assert told["info"]["manufacturer"] == "Vicon"
    assert told["points"]["angle"] == 26
    assert len(told["events"]) == 12
    assert told["gaps"] == {"LFHD": {"gaps": 1, "frames": 30, "longest": 30}}
    assert [plate["type"] for plate in told["force_plates"]] == [2, 2]
    assert told["force_plates"][0]["channels"][:3] == ["Fx1", "Fy1", "Fz1"]
    assert len(told["force_plates"][0]["corners"]) == 4
    rolling = describe_file(mm.read(shared_data / "bodies/03_rolling.c3d"))
    assert "65535" in rolling["missing"]["coding"]
    assert rolling["oddities"]


def test_describe_every_file(shared_data: Path) -> None:
    for path in shared_data.rglob("*.[ct]*"):
        if path.is_file() and path.suffix.lower() in (".c3d", ".trc"):
            try:
                take = mm.read(path)
            except mm.FileFormatError:
                continue
            json.dumps(describe_file(take))


def test_a_cut_list_of_bytes_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    positions = np.random.default_rng(5).normal(0, 100, (400, 6, 3))
    for name, shift in (("a", 0.0), ("b", 3.0)):
        mm.write(Take(positions + shift, tuple("ABCDEF"), 100.0), tmp_path / f"{name}.c3d")
    whole = compare(tmp_path / "a.c3d", tmp_path / "b.c3d")
    assert not whole.bytes_cut
    assert not to_dict(whole)["bytes_cut"]
    runs = len(whole.bytes)
    # Runs that lie across the parts of a file count as often as they are listed.
    monkeypatch.setattr(diff, "_borders", lambda _: ((0, "a"), (2000, "b"), (2001, "c")))
    for most in (100, runs - 1, runs + 2):
        monkeypatch.setattr(diff, "_MOST_RUNS", most)
        found = compare(tmp_path / "a.c3d", tmp_path / "b.c3d")
        assert found.differing_bytes == whole.differing_bytes
        assert len(found.bytes) <= most
        assert found.bytes_cut is to_dict(found)["bytes_cut"] is (most < runs)
        assert ("only the first" in render(found)) is (most < runs)
    monkeypatch.setattr(diff, "_MOST_RUNS", 100)
    text = render(compare(tmp_path / "a.c3d", tmp_path / "b.c3d"))
    assert f"Bytes: {whole.differing_bytes:,} differ in all; only the first 100 runs" in text
    assert text.endswith("… and more than 80 more")


def test_joints_are_compared_frame_by_frame_whatever_they_count_from(
    shared_data: Path, tmp_path: Path
) -> None:
    mm.write(mm.read(shared_data / "poses" / "02_03.amc"), tmp_path / "joints.csv")
    found = compare(shared_data / "poses" / "02_03.amc", tmp_path / "joints.csv")
    assert all(s.change == "moved" and s.largest_mm < 0.001 for s in found.samples)
