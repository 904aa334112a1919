"""The marker tree under real clicks: what is checked is shown, and counts follow the review."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QModelIndex, QPoint, Qt
from PySide6.QtWidgets import QStyle, QStyleOptionViewItem

from markermend.artifact import Artifact, Kind, Status
from markermend.mesh import Group, Mesh
from markermend.review import hand
from markermend.review.file import open_session
from markermend.take import Analog, Points, Take
from markermend_app.document import Document
from markermend_app.panels.markers.marker_model import (
    MISSING,
    NAME,
    NODE,
    MarkerModel,
)
from markermend_app.panels.markers.marker_tree import MarkerTree
from markermend_app.panels.markers.rows import Node

MESH = Mesh(
    ("CLAV", "STRN", "C7", "T10", "LSHO", "LELB", "LWRA", "LWRB"),
    (Group("Trunk", "", (0, 1, 2, 3)), Group("Left arm", "", (4, 5, 6, 7), 0, 0)),
)


@pytest.fixture
def mesh():
    return MESH


@pytest.fixture
def tree(document, qtbot):
    tree = MarkerTree(document)
    qtbot.addWidget(tree)
    tree.resize(280, 600)
    tree.show()
    return tree


def index_of(tree, label):
    return tree.view.model().mapFromSource(tree._model.index_of(label))


def is_checked(index):
    return Qt.CheckState(index.data(Qt.ItemDataRole.CheckStateRole)) == Qt.CheckState.Checked


def click(qtbot, tree, label, held=Qt.KeyboardModifier.NoModifier):
    box = tree.view.visualRect(index_of(tree, label))
    at = QPoint(box.right() - 10, box.center().y())
    qtbot.mouseClick(tree.view.viewport(), Qt.MouseButton.LeftButton, held, at)


def check(qtbot, tree, label):
    option = QStyleOptionViewItem()
    index = index_of(tree, label)
    tree.view.itemDelegate().initStyleOption(option, index)
    option.rect = tree.view.visualRect(index)
    part = QStyle.SubElement.SE_ItemViewItemCheckIndicator
    box = tree.view.style().subElementRect(part, option, tree.view)
    qtbot.mouseClick(tree.view.viewport(), Qt.MouseButton.LeftButton, pos=box.center())


def visible(tree):
    model, names = tree.view.model(), []

    def walk(parent):
        for row in range(model.rowCount(parent)):
            index = model.index(row, NAME, parent)
            names.append(index.data())
            walk(index)

    walk(tree.view.rootIndex())
    return names


def test_body_hierarchy_is_shown_with_markers_before_child_groups(tree):
    names = visible(tree)
    assert names[:5] == ["Trunk", "CLAV", "STRN", "C7", "T10"]
    assert names[5:] == ["Left arm", "LSHO", "LELB", "LWRA", "LWRB"]
    assert index_of(tree, "LELB").parent().parent().data() == "Trunk"


def test_click_shows_a_marker_alone_and_ctrl_click_adds(qtbot, tree, document):
    click(qtbot, tree, "STRN")
    assert document.shown == ("STRN",)
    click(qtbot, tree, "LWRB", Qt.KeyboardModifier.ControlModifier)
    assert set(document.shown) == {"STRN", "LWRB"}
    click(qtbot, tree, "T10")
    assert document.shown == ("T10",)
    click(qtbot, tree, "LWRB", Qt.KeyboardModifier.ShiftModifier)
    assert {"T10", "LSHO", "LELB", "LWRA", "LWRB"} <= set(document.shown)


def test_check_marks_add_and_take_away(qtbot, tree, document):
    click(qtbot, tree, "STRN")
    check(qtbot, tree, "LSHO")
    assert set(document.shown) == {"STRN", "LSHO"}
    check(qtbot, tree, "STRN")
    assert document.shown == ("LSHO",)


def test_check_marks_and_selection_follow_what_is_shown(qtbot, tree, document):
    document.show(["C7", "LWRA"])
    assert is_checked(index_of(tree, "C7"))
    assert not is_checked(index_of(tree, "LSHO"))
    qtbot.waitUntil(lambda: len(tree.view.selectionModel().selectedRows()) == 2)
    rows = {i.data() for i in tree.view.selectionModel().selectedRows()}
    assert rows == {"C7", "LWRA"}


def test_a_decision_is_counted_in_a_turn_of_its_own(qtbot, tree, document, monkeypatch):
    drawn = []
    monkeypatch.setattr(tree, "_count", lambda: drawn.append(1))
    for artifact in document.session.artifacts[:3]:
        document.decisions.reject([artifact.id])
    assert not drawn, "the window is held up by what stands beside the plots"
    qtbot.waitUntil(lambda: len(drawn) == 1)


def test_a_decision_does_not_select_anew_what_is_shown(qtbot, tree, document):
    document.show(["LWRB"])
    selected = tree.view.selectionModel().selectedRows
    qtbot.waitUntil(lambda: len(selected()) == 1)
    tree._syncing = True
    tree.view.clearSelection()
    tree._syncing = False
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.session.set_status([gap.id], Status.REJECTED)
    document.artifacts_changed.emit()
    qtbot.waitUntil(lambda: not index_of(tree, "CLAV").data(NODE).counts)
    assert not selected()


def test_counts_follow_decisions_without_folding_anything(qtbot, tree, document):
    trunk = index_of(tree, "CLAV").parent()
    assert trunk.data(NODE).counts == {k: 1 for k in (Kind.GAP, Kind.PEAK, Kind.NOISE, Kind.STEP)}
    tree.view.collapse(index_of(tree, "LWRA").parent())
    gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
    document.decisions.reject([gap.id])
    qtbot.waitUntil(lambda: not index_of(tree, "CLAV").data(NODE).counts)
    assert tree.view.isExpanded(trunk)
    assert not tree.view.isExpanded(index_of(tree, "LWRA").parent())
    document.undo()
    qtbot.waitUntil(lambda: bool(index_of(tree, "CLAV").data(NODE).counts))
    assert index_of(tree, "CLAV").data(NODE).counts == {Kind.GAP: 1}


def test_joints_that_hold_others_count_their_own():
    root = Node("")
    shoulder = root.add(Node("shoulder", label="shoulder"))
    elbow = shoulder.add(Node("elbow", label="elbow"))
    model = MarkerModel(lambda labels: None, lambda labels: None)
    model.set_root(root)
    model.set_counts(
        [Artifact(name, "xyz", 5, 9, Kind.GAP) for name in ("shoulder", "elbow", "elbow")]
    )
    assert (shoulder.own, shoulder.counts) == ({Kind.GAP: 1}, {Kind.GAP: 3})
    assert elbow.own == elbow.counts == {Kind.GAP: 2}
    index = model.index(0, NAME)
    assert (index.data(NODE).own, index.data(NODE).counts) == ({Kind.GAP: 1}, {Kind.GAP: 3})
    assert "1 gap" in index.data(Qt.ItemDataRole.ToolTipRole)


def test_a_mix_up_counts_for_both_joints_and_once_above_them():
    root = Node("")
    hip = root.add(Node("hip", label="hip"))
    sides = [hip.add(Node(name, label=name)) for name in ("left", "right")]
    model = MarkerModel(lambda labels: None, lambda labels: None)
    model.set_root(root)
    swap = Artifact("left", "xyz", 5, 9, Kind.STEP, counterpart="right")
    gap = Artifact("left", "xyz", 50, 90, Kind.GAP)
    for open_ones, of_hip in (
        ([swap], {Kind.STEP: 1}),
        ([swap, gap], {Kind.STEP: 1, Kind.GAP: 1}),
        ([gap], {Kind.GAP: 1}),
        ([swap], {Kind.STEP: 1}),
        ([], {}),
    ):
        model.set_counts(open_ones)
        assert hip.counts == of_hip
        assert [Kind.STEP in side.own for side in sides] == [swap in open_ones] * 2


def test_worst_first_is_flat_and_sorted_by_open_artifacts(qtbot, tree, document):
    qtbot.mouseClick(tree.worst_first, Qt.MouseButton.LeftButton)
    names = visible(tree)
    assert len(names) == 8
    # All have one open artifact; CLAV misses frames besides.
    assert names[0] == "CLAV"
    assert set(names[:4]) == {"CLAV", "LELB", "C7", "LWRA"}
    document.decisions.reject([a.id for a in document.session.artifacts if a.marker == "CLAV"])
    qtbot.waitUntil(lambda: set(visible(tree)[:3]) == {"LELB", "C7", "LWRA"})


def test_filter_keeps_the_branch_of_what_matches(qtbot, tree):
    qtbot.keyClicks(tree.filter, "lwr")
    assert visible(tree) == ["Trunk", "Left arm", "LWRA", "LWRB"]
    tree.filter.clear()
    assert len(visible(tree)) == 10
    assert tree._nothing.label.isHidden()
    qtbot.keyClicks(tree.filter, "zzz")
    assert not tree._nothing.label.isHidden()
    tree.filter.clear()
    assert tree._nothing.label.isHidden()


def test_a_group_stands_for_its_markers_that_are_listed(qtbot, tree, document):
    qtbot.keyClicks(tree.filter, "lwr")
    model = tree.view.model()
    group = index_of(tree, "LWRA").parent()
    assert group.isValid()
    tree.view.setCurrentIndex(model.index(group.row(), NAME, group.parent()))
    assert document.shown == ("LWRA", "LWRB"), "not those that the filter hides"
    tree.filter.clear()
    tree.view.setCurrentIndex(index_of(tree, "CLAV"))
    tree.view.setCurrentIndex(index_of(tree, "LWRA").parent())
    assert document.shown == ("LSHO", "LELB", "LWRA", "LWRB")


def test_missing_share_is_shown(tree):
    assert index_of(tree, "CLAV").siblingAtColumn(MISSING).data() == "7.5"
    assert not index_of(tree, "C7").siblingAtColumn(MISSING).data()


def test_subjects_unlabelled_and_other_points_stand_apart(tmp_path, qtbot):
    labels = ("A:HEAD", "A:NECK", "B:HEAD", "*7")
    take = Take(
        np.zeros((20, 4, 3)),
        labels,
        100.0,
        points=Points(np.zeros((20, 1, 3)), ("LHipAngles",), ("angle",), (4,), {"angle": "deg"}),
        analog=Analog(np.zeros((20, 1), np.float32), ("Fz1",), ("N",), 100.0),
    )
    document = Document()
    tree = MarkerTree(document)
    qtbot.addWidget(tree)
    document.open(open_session(take, folder=tmp_path), Mesh(labels, (Group("Head", "A", (0, 1)),)))
    qtbot.waitUntil(lambda: not tree._anew.waiting)
    top = [tree.view.model().index(i, 0).data() for i in range(tree.view.model().rowCount())]
    assert top == ["A", "B", "Unlabelled (1)", "Other points (1)", "Analog channels (1)"]
    names = visible(tree)
    assert names[:5] == ["A", "Head", "HEAD", "NECK", "B"]
    # What has no counts has the whole row for its name, a closed group of markers has not.
    spanned = [tree.view.isFirstColumnSpanned(i, QModelIndex()) for i in range(5)]
    assert spanned == [True, True, False, True, True]
    assert names[-4:] == ["Angle (deg)", "LHipAngles", "Analog channels (1)", "Fz1 (N)"]
    document.open(None, None)
    document.proposals.close()


def test_channels_are_checked_into_rows_of_their_own(tmp_path, damaged, qtbot):
    take, _ = damaged
    analog = Analog(np.zeros((800, 2), np.float32), ("Fz1", "EMG"), ("N", "V"), 200.0)
    take = Take(take.positions, take.labels, take.rate, analog=analog)
    document = Document()
    document.open(open_session(take, folder=tmp_path), MESH)
    tree = MarkerTree(document)
    qtbot.addWidget(tree)
    model = tree._model
    section = model.index(model.rowCount() - 1, NAME)
    channel = model.index(1, NAME, section)
    assert model.data(channel) == "EMG (V)"
    assert model.flags(channel) & Qt.ItemFlag.ItemIsUserCheckable
    shown = document.shown
    model.setData(channel, Qt.CheckState.Checked.value, Qt.ItemDataRole.CheckStateRole)
    assert document.beside == ("analog 1",)
    assert document.shown == shown
    assert is_checked(channel)
    model.setData(channel, Qt.CheckState.Unchecked.value, Qt.ItemDataRole.CheckStateRole)
    assert document.beside == ()
    tree.resize(300, 400)
    tree.show()
    tree.filter.setText("EMG")
    view, box = tree.view, QStyle.SubElement.SE_ItemViewItemCheckIndicator
    row = tree._proxy.mapFromSource(channel)
    option = QStyleOptionViewItem()
    view.initViewItemOption(option)
    option.rect = view.visualRect(row)
    option.features |= QStyleOptionViewItem.ViewItemFeature.HasCheckIndicator
    # Its name means it as much as its check mark does.
    for at in (view.style().subElementRect(box, option, view).center(), option.rect.center()):
        for shown_now in (("analog 1",), ()):
            qtbot.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, pos=at)
            assert document.beside == shown_now
    assert document.shown == shown
    document.open(None, None)
    document.proposals.close()


def test_the_next_take_is_shown_whole(qtbot, review, damaged):
    window = review(*damaged)
    document, tree = window.document, window.tree
    qtbot.keyClicks(tree.filter, "lwr")
    document.do(lambda session: hand.rename(session, {"T10": "T11"}))
    assert tree.filter.text() == "lwr"
    document.session.mark_exported()
    document.open(open_session(damaged[0]), document.mesh)
    assert tree.filter.text() == ""
    assert tree._proxy.rowCount() == 0, "nobody can ask for a marker of the take before"
    qtbot.waitUntil(lambda: not tree._anew.waiting)
    assert tree._proxy.rowCount() > 0


def test_from_the_filter_the_first_marker_found_is_chosen(qtbot, review, damaged):
    window = review(*damaged)
    document, tree = window.document, window.tree
    for letters, key, shown in (
        ("lwr", Qt.Key.Key_Return, "LWRA"),
        ("lwrb", Qt.Key.Key_Down, "LWRB"),
        ("lwr", Qt.Key.Key_Down, "LWRB"),
    ):
        tree.filter.clear()
        tree.filter.setFocus()
        qtbot.keyClicks(tree.filter, letters)
        qtbot.keyClick(tree.filter, key)
        assert document.shown == (shown,)
        assert window.focusWidget() is tree.view
