"""``markermend clean``: detect, repair, and write the repaired take."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import markermend as mm
from markermend.artifact import repair_in_words, within
from markermend.cli.console import (
    STDOUT,
    Bar,
    check_outputs,
    check_take_output,
    chosen_frames,
    read_artifacts,
    read_take,
    say,
    write_json,
    write_text,
    written,
)
from markermend.cli.detect import find, summary
from markermend.cli.detection import choose, refuse_choice
from markermend.cli.recordings import heed_prior
from markermend.cli.repairing import left_over, listing, seen_again, summary_table
from markermend.errors import DataError, ExportError
from markermend.outcome import cleaned_document, outcomes
from markermend.patch import patched
from markermend.progress import part
from markermend.repairs import find_method, repair_all


def run(options: argparse.Namespace) -> int:
    """Clean one take."""
    _check(options)
    listed = None if options.artifacts is None else read_artifacts(options.artifacts)
    chosen = choose(options)
    take = read_take(options.take)
    heed_prior(take, options.prior)
    if listed is not None:
        _check_list(options.artifacts, listed[1], take)
    frames = chosen_frames(take, options)
    with Bar() as bar:
        bar(0.0, "Working out the body")
        mesh = mm.infer_mesh(take)
        if listed is None:
            found, method = find(take, mesh, options, chosen, part(bar, 0.0, 0.8)), chosen[0]
        else:
            found, method = listed[0], str(listed[1].get("method", ""))
        # What lies elsewhere is left, but damage is no evidence.
        everything = tuple(found)
        found = everything if frames is None else within(everything, frames)
        pairs = repair_all(
            take,
            found,
            others=everything,
            method=options.method,
            min_confidence=options.min_confidence,
            mesh=mesh,
            progress=part(bar, 0.8, 1.0),
        )
    clean = patched(take, (patch for _, repair in pairs for patch in repair.patches))
    export = mm.write(
        clean,
        options.output,
        as_float=options.float,
        record=[repair_in_words(take, a, r.method) for a, r in pairs if r.patches]
        if options.record
        else (),
        mark_outputs=options.mark_outputs,
    )
    done, name = outcomes(found, pairs, options.min_confidence), Path(options.take).name
    if options.json is not None:
        described = cleaned_document(take, done, method, mm.__version__, name=name, region=frames)
        write_json(options.json, described)
    if options.report is not None:
        from markermend.report import take_report

        page = take_report(take, clean, done, method=method, name=name, region=frames)
        write_text(options.report, page)
    if STDOUT not in (options.json, options.report):
        for line in listing(take, done) if options.list else ():
            say(line)
        say(summary([o.artifact for o in done], part=frames is not None))
        for line in [
            *summary_table(done),
            *seen_again(done),
            *left_over(done),
            "",
            *written(export),
        ]:
            say(line)
    return 0


def _check_list(path: str, listed: dict[str, Any], take: mm.Take) -> None:
    """Refuse a list of artifacts that says it is about another take."""
    for key, word in (("frames", "frames"), ("rate", "Hz")):
        said, there = listed.get(key), getattr(take, key)
        if isinstance(said, int | float) and not math.isclose(said, there, rel_tol=1e-9):
            raise DataError(
                f"“{path}” lists artifacts of a take of {said} {word}, and this one has {there};"
                " name the list that belongs to it."
            )


def _check(options: argparse.Namespace) -> None:
    """Refuse, before any work is done, what cannot be written or would have no effect."""
    outputs = [options.output, options.json, options.report]
    read = options.take if options.artifacts is None else (options.take, options.artifacts)
    check_outputs(outputs, source=read, force=options.force)
    check_take_output(options.output, source=options.take)
    if options.method != "auto":
        find_method(options.method)
    if options.artifacts is not None:
        refuse_choice(options, "--artifacts lists what is repaired")
    if Path(options.output).suffix.lower() != ".c3d" and (options.record or options.mark_outputs):
        raise ExportError(
            f"Only a C3D has room for what --record and --mark-outputs write; leave them out, or"
            f" write “{Path(options.output).with_suffix('.c3d').name}”."
        )
