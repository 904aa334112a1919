"""``markermend bench constraints``: whether those of model averaging pay."""

from __future__ import annotations

import argparse
from pathlib import Path

import markermend as mm
from markermend.cli.console import Bar, say
from markermend.cli.numbers import add_jobs, add_seed, add_simulations

SUMMARY = "model averaging with its constraints on and off, on the same gaps, with a t-test"


def add_constraints(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument("takes", metavar="TAKE", nargs="+", help="recordings with little missing")
    add_simulations(p, 10, "per take and setting")
    add_seed(p, "gaps")
    add_jobs(p)


def run_constraints(options: argparse.Namespace) -> int:
    """Hide, fill both ways, and show what the difference is worth."""
    from markermend.bench.constraints import compare_constraints, constraints_table
    from markermend.bench.gaps import only_named

    takes = {Path(path).stem: only_named(mm.read(path)) for path in options.takes}
    with Bar() as bar:
        rows = compare_constraints(
            takes,
            simulations=options.simulations,
            seed=options.seed,
            n_jobs=options.jobs,
            progress=bar,
        )
    for line in constraints_table(rows):
        say(line)
    return 0
