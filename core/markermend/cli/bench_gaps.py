"""``markermend bench gaps``: how far each method is from what was hidden."""

from __future__ import annotations

import argparse
from pathlib import Path

import markermend as mm
from markermend.cli.console import (
    STDOUT,
    Bar,
    check_figures,
    check_outputs,
    say,
    write_figures,
    write_text,
)
from markermend.cli.numbers import add_jobs, add_seed, add_simulations
from markermend.errors import DataError

SUMMARY = "hide pieces of takes, fill them, compare with what was hidden"


def add_gaps(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument("takes", metavar="TAKE", nargs="+", help="recordings with little missing")
    p.add_argument(
        "--method",
        metavar="NAME",
        nargs="+",
        default=["auto", "pma", "spline", "pchip", "linear"],
        help="repair methods (default: auto pma spline pchip linear); skurowski2021 and tits2018 "
        "stand for all that the paper compares",
    )
    p.add_argument(
        "--protocol",
        metavar="NAME",
        nargs="+",
        default=["skurowski2021", "tits2018"],
        help="skurowski2021, tits2018, tits2018-duration, tits2018-count, single, blackout, ends "
        "(default: the first two)",
    )
    p.add_argument("--list", metavar="FILE", help="replay the gaps of this JSON list instead")
    p.add_argument(
        "--reference", metavar="NAME", help="error the list knows, to compare with (such as pma)"
    )
    add_simulations(p, 10, "per take and setting")
    add_seed(p, "gaps")
    add_jobs(p)
    p.add_argument("--csv", metavar="FILE", help="write every case as CSV; “-” for standard output")
    p.add_argument(
        "--measures", action="store_true", help="how single gaps are spread: mean, mode, IQR, AIC…"
    )
    p.add_argument("--by-take", action="store_true", help="those measures for every take by itself")
    p.add_argument(
        "--correlate",
        action="store_true",
        help="what takes are like (entropy, velocity, …), and how the errors of protocol "
        "skurowski2021 go with it",
    )
    p.add_argument("--figures", metavar="FOLDER", help="draw error against gap length as SVG there")
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_gaps(options: argparse.Namespace) -> int:
    """Hide, fill, and show the errors."""
    from markermend.bench.gap_measures import figure_name, figures, measure, measures_table
    from markermend.bench.gap_protocols import draw_cases, named_methods
    from markermend.bench.gaps import only_named, read_cases, replay, summarise
    from markermend.bench.gaps_text import gaps_csv, gaps_table
    from markermend.bench.sequence import correlate, correlate_measures, describe
    from markermend.bench.sequence_text import correlation_tables, sequence_table

    check_outputs([options.csv], source=[*options.takes, options.list], force=options.force)
    takes = {Path(path).stem: only_named(mm.read(path)) for path in options.takes}
    if options.list is not None:
        cases = tuple(c for c in read_cases(options.list) if c.take in takes)
    else:
        cases = tuple(
            case
            for protocol in options.protocol
            for case in draw_cases(
                takes, protocol, simulations=options.simulations, seed=options.seed
            )
        )
    if not cases:
        raise DataError("No gap fits into these takes, or is listed for them; name other takes.")
    drawn = dict.fromkeys(figure_name(case.protocol) for case in cases)
    check_figures(options.figures, drawn, force=options.force)
    # Before the fills, which may take hours: takes that cannot be compared are told at once.
    known = {name: describe(take) for name, take in takes.items()} if options.correlate else {}
    pairs = correlate_measures(known) if options.correlate else ()
    with Bar() as bar:
        methods = named_methods(options.method)
        results = replay(cases, takes, methods, n_jobs=options.jobs, progress=bar)
    if options.csv is not None:
        write_text(options.csv, gaps_csv(results))
    if options.figures is not None:
        write_figures(options.figures, figures(measure(results)))
    if options.csv == STDOUT:
        return 0
    lines = gaps_table(summarise(results, options.reference), options.reference)
    if options.measures:
        lines += ["", *measures_table(measure(results, by_take=options.by_take))]
    if options.correlate:
        alone = [r for r in results if r.case.protocol == "skurowski2021"]
        errors = correlate(measure(alone, by_take=True), known)
        lines += ["", *sequence_table(known), "", *correlation_tables(errors, pairs)]
    for line in lines:
        say(line)
    return 0
