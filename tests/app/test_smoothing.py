"""Smoothing in the real window: key, dialog, preview, one step, undo."""

from __future__ import annotations

import numpy as np
import pytest
from plots import SHIFT, Bench
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest

from markermend.review import hand
from markermend.smoothers import percent_sm1, smooth
from markermend.take import Origin, Take
from markermend_app.dialogs.smooth_pictures import SmoothPictures, _PowerAxis
from markermend_app.panels.markers.marker_menu import point_at

WAIT = 20_000
CTRL = Qt.KeyboardModifier.ControlModifier
MARKERS = 8


@pytest.fixture
def plots_of_the_smoothing_dialog():
    """Let the window make them ahead, as it does."""


@pytest.fixture
def window(review, damaged):
    """The window on the damaged take, T10 foremost, the first 150 frames in view."""
    made = review(*damaged)
    made.document.show(["T10", "LSHO"])
    made.trajectories.framing.set_view(0, 150)
    return made


def press_s(window, qtbot):
    """Open the dialog by key."""
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    qtbot.keyClick(window, Qt.Key.Key_S)
    return window.smoothing.dialog


def preview(window, qtbot):
    """Open it and wait for the preview."""
    dialog = press_s(window, qtbot)
    wait(dialog, qtbot)
    return dialog


def wait(dialog, qtbot):
    qtbot.waitUntil(lambda: dialog.answer is not None and dialog._found is not None, timeout=WAIT)


def choose(box, text):
    """Walk to an entry of a list with the keyboard."""
    QTest.keyClick(box, Qt.Key.Key_Home)
    for _ in range(box.count()):
        if not box.currentText().startswith(text):
            QTest.keyClick(box, Qt.Key.Key_Down)
    assert box.currentText().startswith(text)


def test_what_is_not_repaired_is_said_to_be_spread(window, qtbot):
    dialog = preview(window, qtbot)
    # T10 itself has none.
    assert not dialog.damage.isVisible()
    choose(dialog.scope, "In the whole take")
    # Where nothing was recorded there is nothing to spread.
    assert dialog.damage.text().startswith("3 artifacts there are not repaired.")
    assert dialog.damage.isVisible()
    dialog.reject()
    for artifact in window.document.session.artifacts:
        if artifact.marker != "C7":
            window.document.decisions.reject([artifact.id])
    dialog = preview(window, qtbot)
    choose(dialog.scope, "In the whole take")
    assert dialog.damage.text().startswith("1 artifact there is not repaired.")


def enter(dialog, name, text):
    """Type the value of a parameter."""
    box = dialog.params.fields[name]
    box.selectAll()
    QTest.keyClicks(box, text)
    QTest.keyClick(box, Qt.Key.Key_Return)


def changed_frames(window, marker):
    session = window.document.session
    column = session.original.index(marker)
    now, was = (p[:, column] for p in (session.positions, session.original.positions))
    return np.flatnonzero((now != was).any(axis=1) & ~np.isnan(was[:, 0]))


def test_a_marker_pointed_at_beside_a_swept_range_is_meant(window, qtbot):
    document = window.document
    Bench(window.trajectories, document).drag(30, 90, keys=SHIFT)
    point_at(document, "LSHO")
    dialog = preview(window, qtbot)
    assert dialog.looked_at == "LSHO"
    last = dialog.scope.count() - 1
    assert dialog.scope.itemText(last) == "Frames 131–191 of T10"
    dialog.reject()


def test_a_swept_range_is_previewed_then_smoothed_as_one_step(window, qtbot):
    document = window.document
    before, steps = document.session.positions.copy(), len(document.session.history)
    Bench(window.trajectories, document).drag(30, 90, keys=SHIFT)
    dialog = preview(window, qtbot)
    # First and foremost what was swept, counted as the file does.
    assert dialog.scope.currentText() == "Frames 131–191 of T10"
    assert dialog.looked_at == "T10"
    assert np.array_equal(document.session.positions, before, equal_nan=True)
    drawn = dialog.pictures.smooth.values
    wanted = smooth(document.session.take, markers=["T10"], start=30, stop=91).positions[:, 3]
    assert np.array_equal(drawn, wanted[:, 0])
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    assert np.array_equal(document.session.positions[:, 3], wanted)
    frames = changed_frames(window, "T10")
    assert len(frames) > 40
    assert frames[0] >= 30
    assert frames[-1] < 91
    others = [i for i in range(MARKERS) if i != 3]
    now = document.session.positions
    assert np.array_equal(now[:, others], before[:, others], equal_nan=True)
    assert (document.session.origin[frames, 3] == Origin.EDITED).all()
    assert len(document.session.history) == steps + 1
    assert document.session.history[-1] == "Smooth T10 in frames 131–191"
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    qtbot.keyClick(window, Qt.Key.Key_Z, CTRL)
    assert np.array_equal(document.session.positions, before, equal_nan=True)


def test_the_whole_take_by_another_method_is_one_step(window, qtbot):
    document = window.document
    before, steps = document.session.positions.copy(), len(document.session.history)
    dialog = preview(window, qtbot)
    assert dialog.scope.currentText() == "On T10"
    choose(dialog.scope, "In the whole take")
    choose(dialog.method, "Butterworth")
    enter(dialog, "cutoff_hz", "12")
    assert not dialog.go.isEnabled()
    wait(dialog, qtbot)
    assert dialog.marker.count() == MARKERS
    qtbot.mouseClick(dialog.go, Qt.MouseButton.LeftButton)
    wanted = smooth(
        document.session.original.with_positions(before, document.session.original.origin),
        "butterworth",
        cutoff_hz=12.0,
    )
    assert np.array_equal(document.session.positions, wanted.positions, equal_nan=True)
    assert len(document.session.history) == steps + 1
    assert document.session.history[-1] == "Smooth 8 markers in all frames"
    # The next time begins with the same method and value.
    dialog = preview(window, qtbot)
    assert dialog.chosen_method == "butterworth"
    assert dialog.params.values()["cutoff_hz"] == 12.0


def test_percent_of_the_way_stands_beside_the_preview_and_warns_above_thirty(window, qtbot):
    document = window.document
    dialog = preview(window, qtbot)
    choose(dialog.method, "Moving average")
    wait(dialog, qtbot)
    enter(dialog, "window", "151")
    wait(dialog, qtbot)
    take = document.session.take
    column = take.index("T10")
    percent = percent_sm1(
        take.positions[:, column],
        smooth(take, "moving_average", window=151).positions[:, column],
    )
    assert dialog.percent.text() == "%SM1 of T10:  X {:.1f}  Y {:.1f}  Z {:.1f}".format(*percent)
    assert percent.max() > 30.0
    assert "T10 loses more than 30 %" in dialog.warning.text()
    choose(dialog.method, "Savitzky")
    wait(dialog, qtbot)
    assert dialog.answer.percent.max() < 30.0
    assert dialog.warning.text() == ""


def test_one_key_shows_the_curve_before_and_after(window, qtbot):
    dialog = preview(window, qtbot)
    assert dialog.pictures.smooth.isVisible()
    qtbot.keyClick(dialog, Qt.Key.Key_B)
    assert not dialog.pictures.smooth.isVisible()
    qtbot.keyClick(dialog, Qt.Key.Key_B)
    assert dialog.pictures.smooth.isVisible()
    choose(dialog.quantity, "Acceleration")
    rough = [np.nanstd(c.values) for c in (dialog.pictures.raw, dialog.pictures.smooth)]
    assert rough[1] < 0.5 * rough[0]


def test_what_a_method_refuses_is_said_and_cannot_be_done(window, qtbot):
    steps = len(window.document.session.history)
    dialog = preview(window, qtbot)
    choose(dialog.method, "Butterworth")
    enter(dialog, "cutoff_hz", "90")
    qtbot.waitUntil(lambda: "too high" in dialog.warning.text(), timeout=WAIT)
    assert not dialog.go.isEnabled()
    assert not dialog.pictures.smooth.isVisible()
    qtbot.keyClick(dialog, Qt.Key.Key_Escape)
    assert window.smoothing.dialog is None
    assert len(window.document.session.history) == steps


def test_another_marker_is_looked_at_with_its_own_spectrum(window, qtbot):
    dialog = preview(window, qtbot)
    choose(dialog.scope, "In the whole take")
    wait(dialog, qtbot)
    first = dialog._found
    choose(dialog.marker, "LELB")
    qtbot.waitUntil(lambda: dialog._found not in (None, first), timeout=WAIT)
    column = window.document.session.original.index("LELB")
    raw = window.document.session.positions[:, column, 0]
    assert np.array_equal(dialog.pictures.raw.values, raw)
    assert dialog.percent.text().startswith("%SM1 of LELB")


def test_nothing_is_written_over_samples_that_changed_meanwhile(window, qtbot):
    document = window.document
    dialog = preview(window, qtbot)
    document.do(lambda s: hand.cut(s, "T10", 10, 20))
    now = document.session.positions.copy()
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    assert np.array_equal(document.session.positions, now, equal_nan=True)


def test_a_marker_seen_for_moments_only_has_no_spectrum_and_is_left(review, damaged, qtbot):
    take, truth = damaged
    positions = take.positions.copy()
    positions[3:, 3] = np.nan
    window = review(Take(positions, take.labels, take.rate, take.first_frame), truth[1:])
    window.document.show(["T10"])
    dialog = press_s(window, qtbot)
    qtbot.waitUntil(lambda: dialog.answer is not None, timeout=WAIT)
    assert not dialog.go.isEnabled()
    assert "too short" in dialog.warning.text()


def test_checking_a_marker_is_enough_to_work_on_it(window):
    window.document.show([])
    assert not window.actions_by_name["smooth"].isEnabled()
    window.document.show(["T10"])
    assert window.actions_by_name["smooth"].isEnabled()
    assert window.actions_by_name["rename_marker"].isEnabled()


def test_powers_of_ten_are_written_out_with_room_between_them():
    axis = _PowerAxis()
    (spacing, values), *_ = axis.tickValues(-6.3, 4.9, 90)
    assert values == [-6.0, -4.0, -2.0, 0.0, 2.0, 4.0]
    texts = axis.tickStrings(values, 1.0, spacing)
    assert texts == ["10⁻⁶", "10⁻⁴", "10⁻²", "1", "10²", "10⁴"]
    assert axis.tickValues(-6.3, 4.9, 900)[0][1] == [float(k) for k in range(-6, 5)]


def test_values_follow_the_frames_in_view(qtbot):
    pictures = SmoothPictures()
    qtbot.addWidget(pictures)
    while pictures.make_one():
        pass
    pictures.resize(600, 400)
    pictures.set_clock(1, 100.0, 400)
    raw = np.zeros(400)
    raw[300:] = 50.0
    pictures.show_frames(0, 399)
    pictures.show_way(raw, raw + 1.0, "X", "mm", QColor("red"))
    low, high = pictures.way.view.viewRange()[1]
    assert low < 0 < 51 < high
    pictures.show_frames(0, 100)
    low, high = pictures.way.view.viewRange()[1]
    assert low < 0 < 1 < high < 5
    pictures.show_way(raw, None, "X", "mm", QColor("red"))
    assert pictures.way.view.viewRange()[1][1] < 0.5
    # A wheel over the plot zooms time, one beside it values, which then stay.
    view = pictures.way.view
    view.wheelEvent(Wheel())
    assert view.viewRange()[0][1] - view.viewRange()[0][0] < 100
    pictures.show_frames(0, 100)
    view.wheelEvent(Wheel(), axis=1)
    zoomed = view.viewRange()[1]
    assert zoomed[1] - zoomed[0] < 0.9
    pictures.show_frames(250, 399)
    assert view.viewRange()[1] == zoomed
    pictures.show_way(raw, raw + 1.0, "X", "mm", QColor("red"))
    assert view.viewRange()[1][1] > 51


@pytest.mark.parametrize("frames", [1, 3, 4])
def test_a_take_of_a_few_frames_fits_the_plot(qtbot, frames):
    pictures = SmoothPictures()
    qtbot.addWidget(pictures)
    while pictures.make_one():
        pass
    pictures.resize(600, 400)
    pictures.set_clock(1, 100.0, frames)
    pictures.show_way(np.arange(frames) * 10.0, None, "X", "mm", QColor("red"))
    pictures.show_frames(0, frames - 1)
    first, last = pictures.way.view.viewRange()[0]
    assert first <= 0
    assert last >= frames - 1
    assert last - first <= frames + 1


class Wheel:
    """A notch of the wheel over the middle of a view."""

    def delta(self):
        return 120

    def pos(self):
        return QPointF(100, 50)

    def accept(self):
        """Take it."""
