"""Comparing repairs: hold a key, walk with the arrows, let go, repair with what was chosen."""

from __future__ import annotations

import numpy as np
import pytest
from driving import settled
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from markermend.artifact import Kind, Status
from markermend_app.panels.plots.quantity import QUANTITIES, way_of

WAIT = 20_000


@pytest.fixture
def window(at_gap):
    return at_gap


def names(window):
    return [c.method for c in window.comparison.candidates]


def test_hold_walk_let_go_and_repair(window, qtbot):
    document, comparison = window.document, window.comparison
    gap = document.current.id
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    QTest.keyPress(window, Qt.Key.Key_C)
    assert comparison.shown
    qtbot.waitUntil(lambda: bool(comparison.candidates), timeout=WAIT)
    panel = window.candidates
    settled(qtbot)
    assert panel.isVisible()
    assert "F repairs" in panel.said.text()
    without = comparison.hopeless
    words = "other method has no" if without == 1 else "other methods have no"
    assert (f"{without} {words} answer here." in panel.said.text()) == (without > 0)
    errors = [c.error_mm for c in comparison.candidates if c.error_mm is not None]
    assert len(errors) >= 3
    assert "±" in panel.rows[0][2].text()
    # The details tell the same error as the list.
    shown = panel.rows[comparison.place][2].text().removeprefix("± ")
    assert f"expected error {shown}" in window.inspector.artifact.methods.outcome.text()
    # It hides none of the curves that are compared.
    lowest = window.trajectories.mapTo(window, window.trajectories.rect().bottomLeft())
    assert lowest.y() < panel.y() < window.height() - panel.height()
    # A line for every candidate in each of three rows.
    assert len(panel._lines) == 3 * len(comparison.candidates)
    assert names(window)[comparison.place] == document.proposal.method
    first = comparison.place
    for key in (Qt.Key.Key_Down, Qt.Key.Key_Down, Qt.Key.Key_Up):
        QTest.keyClick(window, key)
    chosen = names(window)[first + 1]
    assert document.proposal.method == chosen
    QTest.keyRelease(window, Qt.Key.Key_C)
    qtbot.waitUntil(lambda: not comparison.shown)
    settled(qtbot)
    assert not panel.isVisible()
    assert panel._lines == []
    qtbot.keyClick(window, Qt.Key.Key_F)
    assert document.session.notes[gap].method == chosen
    assert document.session.artifact(gap).status is Status.REPAIRED


def test_what_is_repaired_already_is_said_to_be(window, qtbot):
    qtbot.waitUntil(lambda: window.document.proposal is not None, timeout=WAIT)
    gap = window.document.current.id
    qtbot.keyClick(window, Qt.Key.Key_F)
    window.document.select(gap)
    QTest.keyPress(window, Qt.Key.Key_C)
    settled(qtbot)
    assert window.candidates.said.text() == "This is repaired already; U takes that back."
    QTest.keyRelease(window, Qt.Key.Key_C)


def test_arrows_walk_as_the_desktop_sends_them_wherever_the_focus_is(window, qtbot):
    document, comparison = window.document, window.comparison
    desktop = window.windowHandle()
    for widget in (window.scene, window.queue.view):
        widget.setFocus()
        QTest.keyPress(desktop, Qt.Key.Key_C)
        qtbot.waitUntil(lambda: bool(comparison.candidates), timeout=WAIT)
        place = comparison.place
        QTest.keyClick(desktop, Qt.Key.Key_Down)
        assert comparison.place == place + 1
        QTest.keyClick(desktop, Qt.Key.Key_Up)
        assert comparison.place == place
        QTest.keyRelease(desktop, Qt.Key.Key_C)
        qtbot.waitUntil(lambda: not comparison.shown)
    assert document.method == names(window)[place]


def test_arrows_step_frames_again_when_the_key_is_let_go(window, qtbot):
    document = window.document
    QTest.keyPress(window, Qt.Key.Key_C)
    QTest.keyRelease(window, Qt.Key.Key_C)
    qtbot.waitUntil(lambda: not window.comparison.shown)
    method, frame = document.method, document.frame
    QTest.keyClick(window, Qt.Key.Key_Down)
    assert document.method == method
    QTest.keyClick(window, Qt.Key.Key_Right)
    assert document.frame == frame + 1


def test_a_tap_of_the_key_says_to_hold_it(window, qtbot, monkeypatch):
    # Repairs that never come: where they are quick, they are there before the key is let go.
    monkeypatch.setattr(window.comparison, "_ask", lambda artifact: None)
    QTest.keyPress(window, Qt.Key.Key_C)
    QTest.keyRelease(window, Qt.Key.Key_C)
    qtbot.waitUntil(lambda: not window.comparison.shown)
    assert "Hold the key" in window.status._said.whole


def test_letting_go_while_the_next_are_worked_out_says_nothing(window, qtbot, monkeypatch):
    QTest.keyPress(window, Qt.Key.Key_C)
    qtbot.waitUntil(lambda: window.comparison.candidates is not None, timeout=WAIT)
    monkeypatch.setattr(window.comparison, "_ask", lambda artifact: None)
    qtbot.keyClick(window, Qt.Key.Key_N)
    assert window.comparison.candidates is None
    QTest.keyRelease(window, Qt.Key.Key_C)
    qtbot.waitUntil(lambda: not window.comparison.shown)
    assert "Hold the key" not in window.status._said.whole


def test_walking_on_while_comparing_compares_the_next(window, qtbot):
    comparison = window.comparison
    QTest.keyPress(window, Qt.Key.Key_C)
    qtbot.waitUntil(lambda: comparison.candidates is not None, timeout=WAIT)
    before = comparison.candidates
    qtbot.keyClick(window, Qt.Key.Key_N)
    qtbot.waitUntil(lambda: comparison.candidates not in (None, before), timeout=WAIT)
    assert comparison.candidates[0].repair.patches[0].marker == window.document.current.marker
    comparison.stop()


def test_the_difference_row_shows_how_far_a_repair_moved_what_was_measured(window, qtbot):
    document = window.document
    document.select(next(a.id for a in document.session.artifacts if a.kind is Kind.PEAK))
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    peak = document.current
    qtbot.keyClick(window, Qt.Key.Key_F)
    session = document.session
    column = session.original.index(peak.marker)
    source, now = (t.positions[:, column] for t in (session.original, session.take))
    way = way_of(session.take, peak.marker, now, source=source)
    moved = QUANTITIES["difference"].of(way)
    assert moved[peak.start] == pytest.approx(25.0, abs=2.0)
    assert np.nanmax(np.delete(moved, peak.start)) == 0.0
    window.trajectories.choose_rows(["x", "difference"])
    document.show([peak.marker])
    row = window.trajectories.rows[-1]
    assert row.value_at(peak.marker, peak.start) == pytest.approx(25.0, abs=2.0)
    # Nearly all is zero, and what is not is what the row is for, whatever is under review.
    assert document.current.marker != peak.marker
    window.trajectories.framing.fit_all()
    assert row.view.viewRange()[1][1] > 25.0
