"""Which lines differ between two files of text, whose bytes after a longer line all seem to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from markermend.errors import FileFormatError


@dataclass(frozen=True)
class LineDifferences:
    """Lines of two files that have as many.

    Attributes
    ----------
    lines : of each file
    differing : how many of them differ
    runs : half-open intervals of line numbers, counted from 1
    """

    lines: int
    differing: int
    runs: tuple[tuple[int, int], ...]


def differing_lines(a: Path, b: Path) -> LineDifferences | None:
    """Compare line by line; None where one file has more of them.

    Raises
    ------
    FileFormatError
        when one of them cannot be read
    """
    found: list[list[int]] = []
    number = differing = 0
    try:
        with a.open("rb") as one, b.open("rb") as two:
            for left in one:
                right = two.readline()
                if not right:
                    return None
                number += 1
                if left == right:
                    continue
                differing += 1
                if found and found[-1][1] == number:
                    found[-1][1] += 1
                else:
                    found.append([number, number + 1])
            if two.readline():
                return None
    except OSError as error:
        raise FileFormatError(f"The files could not be compared: {error.strerror}.") from error
    return LineDifferences(number, differing, tuple((start, stop) for start, stop in found))
