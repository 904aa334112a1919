"""Bring the translations up to date: ``python docs/translate.py``.

Reads every string of the application into ``translations/*.ts``, where what is new stands as
unfinished, and makes the ``*.qm`` files that the application loads. Translate with Qt Linguist
(``pyside6-linguist``) or any editor, and run it again.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from dataclasses import fields
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "resources" / "markermend_resources" / "translations"
for source in ("core", "app", "resources"):
    sys.path.insert(0, str(ROOT / source))


def table_strings() -> list[str]:
    """What is translated from tables rather than where it is written."""
    from markermend.repairs import REPAIRS
    from markermend.smoothers import SMOOTHERS
    from markermend_app import detection, method_words, report_words, telling
    from markermend_app.actions import joints, synonyms
    from markermend_app.actions import table as actions
    from markermend_app.dialogs import params_form
    from markermend_app.panels.inspector import artifact_text
    from markermend_app.panels.plots import quantity as plot_quantity
    from markermend_app.style import theme

    found = list(theme.KIND_NAME.values())
    found += [name.lower() for name in theme.KIND_NAME.values()]
    for spec in actions.ACTIONS:
        found += [spec.text, spec.tip or spec.text.rstrip("…"), *spec.menu.lstrip("|").split("/")]
    found += [text for texts in joints.TEXTS.values() for text in texts]
    found += method_words.SUMMARIES.values()
    found += synonyms.SYNONYMS.values()
    for method in (*REPAIRS.values(), *SMOOTHERS.values()):
        found += [method.label, method.summary]
    for smoother in SMOOTHERS.values():
        for field in fields(smoother.params):
            found += [params_form.words(field.name), field.metadata.get("help", "")]
    for quantity in plot_quantity.QUANTITIES.values():
        found += [quantity.title, quantity.meaning]
    found += [*artifact_text.STATUS_NAME.values(), *detection.DIALS, *telling.FORMS]
    found += report_words.FORMS
    return list(dict.fromkeys(text for text in found if text))


def tool(name: str) -> str:
    """A program of PySide6, beside this Python."""
    return str(Path(sys.executable).with_name(name + (".exe" if os.name == "nt" else "")))


def finished(ts: str) -> dict[tuple[str | None, str | None], str | None]:
    """What the text of a translation file says of each string, by class and string."""
    return {
        (context.findtext("name"), message.findtext("source")): message.findtext("translation")
        for context in ET.fromstring(ts).findall("context")
        for message in context.findall("message[translation]")
        if message.find("translation[@type]") is None
    }


def keep_moved(before: str, now: str) -> str:
    """Take strings that only moved to another class for translated: lupdate doubts them."""
    asked = {
        (context.findtext("name"), message.findtext("source"))
        for context in ET.fromstring(now).findall("context")
        for message in context.findall("message")
    }
    gone = {(key[1], text) for key, text in finished(before).items() if key not in asked}

    def kept(found: re.Match[str]) -> str:
        source, text = (ET.fromstring(f"<t>{part}</t>").text for part in found.group(2, 3))
        return f"{found[1]}<translation>{found[3]}" if (source, text) in gone else found[0]

    doubted = r'(<source>([^<]*)</source>\s*)<translation type="unfinished">([^<]+)'
    return re.sub(doubted, kept, now)


def update(ts: Path) -> None:
    """Read the strings of the application into a translation file."""
    before = ts.read_text(encoding="utf-8")
    files = sorted((ROOT / "app").rglob("*.py"))
    with tempfile.TemporaryDirectory() as name:
        table = Path(name) / "tables.py"
        lines = [f"QCoreApplication.translate({''!r}, {text!r})" for text in table_strings()]
        table.write_text("\n".join(lines), encoding="utf-8")
        listed = Path(name) / "files.lst"
        listed.write_text("\n".join(map(str, [*files, table])), encoding="utf-8")
        options = ["-locations", "none", "-no-obsolete", "-tr-function-alias", "tr+=_tr"]
        command = [tool("pyside6-lupdate"), *options, f"@{listed}", "-ts", str(ts)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    ts.write_text(keep_moved(before, ts.read_text(encoding="utf-8")), encoding="utf-8")


def main() -> int:
    """Update and compile every translation there is."""
    for ts in sorted(FOLDER.glob("*.ts")):
        update(ts)
        unfinished = ts.read_text(encoding="utf-8").count('type="unfinished"')
        command = [tool("pyside6-lrelease"), "-silent", str(ts), "-qm", str(ts.with_suffix(".qm"))]
        subprocess.run(command, check=True)
        print(f"{ts.name}: {unfinished} strings are not translated yet")
    return 0


if __name__ == "__main__":
    sys.exit(main())
