"""The look in use: colours, icons and font sizes.

Nothing but :mod:`markermend_app.style.looks` names a colour. Who draws by itself reads
:func:`current` and draws anew when ``watcher.changed`` is emitted; ordinary widgets follow palette
and style sheet.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from types import MappingProxyType
from typing import Any

from PySide6.QtCore import QByteArray, QObject, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPalette, QPixmap
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QApplication, QStyleFactory

from markermend.artifact import Kind
from markermend_app import settings
from markermend_app.style.looks import DARK, LIGHT, LOOKS, Theme, colour_blind
from markermend_app.words import tr

__all__ = ["DARK", "LIGHT", "Theme"]

BASE_PT, SMALL_PT, HEADING_PT = 10, 9, 11

COLOUR_BLIND, CLASS_COLOUR = "colour_blind", "colour"

KIND_LETTER: Mapping[Kind, str] = MappingProxyType(
    {Kind.GAP: "G", Kind.PEAK: "P", Kind.NOISE: "N", Kind.STEP: "S", Kind.SLOW: "L"}
)
KIND_NAME: Mapping[Kind, str] = MappingProxyType(
    {
        Kind.GAP: "Gap",
        Kind.PEAK: "Peak",
        Kind.NOISE: "Noise",
        Kind.STEP: "Step",
        Kind.SLOW: "Slow drift",
    }
)


def kind_name(kind: Kind, *, within: bool = False) -> str:
    """A class in the language of the app, as a title or within a sentence."""
    return tr(KIND_NAME[kind].lower() if within else KIND_NAME[kind])


class Watcher(QObject):
    """Tells that the colours have changed.

    Signals
    -------
    changed() : :func:`current` gives another theme
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.theme = LIGHT
        self.name = "light"
        self.listens = self.styled = False
        self.hints: Any = None
        self.contrast: Any = None


watcher = Watcher()


def current() -> Theme:
    """The theme in use."""
    return watcher.theme


def apply(app: QApplication, name: str) -> None:
    """Give the app a look.

    Parameters
    ----------
    app : the application
    name : ``"light"``, ``"dark"``, ``"contrast"``, or ``"system"`` to follow the desktop in all
        three, also later

    Raises
    ------
    KeyError
        when there is no such theme
    """
    hints = app.styleHints()
    if not watcher.listens:
        hints.colorSchemeChanged.connect(lambda _: _follow(app))
        if hasattr(hints, "accessibility"):
            # Both are kept: the one is gone as soon as nobody holds the other.
            watcher.hints, watcher.contrast = hints, hints.accessibility()
            watcher.contrast.contrastPreferenceChanged.connect(lambda _: _follow(app))
        watcher.listens = True
    # Asking for a scheme tells at once, when nothing is to be followed yet.
    watcher.name = ""
    if name in ("system", "contrast"):
        hints.unsetColorScheme()
    else:
        dark = LOOKS[name].dark
        hints.setColorScheme(Qt.ColorScheme.Dark if dark else Qt.ColorScheme.Light)
    watcher.name = name
    _wear(app, _wanted(app))


def recolour(app: QApplication) -> None:
    """Take over colours that were changed in the preferences."""
    _wear(app, _wanted(app))


def _wanted(app: QApplication) -> Theme:
    """The look that was asked for, as the desktop is now."""
    dark = app.styleHints().colorScheme() == Qt.ColorScheme.Dark
    name = watcher.name
    if name == "contrast" or (name == "system" and _high_contrast()):
        name = "contrast-dark" if dark else "contrast-light"
    elif name == "system":
        name = "dark" if dark else "light"
    look = LOOKS[name]
    if settings.flag(COLOUR_BLIND, False):
        look = colour_blind(look)
    kinds = {kind: QColor(settings.text(f"{CLASS_COLOUR}/{kind}", "")) for kind in Kind}
    own = {kind: color for kind, color in kinds.items() if color.isValid()}
    return replace(look, kinds={**look.kinds, **own}) if own else look


def _high_contrast() -> bool:
    """Whether the desktop asks for high contrast, which it can since Qt 6.10."""
    hints = watcher.contrast
    return hints is not None and hints.contrastPreference() == Qt.ContrastPreference.HighContrast


def icon(name: str) -> QIcon:
    """An icon in the theme's text colour, dimmed when disabled; empty when there is none."""
    return _icon(name, current().name)


@cache
def blank_icon() -> QIcon:
    """Nothing, as large as any icon: it keeps the texts of a list in line."""
    pixmap = QPixmap(64, 64)
    pixmap.fill(Qt.GlobalColor.transparent)
    return QIcon(pixmap)


@cache
def app_icon() -> QIcon:
    """Markermend's own icon, in its own colours."""
    path = _icons() / "markermend.svg"
    renderer = QSvgRenderer(QByteArray(path.read_bytes()))
    result = QIcon()
    for size in (16, 32, 48, 64, 96, 128, 256):
        result.addPixmap(_drawn(renderer, size))
    return result


def marker_color(index: int) -> QColor:
    """Colour of the marker shown at this place, going round when there are many."""
    colors = current().markers
    return colors[index % len(colors)]


def svg(name: str, color: QColor) -> str:
    """Text of an icon's SVG in a colour; empty when there is no such icon."""
    return re.sub(r"#000(?![0-9a-fA-F])", color.name(), _black_svg(name))


@cache
def _black_svg(name: str) -> str:
    """Text of an icon as it is kept; empty when there is no such icon."""
    path = _icons() / f"{name}.svg"
    return path.read_text(encoding="utf-8") if name and path.is_file() else ""


def svg_file(name: str, color: QColor, tight: bool = False) -> str:
    """Path of an icon in a colour, as style sheets and icons want it; empty when there is none.

    Tight is without its margin.
    """
    path = Path(_folder().name) / f"{name}-{color.name().lstrip('#')}{'-tight' * tight}.svg"
    if not path.exists():
        text = svg(name, color)
        if not text:
            return ""
        if tight:
            text = text.replace('viewBox="0 0 24 24"', 'viewBox="3 3 18 18"')
        path.write_text(text, encoding="utf-8")
    return path.as_posix()


@cache
def _icons() -> Traversable:
    """Where the icons lie."""
    return files("markermend_resources") / "icons"


@cache
def _folder() -> tempfile.TemporaryDirectory[str]:
    """Where recoloured icons lie while the app runs."""
    return tempfile.TemporaryDirectory(prefix="markermend-", ignore_cleanup_errors=True)


def faded(color: QColor, alpha: float) -> QColor:
    """The same colour, see-through; alpha in [0, 1]."""
    other = QColor(color)
    other.setAlphaF(alpha)
    return other


def blend(color: QColor, other: QColor, share: float) -> QColor:
    """A colour mixed with a share of another."""
    return QColor.fromRgbF(
        color.redF() + (other.redF() - color.redF()) * share,
        color.greenF() + (other.greenF() - color.greenF()) * share,
        color.blueF() + (other.blueF() - color.blueF()) * share,
    )


def _follow(app: QApplication) -> None:
    """Take over the desktop's change between light and dark, or of contrast."""
    if watcher.name in ("system", "contrast"):
        _wear(app, _wanted(app))


def _wear(app: QApplication, theme: Theme) -> None:
    """Set style, palette, font and style sheet."""
    from markermend_app.style.stylesheet import stylesheet

    watcher.theme = theme
    if not watcher.styled:
        # Once: every widget is polished anew for a style, only to be so again for the sheet.
        app.setStyle(QStyleFactory.create("Fusion"))
        watcher.styled = True
    app.setPalette(_palette(theme))
    font = app.font()
    if font.pointSize() != BASE_PT:
        font.setPointSize(BASE_PT)
        app.setFont(font)
    sheet = stylesheet(theme)
    # Every widget is polished anew for a sheet, also for the same.
    if sheet != app.styleSheet():
        app.setStyleSheet(sheet)
    watcher.changed.emit()


def _palette(theme: Theme) -> QPalette:
    """The colours as Qt's widgets know them."""
    palette = QPalette()
    role = QPalette.ColorRole
    for r, color in (
        (role.Window, theme.window),
        (role.WindowText, theme.text),
        (role.Base, theme.panel),
        (role.AlternateBase, blend(theme.panel, theme.text, 0.03)),
        (role.ToolTipBase, theme.raised),
        (role.ToolTipText, theme.text),
        (role.Text, theme.text),
        (role.PlaceholderText, theme.muted),
        (role.Button, theme.raised),
        (role.ButtonText, theme.text),
        (role.BrightText, theme.warning),
        (role.Highlight, theme.accent),
        (role.HighlightedText, theme.on_accent),
        (role.Accent, theme.accent),
        (role.Link, theme.accent),
        (role.LinkVisited, theme.accent),
        (role.Light, blend(theme.raised, theme.text, 0.05)),
        (role.Midlight, theme.raised),
        (role.Mid, theme.border),
        (role.Dark, blend(theme.border, theme.text, 0.2)),
        (role.Shadow, theme.border),
    ):
        palette.setColor(r, color)
    dimmed = blend(theme.muted, theme.window, 0.4)
    for r in (role.WindowText, role.Text, role.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, r, dimmed)
    return palette


@cache
def _icon(name: str, theme_name: str) -> QIcon:
    """An icon that is drawn when it is shown, as sharp as the screen is."""
    theme = LOOKS[theme_name]
    result = QIcon()
    dimmed = blend(theme.muted, theme.window, 0.5)
    for mode, color in ((QIcon.Mode.Normal, theme.text), (QIcon.Mode.Disabled, dimmed)):
        path = svg_file(name, color)
        if path:
            result.addFile(path, QSize(), mode)
    return result


def _drawn(renderer: QSvgRenderer, size: int) -> QPixmap:
    """A square picture of an SVG."""
    pixmap = QPixmap(size, size)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    renderer.render(painter, QRectF(0, 0, size, size))
    painter.end()
    return pixmap
