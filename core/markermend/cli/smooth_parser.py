"""Options of ``markermend smooth``."""

from __future__ import annotations

import argparse

from markermend.cli.numbers import add_frames

SUMMARY = "take noise out of trajectories and fill nothing"


def add_smoothing(p: argparse.ArgumentParser) -> None:
    """Give ``smooth`` its own options."""
    p.add_argument(
        "--method",
        metavar="NAME",
        default="auto",
        help="how to smooth; a wrong name lists those there are (default: auto, nothing to set)",
    )
    p.add_argument(
        "--set",
        metavar="NAME=VALUE",
        nargs="+",
        default=[],
        help="parameters of the method, for example cutoff_hz=8",
    )
    p.add_argument("--marker", metavar="NAME", nargs="+", help="smooth these markers only")
    add_frames(p, "smooth these frames only")
    p.add_argument("--list", action="store_true", help="show what changed for every marker")
    p.add_argument(
        "--derivatives",
        metavar="FILE",
        help="write position, velocity and acceleration of each marker by “auto”, with error "
        "bands, as CSV; “-” for standard output",
    )
