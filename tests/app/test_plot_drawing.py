"""What the plots draw anew, at once or soon, when markers or samples change."""

from __future__ import annotations

import numpy as np
import pytest
from driving import settled

from markermend.review import hand
from markermend_app.panels.plots.row import PlotRow


@pytest.fixture
def panel(bench):
    return bench.panel


def test_markers_that_stay_are_not_drawn_anew(panel, monkeypatch, qtbot):
    document, drawn = panel.document, []
    refresh = PlotRow.refresh

    def note(row, name, shown):
        drawn.append(name)
        refresh(row, name, shown)

    monkeypatch.setattr(PlotRow, "refresh", note)
    document.show(["CLAV", "STRN"])
    assert drawn == ["STRN"] * 3
    x = panel.rows[0]
    kept = x.traces["CLAV"].item("measured").values
    document.do(lambda s: hand.cut(s, "CLAV", 100, 110))
    assert drawn == ["STRN"] * 3 + ["CLAV"], "the first row now, the others soon"
    settled(qtbot)
    assert drawn == ["STRN"] * 3 + ["CLAV"] * 3
    assert np.isfinite(kept[100:110]).all()
    assert np.isnan(x.traces["CLAV"].item("measured").values[100:110]).all()
    document.show(["STRN", "CLAV"])
    assert np.array_equal(
        x.traces["STRN"].item("measured").values, x.values_of["STRN"], equal_nan=True
    )
    assert np.isnan(x.value_at("CLAV", 105))


def test_distances_are_drawn_anew_when_their_partner_moves(panel, qtbot):
    document = panel.document
    panel.choose_partner("STRN")
    settled(qtbot)
    before = panel.rows[-1].value_at("CLAV", 100)
    document.do(lambda s: hand.cut(s, "STRN", 95, 105))
    settled(qtbot)
    assert np.isfinite(before)
    assert np.isnan(panel.rows[-1].value_at("CLAV", 100))


def test_rows_below_the_third_are_drawn_soon(panel, qtbot):
    document = panel.document
    panel.choose_rows(["x", "y", "z", "speed"])
    document.show(["STRN"])
    speed_row = panel.rows[-1]
    assert speed_row.value_at("STRN", 100) is None
    settled(qtbot)
    assert speed_row.value_at("STRN", 100) is not None


def test_a_long_change_is_drawn_soon_in_every_row(panel, monkeypatch, qtbot):
    monkeypatch.setattr("markermend_app.panels.plots.trajectories._MUCH", 50)
    document = panel.document
    document.show(["CLAV"])
    document.do(lambda s: hand.cut(s, "CLAV", 100, 190))
    assert all(np.isfinite(row.values_of["CLAV"][101]) for row in panel.rows)
    settled(qtbot)
    assert all(np.isnan(row.values_of["CLAV"][101]) for row in panel.rows)
    document.undo()
    settled(qtbot)
    assert all(np.isfinite(row.values_of["CLAV"][101]) for row in panel.rows)
    # A long change of what is not shown makes nothing wait that is.
    document.do(lambda s: hand.cut(s, "T10", 100, 190))
    document.do(lambda s: hand.cut(s, "CLAV", 100, 110))
    assert np.isnan(panel.rows[0].values_of["CLAV"][101])


def test_curves_of_markers_that_are_no_longer_shown_go_one_after_the_other(bench, qtbot):
    labels = bench.document.session.original.labels
    bench.document.show(labels[:6])
    settled(qtbot)
    row = bench.panel.rows[0]
    many = len(row.view.curves)
    bench.document.show(labels[:1])
    assert len(row._pool) == 6, "the turn that shows another marker is spared it"
    settled(qtbot)
    assert len(row._pool) == 2
    assert len(row.view.curves) < many
    assert list(row.traces) == [labels[0]]
