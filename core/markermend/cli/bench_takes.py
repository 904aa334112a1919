"""Clean takes for the experiments, with what is damaged in them already."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import markermend as mm
from markermend.cli.console import read_artifacts
from markermend.errors import MarkermendError

if TYPE_CHECKING:
    from markermend.bench.e1 import Clean


def add_clean_takes(p: argparse.ArgumentParser, number: str = "+") -> None:
    """Add the takes, ``"+"`` or ``"*"`` of them, and what is damaged in them already."""
    p.add_argument("takes", metavar="TAKE", nargs=number, help="clean recordings")
    p.add_argument(
        "--flaws",
        metavar="FOLDER",
        help="what is damaged in TAKE already, as JSON of “detect” named after it; left out",
    )


def clean_takes(paths: Iterable[str], flaws: str | None) -> list[Clean]:
    """Read takes, and from a folder of JSON files named after them what is damaged in them."""
    from markermend.bench.e1 import Clean

    if flaws and not Path(flaws).is_dir():
        raise MarkermendError(f"There is no folder “{flaws}” of flaws; check its name.")
    takes = []
    for path in map(Path, paths):
        listed = Path(flaws) / f"{path.stem}.json" if flaws else None
        known = read_artifacts(str(listed))[0] if listed and listed.exists() else ()
        takes.append(Clean(path.stem, mm.read(path), known))
    return takes
