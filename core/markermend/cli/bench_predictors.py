"""``markermend bench predictors``: what predictors leave, and what they let through."""

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
from markermend.cli.numbers import add_jobs, from_one, from_zero

SUMMARY = "compare predictors of a marker: residual, its distribution, what stays of a drift"


def add_predictors(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument("takes", metavar="TAKE", nargs="+", help="clean recordings")
    p.add_argument(
        "--order",
        metavar="L",
        nargs="+",
        type=from_one,
        default=[1, 2, 3, 4, 5],
        help="orders of the polynomial (default: 1 2 3 4 5)",
    )
    p.add_argument(
        "--lags",
        metavar="K",
        nargs="+",
        type=from_zero,
        default=[0, 1, 3, 5],
        help="numbers of former frames (default: 0 1 3 5)",
    )
    p.add_argument(
        "--markers",
        metavar="N",
        type=from_zero,
        default=12,
        help="per take, 0 for all (default: 12)",
    )
    add_jobs(p)
    p.add_argument(
        "--csv", metavar="FILE", help="write all figures as CSV; “-” for standard output"
    )
    p.add_argument("--figures", metavar="FOLDER", help="write the curves as SVG into this folder")
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_predictors(options: argparse.Namespace) -> int:
    """Measure predictors, and show tables and figures."""
    from markermend.bench.predictors import study_predictors
    from markermend.bench.predictors_svg import figure_names, predictor_figures
    from markermend.bench.predictors_text import predictors_csv, predictors_table

    names = {name for path in options.takes for name in figure_names(Path(path).stem)}
    check_figures(options.figures, sorted(names), force=options.force)
    check_outputs([options.csv], source=options.takes, force=options.force)
    takes = {Path(path).stem: mm.read(path) for path in options.takes}
    with Bar() as bar:
        study = study_predictors(
            takes,
            orders=options.order,
            lags=options.lags,
            markers=options.markers,
            n_jobs=options.jobs,
            progress=bar,
        )
    if options.figures is not None:
        write_figures(options.figures, predictor_figures(study))
    if options.csv is not None:
        write_text(options.csv, predictors_csv(study))
    if options.csv != STDOUT:
        for line in predictors_table(study):
            say(line)
    return 0
