"""The comparison of predictors as figures, in plain SVG."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

from markermend.bench.predictors import PredictorStudy
from markermend.bench.residuals import EDGES, CorrelationMatrix, densities
from markermend.report.svg import path, ticks

_WIDTH, _HEIGHT, _LEFT, _RIGHT, _TOP, _BOTTOM = 640.0, 400.0, 60.0, 190.0, 30.0, 45.0
# Okabe and Ito's colours, told apart by colour-blind readers too.
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000")

Curve = tuple[Sequence[float], Sequence[float]]


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


def chart(curves: Mapping[str, Curve], title: str, across: str, up: str) -> str:
    """Draw named curves on common axes, the vertical one from zero.

    Parameters
    ----------
    curves : name to horizontal and vertical coordinates, (n,) each; NaN breaks a line
    title, across, up : what is shown, along the horizontal and the vertical axis

    Returns
    -------
    A whole SVG document
    """
    every_x = [v for x, _ in curves.values() for v in x]
    every_y = [v for _, y in curves.values() for v in y if math.isfinite(v)]
    low, high = min(every_x, default=0.0), max(every_x, default=1.0)
    wide = high - low or 1.0
    top = max(every_y, default=1.0) * 1.05 or 1.0
    right, bottom = _WIDTH - _RIGHT, _HEIGHT - _BOTTOM
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" '
        'font-family="sans-serif" font-size="12">',
        f'<rect width="{_WIDTH:g}" height="{_HEIGHT:g}" fill="white"/>',
        f'<text x="{_LEFT:g}" y="20">{escape(title)}</text>',
        f'<text x="{(_LEFT + right) / 2:g}" y="{_HEIGHT - 8:g}" text-anchor="middle">'
        f"{escape(across)}</text>",
        f'<text x="14" y="{(_TOP + bottom) / 2:g}" text-anchor="middle" '
        f'transform="rotate(-90 14 {(_TOP + bottom) / 2:g})">{escape(up)}</text>',
    ]
    for value in ticks(0.0, top, 6):
        y = bottom - value / top * (bottom - _TOP)
        parts.append(
            f'<path d="M{_LEFT:g} {y:.1f}H{right:g}" stroke="#ddd"/>'
            f'<text x="{_LEFT - 6:g}" y="{y + 4:.1f}" text-anchor="end">{value:g}</text>'
        )
    for value in ticks(low, high, 6):
        x = _LEFT + (value - low) / wide * (right - _LEFT)
        parts.append(f'<text x="{x:.1f}" y="{bottom + 16:g}" text-anchor="middle">{value:g}</text>')
    for number, (name, (xs, ys)) in enumerate(curves.items()):
        colour = _COLOURS[number % len(_COLOURS)]
        x_at = _LEFT + (np.asarray(xs, dtype=np.float64) - low) / wide * (right - _LEFT)
        y_at = bottom - np.asarray(ys, dtype=np.float64) / top * (bottom - _TOP)
        y = _TOP + 16.0 * number
        parts.append(
            f'<path d="{path(x_at, y_at)}" fill="none" stroke="{colour}" stroke-width="1.5" '
            'stroke-linecap="round"/>'
            f'<path d="M{right + 10:g} {y:g}h18" stroke="{colour}" stroke-width="2"/>'
            f'<text x="{right + 33:g}" y="{y + 4:g}">{escape(name)}</text>'
        )
    return "".join(parts) + "</svg>\n"
