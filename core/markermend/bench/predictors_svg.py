"""The comparison of predictors as figures, in plain SVG."""

from __future__ import annotations

import math
from html import escape

from markermend.bench.predictors import PredictorStudy
from markermend.bench.residuals import EDGES, CorrelationMatrix, densities
from markermend.bench.svg import Curve, chart


def figure_names(take: str) -> tuple[str, str, str]:
    """File names of a take's figures: over order and lags, histogram, correlation."""
    return f"{take}-order-lags.svg", f"{take}-histogram.svg", f"{take}-correlation.svg"


def predictor_figures(study: PredictorStudy) -> dict[str, str]:
    """Draw, for every take, the residual over order and lags, its histogram, the correlations.

    Parameters
    ----------
    study : from :func:`markermend.bench.predictors.study_predictors`

    Returns
    -------
    File name to SVG text
    """
    figures = {}
    for take in dict.fromkeys(row.take for row in study.sweep):
        rows = [row for row in study.sweep if row.take == take]
        curves: dict[str, Curve] = {}
        for k in dict.fromkeys(row.lags for row in rows):
            some = [row for row in rows if row.lags == k]
            orders = [float(row.order) for row in some]
            curves[f"k = {k}, fitted"] = (orders, [row.sigma_mm for row in some])
        figures[figure_names(take)[0]] = chart(
            curves, f"{take}: residual of the polynomial", "order L", "standard deviation, mm"
        )
    middles = [float(v) for v in (EDGES[:-1] + EDGES[1:]) / 2]
    for take in dict.fromkeys(row.take for row in study.predictors):
        curves = {}
        for row in (row for row in study.predictors if row.take == take):
            counts = row.shape.counts
            curves[row.predictor] = (middles, list(counts / max(int(counts.sum()), 1)))
        for name, shares in zip(("normal", "Laplace"), densities(), strict=True):
            curves[name] = (middles, list(shares))
        figures[figure_names(take)[1]] = chart(
            curves, f"{take}: residuals", "standard deviations", "share of the samples"
        )
    for matrix in study.matrices:
        figures[figure_names(matrix.take)[2]] = heat_map(matrix)
    return figures


def heat_map(matrix: CorrelationMatrix) -> str:
    """Draw a correlation matrix: blue together, red against each other, grey unknown.

    Returns
    -------
    A whole SVG document
    """
    cell, left, top = 12.0, 110.0, 40.0
    size = cell * len(matrix.labels)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {left + size + 10:g} '
        f'{top + size + 10:g}" font-family="sans-serif" font-size="10">',
        f'<rect width="{left + size + 10:g}" height="{top + size + 10:g}" fill="white"/>',
        f'<text x="10" y="20" font-size="12">{escape(matrix.take)}: correlation of X positions'
        "</text>",
    ]
    for i, (label, values) in enumerate(zip(matrix.labels, matrix.values, strict=True)):
        y = top + i * cell
        name = escape(label[-16:])
        parts.append(f'<text x="{left - 4:g}" y="{y + 9:g}" text-anchor="end">{name}</text>')
        for j, value in enumerate(values):
            parts.append(
                f'<rect x="{left + j * cell:g}" y="{y:g}" width="{cell:g}" height="{cell:g}" '
                f'fill="{_shade(float(value))}"/>'
            )
    return "".join(parts) + "</svg>\n"


def _shade(r: float) -> str:
    """White at 0, blue towards 1, red towards -1."""
    if not math.isfinite(r):
        return "#999"
    full = (0, 114, 178) if r >= 0 else (213, 94, 0)
    mixed = (round(255 + abs(r) * (channel - 255)) for channel in full)
    return "#" + "".join(f"{channel:02x}" for channel in mixed)
