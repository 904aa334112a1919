"""What networks made of less and of more of a take, as a table, as CSV and as figures."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import astuple, fields

from markermend.bench.columns import aligned, csv_cell, number
from markermend.bench.svg import Curve, chart
from markermend.bench.training import TrainingRow

_DRAWN = (
    ("rmse", "root mean square error, mm"),
    ("aic", "AIC per tested coordinate"),
    ("bic", "BIC per tested coordinate"),
)


def training_table(rows: Sequence[TrainingRow]) -> list[str]:
    """Lay rows out as lines for a terminal."""
    cells = [["take", "frames", "learnt s", "method", "gaps", "MSE mm²", "weights", "AIC", "BIC"]]
    cells += [
        [
            r.take,
            str(r.length),
            f"{r.train_s:g}",
            r.method,
            str(r.gaps),
            number(r.mse),
            number(r.weights, 0),
            number(r.aic, 0),
            number(r.bic, 0),
        ]
        for r in rows
    ]
    return aligned(cells)


def training_csv(rows: Sequence[TrainingRow]) -> str:
    """One line for each take, length of gap, length of training and method."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow([f.name for f in fields(TrainingRow)])
    for row in rows:
        out.writerow([csv_cell(v) if isinstance(v, float) else v for v in astuple(row)])
    return text.getvalue()


def figure_names(take: str, lengths: Sequence[int]) -> tuple[str, ...]:
    """File names of a take's figures, three for each length of gaps."""
    return tuple(f"{take}-training-{n}-{name}.svg" for n in lengths for name, _ in _DRAWN)


def training_figures(rows: Sequence[TrainingRow]) -> dict[str, str]:
    """Draw error and criteria over the seconds learnt from, one curve a method.

    The criteria are divided by the coordinates tested, which differ with the windows that fit.

    Returns
    -------
    File name to SVG text
    """
    figures = {}
    for take, length in dict.fromkeys((r.take, r.length) for r in rows):
        mine = [r for r in rows if (r.take, r.length) == (take, length) and r.samples]
        for file, (name, up) in zip(figure_names(take, [length]), _DRAWN, strict=True):
            curves: dict[str, Curve] = {}
            for method in dict.fromkeys(r.method for r in mine):
                some = [r for r in mine if r.method == method]
                curves[method] = ([r.train_s for r in some], [_drawn(r, name) for r in some])
            title = f"{take}: gaps of {length} frames, learnt from more and more"
            figures[file] = chart(curves, title, "seconds learnt from", up)
    return figures


def _drawn(row: TrainingRow, name: str) -> float:
    """The value of a figure."""
    return row.mse**0.5 if name == "rmse" else float(getattr(row, name)) / row.samples
