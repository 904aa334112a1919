"""The command line on a take: what it tells, detects, repairs, converts and compares."""

from __future__ import annotations

import csv
import io
import json
import os
from pathlib import Path

import ezc3d
import numpy as np
import pytest
from command_line import FRAMES, GAP, RATE, run, strict, write_swing

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.cli.repairing import left_over
from markermend.errors import ExportError
from markermend.outcome import Outcome


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("take") / "swing.c3d"
    write_swing(path)
    return path


def test_info_as_json(recording: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("info", recording, "--json", "-") == 0
    told = strict(capsys.readouterr().out)
    assert (told["frames"], told["rate"], told["take"]) == (FRAMES, RATE, "swing.c3d")
    marker = {m["label"]: m for m in told["markers"]}["TOP1"]
    assert (marker["gaps"], marker["longest_gap"]) == (1, 10)
    assert marker["seen"] == pytest.approx(390 / 400)


def test_info_for_people(recording: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("info", recording) == 0
    out = capsys.readouterr().out
    assert "400 frames at 100 Hz" in out
    assert "TOP1" in out


def test_info_counts_unlabelled_trajectories_apart(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    positions = np.ones((100, 3, 3)) * np.arange(1, 4)[None, :, None]
    positions[:50, 1], positions[:80, 2] = np.nan, np.nan
    mm.write(mm.Take(positions, ("A", "B", "*7"), 100.0), tmp_path / "t.c3d")
    assert run("info", tmp_path / "t.c3d") == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "markers 2, seen 75.0% of the time unlabelled 1" in told


def test_what_is_read_is_never_replaced(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    listed, review = tmp_path / "list.json", tmp_path / "swing.c3d.markermend.json"
    assert run("detect", recording, "--no-slow", "--json", listed) == 0
    review.write_text("hours of work")
    before = listed.read_text()
    capsys.readouterr()
    clean = ("clean", recording, "--artifacts", listed, "-o", tmp_path / "o.c3d", "--force")
    assert run(*clean, "--json", listed) == 1
    assert "is read itself" in capsys.readouterr().err
    assert run("report", recording, "-o", review, "--force") == 1
    assert "is a review" in capsys.readouterr().err
    assert (listed.read_text(), review.read_text()) == (before, "hours of work")


def test_a_list_of_another_take_is_refused(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    listed = tmp_path / "list.json"
    assert run("detect", recording, "--no-slow", "--json", listed) == 0
    other = json.loads(listed.read_text()) | {"frames": 50}
    listed.write_text(json.dumps(other))
    capsys.readouterr()
    assert run("clean", recording, "--artifacts", listed, "-o", tmp_path / "o.c3d") == 1
    assert "a take of 50 frames" in capsys.readouterr().err
    assert not (tmp_path / "o.c3d").exists()


def test_a_folder_that_takes_no_files_is_told_first(
    recording: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    (tmp_path / "ro").mkdir()
    # Who runs tests may be allowed everything.
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path).name not in ("ro", "dev"))
    words = ("clean", recording, "-o", tmp_path / "o.c3d", "--json", tmp_path / "ro" / "o.json")
    assert run(*words) == 1
    assert "takes no files" in capsys.readouterr().err
    assert not (tmp_path / "o.c3d").exists()
    if Path("/dev/null").exists():
        assert run("info", recording, "--json", "/dev/null") == 1
        assert "device" in capsys.readouterr().err


def test_a_list_of_gaps_is_not_replaced_by_its_results(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    listed = tmp_path / "gaps.json"
    listed.write_text("[]")
    words = ("bench", "gaps", recording, "--list", listed, "--force")
    assert run(*words, "--csv", listed) == 1
    assert "is read itself" in capsys.readouterr().err
    assert run(*words, "--csv", recording) == 1
    assert listed.read_text() == "[]"


def test_labels_that_end_in_a_dot_come_back_from_a_table(tmp_path: Path) -> None:
    positions = np.ones((9, 3, 3)) * np.arange(1, 4)[None, :, None]
    mm.write(mm.Take(positions, ("L.Fem.", "B-", "C"), 100.0), tmp_path / "t.csv")
    assert mm.read(tmp_path / "t.csv").labels == ("L.Fem.", "B-", "C")
    (tmp_path / "u.csv").write_text("Frame,A - X,A - Y,A - Z\n1,1,2,3\n2,1,2,3\n")
    assert mm.read(tmp_path / "u.csv").labels == ("A",)


def test_a_take_without_markers_is_no_trc(tmp_path: Path) -> None:
    take = mm.Take(np.zeros((9, 0, 3)), (), 100.0)
    with pytest.raises(ExportError, match="nothing but markers"):
        mm.write(take, tmp_path / "t.trc")
    assert not (tmp_path / "t.trc").exists()


def test_detect_finds_gap_and_spike(recording: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("detect", recording, "--no-slow", "--json", "-") == 0
    told = strict(capsys.readouterr().out)
    assert set(told) >= {"take", "rate", "first_frame", "frames", "method", "version", "artifacts"}
    found = {(a["marker"], a["kind"], a["start"], a["stop"]) for a in told["artifacts"]}
    assert ("TOP1", "gap", 150, 160) in found
    assert any(m == "TOP2" and k == "peak" and a <= 300 < b for m, k, a, b in found)


def test_detect_table_counts_in_c3d_frames(
    recording: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("detect", recording, "--no-slow") == 0
    out = capsys.readouterr().out
    first = mm.read(recording).first_frame
    row = next(line for line in out.splitlines() if " gap " in line)
    assert row.split()[:3] == [f"{150 + first}–{159 + first}", "1.50–1.60", "TOP1"]
    assert "1 gap" in out.splitlines()[-1]


def test_detect_csv(recording: Path, tmp_path: Path) -> None:
    path = tmp_path / "found.csv"
    assert run("detect", recording, "--no-slow", "--csv", path) == 0
    rows = list(csv.DictReader(io.StringIO(path.read_text())))
    gap = next(row for row in rows if row["kind"] == "gap")
    assert (gap["start"], gap["stop"], gap["amplitude_mm"]) == ("150", "160", "")
    assert (gap["start_s"], gap["stop_s"]) == ("1.5", "1.6")


def test_clean_repairs_only_what_it_names(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, report = tmp_path / "out.c3d", tmp_path / "report.json"
    assert run("clean", recording, "-o", out, "--no-slow", "--json", report) == 0
    assert "Written" in capsys.readouterr().out
    told = strict(report.read_text())
    before, after = mm.read(recording), mm.read(out)
    allowed = np.zeros(before.positions.shape, dtype=bool)
    for a in told["artifacts"]:
        assert set(a["repair"]) == {"method", "error_mm", "band_mm", "reason", "leaves"}
        if a["status"] == "repaired":
            columns = ["xyz".index(axis) for axis in a["axes"]]
            allowed[a["start"] : a["stop"], before.index(a["marker"]), columns] = True
    same = (before.positions == after.positions) | (
        np.isnan(before.positions) & np.isnan(after.positions)
    )
    assert not (~same & ~allowed).any()
    assert not np.isnan(after.positions[GAP, 1]).any()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["out.c3d", "report.json"]


def test_clean_writes_down_what_it_did_when_asked(recording: Path, tmp_path: Path) -> None:
    out = tmp_path / "clean.c3d"
    assert run("clean", recording, "-o", out, "--no-slow", "--record") == 0
    group = ezc3d.c3d(str(out))["parameters"]["MARKERMEND"]
    changes = group["CHANGES"]["value"]
    assert any("gap TOP1 xyz frames 151-160" in line for line in changes)
    assert group["VERSION"]["value"] == [mm.__version__]


def test_clean_obeys_a_reviewed_list(recording: Path, tmp_path: Path) -> None:
    listed, out = tmp_path / "found.json", tmp_path / "out.c3d"
    assert run("detect", recording, "--no-slow", "--json", listed) == 0
    told = strict(listed.read_text())
    for a in told["artifacts"]:
        a["status"] = "rejected"
    listed.write_text(json.dumps(told))
    assert run("clean", recording, "-o", out, "--artifacts", listed) == 0
    assert out.read_bytes() == recording.read_bytes()


def test_clean_refuses_a_list_that_is_none(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    listed = tmp_path / "found.json"
    for text in (b"not json", b"\xd7", b"[1]", b"{}", b'{"artifacts": [{"marker": "TOP0"}]}'):
        listed.write_bytes(text)
        assert run("clean", recording, "-o", tmp_path / "x.c3d", "--artifacts", listed) == 1
        *odd, said = capsys.readouterr().err.splitlines()
        assert all(line.startswith(recording.name) for line in odd)
        assert listed.name in said


def test_fill_touches_gaps_only(recording: Path, tmp_path: Path) -> None:
    out = tmp_path / "filled.c3d"
    assert run("fill", recording, "-o", out, "--method", "linear") == 0
    before, after = mm.read(recording), mm.read(out)
    seen = before.present
    np.testing.assert_array_equal(after.positions[seen], before.positions[seen])
    assert after.present.all()


def test_fill_leaves_longer_gaps(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for length, missing in (("9", 10), ("0.09s", 10), ("100ms", 0), ("10", 0)):
        out = tmp_path / f"{length}.c3d"
        assert run("fill", recording, "-o", out, "--max-gap", length, "--method", "linear") == 0
        assert (~mm.read(out).present).sum() == missing
    assert "Longer than asked for and left: 1 gap." in capsys.readouterr().out


def test_fill_sets_parameters_of_the_method_it_is_told(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ("fill", recording, "--method", "spline", "-o")
    assert run(*words, tmp_path / "far.c3d") == 0
    assert run(*words, tmp_path / "near.c3d", "--set", "context=4") == 0
    assert (tmp_path / "far.c3d").read_bytes() != (tmp_path / "near.c3d").read_bytes()
    capsys.readouterr()
    for more, said in (
        (["--set", "contxt=4"], "has no parameter “contxt”"),
        (["--set", "context=4", "--method", "auto"], "name it by --method"),
    ):
        assert run(*words, tmp_path / "x.c3d", *more) == 1
        assert said in capsys.readouterr().err


@pytest.mark.parametrize(("method", "known"), [("pma", True), ("ffnn_lin", False)])
def test_a_model_named_by_hand_says_how_far_off_it_is_or_that_this_is_not_measured(
    recording: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    method: str,
    known: bool,
) -> None:
    out, told, page = tmp_path / "out.c3d", tmp_path / "told.json", tmp_path / "page.html"
    words = ("clean", recording, "-o", out, "--no-slow", "--method", method, "--list")
    assert run(*words, "--json", told, "--report", page) == 0
    listed = [line for line in capsys.readouterr().out.splitlines() if f" {method} " in line]
    gap = next(a for a in strict(told.read_text())["artifacts"] if a["kind"] == "gap")
    assert gap["repair"]["method"] == method
    assert (gap["repair"]["error_mm"] is not None) == known
    if known:
        # What the plates do not tell is the noise of 0.2 mm.
        assert 0.05 < gap["repair"]["error_mm"] < 5.0
    assert listed
    assert all(("not measured" in line) != known for line in listed)
    assert ("not measured" in page.read_text()) != known


def test_joints_are_searched_in_one_way_and_counted_as_joints(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    joints, table = tmp_path / "joints.csv", tmp_path / "table.csv"
    joints.write_text(
        "frame,joint,parent,x,y,z\n" + "".join(f"{f},hip,,{f},2,3\n" for f in range(5))
    )
    assert run("detect", joints, "--method", "paper") == 1
    assert "so that “paper” can change nothing" in capsys.readouterr().err
    assert run("convert", joints, "-o", table) == 0
    assert "1 joint, 5 frames" in capsys.readouterr().out


def test_another_format_counts_what_was_repaired(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("fill", recording, "-o", tmp_path / "filled.trc", "--method", "linear") == 0
    assert f"{GAP.stop - GAP.start} new samples" in capsys.readouterr().out


def test_a_marker_that_is_not_there_is_named_with_the_nearest(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for label, said in (("top0", "is “TOP0” meant?"), ("zzzzzz", "“markermend info” lists")):
        assert run("smooth", recording, "-o", tmp_path / "x.c3d", "--marker", label) == 1
        err = capsys.readouterr().err
        assert recording.name in err
        assert said in err


@pytest.mark.parametrize("suffix", [".trc", ".csv", ".c3d"])
def test_convert_keeps_the_markers(recording: Path, tmp_path: Path, suffix: str) -> None:
    out = tmp_path / f"out{suffix}"
    assert run("convert", recording, "-o", out) == 0
    before, after = mm.read(recording), mm.read(out)
    assert (after.labels, after.rate, after.frames) == (before.labels, RATE, FRAMES)
    np.testing.assert_allclose(after.positions, before.positions, atol=0.01)


def test_diff_names_what_fill_did(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out.c3d"
    assert run("fill", recording, "-o", out, "--method", "linear") == 0
    capsys.readouterr()
    assert run("diff", recording, out, "--json", "-") == 0
    told = strict(capsys.readouterr().out)
    first = mm.read(recording).first_frame
    (sample,) = told["samples"]
    assert (sample["marker"], sample["change"]) == ("TOP1", "filled")
    assert (sample["start"], sample["stop"]) == (150 + first, 160 + first)
    assert told["parameters"] == []
    assert run("diff", recording, recording) == 0
    assert "the same, byte for byte" in capsys.readouterr().out


def test_reasons_that_differ_in_size_only_are_told_in_one_line() -> None:
    gap = Artifact("A", "xyz", 0, 9, Kind.GAP)
    reasons = ["It is 73 mm off; too far.", "No 3 markers.", "It is 54 mm off; too far."]
    left = [Outcome(gap, None, None, reason) for reason in reasons]
    assert left_over(left)[2:] == [
        "     2 × It is 54 to 73 mm off; too far.",
        "     1 × No 3 markers.",
    ]
    assert left_over([]) == []
