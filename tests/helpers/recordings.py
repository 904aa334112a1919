"""Recordings that experiments on gaps are about."""

from __future__ import annotations

from pathlib import Path

import markermend as mm
from markermend.bench.gaps import only_named


def read_named(name: str, folder: Path) -> mm.Take:
    """Find a take by name anywhere below a folder, and keep its named markers."""
    return only_named(mm.read(next(iter(sorted(folder.rglob(f"{name}.c3d"))))))
