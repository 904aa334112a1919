"""Options of the experiments of ``markermend bench``."""

from __future__ import annotations

import argparse

from markermend.cli.bench_blind import SUMMARY as BLIND
from markermend.cli.bench_blind import add_blind
from markermend.cli.bench_centres import SUMMARY as CENTRES
from markermend.cli.bench_centres import add_centres
from markermend.cli.bench_constraints import SUMMARY as CONSTRAINTS
from markermend.cli.bench_constraints import add_constraints
from markermend.cli.bench_e2 import SUMMARY as E2
from markermend.cli.bench_e2 import add_e2
from markermend.cli.bench_e3 import SUMMARY as E3
from markermend.cli.bench_e3 import add_e3
from markermend.cli.bench_faults import SUMMARY as FAULTS
from markermend.cli.bench_faults import add_faults
from markermend.cli.bench_gaps import SUMMARY as GAPS
from markermend.cli.bench_gaps import add_gaps
from markermend.cli.bench_pose import SUMMARY as POSE
from markermend.cli.bench_pose import add_pose
from markermend.cli.bench_predictors import SUMMARY as PREDICTORS
from markermend.cli.bench_predictors import add_predictors
from markermend.cli.bench_slides import SUMMARY as SLIDES
from markermend.cli.bench_slides import add_slides
from markermend.cli.bench_smooth import SUMMARY as SMOOTH
from markermend.cli.bench_smooth import add_smooth
from markermend.cli.bench_takes import add_clean_takes
from markermend.cli.bench_training import SUMMARY as TRAINING
from markermend.cli.bench_training import add_training
from markermend.cli.numbers import add_jobs, add_seed, add_simulations, from_zero, positive, share

EXPERIMENTS = {
    "blind": BLIND,
    "centres": CENTRES,
    "e1": "contaminate clean takes, detect, compare by sample and by event",
    "e2": E2,
    "e3": E3,
    "faults": FAULTS,
    "gaps": GAPS,
    "pose": POSE,
    "predictors": PREDICTORS,
    "slides": SLIDES,
    "smooth": SMOOTH,
    "constraints": CONSTRAINTS,
    "training": TRAINING,
}


def add_experiments(parser: argparse.ArgumentParser) -> None:
    """Give ``bench`` a command for each experiment."""
    adders = {
        "blind": add_blind,
        "centres": add_centres,
        "e1": _add_e1,
        "e2": add_e2,
        "e3": add_e3,
        "faults": add_faults,
        "gaps": add_gaps,
        "pose": add_pose,
        "predictors": add_predictors,
        "slides": add_slides,
        "smooth": add_smooth,
        "constraints": add_constraints,
        "training": add_training,
    }
    names = parser.add_subparsers(dest="experiment", metavar="NAME", required=True)
    for name, summary in EXPERIMENTS.items():
        adders[name](
            names.add_parser(name, help=summary, description=f"{summary[0].upper()}{summary[1:]}.")
        )


def _add_e1(p: argparse.ArgumentParser) -> None:
    add_clean_takes(p)
    p.add_argument(
        "--method",
        metavar="NAME",
        nargs="+",
        default=["joint", "paper"],
        help="detectors (default: joint and paper)",
    )
    p.add_argument(
        "--companions", action="store_true", help="generic outlier detectors beside them"
    )
    p.add_argument("--no-slow", action="store_true", help="skip slow changes")
    p.add_argument(
        "--share",
        metavar="P",
        nargs="+",
        type=share,
        default=[0.05, 0.1, 0.2],
        help="damaged share of the frames by class (default: 0.05 0.1 0.2)",
    )
    p.add_argument(
        "--amplitude",
        metavar="MM",
        nargs="+",
        type=positive,
        default=[5.0, 10.0],
        help="mean amplitudes (default: 5 10)",
    )
    p.add_argument(
        "--rounded",
        metavar="N",
        type=from_zero,
        default=0,
        help="frames over which the kinks of slow changes are rounded (default: 0, sharp)",
    )
    add_simulations(p, 100, "per setting")
    add_seed(p, "result")
    add_jobs(p)
    p.add_argument("--csv", metavar="FILE", help="write all counts as CSV; “-” for standard output")
    p.add_argument(
        "--figures", metavar="FOLDER", help="draw confusion matrices and calibration as SVG there"
    )
    p.add_argument("--force", action="store_true", help="overwrite what is there already")
