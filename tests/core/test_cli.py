"""The command line: exit codes, sentences, tables, JSON, and files never half written."""

from __future__ import annotations

import csv
import io
import json
import os
import subprocess
import sys
from pathlib import Path

import ezc3d
import numpy as np
import pytest

import markermend as mm
from markermend.cli import main
from markermend.cli.console import check_outputs, count, table, write_json, write_text
from markermend.cli.numbers import Span
from markermend.cli.parser import COMMANDS
from markermend.errors import ExportError, RangeError

FRAMES, RATE, GAP = 400, 100.0, slice(150, 160)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a C3D of two rigid plates that swing, with one gap and one spike."""
    rng = np.random.default_rng(1)
    time = np.arange(FRAMES) / RATE
    corners = np.array([[0, 0, 0], [200, 0, 0], [0, 150, 0], [200, 150, 30.0]])
    points = []
    for plate, (height, speed) in enumerate(((1000.0, 0.4), (400.0, 0.7))):
        turn = 0.5 * np.sin(2 * np.pi * speed * time)
        sway = 80 * np.sin(2 * np.pi * 0.5 * speed * time + plate)
        for x, y, z in corners:
            points.append(
                [
                    np.cos(turn) * x - np.sin(turn) * y + sway,
                    np.sin(turn) * x + np.cos(turn) * y,
                    np.full(FRAMES, z + height),
                ]
            )
    positions = np.array(points).transpose(1, 0, 2) + rng.normal(0, 0.2, (3, 8, FRAMES))
    positions[2, 2, 300] += 40.0
    positions[:, 1, GAP] = np.nan
    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [RATE]
    file["parameters"]["POINT"]["UNITS"]["value"] = ["mm"]
    names = [f"{plate}{i}" for plate in ("TOP", "LOW") for i in range(4)]
    file["parameters"]["POINT"]["LABELS"]["value"] = names
    file["data"]["points"] = np.concatenate([positions, np.ones((1, 8, FRAMES))])
    path = tmp_path_factory.mktemp("take") / "swing.c3d"
    file.write(str(path))
    return path


def run(*words: object) -> int:
    return main([str(word) for word in words])


def strict(text: str) -> dict[str, object]:
    """Parse JSON, refusing NaN and Infinity, which are not JSON."""

    def refuse(name: str) -> None:
        raise AssertionError(f"{name} is not JSON")

    return json.loads(text, parse_constant=refuse)


def test_help_and_version_need_no_numpy() -> None:
    code = (
        "import sys, markermend.cli as c\n"
        "assert c.main(['--version']) == 0 and c.main(['clean', '--help']) == 0\n"
        "assert 'numpy' not in sys.modules and 'importlib.metadata' not in sys.modules\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert mm.__version__ in done.stdout


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(command, "--help") == 0
    assert "usage: markermend " + command in capsys.readouterr().out


@pytest.mark.parametrize(
    "words",
    [
        ["nonsense"],
        ["clean", "take.c3d"],
        ["fill", "a.c3d", "-o", "b.c3d", "--max-gap", "soon"],
        ["clean", "a.c3d", "-o", "b.c3d", "--min-confidence", "2"],
        ["simulate", "-o", "a.c3d", "--rate", "0"],
        ["simulate", "-o", "a.c3d", "--seed", "-1"],
        ["detect", "a.c3d", "--sensitivity", "2"],
        ["smooth", "a.c3d", "-o", "b.c3d", "--frames", "1", "b"],
        ["bench", "e1", "a.c3d", "--jobs", "0"],
        ["bench", "gaps", "a.c3d", "--simulations", "0"],
        ["bench", "e3", "a.c3d", "--share", "7"],
    ],
)
def test_bad_usage_is_two(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*words) == 2
    assert "usage:" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words",
    [
        ["info", "missing.c3d"],
        ["missing.c3d"],
        ["detect", "missing.c3d", "--method", "magic"],
        ["clean", "missing.c3d", "-o", "missing/out.c3d"],
        ["clean", "missing.c3d", "-o", "out.c3d", "--method", "magic"],
        ["fill", "missing.c3d", "-o", "out.c3d"],
        ["clean", "missing.c3d", "-o", "out.trc", "--record"],
        ["clean", "missing.c3d", "-o", "out.c3d", "--artifacts", "a.json", "--detector", "paper"],
        ["clean", "missing.c3d", "-o", "out.c3d", "--artifacts", "missing.json"],
        ["bench", "gaps", "missing.c3d", "--figures", "a"],
    ],
)
def test_failure_is_one_sentence(
    words: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(*words) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert err.rstrip().endswith(".")
    assert "Traceback" not in err
    assert list(tmp_path.iterdir()) == []


def test_unexpected_errors_become_a_sentence_too(
    recording: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("by zero")

    monkeypatch.delenv("MARKERMEND_DEBUG", raising=False)
    monkeypatch.setattr(mm, "infer_mesh", broken)
    assert run("info", recording) == 1
    assert "ZeroDivisionError" in capsys.readouterr().err
    monkeypatch.setenv("MARKERMEND_DEBUG", "1")
    with pytest.raises(ZeroDivisionError):
        run("info", recording)


def test_a_repair_beyond_integers_names_the_way_out(
    recording: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    def full(*_: object, **__: object) -> None:
        raise RangeError("TOP1 is too far away for this file.")

    monkeypatch.setattr(mm, "write", full)
    assert run("fill", recording, "-o", tmp_path / "out.c3d", "--method", "linear") == 1
    assert "--float" in capsys.readouterr().err


def test_interrupt_stops(
    recording: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(mm, "infer_mesh", interrupted)
    assert run("clean", recording, "-o", tmp_path / "out.c3d") == 1
    assert capsys.readouterr().err.endswith("Stopped.\n")
    assert list(tmp_path.iterdir()) == []


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


def test_span_counts_frames() -> None:
    assert [Span(t).frames(120.0) for t in ("20", "0.2s", "200ms", ".5 s")] == [20, 24, 24, 60]


def test_simulate_tells_the_truth(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    damaged, clean = tmp_path / "damaged.c3d", tmp_path / "clean.c3d"
    common = ("--duration", 20, "--rate", 50, "--seed", 3)
    assert run("simulate", "-o", damaged, "--truth", "-", *common) == 0
    truth = strict(capsys.readouterr().out)
    assert run("simulate", "-o", clean, "--clean", *common) == 0
    one, other = mm.read(damaged), mm.read(clean)
    assert (one.frames, one.rate, one.labels) == (1000, 50.0, other.labels)
    assert {a["kind"] for a in truth["artifacts"]} == {"gap", "peak", "noise", "step", "slow"}
    wrong = np.zeros(one.positions.shape[:2], dtype=bool)
    for a in truth["artifacts"]:
        wrong[a["start"] : a["stop"], one.index(a["marker"])] = True
    np.testing.assert_array_equal(one.positions[~wrong], other.positions[~wrong])
    assert run("simulate", "-o", tmp_path / "again.c3d", *common) == 0
    assert (tmp_path / "again.c3d").read_bytes() == damaged.read_bytes()


def test_nothing_is_overwritten_unasked(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out.c3d"
    out.write_text("mine")
    assert run("fill", recording, "-o", out, "--method", "linear") == 1
    assert "--force" in capsys.readouterr().err
    assert out.read_text() == "mine"
    assert run("fill", recording, "-o", out, "--method", "linear", "--force") == 0
    assert mm.read(out).frames == FRAMES


def test_a_name_that_tells_no_format_is_refused(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("fill", recording, "-o", tmp_path / "out.xyz") == 1
    assert ".c3d" in capsys.readouterr().err


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


def test_the_take_itself_is_never_overwritten(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    link = tmp_path / "link.c3d"
    os.link(recording, link)
    for target in (recording, link):
        assert run("fill", recording, "-o", target, "--force") == 1
        assert "the take itself" in capsys.readouterr().err


def test_outputs_are_checked_before_work(tmp_path: Path) -> None:
    same = str(tmp_path / "a")
    for paths in ([same, same], ["-", "-"], [str(tmp_path)], [str(tmp_path / "no" / "a")]):
        with pytest.raises(ExportError):
            check_outputs(paths, source=None, force=True)
    check_outputs([same, None, "-"], source=None, force=False)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_what_is_no_file_is_never_replaced(tmp_path: Path) -> None:
    pipe, link = tmp_path / "pipe", tmp_path / "link"
    os.mkfifo(pipe)
    link.symlink_to(pipe)
    for path in (pipe, link, "/dev/stdout"):
        with pytest.raises(ExportError, match="device"):
            check_outputs([str(path)], source=None, force=True)
    for path in (pipe, link):
        with pytest.raises(ExportError, match="could not be written"):
            write_text(str(path), "new")
    assert pipe.is_fifo()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["link", "pipe"]


def test_the_file_that_is_missing_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    movement, out = tmp_path / "01_01.amc", tmp_path / "out.csv"
    assert run("denoise", movement, "-o", out) == 1
    assert f"There is no file “{movement}”" in capsys.readouterr().err
    movement.write_text(":FULLY-SPECIFIED\n")
    assert run("denoise", movement, "-o", out, "--skeleton", tmp_path / "no.asf") == 1
    assert "no.asf”; check its name" in capsys.readouterr().err
    assert run("bench", "e1", "a.c3d", "--flaws", tmp_path / "flaws") == 1
    assert "flaws” of flaws" in capsys.readouterr().err


def test_text_is_written_whole_or_not(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    write_text(str(path), "old")
    with pytest.raises(ValueError, match="JSON"):
        write_json(str(path), {"bad": float("nan")})
    with pytest.raises(UnicodeEncodeError):
        write_text(str(path), "\ud800")
    assert path.read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.json"]


def test_table_aligns() -> None:
    lines = table(["A", "Long"], [["1", "x"], ["22", "yy"]], "rl")
    assert lines == [" A  Long", " 1  x", "22  yy"]
    assert (count(1, "gap"), count(1200, "gap")) == ("1 gap", "1,200 gaps")


def test_open_starts_the_app_by_its_entry_point(
    recording: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from markermend.cli import open as command

    opened: list[list[str]] = []

    class Entry:
        def load(self) -> object:
            return lambda words: opened.append(words) or 3

    monkeypatch.setattr(command, "entry_points", lambda group: [Entry()])
    assert run(recording) == run("open", recording) == run() == 3
    assert opened == [[str(recording)], [str(recording)], []]

    class Broken:
        def load(self) -> object:
            raise ModuleNotFoundError("No module named 'PySide6'")

    for found in ([], [Broken()]):
        monkeypatch.setattr(command, "entry_points", lambda group, found=found: found)
        assert run() == 1
        assert "markermend[app]" in capsys.readouterr().err


def test_a_file_that_is_cut_short_is_worked_on_and_told(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    half = tmp_path / "half.c3d"
    whole = recording.read_bytes()
    half.write_bytes(whole[: len(whole) * 3 // 4])
    assert run("fill", half, "-o", tmp_path / "out.c3d", "--method", "linear") == 0
    assert capsys.readouterr().err.startswith("half.c3d: The file is cut short")


@pytest.mark.slow
def test_clean_never_ends_in_a_traceback(
    shared_data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for take in sorted(p for p in shared_data.rglob("*") if p.suffix.lower() == ".c3d"):
        code = run("clean", take, "-o", tmp_path / "out.c3d", "--no-slow", "--force")
        err = capsys.readouterr().err
        told = [line for line in err.splitlines() if not line.startswith(f"{take.name}: ")]
        assert code == (1 if told else 0), take
        assert "itself failed" not in err, (take, err)
        assert len(told) <= 1, (take, err)
