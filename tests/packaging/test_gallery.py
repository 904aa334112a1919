"""Every script of the gallery does on a small take what it says."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import pytest

import markermend as mm

GALLERY = Path(__file__).resolve().parents[2] / "docs" / "gallery"


@pytest.fixture(scope="module")
def takes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with one damaged take, of every third marker."""
    folder = tmp_path_factory.mktemp("takes")
    whole, _ = mm.simulate(duration_s=6.0)
    some = [m for m, name in enumerate(whole.labels) if m % 3 == 1 or name in ("RTOE", "RWRA")]
    labels = tuple(whole.labels[m] for m in some)
    mm.write(mm.Take(whole.positions[:, some], labels, whole.rate), folder / "walk.c3d")
    return folder


def run(
    script: str, *arguments: object, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> str:
    """Run a script as its reader would; returns what it printed."""
    monkeypatch.setattr(sys, "argv", [script, *map(str, arguments)])
    runpy.run_path(str(GALLERY / script), run_name="__main__")
    return capsys.readouterr().out


def test_clean_a_folder(takes: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    told = run("clean_a_folder.py", takes, tmp_path, monkeypatch=monkeypatch, capsys=capsys)

    assert told.startswith("walk.c3d: ")
    assert mm.read(tmp_path / "walk.c3d").present.sum() > mm.read(takes / "walk.c3d").present.sum()


def test_speed_with_bands(takes: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    out = tmp_path / "speed.csv"
    told = run(
        *("speed_with_bands.py", takes / "walk.c3d", "RTOE", out),
        monkeypatch=monkeypatch,
        capsys=capsys,
    )

    assert "RTOE is fastest in frame" in told
    assert out.read_text().splitlines()[0].startswith("frame,time_s,speed_mm_s,speed_band_mm_s")


def test_which_filler(takes: Path, monkeypatch, capsys) -> None:
    told = run(
        *("which_filler.py", takes / "walk.c3d", "RWRA", 0.5),
        monkeypatch=monkeypatch,
        capsys=capsys,
    )

    errors = {line.split()[0]: float(line.split()[1]) for line in told.splitlines() if "mm" in line}
    assert errors["auto"] < errors["linear"]


def test_quality_table(takes: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    pytest.importorskip("pandas")
    out = tmp_path / "table.csv"
    told = run("quality_table.py", takes / "walk.c3d", out, monkeypatch=monkeypatch, capsys=capsys)

    assert "seen" in told
    assert len(out.read_text().splitlines()) == 1 + mm.read(takes / "walk.c3d").markers


def test_review_by_rule(takes: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    told = run(
        *("review_by_rule.py", takes / "walk.c3d", tmp_path / "out.c3d"),
        monkeypatch=monkeypatch,
        capsys=capsys,
    )

    assert "repaired" in told
    assert "pending" not in told
    assert mm.read(tmp_path / "out.c3d").present.sum() > 0


def test_every_script_is_listed_and_tested() -> None:
    scripts = {p.name for p in GALLERY.glob("*.py")}
    listed = (GALLERY / "README.md").read_text(encoding="utf-8")
    assert {s for s in scripts if f"]({s})" not in listed} == set()
    assert {s for s in scripts if s not in Path(__file__).read_text(encoding="utf-8")} == set()
