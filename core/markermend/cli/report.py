"""``markermend report``: what the review of a take came to, as a page and as JSON."""

from __future__ import annotations

import argparse
from pathlib import Path

import markermend as mm
from markermend.cli.console import STDOUT, check_outputs, count, say, write_json, write_text
from markermend.errors import MarkermendError
from markermend.outcome import cleaned_document
from markermend.report import review_report, reviewed
from markermend.review.file import read_review


def run(options: argparse.Namespace) -> int:
    """Report on the review saved beside a take; the review itself is only read."""
    check_outputs([options.output, options.json], source=options.take, force=options.force)
    session = read_review(mm.read(options.take))
    name = Path(options.take).name
    if not session.history:
        raise MarkermendError(
            f"There is no review of “{name}”; review it in the window first, or clean it with "
            "“markermend clean --report”."
        )
    review = reviewed(session)
    write_text(options.output, review_report(review, name=name))
    if options.json is not None:
        described = cleaned_document(
            review.before,
            review.done,
            review.method,
            mm.__version__,
            name=name,
            region=review.region,
        )
        about = {"pace": review.pace.to_dict(), "by_hand": list(review.by_hand)}
        write_json(options.json, described | about)
    if STDOUT not in (options.output, options.json):
        say(f"{review.pace.decided:,} of {count(review.pace.total, 'artifact')} decided.")
        say(f"Report: {options.output}")
    return 0
