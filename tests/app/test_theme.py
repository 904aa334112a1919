"""The looks: readable in light and dark, icons recoloured, watchers told."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from PySide6.QtCore import QEvent
from PySide6.QtGui import QColor, QIcon
from PySide6.QtWidgets import QApplication, QLabel

from markermend.artifact import Kind
from markermend_app import settings
from markermend_app.panels.markers.badge import ground_of, ink_on
from markermend_app.style import theme
from markermend_app.style.looks import LOOKS, colour_blind


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


@pytest.mark.parametrize("look", LOOKS.values(), ids=lambda t: t.name)
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


def test_a_look_that_is_worn_already_polishes_nothing_anew(qapp, qtbot):
    theme.apply(qapp, "light")
    polished = []

    class Watched(QLabel):
        def changeEvent(self, event):
            if event.type() == QEvent.Type.StyleChange:
                polished.append(event)

    label = Watched()
    qtbot.addWidget(label)
    label.show()
    polished.clear()
    theme.recolour(qapp)
    theme.apply(qapp, "light")
    assert not polished
    theme.apply(qapp, "dark")
    assert polished


@pytest.mark.parametrize("name", ["light", "dark", "contrast"])
def test_badges_can_be_read_also_where_they_step_back(qapp, name):
    theme.apply(qapp, name)
    for kind in Kind:
        ground = ground_of(kind, faint=True)
        assert _contrast(ink_on(ground), ground) > 4.5
        assert ground != ground_of(kind)


@pytest.mark.parametrize("look", LOOKS.values(), ids=lambda t: t.name)
def test_classes_differ(look: theme.Theme):
    assert set(look.kinds) == set(Kind) == set(theme.KIND_LETTER) == set(theme.KIND_NAME)
    for a, b in itertools.combinations(look.kinds.values(), 2):
        apart = sum((x - y) ** 2 for x, y in zip(a.getRgb()[:3], b.getRgb()[:3], strict=True))
        assert apart**0.5 > 60


@pytest.mark.parametrize("name", ["contrast-light", "contrast-dark"])
def test_high_contrast_is_high(name):
    look = LOOKS[name]
    for background in (look.window, look.panel, look.raised, look.plot):
        assert _contrast(look.text, background) > 18
        assert _contrast(look.muted, background) > 12
        assert _contrast(look.border, background) > 18
    for color in (*look.axes.values(), *look.markers, *look.kinds.values(), look.accent):
        assert _contrast(color, look.plot) > 4.5
    for color in (look.bones, look.points):
        assert _contrast(color, look.plot) > 10


# Machado, Oliveira and Fernandes (2009), severity 1, on linear RGB.
BLIND = {
    "protan": [[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]],
    "deutan": [[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]],
    "tritan": [[1.256, -0.077, -0.179], [-0.078, 0.931, 0.148], [0.005, 0.691, 0.304]],
}


def _seen(color, how):
    """CIE Lab of a colour as it is seen with a kind of colour blindness."""
    rgb = np.array(color.getRgbF()[:3])
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    linear = np.clip(np.array(BLIND[how]) @ linear, 0, 1)
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    xyz = np.array(to_xyz) @ linear / [0.9505, 1.0, 1.089]
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def _least_apart(colors, how):
    """Smallest difference (CIE 1976) between any two colours."""
    pairs = itertools.combinations([_seen(c, how) for c in colors], 2)
    return min(float(np.linalg.norm(a - b)) for a, b in pairs)


@pytest.mark.parametrize("how", BLIND)
@pytest.mark.parametrize("look", LOOKS.values(), ids=lambda t: t.name)
def test_colour_blind_people_tell_classes_and_axes_apart(look, how):
    safe = colour_blind(look)
    assert _least_apart(safe.kinds.values(), how) > 28
    assert _least_apart(safe.axes.values(), how) > 40
    for color in (*safe.kinds.values(), *safe.axes.values()):
        assert _contrast(color, look.plot) > 2.0


def test_colours_chosen_in_the_preferences_are_worn(qapp: QApplication):
    settings.remember("colour_blind", True)
    settings.remember("colour/gap", "#123456")
    theme.recolour(qapp)
    assert theme.current().kinds[Kind.GAP].name() == "#123456"
    assert theme.current().kinds[Kind.STEP] == colour_blind(theme.LIGHT).kinds[Kind.STEP]


def test_the_desktops_wish_for_contrast_is_followed(qapp: QApplication, monkeypatch):
    monkeypatch.setattr(theme, "_high_contrast", lambda: True)
    theme.apply(qapp, "system")
    assert theme.current().name.startswith("contrast-")


def test_watchers_are_told_and_palette_follows(qapp: QApplication, qtbot):
    theme.apply(qapp, "light")
    with qtbot.waitSignal(theme.watcher.changed):
        theme.apply(qapp, "dark")
    assert theme.current().dark
    assert qapp.palette().window().color() == theme.DARK.window
    assert "$" not in qapp.styleSheet()


def test_widgets_are_styled_once_for_a_look(qapp: QApplication, qtbot):
    class Styled(QLabel):
        times = 0

        def changeEvent(self, event: QEvent) -> None:
            self.times += event.type() == QEvent.Type.StyleChange
            super().changeEvent(event)

    theme.apply(qapp, "light")
    label = Styled("A")
    qtbot.addWidget(label)
    label.show()
    qtbot.waitExposed(label)
    label.times = 0
    theme.apply(qapp, "dark")
    assert label.times == 1
    assert qapp.font().pointSize() == theme.BASE_PT


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
