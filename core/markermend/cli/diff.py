"""``markermend diff``: what differs between two files, sample, parameter, byte."""

from __future__ import annotations

import argparse
from typing import Any

import markermend as mm
from markermend.cli.console import STDOUT, Bar, check_outputs, count, say, write_json
from markermend.files.diff import Comparison, SampleDifference, compare


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
        "bytes_cut": comparison.bytes_cut,
        "lines": None
        if comparison.lines is None
        else {
            "all": comparison.lines.lines,
            "differing": comparison.lines.differing,
            "runs": [{"start": start, "stop": stop} for start, stop in comparison.lines.runs],
        },
    }


def render(comparison: Comparison, *, most: int = 20) -> str:
    """Tell a comparison in lines of text.

    Parameters
    ----------
    comparison : what differs
    most : entries of each kind that are listed; the rest is counted
    """
    names = comparison.a.name, comparison.b.name
    if comparison.identical:
        return f"{names[0]} and {names[1]} are the same, byte for byte."
    told = comparison.lines
    if told is None:
        how_many = f"{count(comparison.differing_bytes, 'byte')} differ"
    else:
        how_many = f"{told.differing:,} of {count(told.lines, 'line')} differ"
    lines = [f"{names[0]} and {names[1]}: {how_many}."]
    if comparison.sizes[0] != comparison.sizes[1]:
        lines.append(f"They have {comparison.sizes[0]} and {comparison.sizes[1]} bytes.")
    lines += [f"Renamed: {old} → {new}" for old, new in comparison.renamed[:most]]
    if len(comparison.renamed) > most:
        lines.append(f"  … and {len(comparison.renamed) - most} more")
    samples = [_sample_line(s) for s in comparison.samples]
    parameters = [
        f"{p.name}: {'absent' if p.before is None else p.before}"
        f" → {'absent' if p.after is None else p.after}"
        for p in comparison.parameters
    ]
    found = [
        f"{d.start}–{d.stop - 1} ({d.part}, {count(d.stop - d.start, 'byte')})"
        for d in comparison.bytes
    ]
    sections = [("Samples", samples), ("Parameters", parameters)]
    if told is None:
        sections.append(("Bytes", found))
    else:
        sections.append(("Lines", [_line_numbers(*run) for run in told.runs]))
    for title, entries in sections:
        if entries is found and not found and comparison.differing_bytes:
            lines.append("Bytes: not listed, since the files are of different formats")
            continue
        cut = entries is found and comparison.bytes_cut
        lines.append(_cut_title(comparison) if cut else f"{title}: {len(entries) or 'none'}")
        lines += [f"  {entry}" for entry in entries[:most]]
        if len(entries) > most:
            lines.append(f"  … and {'more than ' * cut}{len(entries) - most} more")
    return "\n".join(lines)


def _cut_title(comparison: Comparison) -> str:
    """What stands over runs of bytes that are not all there."""
    return (
        f"Bytes: {comparison.differing_bytes:,} differ in all; only the first"
        f" {len(comparison.bytes):,} runs of them are listed"
    )


def _line_numbers(start: int, stop: int) -> str:
    """Numbers of lines in a row, as editors count them."""
    return f"{start}–{stop - 1}" if stop > start + 1 else f"{start}"


def _sample_line(sample: SampleDifference) -> str:
    """One line for a sample difference."""
    last = sample.stop - 1
    frames = f"frame {last}" if sample.start == last else f"frames {sample.start}–{last}"
    size = f" by up to {sample.largest_mm:.3g} mm" if sample.change == "moved" else ""
    return f"{sample.marker} {sample.axes} {frames}: {sample.change}{size}"
