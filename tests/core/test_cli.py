"""The command line: exit codes, sentences, tables, JSON, and files never half written."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from command_line import FRAMES, run, strict, write_swing

import markermend as mm
from markermend.cli import main
from markermend.cli.console import check_outputs, count, table, write_json, write_text
from markermend.cli.numbers import Span
from markermend.cli.parser import COMMANDS
from markermend.errors import ExportError, RangeError


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("take") / "swing.c3d"
    write_swing(path)
    return path


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


def test_what_asks_a_command_to_end_leaves_nothing_half_written(
    recording: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    def ended(*_: object) -> None:
        assert list(tmp_path.glob(".markermend-*.part"))
        os.kill(os.getpid(), signal.SIGTERM)

    monkeypatch.setattr("markermend.files.atomic.os.fsync", ended)
    monkeypatch.setattr("markermend.cli.keep_memory", lambda: None)
    monkeypatch.setattr(
        "sys.argv", ["markermend", "convert", str(recording), "-o", str(tmp_path / "out.csv")]
    )
    before = signal.signal(signal.SIGTERM, signal.SIG_IGN)
    try:
        assert main() == 1
    finally:
        signal.signal(signal.SIGTERM, before)
    assert capsys.readouterr().err.endswith("Stopped.\n")
    assert list(tmp_path.iterdir()) == []


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
    assert path.read_text() == "old"
    # Names of files need not be text.
    write_text(str(path), "a\udcff\ud800ü")
    assert path.read_text(encoding="utf-8") == "a��ü"
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


def test_detect_says_which_markers_are_never_seen(tmp_path, capsys):
    positions = 1000 + np.cumsum(np.random.default_rng(0).normal(size=(300, 4, 3)) * 0.1, axis=0)
    positions[:, 1] = np.nan
    positions[:50, 2] = np.nan
    path = tmp_path / "never.c3d"
    mm.write(mm.Take(positions, ("A", "B", "C", "D"), 100.0), path)
    assert run("detect", path, "--no-slow") == 0
    assert "Never seen: 1 marker (B)." in capsys.readouterr().out
    assert run("detect", path, "--no-slow", "--frames", 1, 40) == 0
    assert "Never seen in these frames: 2 markers (B, C)." in capsys.readouterr().out
