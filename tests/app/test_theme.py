"""The looks: readable in light and dark, icons recoloured, watchers told."""

from __future__ import annotations

import itertools

import pytest
from PySide6.QtGui import QColor, QIcon
from PySide6.QtWidgets import QApplication

from markermend.artifact import Kind
from markermend_app import theme


def _luminance(color: QColor) -> float:
    """WCAG's relative luminance."""
    parts = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in color.getRgbF()]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


def _contrast(a: QColor, b: QColor) -> float:
    """WCAG's contrast ratio."""
    light, dark = sorted((_luminance(a), _luminance(b)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


@pytest.fixture(autouse=True)
def light_again(qapp: QApplication):
    yield
    theme.apply(qapp, "light")


@pytest.mark.parametrize("look", [theme.LIGHT, theme.DARK], ids=lambda t: t.name)
def test_text_is_readable(look: theme.Theme):
    for background in (look.window, look.panel, look.raised):
        assert _contrast(look.text, background) > 7
        assert _contrast(look.muted, background) > 4.5
        assert _contrast(look.warning, background) > 4.5
    assert _contrast(look.on_accent, look.accent) > 4.5
    for color in (*look.axes.values(), *look.markers):
        assert _contrast(color, look.plot) > 3
    for color in look.kinds.values():
        assert _contrast(color, look.plot) > 2.4


@pytest.mark.parametrize("look", [theme.LIGHT, theme.DARK], ids=lambda t: t.name)
def test_classes_differ(look: theme.Theme):
    assert set(look.kinds) == set(Kind) == set(theme.KIND_LETTER) == set(theme.KIND_NAME)
    for a, b in itertools.combinations(look.kinds.values(), 2):
        apart = sum((x - y) ** 2 for x, y in zip(a.getRgb()[:3], b.getRgb()[:3], strict=True))
        assert apart**0.5 > 60


def test_watchers_are_told_and_palette_follows(qapp: QApplication, qtbot):
    theme.apply(qapp, "light")
    with qtbot.waitSignal(theme.watcher.changed):
        theme.apply(qapp, "dark")
    assert theme.current().dark
    assert qapp.palette().window().color() == theme.DARK.window
    assert "$" not in qapp.styleSheet()


def test_icons_take_the_text_colour(qapp: QApplication):
    theme.apply(qapp, "dark")
    icon = theme.icon("accept")
    image = icon.pixmap(24, 24, QIcon.Mode.Normal).toImage()
    drawn = [
        image.pixelColor(x, y)
        for x, y in itertools.product(range(image.width()), range(image.height()))
        if image.pixelColor(x, y).alpha() > 250
    ]
    assert drawn
    assert all(abs(c.red() - theme.DARK.text.red()) < 6 for c in drawn)
    assert theme.icon("no such icon").isNull()


def test_system_theme_is_one_of_both(qapp: QApplication):
    theme.apply(qapp, "system")
    assert theme.current() in (theme.LIGHT, theme.DARK)


def test_marker_colours_go_round():
    n = len(theme.current().markers)
    assert theme.marker_color(n) == theme.marker_color(0)
