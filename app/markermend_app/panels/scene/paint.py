"""How the 3D view is painted: few calls, each over whole arrays."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPainterPath, QPen

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Kind
from markermend_app.panels.scene.camera import Camera
from markermend_app.panels.scene.stage import Stage, floor_lines
from markermend_app.style import theme


@dataclass(frozen=True, eq=False)
class Sight:
    """Painter, camera and size: what everything here needs.

    Attributes
    ----------
    painter : where to
    camera : from where
    width, height : pixels
    """

    painter: QPainter
    camera: Camera
    width: float
    height: float

    def project(self, points: FloatArray) -> FloatArray:
        """(n, 2) pixels."""
        return self.camera.project(points, self.width, self.height)

    def stroke(self, path: QPainterPath, color: QColor, width: float, style: Qt.PenStyle) -> None:
        """Draw a path without filling it."""
        self.painter.setPen(_pen(color, width, style))
        self.painter.setBrush(Qt.BrushStyle.NoBrush)
        self.painter.drawPath(path)


def paint_floor(sight: Sight, stage: Stage) -> None:
    """Draw the floor's squares."""
    start, stop = floor_lines(stage)
    _paint_segments(sight, start, stop, _pen(theme.current().grid, 1.0))


def paint_links(
    sight: Sight, positions: FloatArray, links: IntArray, color: QColor, width: float
) -> None:
    """Draw the body's segments; (n, 2) columns of markers."""
    if len(links):
        _paint_segments(sight, positions[links[:, 0]], positions[links[:, 1]], _pen(color, width))


def paint_proposed(sight: Sight, positions: FloatArray, links: IntArray) -> None:
    """Draw segments that a previewed repair would put there, dashed; (n, 2) columns of markers."""
    if len(links):
        pen = _pen(theme.current().accent, 1.6, Qt.PenStyle.DashLine)
        _paint_segments(sight, positions[links[:, 0]], positions[links[:, 1]], pen)


def paint_other(sight: Sight, now: FloatArray, other: FloatArray, color: QColor) -> None:
    """Draw where markers are in the other version: hollow, tied to where they are in this one.

    What ties them is dotted and in a colour that no segment has: between left and right that were
    swapped it is as long as a bone.

    Parameters
    ----------
    now, other : (n, 3) mm; NaN where a version has no sample
    """
    _paint_segments(sight, now, other, _pen(theme.current().warning, 1.2, Qt.PenStyle.DotLine))
    painter = sight.painter
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(_pen(color, 1.6))
    at = sight.project(other)
    for x, y in at[~np.isnan(at[:, 0])].tolist():
        painter.drawEllipse(QPointF(x, y), 5.0, 5.0)


def _paint_segments(sight: Sight, start: FloatArray, stop: FloatArray, pen: QPen) -> None:
    """Draw separate lines; one path of many crossing lines takes several times as long."""
    ends = sight.camera.segments(start, stop, sight.width, sight.height)
    ends = ends[~np.isnan(ends).any(axis=(1, 2))].reshape(-1, 4)
    sight.painter.setPen(pen)
    sight.painter.drawLines([QLineF(*line) for line in ends.tolist()])


def paint_trails(
    sight: Sight,
    trails: FloatArray,
    color: QColor,
    width: float,
    style: Qt.PenStyle = Qt.PenStyle.SolidLine,
) -> None:
    """Draw (markers, frames, 3) paths, broken where missing, as one path."""
    markers, frames = trails.shape[:2]
    if not markers or frames < 2:
        return
    broken = np.full((markers, frames + 1, 3), np.nan)
    broken[:, :frames] = trails
    points = sight.project(broken.reshape(-1, 3))
    path = pg.arrayToQPath(points[:, 0].copy(), points[:, 1].copy(), connect="finite")
    sight.stroke(path, color, width, style)


def paint_body(sight: Sight, now: FloatArray, links: IntArray, off: BoolArray) -> None:
    """Draw (links, 2) segments; those of the wrong length, (links,) bool, in red."""
    t = theme.current()
    paint_links(sight, now, links[~off], t.bones, 1.6)
    paint_links(sight, now, links[off], t.axes["x"], 2.4)


def paint_paths(sight: Sight, near: FloatArray, shown: Mapping[int, int], everything: bool) -> None:
    """Draw where markers come from and go to.

    Parameters
    ----------
    sight : painter, camera and size
    near : (frames, markers, 3) mm, around the frame
    shown : columns in the plots, and the place of each there
    everything : all others, too
    """
    if everything:
        color = theme.faded(theme.current().muted, 0.5)
        paint_trails(sight, near.transpose(1, 0, 2), color, 1.0)
    for column, place in shown.items():
        color = theme.faded(theme.marker_color(place), 0.7)
        paint_trails(sight, near[None, :, column], color, 1.6)


@dataclass(frozen=True, eq=False)
class Discs:
    """How the markers of a frame look.

    Attributes
    ----------
    positions : (markers, 3) mm
    radius : (markers,) mm
    shown : column to its place among the shown markers
    rings : column to the class of an open artifact that covers the frame
    colours : of each marker, unless it is shown
    least : pixels, the least radius
    """

    positions: FloatArray
    radius: FloatArray
    shown: Mapping[int, int]
    rings: Mapping[int, Kind]
    colours: Sequence[QColor]
    least: float


def paint_discs(sight: Sight, discs: Discs) -> FloatArray:
    """Draw markers from far to near; returns their (markers, 2) pixels, NaN where not drawn."""
    t = theme.current()
    seen = sight.camera.to_view(discs.positions)
    at = sight.camera.to_pixels(seen, sight.width, sight.height)
    scale = sight.camera.scale(sight.height)
    depth = seen[:, 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = np.clip(discs.radius * scale / depth, discs.least, 14.0)
    order = np.argsort(-depth)
    order = order[~np.isnan(at[order, 0])]
    painter = sight.painter
    edge = QPen(t.plot, 1)
    for column in order.tolist():
        centre, r = QPointF(at[column, 0], at[column, 1]), float(radius[column])
        place = discs.shown.get(column)
        painter.setPen(edge)
        painter.setBrush(discs.colours[column] if place is None else theme.marker_color(place))
        r = r if place is None else max(r * 1.35, 4.5)
        painter.drawEllipse(centre, r, r)
        kind = discs.rings.get(column)
        if kind is not None:
            painter.setPen(QPen(t.kinds[kind], 2.2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawEllipse(centre, max(r + 3.5, 6.0), max(r + 3.5, 6.0))
    return at


def paint_ghost(sight: Sight, proposed: FloatArray, now: FloatArray) -> FloatArray:
    """Draw a dashed ring where the previewed repair puts the marker, and the way there.

    Returns its (2,) pixels.
    """
    at = sight.project(np.stack((proposed, now)))
    if np.isnan(at[0]).any():
        return at[0]
    color = theme.current().accent
    painter = sight.painter
    painter.setBrush(Qt.BrushStyle.NoBrush)
    if not np.isnan(at[1]).any():
        painter.setPen(QPen(color, 1, Qt.PenStyle.DotLine))
        painter.drawLine(QPointF(*at[0]), QPointF(*at[1]))
    painter.setPen(QPen(color, 2, Qt.PenStyle.DashLine))
    painter.drawEllipse(QPointF(*at[0]), 7.0, 7.0)
    return at[0]


def paint_followed(sight: Sight, at: FloatArray) -> None:
    """Ring the markers that a repair was told to follow; at is (n, 2) in pixels."""
    sight.painter.setBrush(Qt.BrushStyle.NoBrush)
    sight.painter.setPen(_pen(theme.current().accent, 2.0))
    for x, y in at[np.isfinite(at).all(axis=1)].tolist():
        sight.painter.drawEllipse(QPointF(x, y), 9.0, 9.0)


def paint_labels(sight: Sight, at: FloatArray, names: Sequence[tuple[int, str]]) -> None:
    """Write names beside markers, on a veil of background so that they can be read.

    Each goes to the side of its marker where it covers the fewest others; one that could only
    cover another name is left out.
    """
    t = theme.current()
    painter = sight.painter
    painter.setFont(_font(painter, QFont.Weight.DemiBold))
    room = QRectF(0.0, 0.0, sight.width, sight.height)
    for box, name in place_labels(painter.fontMetrics(), at, names, room):
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.faded(t.plot, 0.75))
        painter.drawRoundedRect(box, 3, 3)
        painter.setPen(t.text)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, name)


def place_labels(
    metrics: QFontMetrics, at: FloatArray, names: Sequence[tuple[int, str]], room: QRectF
) -> list[tuple[QRectF, str]]:
    """Boxes within a room for the names of markers, (markers, 2) pixels; the first choose first."""
    taken: list[tuple[QRectF, str]] = []
    for column, name in names:
        x, y = at[column].tolist()
        if math.isnan(x):
            continue
        width, height = metrics.horizontalAdvance(name) + 6.0, float(metrics.height())
        best, fewest = QRectF(), len(at) + 1
        for left, top in (
            (x + 9, y - height / 2),
            (x - 9 - width, y - height / 2),
            (x - width / 2, y - 8 - height),
            (x - width / 2, y + 8),
        ):
            box = QRectF(left, top, width, height)
            if not room.contains(box) or any(box.intersects(other) for other, _ in taken):
                continue
            over = np.abs(at - (left + width / 2, top + height / 2)) < (width / 2, height / 2)
            covered = int(np.count_nonzero(over.all(axis=1)))
            if covered < fewest:
                best, fewest = box, covered
            if not covered:
                break
        if not best.isNull():
            taken.append((best, name))
    return taken


def paint_triad(sight: Sight) -> None:
    """Draw which way the axes point, in the lower left corner."""
    t = theme.current()
    painter = sight.painter
    origin = QPointF(38, sight.height - 38)
    axes = sight.camera.axes()
    painter.setFont(_font(painter, QFont.Weight.Bold))
    for axis in np.argsort(axes[2]).tolist():
        tip = QPointF(axes[0, axis] * 22, -axes[1, axis] * 22)
        color = t.axes["xyz"[axis]]
        painter.setPen(QPen(color, 2, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawLine(origin, origin + tip)
        box = QRectF(0, 0, 16, 16)
        box.moveCenter(origin + tip * 1.35)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, "XYZ"[axis])


def paint_note(sight: Sight, text: str) -> None:
    """Write a small line in the lower right corner, left of the buttons."""
    painter = sight.painter
    painter.setFont(_font(painter, QFont.Weight.Normal))
    painter.setPen(theme.current().muted)
    box = QRectF(0, sight.height - 24, sight.width - 40, 20)
    painter.drawText(box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, text)


def paint_title(sight: Sight, text: str, color: QColor) -> None:
    """Write a line in the upper left corner."""
    painter = sight.painter
    painter.setFont(_font(painter, QFont.Weight.DemiBold))
    painter.setPen(color)
    painter.drawText(QPointF(10, 20), text)


def _pen(color: QColor, width: float, style: Qt.PenStyle = Qt.PenStyle.SolidLine) -> QPen:
    """A pen; a hairline is one in device pixels, which is many times as fast on dense screens."""
    pen = QPen(color, width, style)
    pen.setCosmetic(width <= 1)
    return pen


def _font(painter: QPainter, weight: QFont.Weight) -> QFont:
    """The small font."""
    font = QFont(painter.font())
    font.setPointSize(theme.SMALL_PT)
    font.setWeight(weight)
    return font


def paint_message(painter: QPainter, box: QRectF, text: str) -> None:
    """Say in the middle why nothing is seen."""
    painter.setPen(theme.current().muted)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
