"""Options of ``markermend train``."""

from __future__ import annotations

import argparse

from markermend.cli.bench_takes import add_clean_takes
from markermend.cli.numbers import add_jobs, add_seed, from_one, from_zero, whole

MODELS = {
    "sudden": "how sure peaks, heavy noise and steps are: one curve a class",
    "slow": "how sure slow changes are: boosted trees on what is measured of each",
    "prior": "how bodies move, for “denoise”: from clean skeleton recordings",
    "segments": "what the CMU skeleton has more than 17 joints, for “denoise --cmu”",
    "pose": "the network of Goncalves and others (2024), in its three trainings (extra “deep”)",
}
"""What can be trained; :mod:`markermend.cli.train` has a function for each."""

_NOISES = ("both", "occlusions", "displacements")


def add_training(parser: argparse.ArgumentParser) -> None:
    """Give ``train`` a command for each model."""
    adders = {
        "sudden": _add_sudden,
        "slow": _add_slow,
        "prior": _add_prior,
        "segments": _add_segments,
        "pose": _add_pose,
    }
    names = parser.add_subparsers(dest="model", metavar="MODEL", required=True)
    for name, summary in MODELS.items():
        adders[name](
            names.add_parser(name, help=summary, description=f"{summary[0].upper()}{summary[1:]}.")
        )


def _add_slow(p: argparse.ArgumentParser) -> None:
    add_clean_takes(p, "*")
    p.add_argument(
        "--poses",
        metavar="FOLDER",
        help="skeleton recordings (AMC and ASF) that markers are put on",
    )
    for name, usual, what in (
        ("--sets", 4, "marker sets put on each skeleton recording"),
        ("--performers", 6, "simulated performers beside them"),
        ("--rounds", 1, "copies of each marker that drifts are put into"),
    ):
        least = from_one if name == "--rounds" else from_zero
        p.add_argument(
            name, metavar="N", type=least, default=usual, help=f"{what} (default: {usual})"
        )
    add_jobs(p)
    add_model_output(p)


def _add_sudden(p: argparse.ArgumentParser) -> None:
    add_clean_takes(p, "*")
    p.add_argument(
        "--performers",
        metavar="N",
        type=from_zero,
        default=12,
        help="simulated performers beside them (default: 12)",
    )
    p.add_argument(
        "--rounds",
        metavar="N",
        type=from_one,
        default=10,
        help="contaminations of each take and amplitude (default: 10)",
    )
    add_model_output(p)


def _add_prior(p: argparse.ArgumentParser) -> None:
    _add_segments(p)
    p.add_argument(
        "--no-recordings",
        action="store_true",
        help="keep how joints move together, but not the recordings, which tell more of whoever"
        " they show",
    )


def _add_segments(p: argparse.ArgumentParser) -> None:
    p.add_argument("poses", metavar="POSE", nargs="+", help="clean skeleton recordings")
    add_output(p)


def _add_pose(p: argparse.ArgumentParser) -> None:
    p.add_argument("poses", metavar="POSE", nargs="+", help="clean skeleton recordings")
    held_out = p.add_mutually_exclusive_group()
    held_out.add_argument(
        "--leave-out",
        action="store_true",
        help="for each person, whom names begin with, networks that never saw them",
    )
    held_out.add_argument(
        "--fold",
        metavar="N",
        type=whole,
        nargs="*",
        choices=range(1, 11),
        help="ten-fold cross-validation: networks that never saw a tenth of the poses, drawn at"
        " random; only these tenths (default: all)",
    )
    p.add_argument(
        "--parts",
        choices=("both", "positions", "rotations"),
        default="both",
        help="what of each joint is learnt (default: both)",
    )
    p.add_argument(
        "--noise",
        choices=_NOISES,
        nargs="+",
        default=_NOISES,
        help="what is learnt to be undone, a network each (default: all three)",
    )
    p.add_argument(
        "--sensor",
        action="store_true",
        help="learn also from every pose that the simulated depth sensor of “bench pose” sees,"
        " clean (the paper adds “some poses” of its sensor, and does not say how many)",
    )
    p.add_argument("--epochs", metavar="N", type=from_one, default=100, help="default: 100")
    p.add_argument(
        "--batch",
        metavar="N",
        type=from_one,
        default=512,
        help="poses a step (default: 512); with fewer more is learnt in as many epochs",
    )
    p.add_argument(
        "--resume",
        action="store_true",
        help="keep each network's state beside the model, and go on from one that is there",
    )
    add_model_output(p)


def add_model_output(p: argparse.ArgumentParser) -> None:
    """Add what every model needs: a seed and a file to write."""
    add_seed(p, "model")
    add_output(p)


def add_output(p: argparse.ArgumentParser) -> None:
    """Add the file to write."""
    p.add_argument("-o", "--output", metavar="FILE", required=True, help="model to write")
    p.add_argument("--force", action="store_true", help="overwrite what is there already")
