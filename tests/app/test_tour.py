"""The tour: every step is done by the gesture it speaks of, and it is left at any time."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from markermend.artifact import Status
from markermend.mesh import infer_mesh
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app import settings
from markermend_app.actions import shortcuts
from markermend_app.looking import Selection
from markermend_app.tour import SEEN, Tour
from markermend_app.window import MainWindow

WAIT = 20_000
CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def window(qtbot, monkeypatch, damaged, tmp_path):
    """The window as it is at the first start; its demo take is a small one."""
    take, truth = damaged
    made = MainWindow()
    made.resize(1200, 800)

    def quiet(window):
        if window.document.session is not None:
            window.document.session.mark_exported()

    qtbot.addWidget(made, before_close_func=quiet)
    made.show()
    made.activateWindow()
    qtbot.waitExposed(made)

    def open_small():
        made.document.open(open_session(take, folder=tmp_path), infer_mesh(take))
        made.document.decisions.add_detected(truth, "truth")
        made.document.step(1)

    monkeypatch.setattr(made.commands, "open_demo", open_small)
    made.welcome.demo_requested.disconnect()
    made.welcome.demo_requested.connect(open_small)
    return made


@pytest.fixture
def tour(window):
    """The tour, begun from the Help menu."""
    window.actions_by_name["tour"].trigger()
    return window.findChild(Tour)


def test_escape_in_the_plots_lets_go_what_is_swept_then_ends_the_tour(window, tour, qtbot):
    qtbot.keyClick(window.welcome.demo, Qt.Key.Key_Space)
    plots = window.trajectories.canvas
    plots.setFocus()
    window.document.sweep(Selection("LWRA", 10, 20))
    qtbot.keyClick(plots, Qt.Key.Key_Escape)
    assert window.document.selection is None
    assert tour.running
    qtbot.keyClick(plots, Qt.Key.Key_Escape)
    assert not tour.running
    assert not tour.card.isVisible()


def test_a_long_title_is_seen_whole_on_the_card(window, tour, qtbot):
    card = tour.card
    title = "Vergleichen oder exportieren, was davon lieber ist"
    card.say(title, "Etwas.", "5 von 5", last=False)
    card.point_at(None)
    wide = card.title.fontMetrics().horizontalAdvance(title)
    lines = -(-wide // card.title.width())
    assert lines > 1
    qtbot.waitUntil(lambda: card.title.height() >= lines * card.title.fontMetrics().height())


def test_the_card_is_reached_and_ended_by_keys_alone(window, tour, qtbot):
    qtbot.keyClick(window.welcome.demo, Qt.Key.Key_Space)
    window.trajectories.canvas.setFocus()
    qtbot.keyClick(window.trajectories.canvas, Qt.Key.Key_F6)
    assert tour.card.end.hasFocus()
    qtbot.keyClick(tour.card.end, Qt.Key.Key_Space)
    assert not tour.running
    qtbot.waitUntil(lambda: QApplication.focusWidget() is window.trajectories.canvas)


def test_every_step_is_done_by_doing_it(window, tour, qtbot):
    document, card = window.document, tour.card
    assert tour.place == 0
    assert card.isVisible()
    qtbot.mouseClick(window.welcome.demo, Qt.MouseButton.LeftButton)
    assert tour.place == 1
    assert document.current is not None
    qtbot.keyClick(window, Qt.Key.Key_N)
    assert tour.place == 2
    qtbot.keyClick(window, Qt.Key.Key_F)
    qtbot.waitUntil(lambda: tour.place == 3, timeout=WAIT)
    assert len(document.session.with_status(Status.REPAIRED)) == 1
    qtbot.keyClick(window, Qt.Key.Key_Z, CTRL)
    assert tour.place == 4
    assert not document.session.with_status(Status.REPAIRED)
    assert not settings.flag(SEEN, False)
    QTest.keyPress(window, Qt.Key.Key_C)
    assert tour.place == 4
    assert window.comparison.shown
    QTest.keyRelease(window, Qt.Key.Key_C)
    qtbot.waitUntil(lambda: tour.place == 5)
    assert shortcuts.first("manual") in card.text.text()
    assert not card.skip.isVisible()
    assert not card.ring.isVisible()
    qtbot.mouseClick(card.end, Qt.MouseButton.LeftButton)
    assert not card.isVisible()
    assert not card.ring.isVisible()
    assert settings.flag(SEEN, False)


def test_exporting_ends_it_too(window, tour, qtbot):
    window.commands.open_demo()
    for _ in range(3):
        qtbot.mouseClick(tour.card.skip, Qt.MouseButton.LeftButton)
    assert tour.place == 4
    session = window.document.session
    session.set_status([session.artifacts[0].id], Status.REJECTED)
    window.document.history_changed.emit()
    assert tour.place == 4
    session.mark_exported()
    window.document.history_changed.emit()
    assert tour.place == 5


def test_other_gestures_do_no_step(window, tour, qtbot):
    window.commands.open_demo()
    qtbot.keyClick(window, Qt.Key.Key_Right)
    assert tour.place == 1
    qtbot.keyClick(window, Qt.Key.Key_N)
    qtbot.keyClick(window, Qt.Key.Key_R)
    assert tour.place == 2
    window.document.open(None, None)
    assert tour.place == 0


def test_it_is_skipped_and_remembered(window, tour, qtbot):
    qtbot.mouseClick(tour.card.end, Qt.MouseButton.LeftButton)
    assert not tour.running
    assert settings.flag(SEEN, False)
    window.commands.open_demo()
    assert not tour.card.isVisible()
    window.actions_by_name["tour"].trigger()
    assert tour.place == 0
    assert tour.card.isVisible()
    assert len(window.findChildren(Tour)) == 1


def test_it_needs_no_mouse_and_takes_no_focus(window, tour, qtbot):
    assert not tour.card.isAncestorOf(QApplication.focusWidget() or window)
    tour.card.end.setFocus(Qt.FocusReason.TabFocusReason)
    qtbot.keyClick(tour.card.end, Qt.Key.Key_Space)
    assert not tour.running


@pytest.mark.parametrize("size", [(1200, 800), (900, 620)])
def test_card_and_ring_stay_in_the_window_beside_the_target(window, tour, qtbot, size):
    window.resize(*size)
    window.commands.open_demo()
    for place in range(1, 5):
        assert tour.place == place
        QTest.qWait(150)
        card = tour.card.geometry()
        assert window.rect().contains(card)
        assert card.height() < 300
        target = tour.steps[place].target(window)
        assert tour.card.ring.isVisible()
        corner = window.mapFromGlobal(target.mapToGlobal(target.rect().center()))
        if size[1] == 800:
            assert tour.card.ring.geometry().contains(corner)
        assert not card.contains(tour.card.ring.geometry().center())
        tour.card.skip.click()


def test_what_the_step_speaks_of_is_not_under_the_card(window, tour):
    window.commands.open_demo()
    tour.card.skip.click()
    assert tour.place == 2
    QTest.qWait(150)
    inspector, card = window.inspector, tour.card.geometry()
    for spoken_of in (
        inspector.decisions.repair,
        inspector.decisions.reject,
        inspector.promise,
    ):
        assert spoken_of.isVisible()
        corner = window.mapFromGlobal(spoken_of.mapToGlobal(QPoint()))
        assert not card.intersects(QRect(corner, spoken_of.size()))


def test_it_brings_back_the_panel_it_speaks_of(window, tour):
    window.docks["inspector"].hide()
    window.commands.open_demo()
    assert window.docks["inspector"].isVisible()


def test_a_take_without_artifacts_can_be_passed(window, tour, damaged, tmp_path):
    take = damaged[0]
    plain = Take(take.positions, take.labels, take.rate)
    window.document.open(open_session(plain, folder=tmp_path), None)
    assert tour.place == 1
    for _ in range(5):
        tour.card.skip.click()
    assert tour.place == 5
    assert settings.flag(SEEN, False)
