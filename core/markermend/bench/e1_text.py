"""The results of E1 as a text table and as CSV."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence

from markermend.bench.columns import aligned, csv_cell, number
from markermend.bench.confusion import CLASSES, FOUND
from markermend.bench.e1 import COMPANIONS, E1Row, pooled
from markermend.bench.events import DECILES

_HEAD = ("class", "samples", "TPR", "FNR", "PPV", "1-PPV", "flagged", "F", "MCC", "events", "found")
_CSV = (
    *("take", "method", "share", "amplitude_mm", "simulations", "class", "samples"),
    *("tpr", "fnr", "ppv", "fdr", "flagged", "f", "mcc", "small_samples", "small_flagged"),
    *("events", "events_found", "flags", "false_alarms", "minutes", "seconds"),
    *(f"found_{name}" for name in FOUND),
)


def e1_table(rows: Sequence[E1Row]) -> list[str]:
    """Write one block a row: measures by class, then false alarms, calibration and time.

    Parameters
    ----------
    rows : from :func:`markermend.bench.e1.e1`

    Returns
    -------
    Lines of text; rates in percent, “–” where there is nothing to measure. Counts by sample
    are means per simulation, as the paper prints them.
    """
    lines: list[str] = []
    for row in rows:
        setting = f"{row.share:.0%}, {row.amplitude_mm:g} mm" if row.share else "untouched"
        lines.append(f"{row.take}, {row.method}, {setting}, simulations: {row.simulations}")
        if row.share:
            lines += aligned([_HEAD, *(_measures(row, kind) for kind in CLASSES[1:])])
            lines += ["", *aligned(_matrix(row))]
            lines.append(
                f"  F {row.confusion.f():.5f}, MCC {row.confusion.mcc():.4f} over all classes"
            )
            lines += _small(row)
        if row.method not in COMPANIONS:
            lines.append(
                f"  {row.events.alarms_per_minute:.2f} false alarms a minute, "
                f"calibration error {number(row.events.calibration_error)}, "
                f"{row.seconds:.2f} s a detection"
            )
        lines.append("")
    return lines + calibration_table(rows)


def calibration_table(rows: Sequence[E1Row]) -> list[str]:
    """Write, by method and decile of confidence, how many flags were real."""
    lines = []
    methods = dict.fromkeys(row.method for row in rows if row.method not in COMPANIONS)
    for method in methods:
        events = pooled([row for row in rows if row.method == method and row.share])[1]
        if not events.count.sum():
            continue
        cells = [("confidence", "flags", "mean", "real")]
        for decile in range(DECILES):
            n = int(events.count[decile])
            if n:
                mean, real = events.confidence[decile] / n, events.real[decile] / n
                where = f"{decile / DECILES:.1f}-{(decile + 1) / DECILES:.1f}"
                cells.append((where, f"{n}", f"{mean:.3f}", f"{real:.3f}"))
        lines += [f"Calibration of {method}", *aligned(cells), ""]
    return lines


def e1_csv(rows: Sequence[E1Row]) -> str:
    """Write one line a row and class; rates as shares, counts summed over simulations."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow(_CSV)
    for row in rows:
        for k, kind in enumerate(CLASSES):
            c, e = row.confusion, row.events
            rates = (c.tpr(kind), c.fnr(kind), c.ppv(kind), c.fdr(kind), c.flagged(kind))
            out.writerow(
                (
                    *(row.take, row.method, row.share, row.amplitude_mm, row.simulations, kind),
                    int(c.counts[k].sum()),
                    *(csv_cell(v) for v in (*rates, c.f(kind), c.mcc(kind))),
                    int(row.small.counts[k].sum()),
                    csv_cell(row.small.flagged(kind)),
                    *(int(n[k]) for n in (e.drawn, e.found, e.flags, e.alarms)),
                    csv_cell(e.minutes),
                    csv_cell(row.seconds),
                    *(int(n) for n in c.counts[k]),
                )
            )
    return text.getvalue()


def _measures(row: E1Row, kind: str) -> tuple[str, ...]:
    """One line of the table."""
    c, k = row.confusion, CLASSES.index(kind)
    rates = (c.tpr(kind), c.fnr(kind), c.ppv(kind), c.fdr(kind), c.flagged(kind))
    return (
        kind,
        f"{c.counts[k].sum() / row.simulations:.0f}",
        *(f"{100 * v:.1f}" if math.isfinite(v) else "–" for v in rates),
        number(c.f(kind)),
        number(c.mcc(kind)),
        f"{row.events.drawn[k]}",
        f"{100 * v:.1f}" if math.isfinite(v := row.events.recall(kind)) else "–",
    )


def _small(row: E1Row) -> list[str]:
    """Sudden artifacts drawn under 1 mm, which the measures leave out."""
    small = row.small
    parts = [
        f"{kind} {small.counts[k].sum()} ({100 * small.flagged(kind):.0f} % flagged)"
        for k, kind in enumerate(CLASSES)
        if k and small.counts[k].sum()
    ]
    return [f"  left out as drawn too small, samples: {', '.join(parts)}"] if parts else []


def _matrix(row: E1Row) -> list[tuple[str, ...]]:
    """The confusion matrix, mean per simulation; columns nothing was ever found in are left out."""
    counts = row.confusion.counts / row.simulations
    columns = [j for j, name in enumerate(FOUND) if name in CLASSES or counts[:, j].any()]
    return [
        ("true \\ found", *(FOUND[j] for j in columns)),
        *((name, *(f"{counts[k, j]:.1f}" for j in columns)) for k, name in enumerate(CLASSES)),
    ]
