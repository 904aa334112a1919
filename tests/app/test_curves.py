"""What the plots draw: curves where there is something to show, the foremost marker first."""

from __future__ import annotations

import numpy as np
import pytest
from plots import SHIFT
from PySide6.QtCore import QCoreApplication

from markermend.artifact import Artifact, Kind
from markermend.patch import Patch
from markermend.repairs.registry import Repair
from markermend.review import hand
from markermend.take import Origin, Take
from markermend_app.panels.plots import drawn
from markermend_app.panels.plots.quantity import way_of
from markermend_app.style import theme


def test_gaps_stay_holes_and_originals_lie_beneath(bench):
    trace = bench.panel.rows[0].traces["CLAV"]
    assert np.isnan(trace.item("measured").values[60:90]).all()
    assert trace.item("original").values is None
    session = bench.document.session
    gap = next(a for a in session.artifacts if a.kind is Kind.GAP)
    values = np.full((30, 3), 321.0)
    bench.document.decisions.repair_many(
        [(gap.id, Repair("test", (Patch("CLAV", "xyz", 60, 90, values),)))], ""
    )
    assert np.isnan(trace.item("measured").values[60:90]).all()
    assert (trace.item("filled").frames[0], trace.item("filled").frames[-1]) == (59, 90)
    assert set(trace.item("filled").values[1:-1]) == {321.0}


def test_axes_that_were_not_edited_stay_as_measured(bench, qtbot):
    document, (x, _, z) = bench.document, bench.panel.rows[:3]
    step = next(a for a in document.session.artifacts if a.kind is Kind.STEP)
    assert step.axes == "z"
    document.show([step.marker])
    patch = Patch(step.marker, "z", step.start, step.stop, np.full((step.length, 1), 5.0))
    document.decisions.repair_many([(step.id, Repair("test", (patch,)))], "")
    qtbot.waitUntil(lambda: "edited" in z.traces[step.marker].made)
    assert set(z.traces[step.marker].item("edited").values[1:-1]) == {5.0}
    assert np.isfinite(x.traces[step.marker].item("measured").values).all()
    told = [row.origin_at(step.marker, step.start) for row in (x, z)]
    assert told == [Origin.MEASURED, Origin.EDITED]
    bench.panel.set_before_after(True)
    assert z.origin_at(step.marker, step.start) is Origin.MEASURED


def test_what_was_before_a_repair_comes_into_view_with_it(open_plots, qtbot):
    positions = np.random.default_rng(1).normal(0.0, 40.0, (200, 1, 3))
    positions[100:120, 0, 2] += 600.0
    wrong = Artifact("A", "z", 100, 120, Kind.STEP, 0.9)
    bench = open_plots(Take(positions, ("A",), 100.0), [wrong], mesh=False)
    document, view = bench.document, bench.panel.rows[2].view
    document.select(wrong.id)
    mended = Patch("A", "z", 100, 120, np.zeros((20, 1)))
    document.decisions.repair_many([(wrong.id, Repair("test", (mended,)))], "")
    bench.panel.framing.frame(100, 120)
    qtbot.waitUntil(lambda: view.viewRange()[1][1] < 500)
    bench.panel.set_before_after(True)
    low, high = view.viewRange()[1]
    assert low < -80
    assert high > 600
    # Back again nothing moves: one looks at both by turns.
    bench.panel.set_before_after(False)
    assert view.viewRange()[1] == [low, high]


@pytest.mark.parametrize(
    "positions",
    [
        np.zeros((1, 1, 3)),
        np.full((50, 2, 3), np.nan),
        np.zeros((30, 0, 3)),
        np.full((20, 1, 3), 7.0),
    ],
    ids=["one frame", "nothing seen", "no markers", "still"],
)
def test_odd_takes_are_shown(open_plots, positions):
    take = Take(positions, tuple(f"M{i}" for i in range(positions.shape[1])), 100.0)
    artifacts = [Artifact(m, "xyz", 0, 1, Kind.GAP) for m in take.labels]
    bench = open_plots(take, artifacts, mesh=False)
    bench.document.show(take.labels)
    bench.panel.framing.fit_all()
    bench.panel.framing.zoom(0.5)
    bench.panel.grab()
    if take.labels:
        bench.click(0)
        bench.drag(0, 0.4, keys=SHIFT)
        bench.panel.set_before_after(True)
        bench.panel.grab()


def test_curves_are_used_again_and_keep_nothing_of_the_marker_before(bench):
    row, take = bench.panel.rows[0], bench.document.session.take
    names = take.labels[:5]
    bench.document.show(names)
    bench.document.show(names[2:4])
    first = row.traces[names[2]].item("measured")
    bench.document.show(names[4:])
    assert row.traces[names[4]].item("measured") is first
    wanted = take.positions[:, take.index(names[4]), 0]
    np.testing.assert_array_equal(first.values, wanted)
    assert [c for c in row.view.curves if c.values is not None] == [first]


def test_many_names_do_not_make_the_window_wider(bench):
    header = bench.panel.header
    narrow = header.minimumSizeHint().width()
    bench.document.show(bench.document.session.original.labels)
    QCoreApplication.processEvents()
    assert header.minimumSizeHint().width() == narrow
    assert narrow < 300
    legend = header.legend
    for width in (150, 300, 900):
        legend.resize(width, 26)
        named = [c for c in legend.chips if not c.isHidden()]
        assert named[-1].geometry().right() <= width
        assert legend.more.text() == f"+{8 - len(named)}"
        assert legend.more.isHidden() or legend.more.geometry().right() <= width
    assert len(named) > 2
    assert legend.chips[0].text() == "CLAV"
    bench.document.show(["CLAV"])
    legend.setMinimumWidth(0)
    legend.resize(legend.chips[0].sizeHint().width() - 6, 26)
    assert legend.chips[0].text() not in ("", "CLAV")
    legend.resize(900, 26)
    assert legend.chips[0].text() == "CLAV"


def test_only_curves_with_something_to_show_are_made(bench, qtbot):
    names = bench.document.session.original.labels
    bench.document.show(names)
    row = bench.panel.rows[0]
    qtbot.waitUntil(lambda: len(row.values_of) == len(names))
    assert all("measured" in row.traces[n].made for n in names)
    assert not any({"filled", "edited"} & set(row.traces[n].made) for n in names if n != "CLAV")


def test_many_markers_are_drawn_one_after_the_other_each_in_its_place(
    open_plots, qtbot, monkeypatch
):
    rng = np.random.default_rng(3)
    labels = tuple(f"M{i:02d}" for i in range(24))
    bench = open_plots(Take(rng.normal(0, 100, (300, 24, 3)), labels, 100.0), mesh=False)
    row = bench.panel.rows[0]
    gathered: list[str] = []

    def gather(take, name, *rest):
        gathered.append(name)
        return way_of(take, name, *rest)

    monkeypatch.setattr(drawn, "way_of", gather)
    bench.document.show(labels)
    assert 0 < len(row.values_of) < 24
    assert len(gathered) < 24, "what is drawn later is gathered later"
    # Others, while some still wait: nothing of what was asked for before may be left.
    wanted = (*labels[:3], *reversed(labels[5:]))
    bench.document.show(wanted)
    qtbot.waitUntil(lambda: len(row.values_of) == len(wanted), timeout=20_000)
    for name in wanted:
        x = bench.document.session.positions[:, labels.index(name), 0]
        np.testing.assert_array_equal(row.traces[name].item("measured").values, x)
    bench.document.show(labels[:1])
    qtbot.wait(50)
    assert set(row.values_of) == {labels[0]}


def test_beside_the_foremost_marker_changes_and_repairs_of_others_may_follow(
    open_plots, qtbot, monkeypatch
):
    rng = np.random.default_rng(3)
    labels = ("A", "B", "C")
    bench = open_plots(Take(rng.normal(0, 100, (300, 3, 3)), labels, 100.0), mesh=False)
    monkeypatch.setattr("markermend_app.panels.plots.row._AT_ONCE", 1)
    document, row = bench.document, bench.panel.rows[0]
    document.show(labels)
    assert set(row.values_of) == {"A"}
    patch = Patch("C", "xyz", 100, 110, np.zeros((10, 3)))
    row.show_proposal([patch], None)
    assert not row.proposed
    qtbot.waitUntil(lambda: len(row.values_of) == 3)
    assert len(row.proposed) == 1, "what a repair would make of it comes with the marker"
    np.testing.assert_array_equal(row.proposed[0].values[1:-1], np.zeros(10))
    smoothed, samples = rng.normal(0, 100, (300, 3, 3)), document.session.take.origin.copy()
    document.do(lambda s: hand.replace_samples(s, "Smooth", labels, 0, smoothed, samples))
    document.stay()
    drawn = [row.values_of[n][0] == smoothed[0, i, 0] for i, n in enumerate(labels)]
    assert drawn == [True, False, False]
    qtbot.waitUntil(lambda: row.values_of["C"][0] == smoothed[0, 2, 0])
    for i, name in enumerate(labels):
        np.testing.assert_array_equal(row.values_of[name], smoothed[:, i, 0])


def test_themes_change_while_open(bench, qapp):
    theme.apply(qapp, "dark")
    assert bench.panel.canvas.backgroundBrush().color() == theme.DARK.plot
    theme.apply(qapp, "light")
