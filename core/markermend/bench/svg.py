"""Figures of the experiments, in plain SVG."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

from markermend.report.svg import path, ticks

_WIDTH, _HEIGHT, _LEFT, _RIGHT, _TOP, _BOTTOM = 640.0, 400.0, 60.0, 190.0, 30.0, 45.0
# Okabe and Ito's colours, told apart by colour-blind readers too.
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000")
_BAR, _NAME = 18.0, 250.0

Curve = tuple[Sequence[float], Sequence[float]]


def chart(curves: Mapping[str, Curve], title: str, across: str, up: str) -> str:
    """Draw named curves on common axes, the vertical one with its zero.

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
    floor = min(0.0, 1.05 * min(every_y, default=0.0))
    top = max(0.0, 1.05 * max(every_y, default=1.0))
    tall = top - floor or 1.0
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
    for value in ticks(floor, floor + tall, 6):
        y = bottom - (value - floor) / tall * (bottom - _TOP)
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
        y_at = bottom - (np.asarray(ys, dtype=np.float64) - floor) / tall * (bottom - _TOP)
        y = _TOP + 16.0 * number
        parts.append(
            f'<path d="{path(x_at, y_at)}" fill="none" stroke="{colour}" stroke-width="1.5" '
            'stroke-linecap="round"/>'
            f'<path d="M{right + 10:g} {y:g}h18" stroke="{colour}" stroke-width="2"/>'
            f'<text x="{right + 33:g}" y="{y + 4:g}">{escape(name)}</text>'
        )
    return "".join(parts) + "</svg>\n"


def stacked_bars(
    bars: Mapping[str, Sequence[float]], parts: Mapping[str, str], title: str, across: str
) -> str:
    """Draw named bars, each of several parts side by side.

    Parameters
    ----------
    bars : name to the size of each part, none negative
    parts : their names, each with its colour
    title, across : what is shown, along the horizontal axis

    Returns
    -------
    A whole SVG document
    """
    top, right = _TOP + 26.0, _WIDTH - 20.0
    bottom = top + _BAR * len(bars)
    longest = max((sum(sizes) for sizes in bars.values()), default=0.0) or 1.0
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH:g} {bottom + 40:g}" '
        'font-family="sans-serif" font-size="12">',
        f'<rect width="{_WIDTH:g}" height="{bottom + 40:g}" fill="white"/>',
        f'<text x="10" y="20">{escape(title)}</text>',
        f'<text x="{(_NAME + right) / 2:g}" y="{bottom + 34:g}" text-anchor="middle">'
        f"{escape(across)}</text>",
    ]
    for k, (name, colour) in enumerate(parts.items()):
        x = _NAME + 95.0 * k
        lines.append(
            f'<rect x="{x:g}" y="{_TOP:g}" width="12" height="12" fill="{colour}"/>'
            f'<text x="{x + 17:g}" y="{_TOP + 11:g}">{escape(name)}</text>'
        )
    for value in ticks(0.0, longest, 6):
        x = _NAME + value / longest * (right - _NAME)
        lines.append(
            f'<path d="M{x:.1f} {top:g}V{bottom:g}" stroke="#ddd"/>'
            f'<text x="{x:.1f}" y="{bottom + 16:g}" text-anchor="middle">{value:g}</text>'
        )
    for i, (name, sizes) in enumerate(bars.items()):
        y, x = top + i * _BAR, _NAME
        lines.append(
            f'<text x="{_NAME - 8:g}" y="{y + 13:g}" text-anchor="end">{escape(name)}</text>'
        )
        for size, colour in zip(sizes, parts.values(), strict=True):
            wide = size / longest * (right - _NAME)
            lines.append(
                f'<rect x="{x:.1f}" y="{y + 2:g}" width="{wide:.1f}" height="{_BAR - 4:g}" '
                f'fill="{colour}"/>'
            )
            x += wide
    return "".join(lines) + "</svg>\n"
