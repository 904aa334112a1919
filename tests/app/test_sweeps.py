"""What a swept range is about, and what becomes of what was found in it."""

from __future__ import annotations

import numpy as np
from driving import WAIT, settled
from plots import SHIFT
from PySide6.QtCore import QPointF, Qt

from markermend.artifact import Kind, Status


def along(bench, name, axis):
    """Share of a plot's height at which a marker's curve passes frame 150."""
    row = bench.panel.rows["xyz".index(axis)]
    box = row.view.sceneBoundingRect()
    y = row.view.mapViewToScene(QPointF(150, row.value_at(name, 150))).y()
    return (box.bottom() - y) / box.height()


def test_a_sweep_along_a_curve_is_of_its_marker_and_elsewhere_of_the_foremost(bench, qtbot):
    document = bench.document
    document.show(["CLAV", "STRN", "LWRA"])
    bench.panel.framing.fit_all()
    settled(qtbot)
    qtbot.waitUntil(lambda: all(len(row.values_of) == 3 for row in bench.panel.rows[:3]))

    def apart(axis):
        return np.diff(sorted(along(bench, name, axis) for name in document.shown)).min()

    axis = max("xyz", key=apart)
    for name in ("STRN", "LWRA", "CLAV"):
        bench.drag(150, 170, axis=axis, keys=SHIFT, up=along(bench, name, axis))
        assert document.selection.marker == name
        document.sweep(None)
    heights = [along(bench, name, axis) for name in document.shown]
    free = max(np.linspace(0.1, 0.9, 81), key=lambda up: min(abs(up - h) for h in heights))
    bench.drag(150, 170, axis=axis, keys=SHIFT, up=float(free))
    assert document.selection.marker == "CLAV"


def test_a_gap_that_a_swept_range_fills_is_answered_by_it(reviewed, qtbot):
    window, document = reviewed, reviewed.document
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    from markermend_app.looking import Selection

    document.show([gap.marker])
    document.sweep(Selection(gap.marker, gap.start - 4, gap.stop + 3))
    qtbot.keyClick(window, Qt.Key.Key_F, SHIFT)
    qtbot.waitUntil(lambda: document.selection is None, timeout=WAIT)
    assert document.session.find(gap.id) is None
    mine = [a for a in document.session.artifacts if a.marker == gap.marker]
    assert [(a.start, a.stop, a.status) for a in mine] == [
        (gap.start - 4, gap.stop + 3, Status.REPAIRED)
    ]
    document.undo()
    assert document.session.artifact(gap.id).status is Status.PENDING


def test_to_move_an_edge_of_what_is_repaired_says_that_it_is_open_again(reviewed, qtbot):
    window, document = reviewed, reviewed.document
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.select(gap.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    qtbot.keyClick(window, Qt.Key.Key_F)
    document.select(gap.id)
    assert document.current.status is Status.REPAIRED
    with qtbot.waitSignal(document.said) as said:
        qtbot.keyClick(window, Qt.Key.Key_BracketRight)
    assert "open again" in said.args[0]
    assert document.current.status is Status.PENDING
    told = []
    document.said.connect(told.append)
    qtbot.keyClick(window, Qt.Key.Key_BracketRight)
    assert told == []
