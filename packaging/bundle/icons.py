"""Draw the icon in every size and kind that systems ask for: ``python icons.py FOLDER``."""

import io
import os
import sys
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from PIL import Image
from PySide6.QtCore import QBuffer, QIODevice
from PySide6.QtGui import QGuiApplication, QImage, QPainter
from PySide6.QtSvg import QSvgRenderer

ROOT = Path(__file__).resolve().parent.parent.parent
SOURCE = ROOT / "resources" / "markermend_resources" / "icons" / "markermend.svg"
SIZES = (16, 24, 32, 48, 64, 128, 256, 512)


def main():
    """Write PNG files, and the collections of Windows and macOS."""
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    app = QGuiApplication([])
    pictures = {size: draw(size) for size in SIZES}
    for size, picture in pictures.items():
        picture.save(str(target / ("markermend-%d.png" % size)))
    largest = pictures[SIZES[-1]]
    others = [pictures[s] for s in SIZES[:-1]]
    largest.save(str(target / "markermend.ico"), sizes=[(s, s) for s in SIZES[:-1]])
    largest.save(str(target / "markermend.icns"), append_images=others)
    app.quit()


def draw(size):
    """Draw the icon in one size."""
    image = QImage(size, size, QImage.Format.Format_ARGB32)
    image.fill(0)
    painter = QPainter(image)
    QSvgRenderer(str(SOURCE)).render(painter)
    painter.end()
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    image.save(buffer, "PNG")
    return Image.open(io.BytesIO(buffer.data().data())).copy()


if __name__ == "__main__":
    main()
