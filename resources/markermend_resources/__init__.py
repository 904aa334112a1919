"""Data that ships with Markermend: demo take, icons, manual, models; and the way to them."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path


def demo_take() -> Path:
    """Return the demo take, a C3D file: what ``markermend simulate`` makes by default."""
    return _demo("demo.c3d")


def demo_truth() -> Path:
    """Return where the demo take is damaged, in the JSON that ``markermend detect`` writes."""
    return _demo("demo_truth.json")


def manual_folder() -> Path:
    """Return the folder of the manual's pages, Markdown files."""
    return Path(str(files("markermend_resources").joinpath("manual")))


def _demo(name: str) -> Path:
    """A file of the demo folder."""
    return Path(str(files("markermend_resources").joinpath("demo", name)))
