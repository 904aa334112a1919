"""``markermend bench faults``: joints that a sensor has wrong without saying so."""

from __future__ import annotations

import argparse

from markermend.cli.console import STDOUT, Bar, check_outputs, say, write_text
from markermend.cli.numbers import add_seed
from markermend.cli.recordings import read_by_name

SUMMARY = "break clean skeleton recordings without a word, find what is wrong, restore"


def add_faults(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument(
        "poses",
        metavar="POSE",
        nargs="+",
        help="clean recordings of two people or more; names begin with the person (01_05.amc)",
    )
    add_seed(p, "faults", 1)
    p.add_argument("--csv", metavar="FILE", help="write all counts as CSV; “-” for standard output")
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_faults(options: argparse.Namespace) -> int:
    """Break, restore, and print the tables."""
    from markermend.bench.faults import faults_csv, faults_table, find_faults

    check_outputs([options.csv], source=options.poses, force=options.force)
    poses = read_by_name(options.poses)
    with Bar() as bar:
        rows = find_faults(poses, seed=options.seed, progress=bar)
    if options.csv is not None:
        write_text(options.csv, faults_csv(rows))
    if options.csv != STDOUT:
        for line in faults_table(rows):
            say(line)
    return 0
