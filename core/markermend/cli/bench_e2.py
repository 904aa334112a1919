"""``markermend bench e2``: detect on raw takes, and hold it against reviewed lists."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

import markermend as mm
from markermend.cli.console import STDOUT, Bar, check_outputs, read_artifacts, say, write_text

if TYPE_CHECKING:
    from markermend.bench.e2 import Reviewed

SUMMARY = "detect on raw takes, compare with reviewed lists, before and after repair"


def add_e2(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument("takes", metavar="TAKE", nargs="+", help="raw recordings")
    p.add_argument(
        "--lists",
        metavar="FOLDER",
        required=True,
        help="what is truly damaged in TAKE, as JSON of “detect” named after it; entries of "
        "a confidence below 0.75 are doubtful",
    )
    p.add_argument(
        "--method",
        metavar="NAME",
        nargs="+",
        default=["joint", "paper"],
        help="detectors (default: joint and paper)",
    )
    p.add_argument("--no-slow", action="store_true", help="skip slow changes")
    p.add_argument(
        "--repair",
        metavar="NAME",
        nargs="*",
        default=[],
        help="also repair what is listed, with each of these methods, and look again",
    )
    p.add_argument(
        "--repaired",
        metavar="FILE",
        nargs="*",
        default=[],
        help="also look at these versions of TAKE that somebody repaired (one TAKE only)",
    )
    p.add_argument("--csv", metavar="FILE", help="write all counts as CSV; “-” for standard output")
    p.add_argument("--figure", metavar="FILE", help="draw the counts as SVG")
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_e2(options: argparse.Namespace) -> int:
    """Detect, compare, and show the counts."""
    from markermend.bench.e2 import e2
    from markermend.bench.e2_text import e2_csv, e2_figure, e2_table
    from markermend.detectors import find_detector
    from markermend.errors import MethodError

    check_outputs(
        [options.csv, options.figure],
        source=[*options.takes, *options.repaired],
        force=options.force,
    )
    if options.repaired and len(options.takes) != 1:
        raise MethodError("--repaired compares with one TAKE; name only that one.")
    takes = [_reviewed(Path(path), Path(options.lists)) for path in options.takes]
    methods = list(dict.fromkeys(options.method))
    params = {name: find_detector(name).params(slow=False) for name in methods if options.no_slow}
    versions = [(Path(path).stem, mm.read(path)) for path in options.repaired]
    for name, take in versions:
        if take.frames != takes[0].take.frames:
            raise MethodError(f"“{name}” has other frames than “{takes[0].name}”.")
    with Bar() as bar:
        rows = e2(
            takes,
            methods=methods,
            params=params,
            repairs=list(dict.fromkeys(options.repair)),
            repaired={takes[0].name: versions},
            progress=bar,
        )
    if options.figure is not None:
        write_text(options.figure, e2_figure(rows))
    if options.csv is not None:
        write_text(options.csv, e2_csv(rows))
    if options.csv != STDOUT:
        for line in e2_table(rows):
            say(line)
    return 0


def _reviewed(path: Path, lists: Path) -> Reviewed:
    """Read a take and its list."""
    from markermend.bench.e2 import Reviewed

    damaged, document = read_artifacts(str(lists / f"{path.stem}.json"))
    complete = float(document.get("complete_from_mm", 0.0))
    return Reviewed(path.stem, mm.read(path), damaged, complete)
