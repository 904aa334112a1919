"""``markermend fill``: fill the gaps and change nothing else."""

from __future__ import annotations

import argparse
from typing import Any

import markermend as mm
from markermend.artifact import within
from markermend.cli.console import (
    Bar,
    check_outputs,
    check_take_output,
    chosen_frames,
    count,
    read_take,
    say,
    written,
)
from markermend.cli.recordings import heed_prior
from markermend.cli.repairing import left_over, listing, seen_again, summary_table
from markermend.cli.settings import settings_of
from markermend.errors import MethodError
from markermend.outcome import outcomes
from markermend.parameters import read_params
from markermend.patch import patched
from markermend.repairs import find_gaps, find_method, repair_all


def run(options: argparse.Namespace) -> int:
    """Fill the gaps of one take."""
    check_outputs([options.output], source=options.take, force=options.force)
    check_take_output(options.output, source=options.take)
    params = _params(options)
    take = read_take(options.take)
    heed_prior(take, options.prior)
    frames = chosen_frames(take, options)
    gaps = find_gaps(take) if frames is None else within(find_gaps(take), frames)
    longest = take.frames if options.max_gap is None else options.max_gap.frames(take.rate)
    short = [gap for gap in gaps if gap.length <= longest]
    with Bar() as bar:
        pairs = repair_all(
            take,
            short,
            method=options.method,
            mesh=mm.infer_mesh(take),
            params=params,
            progress=bar,
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


def _params(options: argparse.Namespace) -> Any:
    """Parameters of the method named, None where nothing is set."""
    if options.method != "auto":
        method = find_method(options.method)
        given = settings_of(method.params, options.set)
        return read_params(method, None, given) if given else None
    if options.set:
        raise MethodError("--set needs the method whose parameter it is; name it by --method.")
    return None
