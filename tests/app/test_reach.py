"""Everything is reached by the keyboard, shows the focus, and has a name for screen readers."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractScrollArea,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QHeaderView,
    QLineEdit,
    QScrollBar,
    QWidget,
)

from markermend_app.actions.shortcut_sheet import ShortcutSheet
from markermend_app.dialogs.alike import AlikeDialog
from markermend_app.dialogs.export import ExportDialog
from markermend_app.dialogs.manual import Manual
from markermend_app.dialogs.preferences import Preferences
from markermend_app.style import theme
from markermend_app.style.looks import LOOKS

USED = (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSlider,
    QAbstractSpinBox,
    QComboBox,
    QHeaderView,
    QLineEdit,
)


@pytest.fixture(autouse=True)
def light_again(qapp: QApplication):
    yield
    theme.apply(qapp, "light")


@pytest.fixture
def window(review, damaged):
    """A window with a take under review."""
    return review(*damaged)


def parts(top):
    """Widgets a hand uses, in a window or dialog, without the inner parts of others."""
    for widget in top.findChildren(QWidget):
        above = widget.parent()
        inner = isinstance(above, (QAbstractSpinBox, QComboBox, QLineEdit))
        inner = inner or widget.objectName().startswith("qt_")
        # Lists of combo boxes are read with their box, headers with their view.
        inner = inner or type(above).__name__ in ("QFrame", "Notice")
        inner = inner or isinstance(widget, (QScrollBar, QHeaderView))
        if isinstance(widget, USED) and not inner:
            yield widget


def dialogs(window, qtbot):
    """Every dialog of the app that has more in it than a question."""
    found = window.document.session.artifacts
    window.smoothing.smooth()
    window.bulk.repair_alike()
    made = (
        window.smoothing.dialog,
        Preferences(window),
        ShortcutSheet(window),
        window.findChild(AlikeDialog),
        ExportDialog(window, found, found[:1], ("LKneeAngles",), 1, True),
        Manual(window),
    )
    for dialog in made:
        qtbot.addWidget(dialog)
    return made


def called(widget):
    """For an assertion's message."""
    return f"{type(widget).__name__} {widget.objectName()!r} in {type(widget.parent()).__name__}"


def test_everything_has_a_name(window, qtbot):
    without = []
    for top in (window, *dialogs(window, qtbot)):
        for widget in parts(top):
            text = widget.text() if isinstance(widget, QAbstractButton) else ""
            label = getattr(widget, "accessibleName", str)()
            if not (text or label) and not widget.objectName().startswith("ScrollLeft"):
                without.append(called(widget))
    assert not without, "\n".join(without)


def reached(window, steps=400):
    """Widgets that Tab walks through."""
    found, focus = set(), window.focusWidget() or window
    for _ in range(steps):
        if not window.focusNextChild():
            break
        focus = window.focusWidget()
        if focus in found:
            break
        found.add(focus)
    return found


def test_tab_reaches_everything_that_is_used(window, qtbot):
    found = set()
    # Of panels that lie over one another, Tab has the one that is seen.
    for name in ("queue", "quality"):
        window.docks[name].raise_()
        window.tree.filter.setFocus()
        found |= reached(window)
    missed = []
    for widget in parts(window):
        # The decisions beside an interval are those of the keys and of the details' buttons.
        beside = window.trajectories.buttons.isAncestorOf(widget)
        inner = isinstance(widget, QAbstractButton) and "Title" in type(widget).__name__
        toolbar = window.toolbar.isAncestorOf(widget)
        usable = widget.isVisible() and widget.isEnabled()
        if usable and not (beside or inner or toolbar) and widget not in found:
            radio = getattr(widget, "autoExclusive", bool)()
            if not radio:
                missed.append(called(widget))
    assert not missed, "\n".join(missed)
    assert window.trajectories.canvas in found
    assert window.scene in found


@pytest.mark.parametrize("look", LOOKS)
def test_the_focus_is_seen(window, qtbot, qapp, look):
    theme.watcher.name = ""
    theme._wear(qapp, LOOKS[look])
    plain = []
    for widget in [*reached(window)]:
        if not isinstance(widget, (*USED, QAbstractScrollArea)) and widget is not window.scene:
            continue
        window.setFocus()
        without = widget.grab().toImage()
        widget.setFocus(Qt.FocusReason.TabFocusReason)
        if window.focusWidget() is widget and widget.grab().toImage() == without:
            plain.append(called(widget))
    assert not plain, "\n".join(plain)


def test_the_focus_is_seen_in_dialogs_and_tab_reaches_all_of_them(window, qtbot, qapp):
    theme.watcher.name = ""
    theme._wear(qapp, LOOKS["contrast-light"])
    plain, missed = [], []
    for dialog in dialogs(window, qtbot):
        dialog.show()
        dialog.activateWindow()
        qtbot.waitUntil(dialog.isActiveWindow)
        found = reached(dialog)
        usable = (w for w in parts(dialog) if w.isVisible() and w.isEnabled())
        missed += [called(w) for w in usable if w not in found]
        for widget in found:
            widget.clearFocus()
            without = widget.grab().toImage()
            widget.setFocus(Qt.FocusReason.TabFocusReason)
            if dialog.focusWidget() is widget and widget.grab().toImage() == without:
                plain.append(called(widget))
        dialog.hide()
    assert not missed, "\n".join(missed)
    assert not plain, "\n".join(plain)


def test_the_body_is_turned_moved_and_zoomed_by_keys(window, qtbot):
    scene, alt = window.scene, Qt.KeyboardModifier.AltModifier
    before = scene.camera
    qtbot.keyClick(scene, Qt.Key.Key_Left, alt)
    assert scene.camera.yaw > before.yaw
    qtbot.keyClick(scene, Qt.Key.Key_Up, alt | Qt.KeyboardModifier.ShiftModifier)
    assert scene.camera.target != before.target
    qtbot.keyClick(scene, Qt.Key.Key_Plus)
    assert scene.camera.distance < before.distance


def test_the_keypad_and_the_menu_look_along_the_axes_of_the_take(window, qtbot):
    scene, keypad = window.scene, Qt.KeyboardModifier.KeypadModifier
    ctrl = keypad | Qt.KeyboardModifier.ControlModifier
    up = scene.camera.up
    method = window.document.method
    for key, held, axis, side in (
        (Qt.Key.Key_7, keypad, up, 1),
        (Qt.Key.Key_7, ctrl, up, -1),
        (Qt.Key.Key_1, keypad, (up + 1) % 3, 1),
        (Qt.Key.Key_1, ctrl, (up + 1) % 3, -1),
        (Qt.Key.Key_3, keypad, (up + 2) % 3, 1),
        (Qt.Key.Key_3, ctrl, (up + 2) % 3, -1),
    ):
        qtbot.keyClick(scene, key, held)
        right, _, back = scene.camera.axes()
        assert np.allclose(back, side * np.eye(3)[axis], atol=0.02), "it is looked at from there"
        if axis == up:
            assert np.allclose(right, np.eye(3)[(up + 1) % 3]), "the first axis points to the right"
    assert window.document.method == method, "the keypad chooses no method there"
    scene.buttons.menu.aboutToShow.emit()
    (views,) = (a.menu() for a in scene.buttons.menu.actions() if a.text() == "Look from")
    above = next(a for a in views.actions() if a.text().startswith("above"))
    above.trigger()
    assert np.allclose(scene.camera.axes()[2], np.eye(3)[up], atol=0.02)
