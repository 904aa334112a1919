"""Joints that changed places, in the window: named, drawn, and offered to be exchanged."""

from __future__ import annotations

import numpy as np
import pytest
from pictures import colours, off
from PySide6.QtCore import Qt
from recordings import exchange_angles

from markermend.artifact import Kind, Status
from markermend.poses.nuitrack import JOINTS
from markermend.review.fitting import exchangers
from markermend_app.actions.palette import Palette
from markermend_app.dialogs.alike import AlikeDialog
from markermend_app.panels.inspector.artifact import ArtifactPage
from markermend_app.panels.markers.naming import paired_name
from markermend_app.panels.queue.model import MARKER, REPAIR
from markermend_app.scope import Scope
from markermend_app.style import theme

WAIT = 60_000


def test_what_is_compared_of_a_mix_up_is_called_as_it_is_elsewhere(opened, qtbot):
    document, comparison = opened.document, opened.comparison
    document.select(next(a.id for a in document.session.artifacts if a.counterpart))
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    said = document.proposal.error_mm
    comparison.start(["C"])
    qtbot.waitUntil(lambda: comparison.candidates is not None, timeout=WAIT)
    assert comparison.candidates[0].error_mm == document.proposal.error_mm == said
    place = [c.method for c in comparison.candidates].index("swap")
    qtbot.waitUntil(lambda: opened.candidates.rows[place][1].text() == "Swap joints", timeout=WAIT)
    comparison.stop()


def test_what_ties_swapped_joints_is_no_bone(opened, qtbot):
    """Lines from before to after a repair have a colour that no segment has."""
    document, scene = opened.document, opened.scene
    swap = next(a for a in document.session.artifacts if a.counterpart)
    document.select(swap.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    document.decisions.repair_current()
    repaired = document.session.with_status
    qtbot.waitUntil(lambda: bool(repaired(Status.REPAIRED)), timeout=WAIT)
    document.select(None)
    document.show(swap.markers)
    document.go_to(swap.start + 1)
    # Thin lines have their colour unmixed in few places of a small picture only.
    dock = opened.docks["scene"]
    dock.setFloating(True)
    dock.resize(900, 900)
    tie = theme.current().warning

    def tied():
        return np.count_nonzero(off(colours(scene), tie) < 60)

    with_ties = tied()
    scene.looks.ghost = False
    assert with_ties > tied() + 5


def test_a_mix_up_is_told_of_both_of_its_joints(opened, qtbot):
    document, queue = opened.document, opened.queue
    swap = next(a for a in document.session.artifacts if a.counterpart)
    part = swap.marker.removeprefix("left_")
    assert queue.model.text(swap, MARKER).split(" +")[0] == f"L/R {part}"
    both = f"{swap.marker} ↔ {swap.counterpart}"
    row = queue.model.index(queue.model.row_of(swap.id), MARKER)
    assert row.data(Qt.ItemDataRole.ToolTipRole).startswith(both)
    model = opened.tree._model
    qtbot.waitUntil(lambda: bool(model.node(model.index_of(swap.marker)).own))
    assert model.node(model.index_of(swap.counterpart)).own[Kind.STEP] == 1
    overview = opened.overview
    at = [overview._rows.row_of[JOINTS.index(m)] for m in swap.markers]
    lying = set(map(tuple, overview._lying.intervals.tolist()))
    assert {(swap.start, swap.stop, r) for r in at} <= lying
    document.select(swap.id)
    document.go_to(swap.start)
    assert {JOINTS.index(m) for m in swap.markers} <= set(opened.scene.seen.rings())
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    document.decisions.repair_current()
    repaired = f"Repair step on {both}"
    qtbot.waitUntil(lambda: document.session.history[-1].startswith(repaired), timeout=WAIT)
    document.select(swap.id)
    assert opened.inspector.findChild(ArtifactPage).title.text().split(" +")[0] == both


def test_a_swap_of_joints_is_called_so_wherever_a_repair_is_told(opened, qtbot):
    document = opened.document
    swap = next(a for a in document.session.artifacts if a.counterpart)
    document.select(swap.id)
    document.choose_method("swap")
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    everywhere = Scope("", None)
    alike = AlikeDialog(document, swap, [everywhere], True, opened)
    alike.repairs[swap.id] = document.proposal
    assert alike._outcome(swap).startswith("Swap joints")
    document.decisions.repair_current()
    qtbot.waitUntil(lambda: document.session.notes.get(swap.id) is not None, timeout=WAIT)
    assert document.session.notes[swap.id].method == "swap"
    document.select(swap.id)
    assert opened.inspector.findChild(ArtifactPage).status.text() == "Repaired: Swap joints"
    row = opened.queue.model.row_of(swap.id)
    assert opened.queue.model.index(row, REPAIR).data() == "Swap joints"


@pytest.mark.parametrize(
    ("names", "told"),
    [
        (("left_ankle", "right_ankle"), "L/R ankle"),
        (("rtibia", "ltibia"), "L/R tibia"),
        (("LeftArm", "RightArm"), "L/R Arm"),
        (("KneeLeft", "KneeRight"), "L/R Knee"),
        (("shin.L", "shin.R"), "L/R shin"),
        (("knee_r", "knee_l"), "L/R knee"),
        (("Bip01 L Thigh", "Bip01 R Thigh"), "L/R Bip01 Thigh"),
        (("mixamorig:LeftLeg", "mixamorig:RightLeg"), "L/R mixamorig:Leg"),
        (("left_ankle", "right_knee"), "left_ankle ↔ right_knee"),
        (("left_hip", "left_hip2"), "left_hip ↔ left_hip2"),
        (("lhand",), "lhand"),
    ],
)
def test_joints_that_change_places_have_a_short_name(names, told):
    assert paired_name(names) == told


def test_joints_whose_angles_were_exchanged_are_not_offered_to_swap(
    window, shared_data, tmp_path, qtbot
):
    folder = shared_data / "poses"
    (tmp_path / "02.asf").write_bytes((folder / "02.asf").read_bytes())
    names = ("femur", "tibia", "foot", "toes")
    path = exchange_angles(folder / "02_01.amc", tmp_path / "02_01.amc", names, range(100, 140))
    window.commands.open_path(path)
    document = window.document
    qtbot.waitUntil(lambda: document.current is not None, timeout=3 * WAIT)
    assert document.current.counterpart
    swap = window.inspector.findChild(ArtifactPage).methods.buttons["swap"]
    qtbot.waitUntil(lambda: not swap.isEnabled(), timeout=WAIT)
    assert "Angles were exchanged here" in swap.toolTip()
    assert not window.actions_by_name["method_6"].isEnabled()
    qtbot.keyClick(window, Qt.Key.Key_6)
    assert document.method == "auto"
    assert not swap.isChecked()


def test_the_joint_of_the_other_side_is_offered_first_to_swap_with(opened, qtbot):
    document = opened.document
    document.show(["left_wrist"])
    document.go_to(60)
    qtbot.keyClick(opened, Qt.Key.Key_V)
    document.go_to(70)
    qtbot.keyClick(opened, Qt.Key.Key_V)
    qtbot.keyClick(opened, Qt.Key.Key_W)
    (asked,) = opened.findChildren(Palette)
    assert asked.list.item(0).text() == "right_wrist"
    # Others would jump less: what is listed next is in order.
    exchanged = exchangers(document.session.take, "left_wrist", 60, 71)
    jumps = [mm for _, mm in exchanged[1:]]
    assert jumps == sorted(jumps)
    assert jumps[0] < exchanged[0][1]
    asked.close()
