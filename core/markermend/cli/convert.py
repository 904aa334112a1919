"""``markermend convert``: the same take in another format."""

from __future__ import annotations

import argparse

import markermend as mm
from markermend.cli.console import Bar, check_outputs, check_take_output, count, read_take, say


def run(options: argparse.Namespace) -> int:
    """Convert one take."""
    check_outputs([options.output], source=options.take, force=options.force)
    check_take_output(options.output, source=options.take)
    take = read_take(options.take)
    with Bar() as bar:
        mm.write(take, options.output, as_float=options.float, progress=bar)
    noun = "joint" if take.skeleton else "marker"
    size = f"{count(take.markers, noun)}, {count(take.frames, 'frame')}"
    say(f"Written: {options.output}, {size} at {take.rate:g} Hz.")
    return 0
