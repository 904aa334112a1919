"""Names of files that are not text, as Linux allows them, end no command and no batch."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest
from command_line import run, strict, write_swing

import markermend as mm
from markermend.batch import Recipe, find_takes, run_batch
from markermend.batch.review import takes_to_review
from markermend.detectors import find_detector
from markermend.encoding import json_kept, printable, utf8
from markermend.review.file import open_session

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="other systems have no such names")
NAME = "\udcff\udcfe.c3d"


@pytest.fixture
def odd(tmp_path: Path) -> Path:
    path = tmp_path / "in" / NAME
    path.parent.mkdir()
    write_swing(path.with_name("swing.c3d"))
    path.write_bytes(path.with_name("swing.c3d").read_bytes())
    return path


def test_text_is_text() -> None:
    assert printable("ü\udcff\ud800") == "ü��"
    assert utf8("ü�") == "ü�".encode()
    assert utf8("\udcfe") == "�".encode()
    kept = json_kept(json.dumps({"a": "ü\udcff"}, ensure_ascii=False))
    assert kept.encode() == b'{"a": "\xc3\xbc\\udcff"}'
    assert json.loads(kept) == {"a": "ü\udcff"}


def test_commands(odd: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("detect", odd, "--json", "-", "--method", "paper") == 0
    assert strict(capsys.readouterr().out)["take"] == "��.c3d"
    told, page = tmp_path / "x.json", tmp_path / "x.html"
    assert run("clean", odd, "-o", tmp_path / "x.c3d", "--json", told, "--report", page) == 0
    assert strict(told.read_text(encoding="utf-8"))["take"] == "��.c3d"
    assert "��.c3d" in page.read_text(encoding="utf-8")
    capsys.readouterr()
    table = odd.with_suffix(".trc")
    assert run("convert", odd, "-o", table) == 0
    assert "��.trc, 8 markers" in capsys.readouterr().out
    assert mm.read(table).markers == 8
    assert run("diff", odd, tmp_path / "x.c3d", "--json", "-") == 0
    assert strict(capsys.readouterr().out)["files"] == ["��.c3d", "x.c3d"]
    assert run("info", odd.with_name("\udcfd.c3d")) == 1
    assert "There is no file" in capsys.readouterr().err


def test_batch(odd: Path, tmp_path: Path) -> None:
    takes, out = find_takes([odd.parent]), tmp_path / "out"
    slowless = find_detector("paper").params(slow=False)
    recipe = Recipe(detector="paper", detector_params=slowless, min_confidence=1.0)
    done = run_batch(takes, out, recipe, jobs=1)
    assert not done.failures
    assert len(done.takes) == 2
    assert done.review
    for name in ("index.json", "review.json"):
        assert len(json.loads((out / name).read_text(encoding="utf-8"))["takes"]) == 2
    assert "��" in (out / "index.json").read_text(encoding="utf-8")
    assert "��" in (out / "report.html").read_text(encoding="utf-8")
    # The window opens what waits by the paths told there.
    for item in takes_to_review([out]):
        assert mm.read(item.path).markers == 8
        assert item.found is not None
        assert item.found.is_file()
    assert odd in {item.path for item in takes_to_review([out])}
    again = run_batch(takes, out, recipe, jobs=1, resume=True)
    assert again.skipped == 2
    odd.write_bytes(b"nothing")
    broken = run_batch(takes, out, recipe, jobs=1, force=True)
    assert list(broken.failures) == [Path(NAME).stem]
    assert "��" in (out / "report.html").read_text(encoding="utf-8")


def test_a_review_is_found_where_the_take_was_moved(odd: Path, tmp_path: Path) -> None:
    with_name = open_session(mm.read(odd))
    with_name.session.add_detected(mm.detect(with_name.session.original, method="paper"), "paper")
    found = len(with_name.session.artifacts)
    with_name.save()
    with_name.close()
    moved = odd.rename(tmp_path / "moved.c3d")
    again = open_session(mm.read(moved))
    assert len(again.session.artifacts) == found > 0
    again.close()
