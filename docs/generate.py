"""Write docs/methods.md from the registries: ``.venv/bin/python docs/generate.py``."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from pathlib import Path

from markermend.detectors import DETECTORS, Detector
from markermend.repairs import REPAIRS, Method
from markermend.smoothers import SMOOTHERS, Smoother

PAGE = Path(__file__).with_name("methods.md")
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


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
