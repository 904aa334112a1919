"""All artifacts of one plot as one item: bands over the plot, and a strip that names them.

Only what is in view is painted, and rectangles that fall on the same pixels are painted once,
so that thousands of artifacts cost no more than the screen is wide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QTransform

from markermend.artifact import Artifact, Kind, Status
from markermend_app.items.in_view import InView
from markermend_app.style import theme

LANE_HEIGHT = 12
THIN_LANE_HEIGHT = 6
_STRIP_MOST = 0.3
"""Share of a plot that lanes with letters may take."""
_LETTER_WIDTH = 11
_REACH_PX = 3.0
# A see-through fill takes twenty times as long as a solid one of the same colour; under narrow
# bands, which are many, there is nothing to be seen through.
_SOLID_PX = 8
# Too narrow for outline or hatching: the status shows as strength alone.
_NARROW = {
    Status.PENDING: 1.0,
    Status.ACCEPTED: 1.0,
    Status.REPAIRED: 0.45,
    Status.REJECTED: 0.25,
}


@dataclass(frozen=True)
class Placed:
    """An artifact on screen: its rectangle of one lane, in scene pixels."""

    artifact: Artifact
    left: float
    right: float
    top: float
    height: float


class Intervals(InView):
    """Artifacts of the shown markers on one axis; one lane a marker, the foremost lowest.

    Those of several markers, which changed places, lie in the lanes of all of them.

    ``show`` takes what is to be drawn; ``hit`` tells which artifact lies under a point.
    """

    def __init__(self) -> None:
        super().__init__()
        self._rows: tuple[Artifact, ...] = ()
        self._lanes: dict[str, int] = {}
        self._current: str | None = None
        self._start = np.zeros(0, dtype=np.int64)
        self._stop = np.zeros(0, dtype=np.int64)
        self._reach = np.zeros(0, dtype=np.int64)
        self.setZValue(-10)

    def show(self, artifacts: Sequence[Artifact], markers: Sequence[str]) -> None:
        """Draw these artifacts, sorted by start; the first marker gets the lowest lane."""
        self._rows = tuple(artifacts)
        self._lanes = {name: i for i, name in enumerate(markers)}
        self._start = np.array([a.start for a in self._rows], dtype=np.int64)
        self._stop = np.array([a.stop for a in self._rows], dtype=np.int64)
        self._reach = np.maximum.accumulate(self._stop) if self._rows else self._stop
        self.update()

    def set_current(self, artifact_id: str | None) -> None:
        """Draw one artifact brighter than the others."""
        if artifact_id != self._current:
            self._current = artifact_id
            self.update()

    @property
    def strip_height(self) -> int:
        """Pixels that the lanes take at the bottom of the plot."""
        return round(max(1, len(self._lanes)) * self._lane_height())

    def hit(self, scene: QPointF) -> str | None:
        """Id of the artifact under a point of the scene: in its lane, else in its band.

        Where several overlap, the current one goes first, then the shortest.
        """
        box = self._view_in_scene()
        if not box.contains(scene):
            return None
        inside = [
            p
            for p in self._placed(box, _REACH_PX)
            if p.left - _REACH_PX <= scene.x() <= p.right + _REACH_PX
        ]
        in_lane = [p for p in inside if p.top <= scene.y() < p.top + p.height]
        if scene.y() >= box.bottom() - self.strip_height:
            inside = in_lane
        if not inside:
            return None
        best = min(inside, key=lambda p: (p.artifact.id != self._current, p.right - p.left))
        return best.artifact.id

    def extent(self, artifact_id: str) -> QRectF | None:
        """Band of an artifact in scene pixels, or None when it is not in view."""
        box = self._view_in_scene()
        for p in self._placed(box, 0.0):
            if p.artifact.id == artifact_id:
                left, right = max(p.left, box.left()), min(p.right, box.right())
                return QRectF(left, box.top(), max(1.0, right - left), box.height())
        return None

    # What pyqtgraph asks for

    def paint(self, painter: QPainter, *_: object) -> None:
        """Paint bands, then the strip, in screen pixels."""
        back, ok = self.sceneTransform().inverted()
        if not ok or not self._rows:
            return
        box = self._view_in_scene()
        placed = self._placed(box, 1.0)
        painter.setWorldTransform(QTransform(back) * painter.worldTransform())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        look = theme.current()
        self._paint_bands(painter, placed, box, look)
        for p in placed:
            self._paint_lane(painter, p, look)

    # Inner workings

    def _lane_height(self) -> float:
        """Height of one lane: with room for letters while there are few markers in a high plot.

        Many lanes share what three take, else they would cover the curves.
        """
        lanes = max(1, len(self._lanes))
        if lanes <= 3 and lanes * LANE_HEIGHT <= _STRIP_MOST * self._view_in_scene().height():
            return LANE_HEIGHT
        return min(THIN_LANE_HEIGHT, max(1.0, 3 * LANE_HEIGHT / lanes))

    def _lanes_of(self, artifact: Artifact) -> list[int]:
        """Lanes of the shown markers that it is of, the lowest first: of a mix-up several."""
        return sorted(self._lanes[m] for m in artifact.markers if m in self._lanes)

    def _view_in_scene(self) -> QRectF:
        """The visible part of the plot, in scene pixels."""
        view = self.getViewBox()
        return QRectF() if view is None else view.sceneBoundingRect()

    def _placed(self, box: QRectF, margin_px: float) -> list[Placed]:
        """Artifacts in view with their places, each at least a pixel wide."""
        view = self.getViewBox()
        if view is None or not self._rows or box.width() <= 0:
            return []
        low, high = view.viewRange()[0]
        scale = box.width() / (high - low)
        margin = margin_px / scale + 1.0
        first = int(np.searchsorted(self._reach, low - margin, side="right"))
        last = int(np.searchsorted(self._start, high + margin, side="left"))
        chosen = first + np.flatnonzero(self._stop[first:last] > low - margin)
        left = box.left() + (self._start[chosen] - 0.5 - low) * scale
        right = np.maximum(box.left() + (self._stop[chosen] - 0.5 - low) * scale, left + 1.0)
        height = self._lane_height()
        floor = box.bottom() - height
        return [
            Placed(a, x0, x1, floor - height * lane, height)
            for a, x0, x1 in zip(
                (self._rows[i] for i in chosen.tolist()), left.tolist(), right.tolist(), strict=True
            )
            for lane in self._lanes_of(a)
        ]

    def _paint_bands(
        self, painter: QPainter, placed: list[Placed], box: QRectF, look: theme.Theme
    ) -> None:
        """Full-height bands: one set of rectangles for each look there is."""
        groups: dict[tuple[Kind, float], set[tuple[int, int]]] = {}
        for p in placed:
            alpha = self._band_alpha(p.artifact)
            if alpha:
                place = (round(p.left), max(1, round(p.right) - round(p.left)))
                groups.setdefault((p.artifact.kind, alpha), set()).add(place)
        for (kind, alpha), places in groups.items():
            clear = theme.faded(look.kinds[kind], alpha)
            solid = theme.blend(look.plot, look.kinds[kind], alpha)
            for left, width in places:
                color = solid if width <= _SOLID_PX else clear
                painter.fillRect(QRectF(left, box.top(), width, box.height()), color)

    def _band_alpha(self, artifact: Artifact) -> float:
        """How strong a band is: open ones of the foremost marker stand out, rejected have none."""
        if artifact.id == self._current:
            return 0.24
        if 0 not in self._lanes_of(artifact):
            return 0.0
        return {
            Status.PENDING: 0.16,
            Status.ACCEPTED: 0.12,
            Status.REPAIRED: 0.06,
            Status.REJECTED: 0.0,
        }[artifact.status]

    def _paint_lane(self, painter: QPainter, p: Placed, look: theme.Theme) -> None:
        """One artifact in the strip: filled, outlined, hatched or hollow by its status."""
        color = look.kinds[p.artifact.kind]
        left, right = round(p.left), max(round(p.right), round(p.left) + 1)
        box = QRectF(left, p.top, right - left, max(1.0, p.height - 1))
        status = p.artifact.status
        if box.width() <= 3 and p.artifact.id != self._current:
            painter.fillRect(box, theme.faded(color, _NARROW[status]))
            return
        if status is Status.REJECTED:
            color = theme.blend(color, look.plot, 0.55)
            painter.setPen(QPen(color, 1, Qt.PenStyle.DotLine))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(box.adjusted(0, 0, -1, -1))
        elif status is Status.REPAIRED:
            painter.fillRect(box, theme.faded(color, 0.3))
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(pg.mkBrush(color))
            painter.fillRect(box, _hatch(color))
        else:
            painter.fillRect(box, color)
        if status is Status.ACCEPTED or p.artifact.id == self._current:
            painter.setPen(QPen(look.text, 1))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(box.adjusted(0, 0, -1, -1))
        if box.width() >= _LETTER_WIDTH and p.height >= LANE_HEIGHT:
            solid = status in (Status.PENDING, Status.ACCEPTED)
            ink = look.plot if solid else look.text if status is Status.REPAIRED else color
            letter = theme.KIND_LETTER[p.artifact.kind]
            _write(painter, box, letter + ("✓" if status is Status.REPAIRED else ""), ink)


def _hatch(color: QColor) -> object:
    """Slanted lines in a colour."""
    brush = pg.mkBrush(color)
    brush.setStyle(Qt.BrushStyle.BDiagPattern)
    return brush


def _write(painter: QPainter, box: QRectF, text: str, color: QColor) -> None:
    """A letter or two in the middle of a box, when they fit."""
    font = QFont(painter.font())
    font.setPixelSize(LANE_HEIGHT - 3)
    font.setBold(True)
    painter.setFont(font)
    if len(text) > 1 and box.width() < 2 * _LETTER_WIDTH:
        text = text[0]
    painter.setPen(color)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
