"""``markermend bench e3``: damage, detect, reconstruct, and what is left of the damage."""

from __future__ import annotations

import argparse

from markermend.cli.bench_takes import add_clean_takes, clean_takes
from markermend.cli.console import STDOUT, Bar, check_outputs, say, write_text
from markermend.cli.numbers import add_jobs, add_seed, add_simulations, positive, share

SUMMARY = "contaminate clean takes, detect, reconstruct, compare with what was there"


def add_e3(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    add_clean_takes(p)
    p.add_argument(
        "--method",
        metavar="NAME",
        nargs="*",
        default=["paper", "joint"],
        help="detectors beside perfect classification (default: paper and joint)",
    )
    p.add_argument("--no-slow", action="store_true", help="detectors do not look for slow changes")
    p.add_argument(
        "--repair",
        metavar="NAME",
        nargs="+",
        default=["linear", "savgol", "spline", "ffnn", "auto"],
        help="reconstructions (default: linear savgol spline ffnn auto)",
    )
    p.add_argument(
        "--kind",
        metavar="NAME",
        nargs="+",
        default=["peak", "noise", "step", "slow"],
        help="classes of damage, one at a time (default: peak noise step slow)",
    )
    p.add_argument(
        "--share",
        metavar="P",
        nargs="+",
        type=share,
        default=[0.05, 0.1, 0.2],
        help="damaged share of the frames (default: 0.05 0.1 0.2)",
    )
    p.add_argument(
        "--amplitude",
        metavar="MM",
        type=positive,
        default=10.0,
        help="mean amplitude (default: 10)",
    )
    p.add_argument(
        "--all-classes",
        action="store_true",
        help="reconstruct all that detectors flag, not only what they call the class planted",
    )
    add_simulations(p, 200, "per setting")
    add_seed(p, "result")
    add_jobs(p)
    p.add_argument("--csv", metavar="FILE", help="write all rows as CSV; “-” for standard output")
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_e3(options: argparse.Namespace) -> int:
    """Contaminate, detect, reconstruct, and show the errors."""
    from markermend.bench.e3 import e3
    from markermend.bench.e3_text import e3_csv, e3_table
    from markermend.detectors import find_detector

    check_outputs([options.csv], source=options.takes, force=options.force)
    detectors = list(dict.fromkeys(options.method))
    params = {
        name: find_detector(name).params(slow=False, jobs=1)
        for name in detectors
        if options.no_slow
    }
    with Bar() as bar:
        rows = e3(
            clean_takes(options.takes, options.flaws),
            detectors=detectors,
            params=params,
            repairers=list(dict.fromkeys(options.repair)),
            kinds=options.kind,
            shares=options.share,
            amplitude_mm=options.amplitude,
            all_classes=options.all_classes,
            simulations=options.simulations,
            seed=options.seed,
            n_jobs=options.jobs,
            progress=bar,
        )
    if options.csv is not None:
        write_text(options.csv, e3_csv(rows))
    if options.csv != STDOUT:
        for line in e3_table(rows):
            say(line)
    return 0
