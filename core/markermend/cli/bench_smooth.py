"""``markermend bench smooth``: the published tables again, and smoothing against a known truth."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

import markermend as mm
from markermend.cli.console import STDOUT, Bar, check_outputs, say, write_text
from markermend.cli.numbers import add_seed, from_one, positive

if TYPE_CHECKING:
    from markermend.bench.smooth import Truth

SUMMARY = "rerun the published tables, and smooth noisy takes whose truth is known"


def add_smooth(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument(
        "takes",
        metavar="TAKE",
        nargs="*",
        help="recordings to smooth hard and make noisy again, beside two simulated ones",
    )
    p.add_argument("--amc", metavar="FILE", nargs="+", help="motions whose hips to smooth as well")
    only = p.add_mutually_exclusive_group()
    only.add_argument("--published", action="store_true", help="the published tables only")
    only.add_argument(
        "--bands",
        action="store_true",
        help="only whether error bands hold nine in ten errors, at rest and in motion",
    )
    p.add_argument(
        "--noise",
        metavar="MM",
        nargs="+",
        type=positive,
        default=[0.3, 1.0, 3.0],
        help="root mean square of the noise (default: 0.3 1 3)",
    )
    p.add_argument(
        "--markers", metavar="N", type=from_one, default=12, help="per take (default: 12)"
    )
    add_seed(p, "result")
    p.add_argument("--csv", metavar="FILE", help="write errors as CSV; “-” for standard output")
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_smooth(options: argparse.Namespace) -> int:
    """Smooth, and show how smooth or how far off the results are."""
    from markermend.bench.smooth import compare
    from markermend.bench.smooth_bands import bands_csv, bands_table, hold
    from markermend.bench.smooth_paper import kick_rows, read_root, sine_rows
    from markermend.bench.smooth_text import paper_table, smooth_csv, truth_table

    check_outputs([options.csv], source=[*options.takes, *(options.amc or ())], force=options.force)
    lines: list[str] = []
    if not options.bands:
        published = list(sine_rows(seed=options.seed))
        if options.amc:
            published += kick_rows([read_root(path) for path in options.amc])
        lines += paper_table(published)
    if not options.published:
        truths = _truths(options)
        with Bar() as bar:
            if options.bands:
                held = hold(truths, noises_mm=options.noise, seed=options.seed, progress=bar)
                text, more = bands_csv(held), bands_table(held)
            else:
                rows = compare(truths, noises_mm=options.noise, seed=options.seed, progress=bar)
                text, more = smooth_csv(rows), truth_table(rows)
        lines += more
        if options.csv is not None:
            write_text(options.csv, text)
    if options.csv != STDOUT:
        for line in lines:
            say(line)
    return 0


def _truths(options: argparse.Namespace) -> list[Truth]:
    """Two simulated trajectories, and the takes named."""
    from markermend.bench.smooth import hard_smoothed, kick, performer

    n = max(1, options.markers)
    takes = [hard_smoothed(mm.read(path), Path(path).stem, n) for path in options.takes]
    return [kick(markers=n), performer(markers=n), *takes]
