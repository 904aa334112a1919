"""The results of E3 as tables like the published ones, and as CSV."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence

from markermend.bench.columns import aligned, csv_cell, number
from markermend.bench.e3 import E3Row

_COLUMNS = ("take", "share", "kind", "located", "method", "simulations")
_NUMBERS = ("rmse_mm", "spread_mm", "published_mm", "seconds")
_TOLD = ("off_mm", "expected_mm", "held")


def e3_table(rows: Sequence[E3Row]) -> list[str]:
    """Write one block a take and share: ways of reconstruction down, classes of damage across.

    Parameters
    ----------
    rows : from :func:`markermend.bench.e3.e3`

    Returns
    -------
    Lines of text; beside every class the published figure, “–” where there is none. Every
    detector but the published one is compared with the published one's figures too. Below, how
    far off the repairs are, on average, that tell how far off they may be.
    """
    lines: list[str] = []
    for take, share in dict.fromkeys((row.take, row.share) for row in rows):
        block = [row for row in rows if (row.take, row.share) == (take, share)]
        by_way = {(row.method, row.located, row.kind): row for row in block}
        kinds = list(dict.fromkeys(row.kind for row in block))
        methods = list(dict.fromkeys(row.method for row in block))
        places = list(dict.fromkeys(row.located for row in block))
        cells = [("", *(word for kind in kinds for word in (kind.value, "paper")))]
        for method in methods:
            for located in places:
                found = [by_way.get((method, located, kind)) for kind in kinds]
                if any(row is not None for row in found):
                    name = f"{method} ({located})" if method else located
                    cells.append((name, *(word for row in found for word in _words(row))))
        seconds = max(row.seconds for row in block)
        lines.append(
            f"{take}, {share:.0%} damaged, simulations: {block[0].simulations}, RMSE in mm, "
            f"at most {seconds:.1f} s a reconstruction"
        )
        lines += [*aligned(cells), "", *_told(block)]
    return lines


def _told(block: Sequence[E3Row]) -> list[str]:
    """What repairs tell of their own error, beside the error; nothing where none does."""
    rows = [row for row in block if row.repairs]
    if not rows:
        return []
    head = ("", "repairs", "off, mm", "expected, mm", "in the 90 % band")
    cells = [head] + [
        (
            f"{row.kind}, {row.method} ({row.located})",
            str(row.repairs),
            number(row.told.off_mm),
            number(row.told.expected_mm),
            f"{row.told.held:.0%}",
        )
        for row in rows
    ]
    return ["What repairs tell of their own error, each counting as much", *aligned(cells), ""]


def e3_csv(rows: Sequence[E3Row]) -> str:
    """Write one line a row."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow((*_COLUMNS, *_NUMBERS, "repairs", *_TOLD))
    for row in rows:
        out.writerow(
            [getattr(row, name) for name in _COLUMNS]
            + [csv_cell(getattr(row, name)) for name in _NUMBERS]
            + [row.repairs]
            + [csv_cell(getattr(row.told, name)) for name in _TOLD]
        )
    return text.getvalue()


def _words(row: E3Row | None) -> tuple[str, str]:
    """What was measured, and what the paper has."""
    if row is None:
        return "–", "–"
    return _mm(row.rmse_mm), _mm(row.published_mm)


def _mm(value: float) -> str:
    """Five decimals, as the paper has; a dash where there is none."""
    return f"{value:.5f}" if math.isfinite(value) else "–"
