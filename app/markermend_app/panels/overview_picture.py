"""The picture of a whole take: one row a marker, time from left to right, artifacts by class."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter

from markermend.arrays import ByteArray, FloatArray
from markermend.artifact import Artifact, Status
from markermend.mesh import Mesh
from markermend.take import Origin
from markermend_app import theme


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
    """Put markers of a group together, in the mesh's order; those without one come last."""
    columns: list[int] = []
    groups: list[tuple[str, int, int]] = []
    for group in () if mesh is None else mesh.groups:
        groups.append((group.name, len(columns), len(columns) + len(group.markers)))
        columns += group.markers
    placed = set(columns)
    columns += [m for m in range(markers) if m not in placed]
    row_of = np.empty(markers, dtype=np.int64)
    row_of[columns] = np.arange(markers)
    return Rows(tuple(columns), tuple(row_of.tolist()), tuple(groups))


def missing_share(origin: ByteArray, width: int) -> FloatArray:
    """Share of missing samples behind each pixel.

    Parameters
    ----------
    origin : (frames, markers) uint8, see :class:`markermend.take.Origin`
    width : pixels

    Returns
    -------
    (markers, width) float64 in [0, 1]; where a pixel holds any missing sample, at least a third,
    so that short gaps stay visible
    """
    frames = len(origin)
    edges = np.linspace(0, frames, width + 1)
    first = np.minimum(edges[:-1].astype(np.int64), frames - 1)
    count = np.maximum(np.diff(np.append(first, frames)), 1)
    lost = (origin == Origin.MISSING).view(np.uint8)
    # A sum of 8-bit numbers overflows, hence the wider type.
    share = np.add.reduceat(lost, first, axis=0, dtype=np.int32) / count[:, None]
    share = np.where(share > 0, np.maximum(share, 1 / 3), 0.0)
    return np.asarray(share.T, dtype=np.float64)


def row_edges(rows: int, height: int) -> list[tuple[int, int]]:
    """Top and bottom pixel of each row, every one at least a pixel high."""
    edges = np.floor(np.arange(rows + 1) * (height / max(1, rows))).astype(int).tolist()
    return [(a, max(b, a + 1)) for a, b in pairwise(edges)]


def draw(
    size: tuple[int, int],
    rows: Rows,
    missing: FloatArray,
    artifacts: Sequence[Artifact],
    column_of: dict[str, int],
    frames: int,
) -> QImage:
    """Paint the picture.

    Parameters
    ----------
    size : width and height in device pixels
    rows : order of the markers
    missing : (markers, width) share of missing samples
    artifacts : what is to be shown
    column_of : column of the take by marker
    frames : length of the take
    """
    width, height = size
    look = theme.current()
    image = QImage(width, height, QImage.Format.Format_RGB32)
    image.fill(look.plot)
    edges = row_edges(len(rows.columns), height)
    _draw_missing(image, missing[list(rows.columns)], edges, look)
    painter = QPainter(image)
    painter.setPen(look.grid)
    for _, first, last in rows.groups:
        for row in (first, last):
            if 0 < row < len(edges):
                painter.drawLine(0, edges[row][0], width, edges[row][0])
    scale = width / frames
    for a in sorted(artifacts, key=lambda a: a.status is not Status.REJECTED):
        top, bottom = edges[rows.row_of[column_of[a.marker]]]
        left = a.start * scale
        right = max(a.stop * scale, left + 1.5)
        box = QRectF(left, top, right - left, bottom - top)
        painter.fillRect(box, _ink(a, look))
    painter.end()
    return image


def _ink(artifact: Artifact, look: theme.Theme) -> QColor:
    """Strong when open and sure, faint when settled."""
    strength = 0.4 + 0.6 * min(max(artifact.confidence, 0.0), 1.0)
    if artifact.status is Status.REPAIRED:
        strength = 0.35
    elif artifact.status is Status.REJECTED:
        strength = 0.15
    return theme.faded(look.kinds[artifact.kind], strength)


def _rgb(color: QColor) -> FloatArray:
    """Red, green and blue of a colour, 0 to 255."""
    return np.array([color.red(), color.green(), color.blue()], dtype=np.float64)


def _draw_missing(
    image: QImage, missing: FloatArray, edges: list[tuple[int, int]], look: theme.Theme
) -> None:
    """Shade missing samples; (rows, width) shares."""
    width, height = image.width(), image.height()
    plain = _rgb(look.plot)
    shade = _rgb(theme.blend(look.plot, look.muted, 0.5))
    row_at = np.zeros(height, dtype=np.int64)
    for row, (top, bottom) in enumerate(edges):
        row_at[top:bottom] = row
    mixed = plain + missing[row_at][:, :, None] * (shade - plain)
    rgb = mixed.astype(np.uint32)
    pixels = np.frombuffer(image.bits(), dtype=np.uint32).reshape(height, -1)
    pixels[:, :width] = 0xFF000000 | rgb[..., 0] << 16 | rgb[..., 1] << 8 | rgb[..., 2]
