"""Small painted things lists share: class badges, marker chips, hints where there is nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache, partial

from PySide6.QtCore import QByteArray, QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QIcon, QPainter, QPixmap
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QLabel, QWidget

from markermend.artifact import Kind
from markermend_app.style import theme

PAD = 4


def ink_on(color: QColor) -> QColor:
    """Whichever of the theme's lightest and darkest is read best on a colour."""
    t = theme.current()
    return max((t.text, t.panel), key=lambda ink: abs(_luminance(ink) - _luminance(color)))


def _luminance(color: QColor) -> float:
    """How bright a colour looks, 0 to 1."""
    return 0.299 * color.redF() + 0.587 * color.greenF() + 0.114 * color.blueF()


def ground_of(kind: Kind, faint: bool = False) -> QColor:
    """Colour behind a class's letter; a faint one steps back, and can still be read."""
    look = theme.current()
    color = look.kinds[kind]
    return theme.blend(look.panel, color, 0.3) if faint else color


def badge_width(text: str, metrics: QFontMetrics) -> int:
    """Width of a badge with this text."""
    return metrics.horizontalAdvance(text) + 2 * PAD


def paint_badge(painter: QPainter, rect: QRectF, text: str, color: QColor) -> None:
    """Fill a rounded box with a class colour and write on it, in the painter's font."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(color)
    painter.drawRoundedRect(rect, 3, 3)
    painter.setPen(ink_on(color))
    painter.drawText(rect, Qt.AlignmentFlag.AlignCenter, text)


def paint_share(painter: QPainter, rect: QRectF, share: float) -> None:
    """Paint a small bar, filled to a share in [0, 1]."""
    t = theme.current()
    bar = QRectF(rect.left(), rect.center().y() - 2, rect.width(), 5)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(t.grid)
    painter.drawRoundedRect(bar, 2.5, 2.5)
    painter.setBrush(t.accent)
    bar.setWidth(rect.width() * min(max(share, 0.0), 1.0))
    painter.drawRoundedRect(bar, 2.5, 2.5)


def badge_font(font: QFont) -> QFont:
    """The small semibold font badges are written in."""
    small = QFont(font)
    small.setPointSize(max(theme.SMALL_PT - 1, 7))
    small.setWeight(QFont.Weight.DemiBold)
    return small


def paint_counts(
    painter: QPainter, rect: QRect, counts: Mapping[Kind, int], font: QFont, faint: bool = False
) -> None:
    """Paint one badge a class, letter and number; dots stand for those there is no room for."""
    if not counts:
        return
    font = badge_font(font)
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setClipRect(rect)
    painter.setFont(font)
    look, metrics = theme.current(), QFontMetrics(font)
    height = metrics.height() + 2
    x = rect.left() + PAD
    texts = count_texts(counts)
    dots = metrics.horizontalAdvance("…")
    for i, (text, kind) in enumerate(texts):
        width = badge_width(text, metrics)
        needed = width if i == len(texts) - 1 else width + 3 + dots
        if x + needed > rect.right():
            painter.setPen(look.muted)
            painter.drawText(
                QRectF(x, rect.top(), dots + 1, rect.height()), Qt.AlignmentFlag.AlignVCenter, "…"
            )
            break
        box = QRectF(x, rect.center().y() + 1 - height / 2, width, height)
        paint_badge(painter, box, text, ground_of(kind, faint))
        x += width + 3
    painter.restore()


def counts_width(rows: Iterable[Mapping[Kind, int]], font: QFont) -> int:
    """Width the badges of these rows need at most."""
    metrics = QFontMetrics(badge_font(font))
    texts = {tuple(text for text, _ in count_texts(counts)) for counts in rows}
    widths = (sum(badge_width(text, metrics) + 3 for text in row) for row in texts)
    return 2 * PAD + max(widths, default=0)


def count_texts(counts: Mapping[Kind, int]) -> Sequence[tuple[str, Kind]]:
    """What the badges say, in the order of the classes."""
    return [(f"{theme.KIND_LETTER[k]}{counts[k]}", k) for k in Kind if counts.get(k)]


def kind_icon(kind: Kind, size: int = 16) -> QIcon:
    """A class as an icon: its letter on its colour."""
    return QIcon(_drawn(size, lambda p: _letter(p, kind, size)))


def dot_icon(color: QColor, filled: bool = True, size: int = 12) -> QIcon:
    """A marker as an icon: a disc in its colour, or a ring where it is not shown."""
    return _dot_icon(color.rgba(), filled, size)


@cache
def _dot_icon(rgba: int, filled: bool, size: int) -> QIcon:
    """One icon for each look there is: lists ask for them with every row they paint."""
    color = QColor.fromRgba(rgba)

    def draw(painter: QPainter) -> None:
        painter.setPen(color)
        painter.setBrush(color if filled else Qt.BrushStyle.NoBrush)
        radius = size * (0.36 if filled else 0.26)
        painter.drawEllipse(QPointF(size / 2, size / 2), radius, radius)

    return QIcon(_drawn(size, draw))


def tinted_icon(name: str, color: QColor, size: int = 16) -> QIcon:
    """One of the app's icons in another colour than the text's; empty when there is none.

    Where it is disabled it is dimmed as the others are.
    """
    result = QIcon()
    look = theme.current()
    dimmed = theme.blend(look.muted, look.window, 0.5)
    for mode, ink in ((QIcon.Mode.Normal, color), (QIcon.Mode.Disabled, dimmed)):
        text = theme.svg(name, ink)
        if text:
            renderer = QSvgRenderer(QByteArray(text.encode()))
            drawn = _drawn(size, partial(_whole, renderer, size))
            result.addPixmap(drawn, mode)
    return result


def _whole(renderer: QSvgRenderer, size: int, painter: QPainter) -> None:
    """Draw an icon as large as its picture."""
    renderer.render(painter, QRectF(0, 0, size, size))


def _letter(painter: QPainter, kind: Kind, size: int) -> None:
    """Draw a class letter."""
    font = QFont(painter.font())
    font.setPixelSize(round(size * 0.7))
    font.setWeight(QFont.Weight.DemiBold)
    painter.setFont(font)
    box = QRectF(0.5, 0.5, size - 1, size - 1)
    paint_badge(painter, box, theme.KIND_LETTER[kind], theme.current().kinds[kind])


def _drawn(size: int, draw: Callable[[QPainter], None]) -> QPixmap:
    """A pixmap, dense enough for dense screens."""
    ratio = 3
    pixmap = QPixmap(QSize(size * ratio, size * ratio))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    draw(painter)
    painter.end()
    return pixmap


def hint(text: str, parent: QWidget | None = None) -> QLabel:
    """A calm sentence in the middle of a panel that has nothing to show."""
    label = QLabel(text, parent)
    label.setProperty("role", "muted")
    label.setAlignment(Qt.AlignmentFlag.AlignCenter)
    label.setWordWrap(True)
    label.setMargin(16)
    label.setTextFormat(Qt.TextFormat.PlainText)
    return label
