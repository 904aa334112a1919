"""The page of preferences: what is chosen there is stored and holds at once."""

from __future__ import annotations

import math
import re

import pytest
from driving import settled
from PySide6.QtCore import QAbstractTableModel, QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QWheelEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QLabel,
    QPushButton,
    QScrollArea,
)

import markermend as mm
from markermend.artifact import Kind
from markermend.detectors.joint import JointParams
from markermend.presets import save_preset
from markermend.review.file import open_session
from markermend_app import detection, languages, settings, units
from markermend_app.actions import shortcuts
from markermend_app.actions.shortcut_sheet import ShortcutSheet
from markermend_app.dialogs.preferences import OFFERED, Preferences
from markermend_app.panels.inspector.artifact import ArtifactPage
from markermend_app.style import theme
from markermend_app.telling import told


@pytest.fixture(autouse=True)
def light_again(qapp: QApplication):
    yield
    theme.apply(qapp, "light")


@pytest.fixture
def window(review, damaged):
    """A window with a take under review."""
    return review(*damaged)


@pytest.fixture
def page(qtbot, window):
    """The page, as the window opens it."""
    made = Preferences(window)
    made.changed.connect(window.preferred.take)
    qtbot.addWidget(made)
    made.show()
    return made


def choose(box, value):
    """Choose an entry as a hand does."""
    place = box.findData(value)
    assert place >= 0
    box.setCurrentIndex(place)
    box.activated.emit(place)


def test_the_theme_is_worn_at_once_and_checked_in_the_menu(page, window):
    choose(page.theme, "contrast")
    assert theme.current().name.startswith("contrast")
    assert window.actions_by_name["theme_contrast"].isChecked()
    assert settings.text("theme", "") == "contrast"


def test_the_classes_are_shown_in_the_colours_of_the_theme(page):
    for name in ("contrast", "dark", "light"):
        choose(page.theme, name)
        for kind, button in page.kinds.items():
            shown = button.icon().pixmap(16, 16).toImage().pixelColor(8, 8)
            assert shown == theme.current().kinds[kind]


def test_lengths_are_written_in_the_chosen_unit_everywhere(page, window):
    extent = window.findChild(ArtifactPage).extent
    peak = next(a for a in window.document.session.artifacts if a.kind is Kind.PEAK)
    window.document.select(peak.id)
    assert "25.0 mm" in extent.text()
    choose(page.unit, "cm")
    assert "2.50 cm" in extent.text()
    row = window.trajectories.rows[0]
    assert "(cm)" in row.values.label.toPlainText()
    assert row.values.scale == 0.1
    assert "cm" in window.trajectories.header.readout.text()
    queue = window.queue.model
    cells = {
        queue.index(r, c).data()
        for r in range(queue.rowCount())
        for c in range(queue.columnCount())
    }
    assert "2.50 cm" in cells
    # Nothing else goes on counting in millimetres, reasons neither.
    assert not [text for text in texts_of(window) if re.search(r"\bmm\b", text)]


def texts_of(window):
    """What labels and tables say."""
    for label in window.findChildren(QLabel):
        yield label.text()
    for view in window.findChildren(QAbstractItemView):
        model = view.model()
        if not isinstance(model, QAbstractTableModel):
            continue
        for column in range(model.columnCount()):
            yield str(model.headerData(column, Qt.Orientation.Horizontal))
            for row in range(model.rowCount()):
                yield str(model.index(row, column).data())


@pytest.mark.parametrize(
    ("name", "sticks", "residual"),
    [("mm", "41 mm", "0.5 mm to 1.5 mm"), ("m", "0.041 m", "0.0005 m to 0.0015 m")],
)
def test_reasons_are_told_in_the_unit(name, sticks, residual):
    settings.remember(units.SETTING, name)
    why = "sticks out by 41 mm for 12 frames (100 ms), its neighbours by 3.2 mm"
    other = "; its residual changes there from 0.5 mm to 1.5 mm"
    said = told(why + other)
    assert said.startswith(f"sticks out by {sticks} for 12 frames (100 ms), its neighbours by ")
    assert said.endswith(f"changes there from {residual}")
    # The name of a file is its name.
    assert told("cube 5 mm.c3d is empty; look for another copy of it.").startswith("cube 5 mm.c3d")


def test_lengths_keep_their_precision():
    settings.remember(units.SETTING, "m")
    assert units.length(1234.5) == "1.2345 m"
    assert units.scaled("mm/s²") == ("m/s²", 0.001, 3)
    assert units.scaled("N") == ("N", 1.0, 0)


def test_the_axis_that_points_up_is_set_for_this_take_and_the_next(
    page, window, damaged, tmp_path, qtbot
):
    choose(page.vertical, "y")
    assert window.scene.stage.up == 1
    window.document.session.mark_exported()
    window.document.open(open_session(damaged[0], folder=tmp_path / "next"), None)
    settled(qtbot)
    assert window.scene.stage.up == 1


def test_the_dial_reaches_the_detector(page, qtbot):
    page.dial.setValue(85)
    assert math.isclose(detection.chosen_params(slow=False).sensitivity, 0.85)
    assert not detection.chosen_params(slow=False).slow
    choose(page.preset, detection.BALANCED)
    assert detection.chosen_params(slow=True) == JointParams(slow=True)


def test_a_preset_kept_under_a_name_is_offered_and_used(qtbot, window):
    save_preset("my lab", "joint", JointParams(sensitivity=0.3, least_mm=2.0))
    page = Preferences(window)
    qtbot.addWidget(page)
    choose(page.preset, "my lab")
    params = detection.chosen_params(slow=False)
    assert (params.sensitivity, params.least_mm) == (0.3, 2.0)
    assert not page.dial.isEnabled()


def test_a_dial_that_does_nothing_beside_a_preset_looks_so(qtbot, window):
    save_preset("my lab", "joint", JointParams())
    page = Preferences(window)
    qtbot.addWidget(page)
    choose(page.theme, "light")
    theme.apply(QApplication.instance(), "light")
    page.show()
    usable = page.dial.grab().toImage()
    choose(page.preset, "my lab")
    assert page.dial.grab().toImage() != usable


def test_a_preset_that_is_gone_is_told_in_a_sentence(page):
    settings.remember(detection.PRESET, "lost")
    with pytest.raises(mm.MarkermendError, match="lost"):
        detection.chosen_params(slow=False)


def test_reviews_are_saved_as_often_as_was_chosen(page, window, qtbot):
    path = window.document.file.path
    written = path.stat().st_mtime_ns if path.exists() else None
    assert window.preferred.saving.interval() == 5 * 60_000
    page.autosave.setValue(2)
    assert window.preferred.saving.interval() == 2 * 60_000
    window.preferred.saving.timeout.emit()
    qtbot.waitUntil(lambda: path.exists() and path.stat().st_mtime_ns != written)
    page.autosave.setValue(0)
    assert not window.preferred.saving.isActive()


def test_a_class_gets_another_colour(page):
    page.set_colour(Kind.STEP, QColor("#ff00aa"))
    assert theme.current().kinds[Kind.STEP].name() == "#ff00aa"


def test_colours_for_colour_blind_eyes(page, qtbot):
    before = theme.current().kinds
    qtbot.mouseClick(page.blind, Qt.MouseButton.LeftButton, pos=page.blind.rect().center() * 0.1)
    assert settings.flag(theme.COLOUR_BLIND, False)
    assert theme.current().kinds != before


def test_as_delivered_forgets_everything_on_the_page(page):
    choose(page.unit, "m")
    page.dial.setValue(10)
    page.set_colour(Kind.STEP, QColor("#ff00aa"))
    page._restore()
    assert units.unit() == "mm"
    assert detection.chosen_params(slow=True) == JointParams(slow=True)
    settings.settle()
    assert not [name for name in OFFERED if settings.store().contains(name)]


def test_the_language_is_the_chosen_one_else_the_systems(page, monkeypatch):
    choose(page.language, "de")
    assert languages.language() == "de"
    settings.remember(languages.SETTING, "system")
    monkeypatch.setattr(
        "PySide6.QtCore.QLocale.system", lambda: type("L", (), {"name": lambda self: "xx_XX"})()
    )
    assert languages.language() == "en"


def test_return_in_a_field_presses_no_button(qtbot) -> None:
    preferences = Preferences()
    qtbot.addWidget(preferences)
    preferences.show()
    assert not [b.text() for b in preferences.findChildren(QPushButton) if b.isDefault()]


def wheel(widget):
    """Turn the wheel over a widget by one notch."""
    at = QPointF(widget.rect().center())
    turn = QWheelEvent(
        at,
        QPointF(widget.mapToGlobal(at.toPoint())),
        QPoint(),
        QPoint(0, -120),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(widget, turn)


def test_the_wheel_scrolls_the_page_and_changes_no_field_on_its_way(page):
    page.preset.setFocus()
    was = page.autosave.value()
    for field in (page.theme, page.unit, page.autosave, page.dial):
        wheel(field)
    settings.settle()
    assert [n for n in OFFERED if settings.store().contains(n)] == []
    assert page.autosave.value() == was
    page.autosave.setFocus()
    wheel(page.autosave)
    assert page.autosave.value() == was - 1


def test_the_wheel_over_the_details_changes_no_artifact(window, qtbot):
    window.show()
    artifact = window.inspector.artifact
    before = window.document.current
    for field in (artifact.kind, artifact.first, artifact.last, artifact.methods.more):
        wheel(field)
    assert window.document.current == before
    assert len(window.document.session.history) == 1


def test_the_page_takes_the_keyboard_at_its_first_field_and_is_seen_whole(page, qtbot):
    qtbot.waitUntil(page.isVisible)
    assert page.theme.hasFocus() or page.focusWidget() is page.theme
    scroll = page.findChild(QScrollArea)
    assert scroll.focusPolicy() is Qt.FocusPolicy.NoFocus
    content, seen = scroll.widget().sizeHint(), scroll.viewport().size()
    assert content.width() <= seen.width()
    limit = page.screen().availableSize().height() * 0.9
    assert content.height() <= seen.height() or page.height() >= limit - 1


def test_a_list_drops_down_below_its_field_where_no_entry_is_cut(page, qtbot):
    choose(page.theme, "dark")
    page.theme.showPopup()
    view, field = page.theme.view(), page.theme
    last = view.visualRect(view.model().index(field.count() - 1, 0))
    assert last.bottom() < view.viewport().height()
    assert view.mapToGlobal(QPoint()).y() >= field.mapToGlobal(field.rect().bottomLeft()).y()
    field.hidePopup()


def test_the_page_leads_to_the_keys_and_names_their_preset(page, monkeypatch):
    monkeypatch.setattr(ShortcutSheet, "exec", lambda self: shortcuts.use_preset("nexus"))
    assert page.keys.text() == "Markermend…"
    page.keys.click()
    assert page.keys.text() == "Vicon Nexus…"


@pytest.mark.parametrize(
    ("unit", "mm", "told"),
    [
        ("mm", 0.03, "< 0.05 mm"),
        ("mm", 0.05, "0.1 mm"),
        ("mm", 0.8, "0.8 mm"),
        ("cm", 0.03, "< 0.005 cm"),
        ("m", 0.03, "< 0.00005 m"),
    ],
)
def test_an_expected_error_is_never_told_as_nothing(unit, mm, told):
    settings.remember(units.SETTING, unit)
    assert units.error(mm) == told
    assert units.give_or_take(mm) == (told if "<" in told else f"± {told}")
