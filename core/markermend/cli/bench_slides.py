"""``markermend bench slides``: markers that slide off and stay off."""

from __future__ import annotations

import argparse
from pathlib import Path

import markermend as mm
from markermend.cli.console import Bar, say
from markermend.cli.numbers import add_jobs, add_seed, add_simulations, positive

SUMMARY = "let one marker at a time slide off and stay off, and look for it"


def add_slides(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument("takes", metavar="TAKE", nargs="+", help="recordings in which none has slid")
    p.add_argument(
        "--amplitude",
        metavar="MM",
        nargs="+",
        type=positive,
        default=[10.0, 20.0, 40.0],
        help="how far it slides (default: 10 20 40)",
    )
    add_simulations(p, 8, "per take and amplitude")
    add_seed(p, "slides")
    add_jobs(p)


def run_slides(options: argparse.Namespace) -> int:
    """Simulate, look for them, and print the table."""
    from markermend.bench.slides import slides, slides_table

    takes = {Path(path).stem: mm.read(path) for path in options.takes}
    with Bar() as bar:
        rows = slides(
            takes,
            sizes_mm=options.amplitude,
            simulations=options.simulations,
            seed=options.seed,
            n_jobs=options.jobs,
            progress=bar,
        )
    for line in slides_table(rows):
        say(line)
    return 0
