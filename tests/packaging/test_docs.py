"""The pages people read, held to the code."""

from __future__ import annotations

import importlib
import importlib.util
import re
from pathlib import Path

import pytest

import markermend as mm
from markermend import errors
from markermend.cli.parser import COMMANDS
from markermend_resources import manual_folder

ROOT = Path(__file__).resolve().parents[2]
PAGES = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]


def test_pages_made_from_the_code_are_up_to_date() -> None:
    spec = importlib.util.spec_from_file_location("docs_generate", ROOT / "docs" / "generate.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.PAGE.read_text(encoding="utf-8") == module.page(), "run docs/generate.py"
    assert module.KEYS.read_text(encoding="utf-8") == module.keys(), "run docs/generate.py"


def test_every_command_is_documented() -> None:
    text = (manual_folder() / "command-line.md").read_text(encoding="utf-8")
    assert [c for c in COMMANDS if not re.search(rf"markermend \[?{c}\b", text)] == []


def test_every_public_name_is_in_the_reference() -> None:
    text = (ROOT / "docs" / "sphinx" / "api.md").read_text(encoding="utf-8")
    named = {
        name.rpartition(".")[2] for name in re.findall(r"auto(?:function|class):: (\S+)", text)
    }
    # Errors are there as one module.
    named |= {name for name in dir(errors) if name[0].isupper()}
    assert set(mm.__all__) - named == set()


def test_every_name_in_the_reference_is_there() -> None:
    text = (ROOT / "docs" / "sphinx" / "api.md").read_text(encoding="utf-8")
    for name in re.findall(r"auto(?:function|class):: (\S+)", text):
        room, _, thing = name.rpartition(".")
        assert getattr(importlib.import_module(room), thing).__doc__, name


def headings(page: Path) -> set[str]:
    """Names by which links reach the headings of a page."""
    found = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in found}


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)]+)\)", page.read_text(encoding="utf-8")):
        if target.startswith("https://"):
            continue
        name, _, heading = target.partition("#")
        other = page.parent / name if name else page
        assert other.exists(), target
        assert not heading or heading in headings(other), target
