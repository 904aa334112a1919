"""The quality panel: what it counts, how it sorts, and where a click goes."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu

from markermend.artifact import Artifact, Kind
from markermend.patch import Patch
from markermend.repairs import Repair
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app import settings
from markermend_app.document import Document
from markermend_app.panels.quality import QualityPanel
from markermend_app.panels.quality_model import BEFORE, DECIDED, MARKER, MEAN, MENDED, NOW, OPEN


@pytest.fixture
def panel(document, qtbot):
    panel = QualityPanel(document)
    qtbot.addWidget(panel)
    panel.resize(1100, 300)
    panel.show()
    qtbot.waitExposed(panel)
    return panel


def row(panel, marker):
    model = panel.model if marker else panel.total
    return [model.index(model.row_of(marker), c).data() for c in range(8)]


def click(qtbot, panel, marker, press):
    index = panel.model.index(panel.model.row_of(marker), MARKER)
    press(
        panel.view.viewport(),
        Qt.MouseButton.LeftButton,
        pos=panel.view.visualRect(index).center(),
    )


def test_a_decision_is_counted_once_it_has_settled(qtbot, panel, document):
    assert row(panel, "CLAV")[BEFORE] == "7.5 %"
    assert row(panel, "CLAV")[OPEN] == "1 gap"
    assert row(panel, "")[MARKER] == "Whole take"
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    patch = Patch("CLAV", "xyz", 60, 90, np.ones((30, 3)))
    document.decisions.repair_many([(gap.id, Repair("linear", (patch,), error_mm=2.5))], "Repair")
    qtbot.waitUntil(lambda: row(panel, "CLAV")[OPEN] == "", timeout=2000)
    clav = row(panel, "CLAV")
    assert (clav[BEFORE], clav[NOW], clav[MENDED], clav[MEAN]) == (
        "7.5 %",
        "0 %",
        "7.5 %",
        "2.5 mm",
    )
    assert clav[DECIDED] == "1 gap"
    assert row(panel, "")[NOW] == "0 %"
    settings.remember("unit", "cm")
    assert row(panel, "CLAV")[MEAN] == "0.25 cm"
    document.undo()
    qtbot.waitUntil(lambda: row(panel, "CLAV")[NOW] == "7.5 %", timeout=2000)
    assert row(panel, "CLAV")[MEAN] == "–"


def test_the_menu_says_that_it_sorts(panel):
    panel.view.customContextMenuRequested.emit(panel.view.rect().center())
    (menu,) = panel.findChildren(QMenu)
    title, first, *_ = menu.actions()
    assert (title.text(), title.isEnabled(), first.text()) == ("Sort by", False, "Marker")
    menu.close()


def test_click_on_a_column_sorts_by_it(qtbot, panel):
    assert panel.model.rows[0].marker == "CLAV"
    header = panel.head.horizontalHeader()
    at = header.rect().center()
    for expected in (sorted, lambda names: sorted(names, reverse=True)):
        at.setX(header.sectionViewportPosition(MARKER) + 30)
        qtbot.mouseClick(header.viewport(), Qt.MouseButton.LeftButton, pos=at)
        names = [s.marker for s in panel.model.rows]
        assert names == expected(names)


def test_click_shows_a_marker_and_double_click_its_worst(qtbot, panel, document):
    click(qtbot, panel, "LWRA", qtbot.mouseClick)
    assert document.shown == ("LWRA",)
    assert document.current is None
    click(qtbot, panel, "LELB", qtbot.mouseClick)
    click(qtbot, panel, "LELB", qtbot.mouseDClick)
    assert document.current.marker == "LELB"
    document.show(("C7",))
    assert panel.view.currentIndex().row() == panel.model.row_of("C7")


def test_a_mix_up_is_counted_and_found_on_each_marker_but_once_in_the_take(panel, document, qtbot):
    swap = Artifact("STRN", "xyz", 250, 280, Kind.STEP, counterpart="T10")
    document.decisions.add_detected([swap], "test")
    qtbot.waitUntil(lambda: row(panel, "STRN")[OPEN] == "1 step", timeout=2000)
    assert row(panel, "T10")[OPEN] == "1 step"
    assert row(panel, "")[OPEN] == "1 step"
    click(qtbot, panel, "T10", qtbot.mouseClick)
    click(qtbot, panel, "T10", qtbot.mouseDClick)
    assert document.current == swap


def test_nothing_is_counted_while_nobody_looks(qtbot, panel, document):
    panel.hide()
    document.decisions.accept([a.id for a in document.session.artifacts])
    qtbot.wait(150)
    assert row(panel, "CLAV")[OPEN] == "1 gap"
    panel.show()
    qtbot.waitUntil(lambda: row(panel, "CLAV")[OPEN] == "", timeout=2000)


@pytest.mark.parametrize("markers", [0, 1, 2])
def test_takes_of_few_markers_and_frames(qtbot, tmp_path, markers):
    labels = ("A", "*7")[:markers]
    document = Document()
    panel = QualityPanel(document)
    qtbot.addWidget(panel)
    panel.show()
    document.open(
        open_session(Take(np.ones((1, markers, 3)), labels, 100.0), folder=tmp_path), None
    )
    assert [s.marker for s in panel.model.rows] == ["A"][:markers]
    assert len(panel.total.rows) == 1
    document.open(None, None)
    assert panel.model.rows == panel.total.rows == ()
    document.proposals.close()


def test_nothing_is_counted_while_another_tab_covers_it(review, damaged, qtbot, monkeypatch):
    window = review(*damaged)
    quality = window.quality
    window.docks["queue"].raise_()
    qtbot.waitUntil(lambda: quality._covered)
    counted = []
    monkeypatch.setattr(
        "markermend_app.panels.quality.standings", lambda *_: counted.append(1) or ()
    )
    window.document.decisions.reject([window.document.current.id])
    qtbot.waitUntil(lambda: not quality._settle.isActive())
    assert not counted
    window.docks["quality"].raise_()
    qtbot.waitUntil(lambda: counted == [1])


def test_columns_stand_below_their_heads_without_a_scroll_bar(qtbot, panel):
    panel.resize(900, 120)
    qtbot.wait(20)
    assert panel.view.verticalScrollBar().isVisible()
    assert not panel.view.horizontalScrollBar().isVisible()
    panel.head.horizontalHeader().resizeSection(MARKER, 150)
    assert panel.view.columnWidth(MARKER) == 150
    panel.resize(500, 120)
    qtbot.wait(20)
    assert panel.view.horizontalScrollBar().isVisible()


def test_markers_are_told_apart_without_the_name_of_their_subject(qtbot, tmp_path):
    labels = ("Anna:LSHO", "Anna:RSHO", "Bert:RSHO")
    document = Document()
    panel = QualityPanel(document)
    qtbot.addWidget(panel)
    panel.show()
    document.open(open_session(Take(np.ones((5, 3, 3)), labels, 100.0), folder=tmp_path), None)
    model = panel.model
    told = {s.marker: model.index(i, MARKER).data() for i, s in enumerate(model.rows)}
    assert told == dict(zip(labels, ("LSHO", "Anna:RSHO", "Bert:RSHO"), strict=True))
    tip = model.index(0, MARKER).data(Qt.ItemDataRole.ToolTipRole)
    assert tip == model.rows[0].marker
    document.open(None, None)
    document.proposals.close()
