"""Columns of text for the tables of the experiments."""

from __future__ import annotations

import math
from collections.abc import Sequence


def aligned(cells: Sequence[Sequence[str]]) -> list[str]:
    """Lay cells out in columns of equal width, indented.

    Parameters
    ----------
    cells : rows of equal length

    Returns
    -------
    Lines of text; the first column to the left, the others to the right.
    """
    widths = [max(len(row[i]) for row in cells) for i in range(len(cells[0]))]
    return [
        "  "
        + "  ".join(
            cell.ljust(width) if i == 0 else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        for row in cells
    ]


def number(value: float, digits: int = 3) -> str:
    """Write a number with so many decimals, a dash where there is none."""
    return f"{value:.{digits}f}" if math.isfinite(value) else "–"


def csv_cell(value: float) -> str:
    """Write a number for CSV; empty where there is none."""
    return f"{value:.6g}" if math.isfinite(value) else ""
