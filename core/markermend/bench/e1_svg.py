"""The results of E1 as figures: confusion matrices side by side, and calibration."""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape

import numpy as np

from markermend.bench.confusion import CLASSES, FOUND
from markermend.bench.e1 import COMPANIONS, E1Row, pooled
from markermend.bench.svg import Curve, chart

_CELL, _LEFT, _TOP, _GAP = 46.0, 60.0, 62.0, 26.0
_ACROSS = 4
CALIBRATION = "calibration.svg"


def figure_names(
    takes: Sequence[str], shares: Sequence[float], amplitudes_mm: Sequence[float]
) -> list[str]:
    """File names that :func:`e1_figures` may give."""
    names = [_name(take, share, mm) for take in takes for share in shares for mm in amplitudes_mm]
    return [*names, CALIBRATION]


def e1_figures(rows: Sequence[E1Row]) -> dict[str, str]:
    """Draw, for every take and setting, the confusion matrices of all methods; and calibration.

    Parameters
    ----------
    rows : from :func:`markermend.bench.e1.e1`

    Returns
    -------
    File name to SVG text. Matrices as in skurowski2022, Figure 15: blue what is right, red what
    is wrong, as shares of the true class.
    """
    figures = {}
    damaged = [row for row in rows if row.share]
    for take, share, mm in dict.fromkeys((r.take, r.share, r.amplitude_mm) for r in damaged):
        some = [r for r in damaged if (r.take, r.share, r.amplitude_mm) == (take, share, mm)]
        title = f"{take}, {share:.0%} damaged, {mm:g} mm"
        figures[_name(take, share, mm)] = matrices(some, title)
    curves = calibration(rows)
    if curves:
        curves["perfect"] = ([0.0, 1.0], [0.0, 1.0])
        figures[CALIBRATION] = chart(
            curves, "Calibration", "confidence", "share of the flags that are real"
        )
    return figures


def calibration(rows: Sequence[E1Row]) -> dict[str, Curve]:
    """Mean confidence and share of real flags by decile of confidence, for every method."""
    curves: dict[str, Curve] = {}
    for method in dict.fromkeys(row.method for row in rows if row.method not in COMPANIONS):
        events = pooled([row for row in rows if row.method == method and row.share])[1]
        full = events.count > 0
        if full.any():
            count = events.count[full]
            mean, real = events.confidence[full] / count, events.real[full] / count
            curves[method] = (mean.tolist(), real.tolist())
    return curves


def matrices(rows: Sequence[E1Row], title: str) -> str:
    """Draw confusion matrices side by side, one a row.

    Returns
    -------
    A whole SVG document
    """
    wide = _LEFT + len(FOUND) * _CELL + _GAP
    high = _TOP + len(CLASSES) * _CELL + _GAP
    across = min(_ACROSS, len(rows))
    width, height = across * wide, -(-len(rows) // across) * high + 30
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" '
        'font-family="sans-serif" font-size="11">',
        f'<rect width="{width:g}" height="{height:g}" fill="white"/>',
        f'<text x="10" y="20" font-size="14">{escape(title)}</text>',
    ]
    for n, row in enumerate(rows):
        x, y = (n % across) * wide, 30 + (n // across) * high
        parts.append(f'<g transform="translate({x:g} {y:g})">{_matrix(row)}</g>')
    return "".join(parts) + "</svg>\n"


def _name(take: str, share: float, amplitude_mm: float) -> str:
    """File name of the matrices of one take and setting."""
    plain = re.sub(r"[^\w.-]", "_", take)
    return f"{plain}-{100 * share:g}-{amplitude_mm:g}mm.svg"


def _matrix(row: E1Row) -> str:
    """One matrix with its titles; each cell the share of its true class, in percent."""
    counts = row.confusion.counts.astype(np.float64)
    total = counts.sum(axis=1, keepdims=True)
    shares = counts / np.where(total > 0, total, 1.0)
    parts = [f'<text x="{_LEFT:g}" y="24" font-size="13">{escape(row.method)}</text>']
    for j, name in enumerate(FOUND):
        x = _LEFT + (j + 0.5) * _CELL
        parts.append(f'<text x="{x:g}" y="{_TOP - 8:g}" text-anchor="middle">{name}</text>')
    for i, name in enumerate(CLASSES):
        y = _TOP + i * _CELL
        parts.append(f'<text x="{_LEFT - 6:g}" y="{y + 27:g}" text-anchor="end">{name}</text>')
        for j, found in enumerate(FOUND):
            right = found == name or (found == "outlier" and name != "clear")
            full = (0, 114, 178) if right else (213, 94, 0)
            share = float(shares[i, j])
            shade = "".join(f"{round(255 + share * (c - 255)):02x}" for c in full)
            ink = "white" if share > 0.6 else "black"
            parts.append(
                f'<rect x="{_LEFT + j * _CELL:g}" y="{y:g}" width="{_CELL:g}" height="{_CELL:g}" '
                f'fill="#{shade}" stroke="#ddd"/>'
                f'<text x="{_LEFT + (j + 0.5) * _CELL:g}" y="{y + 27:g}" text-anchor="middle" '
                f'fill="{ink}">{100 * share:.1f}</text>'
            )
    return "".join(parts)
