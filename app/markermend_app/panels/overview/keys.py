"""What keys mean while the overview has the keyboard."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt

_ROWS: Mapping[int, int] = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}
_ZOOM: Mapping[int, float] = {Qt.Key.Key_Plus: 0.5, Qt.Key.Key_Equal: 0.5, Qt.Key.Key_Minus: 2.0}


def row_by_key(key: int, row: int | None, rows: int) -> int | None:
    """The row above or below, the first where none was chosen; None for another key."""
    if key not in _ROWS or not rows:
        return None
    return 0 if row is None else min(max(row + _ROWS[key], 0), rows - 1)


def span_by_key(key: int, span: tuple[float, float], at: float) -> tuple[float, float] | None:
    """Frames in view after zooming by + or − around ``at``; None for another key."""
    if key not in _ZOOM:
        return None
    low, high = span
    at, factor = min(max(at, low), high), _ZOOM[key]
    return at - (at - low) * factor, at + (high - at) * factor
