"""``markermend bench centres``: joint centres from markers, where the joints are known."""

from __future__ import annotations

import argparse

from markermend.cli.console import STDOUT, Bar, check_outputs, say, write_text
from markermend.cli.numbers import add_seed, add_simulations, positive

SUMMARY = "find the joint centres of simulated performers, and compare with where they are"


def add_centres(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    add_simulations(p, 10, "performers")
    p.add_argument(
        "--duration",
        metavar="S",
        type=positive,
        default=40.0,
        help="seconds that each of them moves (default: 40)",
    )
    add_seed(p, "performers")
    p.add_argument(
        "--csv", metavar="FILE", help="write every joint as CSV; “-” for standard output"
    )
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_centres(options: argparse.Namespace) -> int:
    """Simulate, find, and print the table."""
    from markermend.bench.centres import centres, centres_csv, centres_table

    check_outputs([options.csv], source=None, force=options.force)
    with Bar() as bar:
        rows = centres(
            simulations=options.simulations,
            duration_s=options.duration,
            seed=options.seed,
            progress=bar,
        )
    if options.csv is not None:
        write_text(options.csv, centres_csv(rows))
    if options.csv != STDOUT:
        for line in centres_table(rows):
            say(line)
    return 0
