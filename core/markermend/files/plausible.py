"""What is a measurement of a body, and what cannot be one."""

from __future__ import annotations

FARTHEST = 1e7
"""Up to so many millimetres, or degrees, a number is a measurement."""


def read_as_missing(count: int) -> list[str]:
    """The sentence about samples that are no measurement; none where there is none."""
    if not count:
        return []
    return [
        f"{count} samples whose coordinates are no numbers, or farther out than any room, were"
        " read as missing."
    ]
