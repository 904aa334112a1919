"""``markermend batch``: clean many takes alike, and go on after a crash."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import markermend as mm
from markermend.batch import BatchResult, Recipe, find_takes, read_recipe, run_batch
from markermend.batch.run import RECIPE, REPORT, REVIEW
from markermend.cli.batch_progress import JsonLines, Lines
from markermend.cli.console import count, say, warn


def run(options: argparse.Namespace) -> int:
    """Clean all takes; what fails is told and passed over."""
    recipe = _recipe(options)
    takes = find_takes(options.takes, leave_out=options.output)
    as_json = options.progress == "json"
    with JsonLines() if as_json else Lines() as show:
        result = run_batch(
            takes,
            options.output,
            recipe,
            jobs=options.jobs,
            cluster=options.cluster,
            resume=options.resume,
            force=options.force,
            listener=show,
        )
        if isinstance(show, JsonLines):
            show.finished(result)
    if not as_json:
        _tell(result, options.output)
    return 1 if result.failures else 0


def _recipe(options: argparse.Namespace) -> Recipe:
    """The recipe named, or that of the run which is resumed, or the defaults."""
    path = options.recipe
    before = Path(options.output) / RECIPE
    if path is None and options.resume and before.exists():
        path = before
    recipe = Recipe() if path is None else read_recipe(path)
    if recipe.version != mm.__version__:
        warn(
            f"The recipe is of Markermend {recipe.version}, this is {mm.__version__}: "
            "results may differ."
        )
    recipe = replace(recipe, version=mm.__version__)
    if options.min_confidence is not None:
        recipe = replace(recipe, min_confidence=options.min_confidence)
    if options.prior is not None:
        recipe = replace(recipe, prior=options.prior)
    return recipe


def _tell(result: BatchResult, folder: str) -> None:
    """Sum the batch up in a few lines."""
    before = f", {result.skipped} of them before" if result.skipped else ""
    say(f"{count(len(result.takes), 'take')} cleaned{before}.")
    mended = sum(sum(q.repaired.values()) for q in result.takes.values())
    say(f"{count(mended, 'artifact')} repaired, {result.review:,} for review.")
    if result.failures:
        say(f"{count(len(result.failures), 'take')} failed; --resume tries them again.")
    say(f"Report: {Path(folder) / REPORT}")
    if result.review:
        say(f"To be reviewed: {Path(folder) / REVIEW}")
