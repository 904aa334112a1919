"""What the window says and draws of skeleton recordings, where it differs from takes."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QLabel,
    QMenu,
)

from markermend.artifact import Kind
from markermend.poses.nuitrack import JOINTS
from markermend.repairs import REPAIRS
from markermend_app.actions.elsewhere import elsewhere
from markermend_app.actions.palette import entries, ranked
from markermend_app.dialogs.preferences import Preferences
from markermend_app.looking import Selection
from markermend_app.method_words import SUMMARIES
from markermend_app.panels.inspector.artifact import ArtifactPage
from markermend_app.panels.inspector.take import SelectionPage
from markermend_app.panels.markers.marker_menu import add_marker_verbs
from markermend_app.panels.markers.marker_model import MISSING, NAME
from markermend_app.panels.scene import paint
from markermend_app.panels.scene.proposed import proposed_body

WAIT = 60_000


def test_what_has_joints_is_not_said_to_have_markers(opened):
    assert opened.docks["markers"].windowTitle() == "Joints"
    assert opened.tree.filter.accessibleName() == "Filter joints"
    assert opened.tree._model.headerData(NAME, Qt.Orientation.Horizontal) == "Joint"
    facts = [label.text() for label in opened.inspector.findChildren(QLabel)]
    assert "Joints" in facts
    assert "Markers" not in facts
    assert opened.queue.filters.marker.accessibleName() == "Filter by joint"
    opened.docks["quality"].raise_()
    opened.quality._count()
    for header in (opened.queue.view.horizontalHeader(), opened.quality.head.horizontalHeader()):
        named = [header.model().headerData(i, Qt.Orientation.Horizontal) for i in range(3)]
        assert "Joint" in named
        assert "Marker" not in named
    assert opened.quality.view.accessibleName() == "Quality, joint by joint"
    assert opened.trajectories.canvas.accessibleName() == "Plots of the shown joints"
    assert "the joints with most" in opened.tree.worst_first.toolTip()
    assert "in which the joint is missing" in opened.tree._model.headerData(
        MISSING, Qt.Orientation.Horizontal, Qt.ItemDataRole.ToolTipRole
    )
    opened.document.show(())
    assert opened.trajectories.empty.accessibleName() == "No joint is shown"


def test_restoring_is_compared_with_the_others_and_stands_first(opened, qtbot):
    document, comparison = opened.document, opened.comparison
    gap = next(a for a in document.session.artifacts if a.marker == "head")
    document.select(gap.id)
    comparison.start(["C"])
    qtbot.waitUntil(lambda: comparison.candidates is not None, timeout=WAIT)
    restored = comparison.candidates[0]
    assert restored.method == "skeleton"
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    # One figure wherever it is told.
    assert restored.error_mm == document.proposal.error_mm
    assert {"local_regression", "spline"} <= {c.method for c in comparison.candidates}
    assert all(c.error_mm is not None for c in comparison.candidates if c.trials)
    said = opened.candidates.said
    qtbot.waitUntil(lambda: "each method's own estimate" in said.text(), timeout=WAIT)
    comparison.stop()


def test_the_best_is_what_compare_has_first(window, shared_data, tmp_path, qtbot):
    for name in ("02.asf", "02_01.amc"):
        (tmp_path / name).write_bytes((shared_data / "poses" / name).read_bytes())
    window.commands.open_path(tmp_path / "02_01.amc")
    document, comparison = window.document, window.comparison
    qtbot.waitUntil(lambda: document.session is not None, timeout=WAIT)
    qtbot.waitUntil(lambda: not window.lane.busy, timeout=WAIT)
    document.show(["lthumb"])
    document.go_to(105)
    qtbot.keyClick(window, Qt.Key.Key_V)
    document.go_to(225)
    qtbot.keyClick(window, Qt.Key.Key_V)
    qtbot.keyClick(window, Qt.Key.Key_M)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    said = document.proposal.error_mm
    comparison.start(["C"])
    qtbot.waitUntil(lambda: comparison.candidates is not None, timeout=WAIT)
    assert comparison.place == 0
    assert comparison.candidates[0].method == document.proposal.method
    assert comparison.candidates[0].error_mm == document.proposal.error_mm == said
    methods = window.inspector.findChild(ArtifactPage).methods
    best = methods.buttons["auto"]
    named = REPAIRS[document.proposal.method].label
    assert best.text() == f"Best: {named}"
    assert best.toolTip().startswith(f"Best: {named}")
    comparison.stop()
    # With joints chosen to follow, another may be the best, as soon as it is known.
    document.follow(("lhand", "lwrist", "lradius"))
    assert best.text() == "Best for this artifact"
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    assert document.proposal.patches, document.proposal.reason
    named = REPAIRS[document.proposal.method].label
    assert best.text() == f"Best: {named}"


def test_bones_of_what_is_proposed_are_drawn_in_space(opened, qtbot):
    document, scene = opened.document, opened.scene
    take = document.session.original
    gap = next(a for a in document.session.artifacts if a.marker == "head")
    document.select(gap.id)
    document.go_to(gap.start + 2)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    now = document.session.positions[document.frame]
    placed, proposed = proposed_body(document, now)
    head = take.index("head")
    assert np.isnan(now[head]).all()
    assert proposed[head]
    np.testing.assert_array_equal(placed[head], document.proposal.patches[0].values[2])
    drawn = []
    as_it_is = paint.paint_proposed
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(paint, "paint_proposed", lambda s, p, n: drawn.append(n) or as_it_is(s, p, n))
        scene.grab()
    assert sorted((head, take.index("neck"))) in [sorted(pair) for pair in drawn[0].tolist()]
    document.go_to(gap.stop + 5)
    assert not proposed_body(document, document.session.positions[document.frame])[1].any()


def test_tool_tips_speak_of_joints(opened, qtbot):
    document, page = opened.document, opened.inspector.findChild(SelectionPage)
    document.show(["head"])
    document.sweep(Selection("head", 10, 20))
    for name in ("repair_selection", "smooth", "swap_selection", "move_selection"):
        assert "joint" in page.verbs[name].toolTip(), name
    methods = opened.inspector.findChild(ArtifactPage).methods
    said = [button.toolTip() for button in methods.buttons.values()]
    tip = Qt.ItemDataRole.ToolTipRole
    said += [methods.more.itemData(row, tip) for row in range(methods.more.count())]
    assert not [text for text in said if "marker" in text.lower()]
    # What methods say of joints they say of markers, too.
    assert all("marker" in REPAIRS[name].summary for name in SUMMARIES)


def test_actions_speak_of_joints_and_those_without_use_rest(opened, window, qtbot):
    actions = opened.actions_by_name
    assert actions["rename_marker"].text() == "Rename joint…"
    assert "joint" in actions["choose_references"].toolTip()
    assert not actions["detect_slow"].isEnabled()
    assert "Only for takes of markers" in actions["detect_slow"].toolTip()
    found = entries(actions, opened.document)
    names = [entry.text for entry in ranked("joint", found)]
    assert "By hand: Rename joint…" in names
    assert "left_wrist" in names
    swap = next(entry for entry in ranked("swap joints", found))
    assert swap.text == "Review: Repair method: Swap joints"
    methods = ranked("restore skel", list(elsewhere(opened)))
    assert methods[0].text == "Review: Repair method: Restore skeleton"
    methods[0].do()
    assert opened.document.method == "skeleton"
    menu = QMenu()
    opened.document.show(["head"])
    add_marker_verbs(menu, opened.document, lambda _: None)
    assert any(action.text().startswith("Merge joint…") for action in menu.actions())
    opened.scene.looks.fill(menu, None, lambda _: None, lambda: None, lambda _: None, joints=True)
    assert "Joints in one colour" in [action.text() for action in menu.actions()]
    assert opened.scene.buttons.trails.toolTip() == "Trails of all joints"
    assert actions["method_6"].text() == "Swap joints"


def test_actions_speak_of_markers_again(opened, take_path, qtbot):
    opened.document.session.mark_exported()
    opened.commands.open_path(take_path)
    qtbot.waitUntil(lambda: not opened.document.joints, timeout=WAIT)
    actions = opened.actions_by_name
    qtbot.waitUntil(lambda: opened.document.current is not None, timeout=WAIT)
    assert actions["method_6"].text() == "Swap markers"
    rename = next(e for e in entries(actions, opened.document) if "Rename marker" in e.text)
    assert rename.also.count("Give the foremost marker another name") == 1
    assert actions["method_6"].isEnabled()
    swap = opened.inspector.findChild(ArtifactPage).methods.buttons["swap"]
    assert swap.toolTip().startswith("6 Swap markers\nGives the marker")
    assert opened.trajectories.canvas.accessibleName() == "Plots of the shown markers"
    assert opened.quality.view.accessibleName() == "Quality, marker by marker"
    assert "the markers with most" in opened.tree.worst_first.toolTip()
    assert actions["rename_marker"].text() == "Rename marker…"
    assert actions["detect_slow"].isEnabled()
    assert opened.scene.buttons.trails.toolTip() == "Trails of all markers"


def test_the_dial_rests_where_it_changes_nothing(qtbot):
    page = Preferences()
    qtbot.addWidget(page)
    assert page.dial.isEnabled()
    page.dial_does_nothing()
    page._read_detection()
    assert not page.dial.isEnabled()
    assert not page.preset.isEnabled()
    assert "joints" in page.dial_hint.text()


@pytest.mark.parametrize(("recording", "able"), [("opened", False), ("reviewed", True)])
def test_the_page_that_the_window_opens_knows_whether_the_dial_changes_anything(
    request, recording, able, monkeypatch
):
    window, pages = request.getfixturevalue(recording), []
    monkeypatch.setattr(Preferences, "exec", lambda page: pages.append(page))
    window.actions_by_name["preferences"].trigger()
    pages[0]._read_detection()
    assert pages[0].dial.isEnabled() == able


@pytest.mark.parametrize(("recording", "them"), [("opened", "joints"), ("reviewed", "markers")])
def test_what_may_be_followed_is_called_what_it_is(request, recording, them, qtbot):
    window, said = request.getfixturevalue(recording), []
    window.references.said.connect(said.append)
    qtbot.keyClick(window, Qt.Key.Key_K)
    assert said[-1].startswith(f"Choose the {them} that {window.document.current.marker} is to")


def test_restoring_is_named_where_it_is_the_best(opened, qtbot):
    document = opened.document
    methods = opened.inspector.findChild(ArtifactPage).methods
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.select(gap.id)
    best = methods.buttons["auto"]
    qtbot.waitUntil(lambda: best.text() == "Best: Restore skeleton", timeout=WAIT)
    assert methods.buttons["swap"].text() == "6 Swap joints"
    assert not methods.buttons["swap"].isEnabled()
    # Nor by its key: it would be chosen where it cannot be.
    qtbot.keyClick(opened, Qt.Key.Key_6)
    assert document.method == "auto"
    assert opened.inspector.findChild(ArtifactPage).sureness.text().startswith("certain")
    document.select(next(a for a in document.session.artifacts if a.counterpart).id)
    assert methods.buttons["swap"].isEnabled()
    assert opened.actions_by_name["method_6"].isEnabled()
    qtbot.keyClick(opened, Qt.Key.Key_6)
    assert document.method == "swap"
    assert "%" in opened.inspector.findChild(ArtifactPage).sureness.text()


def test_the_overview_is_in_the_order_of_the_tree(opened):
    rows = opened.overview._rows
    names = [JOINTS[column] for column in rows.columns]
    place = {name: names.index(name) for name in names}
    assert place["left_elbow"] == place["left_shoulder"] + 1
    assert place["left_wrist"] == place["left_elbow"] + 1
    assert place["left_ankle"] == place["left_knee"] + 1
    assert sorted(rows.row_of) == list(range(len(JOINTS)))
    assert [name for name, *_ in rows.groups] == names
