"""The history panel: a click goes to that step, and samples go with it."""

from __future__ import annotations

import pytest
from driving import settled
from PySide6.QtCore import Qt
from PySide6.QtGui import QFont

from markermend_app.panels.history import HistoryPanel


@pytest.fixture
def panel(document, qtbot):
    panel = HistoryPanel(document)
    qtbot.addWidget(panel)
    panel.resize(270, 300)
    panel.show()
    return panel


def rows(panel):
    return [panel.model.index(i).data() for i in range(panel.model.rowCount())]


def click(qtbot, panel, row):
    at = panel.view.visualRect(panel.model.index(row)).center()
    qtbot.mouseClick(panel.view.viewport(), Qt.MouseButton.LeftButton, pos=at)


def test_only_what_is_new_gets_new_rows(qtbot, panel, document):
    ids = [a.id for a in document.session.artifacts]
    settled(qtbot)
    came, went, anew = [], [], []
    panel.model.rowsInserted.connect(lambda _, first, last: came.append((first, last)))
    panel.model.rowsRemoved.connect(lambda _, first, last: went.append((first, last)))
    panel.model.modelReset.connect(lambda: anew.append(True))
    document.decisions.accept(ids[:1])
    document.decisions.reject(ids[1:2])
    settled(qtbot)
    assert (came, went) == ([(2, 3)], [])
    document.undo()
    settled(qtbot)
    assert rows(panel)[3].startswith("Reject peak")
    document.decisions.reject(ids[2:3])
    settled(qtbot)
    assert (came, went) == ([(2, 3), (3, 3)], [(3, 3)])
    assert not anew


def test_a_key_that_comes_at_once_means_the_step_that_stands_there_by_then(qtbot, panel, document):
    document.decisions.accept([document.session.artifacts[0].id])
    settled(qtbot)
    panel.view.setFocus()
    document.undo()
    qtbot.keyClick(panel.view, Qt.Key.Key_Return)
    assert document.session.history == ("Detect (paper)",)


def test_click_travels_back_and_forth(qtbot, panel, document):
    ids = [a.id for a in document.session.artifacts]
    document.decisions.accept(ids[:1])
    document.decisions.reject(ids[1:2])
    settled(qtbot)
    steps = [
        "As opened",
        "Detect (paper)",
        "Accept gap on CLAV, 161–190",
        "Reject peak on LELB, 251",
    ]
    assert rows(panel) == steps
    click(qtbot, panel, 1)
    assert document.session.history == ("Detect (paper)",)
    settled(qtbot)
    assert rows(panel) == steps
    assert panel.view.currentIndex().row() == 1
    font = Qt.ItemDataRole.FontRole
    assert panel.model.index(1).data(font).weight() == QFont.Weight.DemiBold
    assert panel.model.index(3).data(font).italic()
    click(qtbot, panel, 3)
    assert len(document.session.history) == 3
    click(qtbot, panel, 0)
    assert document.session.history == ()
    assert document.session.artifacts == ()
    document.redo()
    settled(qtbot)
    assert panel.view.currentIndex().row() == 1


def test_the_present_step_stays_in_sight_where_the_window_is_made_lower(at_gap, qtbot):
    document, view = at_gap.document, at_gap.history.view
    at_gap.resize(1280, 1100)
    for i in range(40):
        document.do(lambda s, i=i: s.annotate(document.current.id, f"looked {i} times"))
    settled(qtbot)
    here = view.currentIndex()
    assert here.row() == view.model().rowCount() - 1
    height = view.height()
    for lower in (900, 800, 720):
        at_gap.resize(1280, lower)
        qtbot.waitUntil(lambda h=height: view.height() < h)
        height = view.height()
        assert view.viewport().rect().contains(view.visualRect(here))
    # Who looks at another one stays there.
    view.scrollToTop()
    at_gap.resize(1280, 680)
    qtbot.waitUntil(lambda: view.height() < height)
    assert view.verticalScrollBar().value() == 0
