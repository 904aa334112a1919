"""What a widget looks like, as numbers."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QColor, QImage
from PySide6.QtWidgets import QWidget

from markermend.arrays import IntArray


def colours(widget: QWidget) -> IntArray:
    """(height, width, 3) red, green and blue of each pixel, 0 to 255."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGB888)
    flat = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return flat[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)


def off(seen: IntArray, colour: QColor) -> IntArray:
    """(height, width) how far pixels are from a colour, summed over red, green and blue."""
    return np.asarray(np.abs(seen - colour.toTuple()[:3]).sum(axis=2))
