"""The results of E2 as a text table, as CSV and as a figure."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import astuple, fields

from markermend.bench.columns import aligned, csv_cell
from markermend.bench.e2 import E2Row
from markermend.bench.svg import stacked_bars

_HEAD = (
    *("take", "version", "method", "listed", "flags", "approved", "of its class"),
    *("rejected", "doubtful", "missed", "added"),
)

# Right is green, wrong is red, and what nobody can say lies between; Okabe and Ito's.
_PARTS = {"approved": "#009e73", "doubtful": "#e69f00", "rejected": "#d55e00", "missed": "#999999"}


def e2_table(rows: Sequence[E2Row]) -> list[str]:
    """Write one line a row, as Table 2 of skurowski2022 has it, with what was added.

    Returns
    -------
    Lines of text; “–” for what was added to a take that nobody repaired
    """
    cells = [
        (
            *(r.take, r.repair or "raw", r.method),
            *(f"{n}" for n in (r.listed, r.flags, r.approved, r.named)),
            *(f"{n}" for n in (r.rejected, r.doubtful, r.missed)),
            f"{r.added}" if r.repair else "–",
        )
        for r in rows
    ]
    return aligned([_HEAD, *cells])


def e2_csv(rows: Sequence[E2Row]) -> str:
    """Write one line a row."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow([f.name for f in fields(E2Row)])
    for row in rows:
        out.writerow([csv_cell(v) if isinstance(v, float) else v for v in astuple(row)])
    return text.getvalue()


def e2_figure(rows: Sequence[E2Row]) -> str:
    """Draw how many flags were approved, doubtful and rejected, and what was missed.

    Returns
    -------
    A whole SVG document
    """
    bars = {
        f"{r.take}, {r.repair or 'raw'}, {r.method}": (
            *(float(n) for n in (r.approved, r.doubtful, r.rejected)),
            float(r.missed),
        )
        for r in rows
    }
    return stacked_bars(bars, _PARTS, "Flags held against reviewed lists", "artifacts")
