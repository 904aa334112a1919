"""Numbers as options take them, and the options of numbers that many commands share."""

from __future__ import annotations

import argparse
import math
import re
from typing import Any

from markermend.rates import LEAST_HZ, MOST_HZ


class _Interval(argparse.Action):
    """The first and the last of something, in this order."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Keep them, unless they are the wrong way round."""
        first, last = values
        if first > last:
            raise argparse.ArgumentError(self, f"{first} comes after {last}; FIRST goes first")
        setattr(namespace, self.dest, values)


def add_frames(p: argparse.ArgumentParser, what: str) -> None:
    """Add an interval of frames, of which something is done ``what``."""
    p.add_argument(
        "--frames",
        metavar=("FIRST", "LAST"),
        nargs=2,
        type=whole,
        action=_Interval,
        help=f"{what}, by the file's own numbers, the last one included",
    )


class Span:
    """A length of time as people type it: ``20`` frames, ``0.2s`` or ``200ms``."""

    def __init__(self, text: str) -> None:
        found = re.fullmatch(r"(\d+(?:\.\d+)?|\.\d+)\s*(ms|s)?", text.strip())
        if found is None or (found[2] is None and not found[1].isdigit()):
            raise argparse.ArgumentTypeError(
                f"“{text}” is no length; write frames (20), seconds (0.2s) or milliseconds (200ms)"
            )
        self.value = float(found[1])
        self.seconds_per_unit = {None: 0.0, "s": 1.0, "ms": 0.001}[found[2]]

    def frames(self, rate: float) -> int:
        """Return the number of frames at a rate in Hz, rounded."""
        return round(self.value * (self.seconds_per_unit * rate or 1.0))


def number(text: str) -> float:
    """Read a finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"“{text}” is not a number")
    return value


def positive(text: str) -> float:
    """Read a number above 0."""
    value = number(text)
    if value <= 0.0:
        raise argparse.ArgumentTypeError(f"“{text}” is not above 0")
    return value


def hertz(text: str) -> float:
    """Read a rate that something is recorded at."""
    value = number(text)
    if not LEAST_HZ <= value <= MOST_HZ:
        raise argparse.ArgumentTypeError(
            f"“{text}” is no rate of a recording; give {LEAST_HZ:g} to {MOST_HZ:,.0f} Hz"
        )
    return value


def share(text: str) -> float:
    """Read a number from 0 to 1."""
    value = number(text)
    if not 0.0 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"“{text}” does not lie between 0 and 1")
    return value


def whole(text: str) -> int:
    """Read a whole number."""
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"“{text}” is not a whole number") from None


def from_zero(text: str) -> int:
    """Read a whole number from 0."""
    return _at_least(text, 0)


def from_one(text: str) -> int:
    """Read a whole number from 1."""
    return _at_least(text, 1)


def add_simulations(p: argparse.ArgumentParser, usual: int, what: str) -> None:
    """Add how often an experiment is repeated."""
    p.add_argument(
        "--simulations",
        metavar="N",
        type=from_one,
        default=usual,
        help=f"{what} (default: {usual})",
    )


def add_seed(p: argparse.ArgumentParser, what: str, usual: int | None = 0) -> None:
    """Add the seed of everything random.

    Parameters
    ----------
    p : of the command
    what : that the same seed gives the same of
    usual : seed when none is given
    """
    told = "any" if usual is None else usual
    p.add_argument(
        "--seed",
        metavar="N",
        type=from_zero,
        default=usual,
        help=f"same seed, same {what} (default: {told})",
    )


def add_jobs(p: argparse.ArgumentParser) -> None:
    """Add the number of processes."""
    p.add_argument(
        "--jobs", metavar="N", type=_jobs, default=-1, help="processes (default: -1, all cores)"
    )


def _jobs(text: str) -> int:
    """Read a number of processes, or -1."""
    value = whole(text)
    if value < 1 and value != -1:
        raise argparse.ArgumentTypeError(f"“{text}” is no number of processes; -1 takes all cores")
    return value


def _at_least(text: str, least: int) -> int:
    """Read a whole number from `least` on."""
    value = whole(text)
    if value < least:
        raise argparse.ArgumentTypeError(f"“{text}” is below {least}")
    return value
