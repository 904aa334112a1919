"""The picture of a whole take: one row a marker, time from left to right."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind, Status
from markermend.mesh import Group, Mesh
from markermend_app.style import theme
from markermend_app.telling import told_group
from markermend_app.words import tr

MODES = ("damage", "gaps", "residual")
MOST_MM = 20.0
"""Residual at which the colours of the heat end."""
_STEPS = 255

Colors = NDArray[np.uint32]


@dataclass(frozen=True)
class Rows:
    """Which marker stands in which row.

    Attributes
    ----------
    columns : column of the take for each row, from the top
    row_of : row of each column
    groups : (name, first row, row after the last) of each group of markers
    """

    columns: tuple[int, ...]
    row_of: tuple[int, ...]
    groups: tuple[tuple[str, int, int], ...]


def arrange(markers: int, mesh: Mesh | None) -> Rows:
    """Put markers of a group together, in the tree's order; those without one come last."""
    columns: list[int] = []
    groups: list[tuple[str, int, int]] = []
    for group in () if mesh is None else _as_in_the_tree(mesh):
        groups.append((told_group(group.name), len(columns), len(columns) + len(group.markers)))
        columns += group.markers
    rest = sorted(set(range(markers)) - set(columns))
    if groups and rest:
        groups.append((tr("Others"), len(columns), markers))
    columns += rest
    row_of = np.empty(markers, dtype=np.int64)
    row_of[columns] = np.arange(markers)
    return Rows(tuple(columns), tuple(row_of.tolist()), tuple(groups))


def _as_in_the_tree(mesh: Mesh) -> list[Group]:
    """Groups, each followed by all that hang on it."""
    below: dict[int | None, list[int]] = {}
    for i, group in enumerate(mesh.groups):
        below.setdefault(group.parent, []).append(i)
    order, waiting = list[Group](), below.get(None, [])[::-1]
    while waiting:
        i = waiting.pop()
        order.append(mesh.groups[i])
        waiting += below.get(i, [])[::-1]
    return order


def row_edges(rows: int, height: int) -> list[tuple[int, int]]:
    """Top and bottom pixel of each row, every one at least a pixel high."""
    edges = np.floor(np.arange(rows + 1) * (height / max(1, rows))).astype(int).tolist()
    return [(a, max(b, a + 1)) for a, b in pairwise(edges)]


def heat(mode: str) -> tuple[QColor, ...]:
    """Colours from nothing to the most, for a mode."""
    look = theme.current()
    if mode == "gaps":
        return look.plot, look.kinds[Kind.GAP]
    if mode == "residual":
        return look.plot, look.kinds[Kind.NOISE], look.kinds[Kind.PEAK], look.text
    return look.plot, theme.blend(look.plot, look.muted, 0.5)


def residual_levels(residuals: NDArray[np.float32]) -> FloatArray:
    """Residuals in mm as shares of the heat: small ones need most of the colours."""
    return np.asarray(np.sqrt(np.clip(residuals / MOST_MM, 0.0, 1.0)), dtype=np.float64)


def paint_levels(
    size: tuple[int, int], rows: Rows, levels: FloatArray, colors: Sequence[QColor]
) -> QImage:
    """Paint rows of levels.

    Parameters
    ----------
    size : width and height in device pixels
    rows : order of the markers
    levels : (markers, width) in [0, 1]; NaN where nothing is known, which is painted grey
    colors : from level 0 to level 1

    Returns
    -------
    The picture; the markers of every other group lie on a tinted band
    """
    width, height = size
    look = theme.current()
    edges = row_edges(len(rows.columns), height)
    row_at = np.zeros(height, dtype=np.int64)
    for row, (top, bottom) in enumerate(edges):
        row_at[top:bottom] = row
    ramp = _ramp(colors)
    band = _ramp((theme.blend(colors[0], look.grid, 0.6), *colors[1:]))
    unknown = np.isnan(levels)
    index = np.where(unknown, 0, levels * _STEPS).astype(np.intp)[list(rows.columns)]
    pixels_of = ramp[index]
    odd = np.zeros(len(rows.columns), dtype=bool)
    for _, first, last in rows.groups[1::2]:
        odd[first:last] = True
    pixels_of[odd] = band[index[odd]]
    pixels_of[unknown[list(rows.columns)]] = _argb(theme.blend(look.plot, look.muted, 0.18))
    image = QImage(width, height, QImage.Format.Format_RGB32)
    pixels = np.frombuffer(image.bits(), dtype=np.uint32).reshape(height, -1)
    pixels[:, :width] = pixels_of[row_at]
    return image


def paint_artifacts(
    image: QImage,
    rows: Rows,
    artifacts: Sequence[Artifact],
    column_of: dict[str, int],
    span: tuple[float, float],
) -> None:
    """Paint artifacts by class over a picture that reaches over these frames."""
    look, (start, stop) = theme.current(), span
    scale = image.width() / (stop - start)
    edges = row_edges(len(rows.columns), image.height())
    painter = QPainter(image)
    inks: dict[tuple[Status, Kind, float], QColor] = {}
    for a in sorted(artifacts, key=lambda a: a.status is not Status.REJECTED):
        if a.stop > start and a.start < stop:
            left = (a.start - start) * scale
            right = max((a.stop - start) * scale, left + 1.5)
            kind = a.status, a.kind, a.confidence
            if kind not in inks:
                inks[kind] = _ink(a, look)
            for marker in a.markers:
                top, bottom = edges[rows.row_of[column_of[marker]]]
                painter.fillRect(QRectF(left, top, right - left, bottom - top), inks[kind])
    painter.end()


def _ink(artifact: Artifact, look: theme.Theme) -> QColor:
    """Strong when open and sure, faint when settled."""
    strength = 0.4 + 0.6 * min(max(artifact.confidence, 0.0), 1.0)
    if artifact.status is Status.REPAIRED:
        strength = 0.35
    elif artifact.status is Status.REJECTED:
        strength = 0.15
    return theme.faded(look.kinds[artifact.kind], strength)


def _argb(color: QColor) -> int:
    """A colour as a picture holds it."""
    return int(color.rgb()) & 0xFFFFFFFF


def _ramp(colors: Sequence[QColor]) -> Colors:
    """(256,) colours, evenly mixed from the first to the last."""
    return _mixed(tuple(_argb(color) for color in colors))


@lru_cache(maxsize=32)
def _mixed(values: tuple[int, ...]) -> Colors:
    """(256,) colours; the picture is painted anew at every decision."""
    colors = [QColor.fromRgb(value) for value in values]
    at = np.linspace(0.0, len(colors) - 1, _STEPS + 1)
    mixed = []
    for place in at.tolist():
        i = min(int(place), len(colors) - 2)
        mixed.append(_argb(theme.blend(colors[i], colors[i + 1], place - i)))
    return np.array(mixed, dtype=np.uint32)
