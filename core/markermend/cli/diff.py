"""``markermend diff``: what differs between two files, sample, parameter, byte."""

from __future__ import annotations

import argparse
from typing import Any

import markermend as mm
from markermend.cli.console import STDOUT, Bar, check_outputs, say, write_json
from markermend.files.diff import Comparison, compare, render


def run(options: argparse.Namespace) -> int:
    """Compare two files."""
    check_outputs([options.json], source=options.take, force=options.force)
    check_outputs([options.json], source=options.other, force=options.force)
    with Bar() as bar:
        comparison = compare(options.take, options.other, progress=bar)
    if options.json is not None:
        write_json(options.json, to_dict(comparison))
    if options.json != STDOUT:
        say(render(comparison))
    return 0


def to_dict(comparison: Comparison) -> dict[str, Any]:
    """Turn a comparison into plain values for JSON.

    Sample differences are in the files' own frame numbers, ``stop`` not included; byte runs are
    half-open too.
    """
    return {
        "files": [comparison.a.name, comparison.b.name],
        "version": mm.__version__,
        "identical": comparison.identical,
        "sizes": list(comparison.sizes),
        "differing_bytes": comparison.differing_bytes,
        "renamed": [{"before": old, "after": new} for old, new in comparison.renamed],
        "samples": [
            {
                "marker": s.marker,
                "axes": s.axes,
                "start": int(s.start),
                "stop": int(s.stop),
                "change": s.change,
                "largest_mm": float(s.largest_mm),
            }
            for s in comparison.samples
        ],
        "parameters": [
            {"name": p.name, "before": p.before, "after": p.after} for p in comparison.parameters
        ],
        "bytes": [
            {"start": int(b.start), "stop": int(b.stop), "part": b.part} for b in comparison.bytes
        ],
    }
