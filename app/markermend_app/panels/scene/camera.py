"""A camera that goes round a point: from millimetres to pixels, for whole arrays at once."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from PySide6.QtCore import Qt

from markermend.arrays import FloatArray

NEAR = 0.02
"""Near plane as a share of the distance to the target."""

FOV = math.radians(35.0)
_MAX_PITCH = math.radians(89.0)

_KEY_PX = 24.0
_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
}
# As other programs have them: from the front, from a side and from above, with Ctrl the opposite.
_VIEWS = {Qt.Key.Key_1: 1, Qt.Key.Key_3: 2, Qt.Key.Key_7: 0}
_ZOOM = {Qt.Key.Key_Plus: 0.85, Qt.Key.Key_Equal: 0.85, Qt.Key.Key_Minus: 1 / 0.85}


@lru_cache(maxsize=8)
def _axes(yaw: float, pitch: float, axis: int) -> FloatArray:
    """Axes of a camera, which each part of a picture asks for."""
    e = np.eye(3)
    side, front, up = e[(axis + 1) % 3], e[(axis + 2) % 3], e[axis]
    across = -math.sin(yaw) * side + math.cos(yaw) * front
    out = math.cos(yaw) * side + math.sin(yaw) * front
    back = math.cos(pitch) * out + math.sin(pitch) * up
    axes = np.stack((across, np.cross(back, across), back))
    axes.setflags(write=False)
    return axes


def is_view_key(key: int, held: Qt.KeyboardModifier) -> bool:
    """Whether a key of the keypad asks for a view along an axis."""
    keypad, ctrl = Qt.KeyboardModifier.KeypadModifier, Qt.KeyboardModifier.ControlModifier
    return key in _VIEWS and bool(held & keypad) and not held & ~(keypad | ctrl)


@dataclass(frozen=True)
class Camera:
    """Where we look from.

    Attributes
    ----------
    target : (x, y, z) mm, the point in the middle
    distance : mm from the target
    yaw, pitch : radians, round and above the target
    up : axis that points up, 0, 1 or 2
    """

    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    distance: float = 5000.0
    yaw: float = math.radians(35.0)
    pitch: float = math.radians(14.0)
    up: int = 2

    def axes(self) -> FloatArray:
        """(3, 3): rows are right, up and back, in the take's coordinates; not to be written to."""
        return _axes(self.yaw, self.pitch, self.up)

    def to_view(self, points: FloatArray) -> FloatArray:
        """(n, 3) points as right, up, and depth in front of the eye, mm."""
        seen = (points - np.asarray(self.target)) @ self.axes().T
        seen[:, 2] = self.distance - seen[:, 2]
        return seen

    def to_pixels(self, seen: FloatArray, width: float, height: float) -> FloatArray:
        """(n, 2) pixels of points as :meth:`to_view` gives them; NaN behind the near plane."""
        scale = self.scale(height)
        depth = np.where(seen[:, 2] > NEAR * self.distance, seen[:, 2], np.nan)
        return np.stack(
            (width / 2 + scale * seen[:, 0] / depth, height / 2 - scale * seen[:, 1] / depth),
            axis=1,
        )

    def project(self, points: FloatArray, width: float, height: float) -> FloatArray:
        """(n, 2) pixels of (n, 3) points, NaN where missing or too near."""
        return self.to_pixels(self.to_view(points), width, height)

    def segments(
        self, start: FloatArray, stop: FloatArray, width: float, height: float
    ) -> FloatArray:
        """(n, 2, 2) pixels of lines, cut off at the near plane; NaN where nothing is left."""
        a, b = self.to_view(start), self.to_view(stop)
        near = NEAR * self.distance * 1.001
        for p, q in ((a, b), (b, a)):
            cut = (p[:, 2] < near) & (q[:, 2] > near)
            share = (near - p[cut, 2]) / (q[cut, 2] - p[cut, 2])
            p[cut] += share[:, None] * (q[cut] - p[cut])
        return np.stack(
            (self.to_pixels(a, width, height), self.to_pixels(b, width, height)), axis=1
        )

    def scale(self, height: float) -> float:
        """Pixels a millimetre takes at a depth of a millimetre."""
        return height / (2 * math.tan(FOV / 2))

    # Moves, each gives another camera

    def orbited(self, dx: float, dy: float) -> Camera:
        """Turned by a drag of pixels."""
        pitch = self.pitch + dy * 0.008
        return replace(
            self, yaw=self.yaw - dx * 0.008, pitch=max(-_MAX_PITCH, min(_MAX_PITCH, pitch))
        )

    def panned(self, dx: float, dy: float, height: float) -> Camera:
        """Moved sideways so that the target follows a drag of pixels."""
        across, up, _ = self.axes()
        mm = self.distance / self.scale(height)
        return self.moved(-across * dx * mm + up * dy * mm)

    def by_key(self, key: Qt.Key, held: Qt.KeyboardModifier, height: float) -> Camera | None:
        """Turned by Alt and an arrow, moved with Shift besides, zoomed by + and −; else None.

        The keypad's 1, 3 and 7 look along an axis, with Ctrl from the other side.
        """
        if key in _ZOOM:
            return self.zoomed(_ZOOM[key])
        if is_view_key(key, held):
            back = held & Qt.KeyboardModifier.ControlModifier
            return self.seen_from((self.up + _VIEWS[key]) % 3, -1 if back else 1)
        if key not in _ARROWS or not held & Qt.KeyboardModifier.AltModifier:
            return None
        dx, dy = (_KEY_PX * step for step in _ARROWS[key])
        if held & Qt.KeyboardModifier.ShiftModifier:
            return self.panned(dx, dy, height)
        return self.orbited(dx, dy)

    def moved(self, by: FloatArray) -> Camera:
        """Target and eye moved by mm."""
        x, y, z = (np.asarray(self.target) + by).tolist()
        return replace(self, target=(x, y, z))

    def seen_from(self, axis: int, side: int) -> Camera:
        """Turned so that an axis of the take points at the eye, or away from it.

        Parameters
        ----------
        axis : 0, 1 or 2; from above and below, the first axis across points to the right
        side : 1 or -1
        """
        turns = (axis - self.up) % 3
        if not turns:
            return replace(self, yaw=-math.pi / 2, pitch=side * _MAX_PITCH)
        yaw = (turns - 1) * math.pi / 2 + (math.pi if side < 0 else 0.0)
        return replace(self, yaw=yaw, pitch=0.0)

    def zoomed(self, factor: float) -> Camera:
        """Nearer (factor below 1) or farther."""
        return replace(self, distance=max(20.0, min(200_000.0, self.distance * factor)))
