"""``markermend simulate``: a synthetic performer, damaged, with the truth beside it."""

from __future__ import annotations

import argparse
from pathlib import Path

import markermend as mm
from markermend.artifact_json import document
from markermend.cli.console import (
    STDOUT,
    Bar,
    check_outputs,
    check_take_output,
    count,
    say,
    write_json,
)
from markermend.cli.detect import summary


def run(options: argparse.Namespace) -> int:
    """Simulate one take."""
    check_outputs([options.output, options.truth], source=None, force=options.force)
    check_take_output(options.output)
    with Bar() as bar:
        take, truth = mm.simulate(
            duration_s=options.duration,
            rate=options.rate,
            seed=options.seed,
            height_m=options.height,
            damaged=not options.clean,
            progress=bar,
        )
    mm.write(take, options.output)
    if options.truth is not None:
        name = Path(options.output).name
        write_json(options.truth, document(take, truth, "truth", mm.__version__, name=name))
    if options.truth != STDOUT:
        say(
            f"Written: {options.output}, {count(take.markers, 'marker')}, "
            f"{take.duration_s:g} s at {take.rate:g} Hz."
        )
        say("Undamaged." if options.clean else f"Damage: {summary(truth)}")
    return 0
