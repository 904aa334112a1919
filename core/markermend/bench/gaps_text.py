"""Results of replayed gaps as a table and as CSV."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Sequence

from markermend.bench.gaps import GapResult, GapRow


def gaps_table(rows: Sequence[GapRow], reference: str | None = "pma") -> list[str]:
    """Lay rows out as lines for a terminal; a reference adds its error and the ratio to it."""
    compared = reference is not None
    head = f"{'protocol':<16}{'frames':>7}  {'method':<18}{'cases':>5}{'error mm':>10}{'rmse':>9}"
    head += f"{f'{reference} mm':>10}{'ratio':>7}" if compared else ""
    lines = [head + f"{'filled':>8}{'in band':>9}{'ms':>7}"]
    for r in rows:
        band = "" if math.isnan(r.in_band) else f"{100 * r.in_band:.0f} %"
        line = f"{r.protocol:<16}{r.length:>7}  {r.method:<18}{r.cases:>5}"
        line += f"{r.error_mm:>10.2f}{r.rmse_mm:>9.2f}"
        line += f"{r.reference_mm:>10.2f}{r.ratio:>7.2f}" if compared else ""
        lines.append(line + f"{100 * r.filled:>6.0f} %{band:>9}{1000 * r.seconds:>7.0f}")
    return lines


def gaps_csv(results: Iterable[GapResult]) -> str:
    """One line for each case and method."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    columns = ["take", "protocol", "length", "gaps", "method"]
    writer.writerow([*columns, "error_mm", "rmse_mm", "filled", "in_band", "seconds"])
    for r in results:
        c = r.case
        numbers = (r.error_mm, r.rmse_mm, r.filled, r.in_band, r.seconds)
        writer.writerow(
            [c.take, c.protocol, c.length, len(c.gaps), r.method, *(f"{v:.6g}" for v in numbers)]
        )
    return file.getvalue()
