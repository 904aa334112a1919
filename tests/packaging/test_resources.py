"""What ships is used."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_every_icon_is_named_in_the_code() -> None:
    sources = (path for room in ("core", "app") for path in (ROOT / room).rglob("*.py"))
    code = "".join(path.read_text(encoding="utf-8") for path in sources)
    icons = (ROOT / "resources" / "markermend_resources" / "icons").glob("*.svg")
    assert [i.name for i in icons if f'"{i.stem}"' not in code and i.name not in code] == []
