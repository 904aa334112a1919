"""``markermend convert``: the same take in another format, or a part of it."""

from __future__ import annotations

import argparse

import markermend as mm
from markermend.cli.console import (
    Bar,
    check_outputs,
    check_take_output,
    chosen_frames,
    count,
    read_take,
    say,
)


def run(options: argparse.Namespace) -> int:
    """Convert one take."""
    check_outputs([options.output], source=options.take, force=options.force)
    check_take_output(options.output, source=options.take)
    take = read_take(options.take)
    frames = chosen_frames(take, options)
    with Bar() as bar:
        mm.write(take, options.output, as_float=options.float, frames=frames, progress=bar)
    start, stop = frames or (0, take.frames)
    noun = "joint" if take.skeleton else "marker"
    size = f"{count(take.markers, noun)}, {count(stop - start, 'frame')}"
    say(f"Written: {options.output}, {size} at {take.rate:g} Hz.")
    return 0
