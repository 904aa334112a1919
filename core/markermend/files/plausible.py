"""What a skeleton recording can hold: how many poses a second, how far from its origin."""

from __future__ import annotations

from markermend.errors import FileFormatError

LEAST_HZ, MOST_HZ = 0.1, 10_000.0
FARTHEST = 1e7
"""Millimetres, and whatever else a joint is told by, up to which a number is a measurement."""


def rate_of(hertz: float, name: str) -> float:
    """A rate that a recording can have, rounded as times are.

    Parameters
    ----------
    hertz : poses per second
    name : of the file, for what is wrong with it

    Raises
    ------
    FileFormatError
        when nothing records so slowly or so fast
    """
    if not LEAST_HZ <= hertz <= MOST_HZ:
        raise FileFormatError(
            f"{name} would have {hertz:g} poses a second, which is no rate of a recording;"
            f" {LEAST_HZ:g} to {MOST_HZ:,.0f} Hz can be read."
        )
    return hertz


def read_as_missing(count: int) -> list[str]:
    """The sentence about samples that are no measurement; none where there is none."""
    if not count:
        return []
    return [
        f"{count:,} samples whose coordinates are no numbers, or farther out than any room, were"
        " read as missing."
    ]
