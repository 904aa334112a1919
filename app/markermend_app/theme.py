"""Every colour, icon and font size of the app, in light and dark.

Nothing else names a colour. Who draws by itself reads :func:`current` and draws anew when
``watcher.changed`` is emitted; ordinary widgets follow palette and style sheet.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from types import MappingProxyType

from PySide6.QtCore import QByteArray, QObject, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPalette, QPixmap
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QApplication, QStyleFactory

from markermend.artifact import Kind

BASE_PT, SMALL_PT, HEADING_PT = 10, 9, 11

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


@dataclass(frozen=True)
class Theme:
    """The colours of one look.

    Attributes
    ----------
    name, dark : which look this is
    window, panel, plot : backgrounds of the window, of lists and fields, and of drawings
    raised : background of buttons, headers and dock titles
    border : lines between things
    text, muted : what is read, and what is read second
    grid : lines within drawings
    accent, on_accent : what is active or proposed, and text upon it
    selection : what the operator has swept over
    original : samples as they were opened
    warning : what needs attention
    flag : events of the file
    axes : by axis name, x red, y green, z blue
    kinds : by class of artifact, told apart by colour-blind people too (after Okabe and Ito)
    markers : curves of shown markers, in the order they are shown
    """

    name: str
    dark: bool
    window: QColor
    panel: QColor
    plot: QColor
    raised: QColor
    border: QColor
    text: QColor
    muted: QColor
    grid: QColor
    accent: QColor
    on_accent: QColor
    selection: QColor
    original: QColor
    warning: QColor
    flag: QColor
    axes: Mapping[str, QColor]
    kinds: Mapping[Kind, QColor]
    markers: tuple[QColor, ...]


def _kinds(gap: str, peak: str, noise: str, step: str, slow: str) -> Mapping[Kind, QColor]:
    """Colours by class."""
    names = (gap, peak, noise, step, slow)
    return MappingProxyType({k: QColor(c) for k, c in zip(Kind, names, strict=True)})


def _axes(x: str, y: str, z: str) -> Mapping[str, QColor]:
    """Colours by axis."""
    return MappingProxyType({"x": QColor(x), "y": QColor(y), "z": QColor(z)})


LIGHT = Theme(
    name="light",
    dark=False,
    window=QColor("#eef0f3"),
    panel=QColor("#ffffff"),
    plot=QColor("#ffffff"),
    raised=QColor("#f7f8fa"),
    border=QColor("#d3d8df"),
    text=QColor("#1d2430"),
    muted=QColor("#5d6776"),
    grid=QColor("#dfe3e9"),
    accent=QColor("#4a55c9"),
    on_accent=QColor("#ffffff"),
    selection=QColor("#7a8299"),
    original=QColor("#a2a9b4"),
    warning=QColor("#a8570a"),
    flag=QColor("#6a4fb3"),
    axes=_axes("#c62f2f", "#22802f", "#2563c9"),
    kinds=_kinds("#2f8fd0", "#cb4512", "#c79200", "#009e73", "#b8569a"),
    markers=tuple(
        QColor(c)
        for c in ("#2b3a55", "#0f7c8a", "#8a5a14", "#7b3fa0", "#4d7a1e", "#a83256", "#5b6573")
    ),
)

DARK = Theme(
    name="dark",
    dark=True,
    window=QColor("#1c1f24"),
    panel=QColor("#22262c"),
    plot=QColor("#191c20"),
    raised=QColor("#2a2f36"),
    border=QColor("#3a404a"),
    text=QColor("#e4e7ec"),
    muted=QColor("#9aa3b0"),
    grid=QColor("#30363e"),
    accent=QColor("#8e98ff"),
    on_accent=QColor("#14171c"),
    selection=QColor("#98a2b8"),
    original=QColor("#6b7380"),
    warning=QColor("#f0b45a"),
    flag=QColor("#b9a5f5"),
    axes=_axes("#ff7070", "#62c972", "#6fa8ff"),
    kinds=_kinds("#56b4e9", "#f2683a", "#f5c542", "#2cc295", "#dd8fc0"),
    markers=tuple(
        QColor(c)
        for c in ("#d7e0f0", "#5cd0dc", "#e0b070", "#c79bf0", "#a8d66a", "#f58ca8", "#a4afbf")
    ),
)

_THEMES = MappingProxyType({"light": LIGHT, "dark": DARK})


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
        self.follows_system = False
        self.listens = False


watcher = Watcher()


def current() -> Theme:
    """The theme in use."""
    return watcher.theme


def apply(app: QApplication, name: str) -> None:
    """Give the app a look.

    Parameters
    ----------
    app : the application
    name : ``"light"``, ``"dark"``, or ``"system"`` to follow the desktop, also later

    Raises
    ------
    KeyError
        when there is no such theme
    """
    hints = app.styleHints()
    watcher.follows_system = name == "system"
    if not watcher.listens:
        hints.colorSchemeChanged.connect(lambda _: _follow(app))
        watcher.listens = True
    if name == "system":
        hints.unsetColorScheme()
        _wear(app, DARK if hints.colorScheme() == Qt.ColorScheme.Dark else LIGHT)
        return
    theme = _THEMES[name]
    hints.setColorScheme(Qt.ColorScheme.Dark if theme.dark else Qt.ColorScheme.Light)
    _wear(app, theme)


def icon(name: str) -> QIcon:
    """An icon in the theme's text colour, dimmed when disabled; empty when there is none."""
    return _icon(name, current().name)


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
    path = _icons() / f"{name}.svg"
    if not name or not path.is_file():
        return ""
    return re.sub(r"#000(?![0-9a-fA-F])", color.name(), path.read_text(encoding="utf-8"))


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
    """Take over the desktop's change between light and dark."""
    if watcher.follows_system:
        dark = app.styleHints().colorScheme() == Qt.ColorScheme.Dark
        _wear(app, DARK if dark else LIGHT)


def _wear(app: QApplication, theme: Theme) -> None:
    """Set style, palette, font and style sheet."""
    from markermend_app.stylesheet import stylesheet

    watcher.theme = theme
    app.setStyle(QStyleFactory.create("Fusion"))
    app.setPalette(_palette(theme))
    font = app.font()
    font.setPointSize(BASE_PT)
    app.setFont(font)
    app.setStyleSheet(stylesheet(theme))
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
    theme = _THEMES[theme_name]
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
