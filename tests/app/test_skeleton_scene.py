"""The 3D view of a skeleton whose whole body, or a limb, is wrong at once."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

import markermend as mm
from markermend.artifact import Artifact, Kind, Status
from markermend.poses.nuitrack import JOINTS, to_nuitrack
from markermend_app.panels.scene import paint
from markermend_app.panels.scene.proposed import proposed_body
from markermend_app.style import theme
from markermend_app.walk import ahead_and_beside

WAIT = 60_000
CARRIED = slice(150, 160)


@pytest.fixture
def walk(shared_data):
    """A clean walk."""
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))


@pytest.fixture
def carried(window, walk, tmp_path, qtbot):
    """The window on a recording whose body is carried off for ten frames."""
    positions = np.array(walk.positions)
    positions[CARRIED] += [500, 0, 300]
    path = tmp_path / "carried.csv"
    mm.write_pose(walk.with_samples(positions, walk.rotations, walk.confidence), path)
    window.commands.open_path(path)
    qtbot.waitUntil(lambda: window.document.current is not None, timeout=WAIT)
    return window


def painted(scene, name):
    """What is handed to one of the functions that paint while the view is painted once."""
    calls, as_it_is = [], getattr(paint, name)

    def painting(sight, *what):
        # Nobody may keep a painter that is done.
        calls.append(what)
        return as_it_is(sight, *what)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(paint, name, painting)
        scene.grab()
    return calls


def whole_body_proposed(window, qtbot):
    """Wait until a place is proposed for each joint."""
    document = window.document

    def every():
        return proposed_body(document, document.session.positions[document.frame])[1].all()

    qtbot.waitUntil(every, timeout=WAIT)


def test_the_whole_body_is_proposed_where_the_whole_body_is_wrong(carried, walk, qtbot):
    document, scene = carried.document, carried.scene
    assert len(document.session.listed_with(Status.PENDING)) == len(JOINTS)
    document.go_to(155)
    whole_body_proposed(carried, qtbot)
    placed, _ = proposed_body(document, document.session.positions[155])
    assert np.abs(placed - walk.positions[155]).max() < 30
    [(_, drawn)] = painted(scene, "paint_proposed")
    assert len(drawn) == len(JOINTS) - 1


def test_joints_that_are_repaired_at_once_are_proposed_by_the_chosen_method(carried, qtbot):
    document = carried.document
    document.go_to(155)
    whole_body_proposed(carried, qtbot)
    document.choose_method("spline")
    whole_body_proposed(carried, qtbot)
    neck = next(a for a in document.session.artifacts if a.marker == "neck")
    assert neck.id != document.current.id
    placed, _ = proposed_body(document, document.session.positions[155])
    [patch] = document.proposals.get(neck, "spline").patches
    np.testing.assert_array_equal(placed[JOINTS.index("neck")], patch.values[155 - patch.start])


def test_beside_a_joint_that_follows_chosen_ones_the_rest_of_the_body_is_proposed(carried, qtbot):
    document = carried.document
    document.go_to(155)
    whole_body_proposed(carried, qtbot)
    document.proposals.forget()
    document.follow(("left_hip", "right_hip", "collar"))
    assert len(document.at_once(document.session)) == 1

    def others():
        now = document.session.positions[155]
        return proposed_body(document, now)[1].sum() >= len(JOINTS) - 1

    qtbot.waitUntil(others, timeout=WAIT)


def test_a_proposal_beside_is_painted_as_it_comes_and_no_damage_is_counted_anew(
    carried, qtbot, monkeypatch
):
    document, scene = carried.document, carried.scene
    document.go_to(155)
    whole_body_proposed(carried, qtbot)
    scene.looks.colours = "damage"
    scene.grab()
    document.follow(("left_hip", "right_hip", "collar"))
    beside = next(a for a in document.session.artifacts if a.id != document.current.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    qtbot.waitUntil(lambda: not document.proposals.lane.busy, timeout=WAIT)
    counted, drawn = [], []
    monkeypatch.setattr(
        "markermend_app.panels.scene.seen.damage_share",
        lambda *_: counted.append(1) or np.zeros(len(JOINTS)),
    )
    as_it_is = paint.paint_proposed
    monkeypatch.setattr(paint, "paint_proposed", lambda *what: drawn.append(1) or as_it_is(*what))
    qtbot.waitUntil(lambda: not scene._soon.waiting)
    QApplication.processEvents()
    drawn.clear()
    document.proposals.ready.emit(beside.id)
    qtbot.waitUntil(lambda: bool(drawn), timeout=WAIT)
    document.proposal_changed.emit()
    scene.grab()
    assert not counted


def test_no_bone_is_proposed_to_a_joint_of_which_nothing_is_known_yet(carried, qtbot, monkeypatch):
    document = carried.document
    by_marker = {a.marker: a for a in document.session.artifacts}
    document.decisions.reject([by_marker["waist"].id])
    document.select(by_marker["left_hip"].id)
    document.go_to(155)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    known = document.proposal
    monkeypatch.setattr(
        document.proposals, "get", lambda a, *_: known if a.marker == "left_hip" else None
    )
    placed, proposed = proposed_body(document, document.session.positions[155])
    assert [JOINTS[i] for i in np.flatnonzero(proposed)] == ["left_hip"]
    # The one whose flag was rejected is where it is said to be.
    there = {JOINTS[i] for i in np.flatnonzero(np.isfinite(placed).all(axis=1))}
    assert there == {"waist", "left_hip"}


def test_marks_of_the_same_moment_that_take_long_are_few(carried, qtbot):
    document = carried.document
    session = document.session
    whole = session.listed_with(Status.PENDING)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    assert len(ahead_and_beside(session, whole[:1], ())) == len(JOINTS) - 1
    for joint in JOINTS:
        document.decisions.mark(Artifact(joint, "xyz", 152, 200, Kind.NOISE))
    beside = ahead_and_beside(session, whole[:1], ())
    assert {a.id for a in whole[1:]} < {a.id for a in beside}
    by_hand = [a for a in beside if a.stop == 200]
    assert 0 < len(by_hand) < 10
    assert beside[-len(by_hand) :] == tuple(by_hand)


def test_the_camera_does_not_go_along_with_what_is_carried_off(carried, walk, qtbot):
    document, scene = carried.document, carried.scene
    document.go_to(140)
    targets = []
    for _ in range(30):
        targets.append(scene.camera.target)
        qtbot.keyClick(carried, Qt.Key.Key_Right)
    assert document.frame == 170
    truth = np.median(walk.positions[140:170], axis=1)
    moved = np.array(targets) - targets[0]
    assert np.abs(moved - (truth - truth[0])).max() < 60
    # A body that is where it is said to be is followed again.
    document.decisions.reject([a.id for a in document.session.artifacts])
    document.go_to(155)
    there = np.median(document.session.positions[155], axis=0) - truth[0]
    assert np.abs(np.array(scene.camera.target) - targets[0] - there).max() < 60


def test_what_a_body_was_has_bones_and_only_what_is_shown_is_tied(carried, qtbot):
    document, scene = carried.document, carried.scene
    document.go_to(155)
    whole_body_proposed(carried, qtbot)
    document.decisions.repair_many(
        [(a.id, document.proposals.get(a, "auto")) for a in document.session.artifacts], ""
    )
    document.show(["left_knee"])
    was = document.session.original.positions[155]
    grey = theme.current().original
    bones = [links for _, links, color, _ in painted(scene, "paint_links") if color == grey]
    assert [len(links) for links in bones] == [len(JOINTS) - 1]
    [(_, other, _)] = painted(scene, "paint_other")
    np.testing.assert_array_equal(other, was[[JOINTS.index("left_knee")]])
    # Where nothing was repaired, the body is drawn once.
    document.go_to(165)
    bones = [links for _, links, color, _ in painted(scene, "paint_links") if color == grey]
    assert sum(map(len, bones)) == 0


def test_both_joints_of_a_mix_up_are_shown_where_they_would_go(opened, qtbot):
    document, scene = opened.document, opened.scene
    swap = next(a for a in document.session.artifacts if a.counterpart)
    document.select(swap.id)
    document.go_to(swap.start + 1)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    rings = painted(scene, "paint_ghost")
    now = document.session.positions[document.frame]
    first, second = (JOINTS.index(m) for m in swap.markers)
    assert len(rings) == 2
    np.testing.assert_allclose(rings[0][0], now[second], atol=1e-6)
    np.testing.assert_allclose(rings[1][0], now[first], atol=1e-6)

    def ways():
        return sum(what[-1] is Qt.PenStyle.DashLine for what in painted(scene, "paint_trails"))

    assert ways() == 2
    # Two seconds away nothing of it is left to be seen.
    document.go_to(document.frame + (240 if document.frame < 100 else -240))
    assert ways() == 0
