"""Write what is made from the code, methods and keys: ``.venv/bin/python docs/generate.py``."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields

from markermend.detectors import DETECTORS, Detector
from markermend.repairs import REPAIRS, Method
from markermend.smoothers import SMOOTHERS, Smoother
from markermend_app.actions.table import ACTIONS
from markermend_resources import manual_folder

PAGE, KEYS = manual_folder() / "methods.md", manual_folder() / "keys.md"
_HEAD = """\
# Methods

Made from the registries by `docs/generate.py`; a test holds it up to date.
"""

_SOURCES = """\
## Sources

- skurowski2022: P. Skurowski, M. Pawlyta, *Detection and Classification of Artifact Distortions in
  Optical Motion Capture Sequences*, 2022
- skurowski2021: P. Skurowski, M. Pawlyta, *Gap Reconstruction in Optical Motion Capture Sequences
  Using Neural Networks*, 2021
- tits2018: M. Tits, J. Tilmanne, T. Dutoit, *Robust and automatic motion-capture data recovery
  using soft skeleton constraints and model averaging*, 2018
- ardestani2022: M. Memar Ardestani, H. Yan, *Noise Reduction in Human Motion-Captured Signals for
  Computer Animation based on B-Spline Filtering*, 2022
"""


def page() -> str:
    """Return the page of all detection, repair and smoothing methods."""
    return "\n".join(
        [
            _HEAD,
            "## Detection",
            "",
            *_sections(DETECTORS.values()),
            "## Repair",
            "",
            "`auto` gives a peak the Kalman smoother, a step with a known counterpart the swap, "
            "and everything else the local regression; where one cannot work, or leaves damage, "
            "the next that can.",
            "",
            *_sections(REPAIRS.values()),
            "## Smoothing",
            "",
            *_sections(SMOOTHERS.values()),
            _SOURCES,
        ]
    )


def _sections(methods: Iterable[Method | Detector | Smoother]) -> list[str]:
    """One section a method: what it does, its source, its parameters."""
    lines: list[str] = []
    for method in (m for m in methods if not m.plugin):
        lines += [f"### `{method.name}` – {method.label}", "", method.summary]
        if method.source:
            lines[-1] += f" Source: {method.source}."
        lines.append("")
        rows = [
            f"| `{f.name}` | {f.default} {f.metadata.get('unit', '')} "
            f"| {f.metadata.get('help', '')} |".replace("  |", " |")
            for f in fields(method.params)
        ]
        if rows:
            lines += ["| parameter | default | |", "|---|---|---|", *rows, ""]
    return lines


def keys() -> str:
    """Return the page of all actions that have keys, by menu."""
    lines = [
        "# Keys",
        "",
        "As Markermend comes; **?** shows yours, changes them, and has presets after Nexus, QTM "
        "and Motive. Everything, also what has no key, is found by **Ctrl+K**.",
    ]
    for menu in dict.fromkeys(a.menu.lstrip("|") for a in ACTIONS):
        rows = [a for a in ACTIONS if a.menu.lstrip("|") == menu and a.keys]
        if rows:
            lines += ["", f"## {menu}", "", "| key | what it does |", "|---|---|"]
            shown = [(" or ".join(f"`{k}`" for k in a.keys), a.text.rstrip("…")) for a in rows]
            lines += [f"| {key} | {text} |" for key, text in shown]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    KEYS.write_text(keys(), encoding="utf-8")
