"""``markermend bench training``: what networks make of less and of more of a take."""

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
from markermend.cli.numbers import add_seed, add_simulations, from_one, positive

SUMMARY = "fill the same gaps with networks that learnt from less and from more of a take"


def add_training(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument("takes", metavar="TAKE", nargs="+", help="recordings with little missing")
    p.add_argument(
        "--method",
        metavar="NAME",
        nargs="+",
        default=["ffnn_lin", "ffnn_tanh", "lstm", "gru", "bilstm"],
        help="repair methods (default: ffnn_lin ffnn_tanh lstm gru bilstm; the last three need "
        "the extra “deep”)",
    )
    p.add_argument(
        "--length",
        metavar="N",
        nargs="+",
        type=from_one,
        default=[10, 20, 50, 100, 200],
        help="mean lengths of the gaps, in frames at 100 Hz (default: 10 20 50 100 200)",
    )
    p.add_argument(
        "--train",
        metavar="S",
        nargs="+",
        type=positive,
        default=[4.0, 8.0, 16.0, 32.0],
        help="seconds to learn from (default: 4 8 16 32)",
    )
    add_simulations(p, 10, "gaps for each length")
    add_seed(p, "gaps")
    p.add_argument("--csv", metavar="FILE", help="write all rows as CSV; “-” for standard output")
    p.add_argument("--figures", metavar="FOLDER", help="write the curves as SVG into this folder")
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_training(options: argparse.Namespace) -> int:
    """Learn, fill, and show table and figures."""
    from markermend.bench.gaps import only_named
    from markermend.bench.training import study_training
    from markermend.bench.training_text import (
        figure_names,
        training_csv,
        training_figures,
        training_table,
    )

    stems = [Path(path).stem for path in options.takes]
    names = [name for stem in stems for name in figure_names(stem, options.length)]
    check_figures(options.figures, names, force=options.force)
    check_outputs(
        [options.csv], source=[*options.takes, *(options.train or ())], force=options.force
    )
    takes = {Path(path).stem: only_named(mm.read(path)) for path in options.takes}
    with Bar() as bar:
        rows = study_training(
            takes,
            methods=options.method,
            lengths=options.length,
            train_s=sorted(options.train),
            simulations=options.simulations,
            seed=options.seed,
            progress=bar,
        )
    if options.figures is not None:
        write_figures(options.figures, training_figures(rows))
    if options.csv is not None:
        write_text(options.csv, training_csv(rows))
    if options.csv != STDOUT:
        for line in training_table(rows):
            say(line)
    return 0
