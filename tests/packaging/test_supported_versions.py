"""What is supported is said in four places, all the same."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
TABLE = (ROOT / "docs" / "supported-versions.md").read_text(encoding="utf-8")
MATRIX = yaml.safe_load((ROOT / ".github/workflows/ci.yml").read_text(encoding="utf-8"))["jobs"][
    "check"
]["strategy"]["matrix"]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_python_versions() -> None:
    stated = re.search(r"\| Python \| (.+) \|", TABLE)
    assert stated is not None
    assert stated[1].split(", ") == MATRIX["python"]
    assert PROJECT["requires-python"] == f">={MATRIX['python'][0]}"


def test_qt_versions() -> None:
    (pin,) = (d for d in PROJECT["optional-dependencies"]["app"] if d.startswith("PySide6"))
    oldest, newest = MATRIX["qt"]
    assert f">={oldest}," in pin
    assert f"<6.{int(newest.split('.')[1]) + 1}" in pin
    assert f"| {oldest} to {newest};" in TABLE


def test_systems() -> None:
    for system in MATRIX["os"]:
        name, version = system.split("-")
        row = next(
            line
            for line in TABLE.splitlines()
            if line.lower().startswith(f"| {'linux' if name == 'ubuntu' else name}")
        )
        assert version in row
