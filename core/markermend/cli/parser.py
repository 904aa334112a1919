"""Commands, options and help of the command line; nothing here imports the engine."""

from __future__ import annotations

import argparse

import markermend
from markermend.cli.detection import add_detection
from markermend.cli.numbers import Span, add_frames, add_jobs, add_seed, hertz, positive, share
from markermend.cli.smooth_parser import SUMMARY as SMOOTH
from markermend.cli.smooth_parser import add_smoothing

ABOUT = """\
Find, name and repair damaged intervals in optical motion capture takes.

A gap, a spike, a stretch of noise, two swapped markers, a slow drift: Markermend finds
them from the body's own movement, says how sure it is, repairs each with a method that fits,
and writes a file in which only the repaired samples differ from yours."""

EXAMPLES = """\
examples:
  markermend take.c3d                            review it in the window
  markermend detect take.c3d                     list what is damaged
  markermend clean take.c3d -o take_clean.c3d    repair it

Nothing is overwritten without --force, and the take that is read never is.
Exit codes: 0 done, 1 the work could not be done or was stopped, 2 bad usage."""

COMMANDS = {
    "open": "review a take in the desktop window",
    "info": "what a take holds: markers, gaps, bodies, events",
    "detect": "list the damaged intervals, each with class and confidence",
    "clean": "detect and repair, and write the repaired take",
    "fill": "fill the gaps and change nothing else",
    "smooth": SMOOTH,
    "denoise": "make a skeleton recording clean: joints of a Kinect, a tracker of poses",
    "pose": "joint centres of a body under markers, each with its error",
    "convert": "write a take in another format: c3d, trc, csv; of joints also amc, bvh",
    "diff": "what differs between two files: samples, parameters, bytes",
    "batch": "clean many takes alike, in several processes",
    "report": "what the review of a take came to, as one HTML file",
    "methods": "every method there is, with its parameters",
    "simulate": "make a take of a synthetic performer, damaged, with the truth",
    "bench": "rerun an experiment and print its table",
    "train": "learn one of Markermend's own models anew",
}


def make_parser(command: str) -> argparse.ArgumentParser:
    """Build a parser that knows all commands, and the options of the one that was given.

    Those of the experiments alone take longer than to open a take's file.
    """
    parser = argparse.ArgumentParser(
        "markermend",
        description=ABOUT,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--version", action="version", version=f"markermend {markermend.__version__}"
    )
    adders = {
        "open": _add_open,
        "report": _add_report,
        "info": _add_info,
        "detect": _add_detect,
        "clean": _add_clean,
        "fill": _add_fill,
        "smooth": _add_smooth,
        "denoise": _add_denoise,
        "pose": _add_pose,
        "convert": _add_convert,
        "diff": _add_diff,
        "batch": _add_batch,
        "methods": _add_methods,
        "simulate": _add_simulate,
        "bench": _add_bench,
        "train": _add_train,
    }
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, summary in COMMANDS.items():
        described = f"{summary[0].upper()}{summary[1:]}."
        known = commands.add_parser(name, help=summary, description=described)
        if name == command:
            adders[name](known)
    return parser


def _add_bench(p: argparse.ArgumentParser) -> None:
    from markermend.cli.bench_parser import add_experiments

    add_experiments(p)


def _add_train(p: argparse.ArgumentParser) -> None:
    from markermend.cli.train_parser import add_training

    add_training(p)


def _add_open(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "takes",
        metavar="TAKE",
        nargs="*",
        help="recording to open; several, a folder, or a batch's review.json to go through",
    )


def _add_report(p: argparse.ArgumentParser) -> None:
    _take(p)
    p.add_argument(
        "-o", "--output", metavar="FILE.html", required=True, help="where the report is written"
    )
    _json(p)
    _force(p)


def _add_info(p: argparse.ArgumentParser) -> None:
    _take(p)
    _json(p)
    _force(p)


def _add_detect(p: argparse.ArgumentParser) -> None:
    _take(p)
    add_detection(p, "--method")
    add_frames(p, "list what reaches into these frames only")
    _json(p)
    p.add_argument("--csv", metavar="FILE", help="write a table as CSV; “-” for standard output")
    _prior(p)
    _force(p)


def _add_clean(p: argparse.ArgumentParser) -> None:
    _take(p)
    _output(p)
    _float(p)
    _repairing(p)
    p.add_argument(
        "--min-confidence",
        metavar="P",
        type=share,
        default=0.5,
        help="repair what is at least this sure, from 0 to 1 (default: 0.5)",
    )
    p.add_argument(
        "--artifacts",
        metavar="FILE",
        help="repair what this JSON of “detect” lists, for example after editing it, "
        "instead of detecting; what it calls rejected is left alone",
    )
    add_detection(p, "--detector")
    add_frames(p, "repair what reaches into these frames only")
    p.add_argument(
        "--record",
        action="store_true",
        help="write into the C3D, in a MARKERMEND group, what was repaired and how",
    )
    p.add_argument(
        "--mark-outputs",
        action="store_true",
        help="name in the C3D the model outputs (angles, moments…) that no longer match",
    )
    p.add_argument("--list", action="store_true", help="show every single repair")
    _json(p)
    p.add_argument(
        "--report", metavar="FILE", help="write a report to read, print and mail: one HTML file"
    )
    _prior(p)
    _force(p)


def _add_fill(p: argparse.ArgumentParser) -> None:
    _take(p)
    _output(p)
    _float(p)
    _repairing(p)
    p.add_argument(
        "--max-gap",
        metavar="LENGTH",
        type=Span,
        help="leave longer gaps alone: frames (20), seconds (0.2s) or milliseconds (200ms)",
    )
    p.add_argument(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="a parameter of the method; “markermend methods NAME” lists them",
    )
    add_frames(p, "fill gaps that reach into these frames only")
    p.add_argument("--list", action="store_true", help="show every single gap")
    _prior(p)
    _force(p)


def _add_smooth(p: argparse.ArgumentParser) -> None:
    _take(p)
    _output(p)
    _float(p)
    add_smoothing(p)
    _force(p)


def _add_denoise(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "pose",
        metavar="POSE",
        help="joints: .csv, .bvh, .amc, or “-” for a stream, with a row for every joint of every"
        " pose, confidence 0 or empty numbers where it was not seen: where rows are left out, poses"
        " may go out one pose late",
    )
    p.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=True,
        help="file to write: .csv, .bvh, .amc or “-”",
    )
    p.add_argument(
        "--rate",
        metavar="HZ",
        type=hertz,
        help="poses per second, instead of what the file says; of a stream without times, 30",
    )
    p.add_argument(
        "--unit",
        choices=("mm", "cm", "m", "in", "ft"),
        help="unit of length of a BVH, or a table that does not say; otherwise the size of the body"
        " tells it",
    )
    p.add_argument("--skeleton", metavar="ASF", help="skeleton of an AMC that is not beside it")
    _prior(p)
    p.add_argument(
        "--network",
        metavar=("FILE", "NAME"),
        nargs=2,
        help="let a network of “train pose” do it instead, as Goncalves and others (2024) do",
    )
    p.add_argument(
        "--cmu",
        action="store_true",
        help="write the 31 segments of the CMU skeleton, those that 17 joints do not tell of as"
        " other bodies have them",
    )
    p.add_argument("--list", action="store_true", help="show what was done to every joint")
    _force(p)


def _add_pose(p: argparse.ArgumentParser) -> None:
    _take(p)
    p.add_argument(
        "-o", "--output", metavar="OUT.csv", required=True, help="table of joints to write"
    )
    _force(p)


def _add_convert(p: argparse.ArgumentParser) -> None:
    _take(p)
    _output(p)
    _float(p)
    add_frames(p, "write these frames only")
    _force(p)


def _add_diff(p: argparse.ArgumentParser) -> None:
    p.add_argument("take", metavar="A", help="one file")
    p.add_argument("other", metavar="B", help="the other")
    _json(p)
    _force(p)


def _add_batch(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "takes",
        metavar="TAKE",
        nargs="+",
        help="recordings, folders of them, or patterns such as “day1/**/walk*.c3d”",
    )
    p.add_argument(
        "-o", "--output", metavar="DIR", required=True, help="folder for everything that is written"
    )
    add_jobs(p)
    p.add_argument(
        "--cluster",
        metavar="ADDRESS",
        help="use the workers of this Dask scheduler, such as tcp://host:8786, instead",
    )
    p.add_argument(
        "--recipe",
        metavar="FILE",
        help="TOML with every choice, such as the recipe.toml that a batch leaves in DIR",
    )
    p.add_argument(
        "--min-confidence",
        metavar="P",
        type=share,
        help="repair what is at least this sure and list the rest for review, instead of what "
        "the recipe says (0.5 without one)",
    )
    _prior(p)
    p.add_argument(
        "--resume", action="store_true", help="do what is left of a run that was stopped or killed"
    )
    p.add_argument(
        "--progress",
        choices=["bar", "json"],
        default="bar",
        help="how to show progress: bars on a terminal, or lines of JSON on standard output",
    )
    _force(p)


def _add_methods(p: argparse.ArgumentParser) -> None:
    p.add_argument("name", metavar="NAME", nargs="?", help="show this one, with its parameters")
    _json(p)
    _force(p)


def _add_simulate(p: argparse.ArgumentParser) -> None:
    _output(p)
    p.add_argument("--duration", metavar="S", type=positive, default=40.0, help="seconds")
    p.add_argument("--rate", metavar="HZ", type=hertz, default=100.0, help="frames per second")
    p.add_argument(
        "--height", metavar="M", type=positive, default=1.75, help="the performer's, in metres"
    )
    add_seed(p, "take")
    p.add_argument("--clean", action="store_true", help="leave the take undamaged")
    p.add_argument(
        "--truth",
        metavar="FILE",
        help="write where the damage is, as JSON; “-” for standard output",
    )
    _force(p)


def _take(p: argparse.ArgumentParser) -> None:
    p.add_argument("take", metavar="TAKE", help="recording to read")


def _output(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=True,
        help="take to write; its ending says the format: .c3d, .trc, .csv, or a plugin's; of joints"
        " also .amc, .bvh",
    )


def _prior(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "--prior",
        metavar="FILE",
        help="how bodies of skeletons move, of “train prior”, beside what we know of 17 joints",
    )


def _float(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "--float",
        action="store_true",
        help="write floats even where the C3D that is read holds 16-bit integers",
    )


def _json(p: argparse.ArgumentParser) -> None:
    p.add_argument("--json", metavar="FILE", help="write JSON; “-” for standard output")


def _force(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "--force",
        action="store_true",
        help="overwrite what is there already (never the take that is read)",
    )


def _repairing(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "--method",
        metavar="NAME",
        default="auto",
        help="repair with this method only; a wrong name lists those there are (default: auto)",
    )
