"""``markermend fill``: fill the gaps and change nothing else."""

from __future__ import annotations

import argparse

import markermend as mm
from markermend.cli.console import (
    Bar,
    check_outputs,
    check_take_output,
    count,
    read_take,
    say,
    written,
)
from markermend.cli.repairing import left_over, listing, seen_again, summary_table
from markermend.outcome import outcomes
from markermend.patch import patched
from markermend.repairs import find_gaps, find_method, repair_all


def run(options: argparse.Namespace) -> int:
    """Fill the gaps of one take."""
    check_outputs([options.output], source=options.take, force=options.force)
    check_take_output(options.output, source=options.take)
    if options.method != "auto":
        find_method(options.method)
    take = read_take(options.take)
    gaps = find_gaps(take)
    longest = take.frames if options.max_gap is None else options.max_gap.frames(take.rate)
    short = [gap for gap in gaps if gap.length <= longest]
    with Bar() as bar:
        pairs = repair_all(
            take, short, method=options.method, mesh=mm.infer_mesh(take), progress=bar
        )
    filled = patched(take, (patch for _, repair in pairs for patch in repair.patches))
    export = mm.write(filled, options.output, as_float=options.float)
    done = outcomes(short, pairs)
    for line in listing(take, done) if options.list else ():
        say(line)
    for line in [*summary_table(done), *seen_again(done), *left_over(done), ""]:
        say(line)
    if len(gaps) > len(short):
        say(f"Longer than asked for and left: {count(len(gaps) - len(short), 'gap')}.")
    for line in written(export):
        say(line)
    return 0
