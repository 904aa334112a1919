"""The manual: its links lead somewhere, its keys exist, its examples run."""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.cli import main
from markermend.review.place import session_path
from markermend_app.actions.table import ACTIONS
from markermend_app.dialogs.manual import PAGES, slug_of
from markermend_resources import manual_folder

PAGE_FILES = sorted(manual_folder().glob("*.md"))
BY_MOUSE = {"Ctrl", "Shift"}


def text_of(page: Path) -> str:
    """Text of a page."""
    return page.read_text(encoding="utf-8")


def headings(page: Path) -> set[str]:
    """Names of a page's headings in links."""
    return {slug_of(h) for h in re.findall(r"^#+ (.+)$", text_of(page), re.MULTILINE)}


def skeleton_recording() -> mm.Pose:
    """A forearm that waves for four seconds, its hand unseen for a while."""
    angle = np.sin(np.arange(120) / 10.0)
    joints = np.zeros((120, 3, 3))
    joints[:, 1] = [0.0, 300.0, 0.0]
    joints[:, 2, :2] = 250.0 * np.stack([np.sin(angle), np.cos(angle)], axis=1) + [0.0, 300.0]
    joints[40:45, 2] = np.nan
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (120, 3, 1))
    return mm.Pose(joints, turns, ("shoulder", "elbow", "hand"), (-1, 0, 1), 30.0)


@pytest.fixture(scope="module")
def furnished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that holds what the examples name; the take has every third marker only."""
    folder = tmp_path_factory.mktemp("furnished")
    whole, _ = mm.simulate(duration_s=4.0, seed=3)
    some = [m for m, name in enumerate(whole.labels) if m % 3 == 1 or name == "LTOE"]
    labels = tuple(whole.labels[m] for m in some)
    mm.write(mm.Take(whole.positions[:, some], labels, whole.rate), folder / "take.c3d")
    (folder / "day1").mkdir()
    shutil.copy(folder / "take.c3d", folder / "day1" / "walk.c3d")
    mm.write_pose(skeleton_recording(), folder / "kinect.csv")
    return folder


@pytest.fixture
def desk(furnished: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of that folder, in which the examples run."""
    shutil.copytree(furnished, tmp_path / "desk")
    monkeypatch.chdir(tmp_path / "desk")
    return tmp_path / "desk"


@pytest.mark.parametrize("page", PAGE_FILES, ids=lambda p: p.stem)
def test_links_and_pictures_are_there(page: Path) -> None:
    for target in re.findall(r"\]\(([^)]+)\)", text_of(page)):
        name, _, heading = target.partition("#")
        assert (page.parent / name).exists(), target
        assert not heading or heading in headings(page.parent / name), target


def test_every_page_stands_in_the_contents() -> None:
    listed = set(re.findall(r"\]\((.+?)\)", text_of(manual_folder() / "index.md")))
    assert listed == {p.name for p in PAGE_FILES} - {"index.md"}


@pytest.mark.parametrize("target", PAGES.values())
def test_help_opens_pages_that_are_there(target: str) -> None:
    name, _, heading = target.partition("#")
    assert not heading or heading in headings(manual_folder() / name)


@pytest.mark.parametrize("page", PAGE_FILES, ids=lambda p: p.stem)
def test_keys_that_are_named_do_something(page: Path) -> None:
    known = {key for action in ACTIONS for key in action.keys} | {"1–9"} | BY_MOUSE
    named = re.findall(
        r"\*\*((?:Ctrl\+|Shift\+|Alt\+)*(?:[A-Z?]|F\d+|Space|Esc|1–9))\*\*", text_of(page)
    )
    assert [key for key in named if key not in known] == []


@pytest.mark.parametrize("page", PAGE_FILES, ids=lambda p: p.stem)
def test_python_examples_run(page: Path, desk: Path) -> None:
    for code in re.findall(r"```python\n(.+?)```", text_of(page), re.DOTALL):
        exec(compile(code, page.name, "exec"), {"__name__": "__main__"})


@pytest.mark.parametrize("page", PAGE_FILES, ids=lambda p: p.stem)
def test_commands_run(page: Path, desk: Path) -> None:
    if page.name == "command-line.md":
        pytest.skip("shows how commands are written, not examples")
    lines = re.findall(r"^markermend (.+)$", text_of(page), re.MULTILINE)
    for line in lines:
        words = shlex.split(line, comments=True)
        if words[0] == "diff":
            assert main(["clean", "take.c3d", "-o", "take_clean.c3d", "--no-slow", "--force"]) == 0
        if words[0] == "smooth":
            words.append("--force")
        assert main(words) == 0, line


def test_the_review_file_has_the_name_that_the_manual_says(desk: Path) -> None:
    name = session_path(mm.read(desk / "take.c3d"), "", None).name
    assert f"`{name}`" in text_of(manual_folder() / "files.md")
