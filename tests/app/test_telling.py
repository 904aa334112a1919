"""The engine's sentences in the language of the app: every form is known and keeps its values."""

from __future__ import annotations

import ast
import re
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QTranslator

import markermend as mm
from markermend.artifact import Artifact, Kind, Status
from markermend.detectors import detect
from markermend.errors import DataError
from markermend.mesh.names import _FROM_THE_TOP
from markermend.poses.from_markers import joint_centres
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.simulated.noise import Noise, corrupt_pose
from markermend.repairs import propose
from markermend.repairs.look_again import in_words
from markermend.review import hand
from markermend.review.restoring import OVERWRITTEN, SMOOTHED
from markermend.review.session import Session
from markermend.simulation import simulate_clean
from markermend.take import Take
from markermend_app import file_words
from markermend_app.telling import _JOINTS, _PARTS, told, told_group


class Brackets(QTranslator):
    """Puts every translated text into brackets."""

    def translate(self, context, text, disambiguation=None, n=-1):
        return f"⟦{text}⟧"

    def isEmpty(self):
        return False


@pytest.fixture
def brackets(qapp):
    made = Brackets()
    QCoreApplication.installTranslator(made)
    yield
    QCoreApplication.removeTranslator(made)


def steps(take, truth):
    """The history of a review in which everything was done once."""
    session = Session(take)
    session.add_detected(truth, "sudden")
    gap, peak, noise, step = session.artifacts
    session.set_status([gap.id], Status.ACCEPTED)
    session.set_status([gap.id, peak.id], Status.REJECTED)
    session.set_status([gap.id], Status.PENDING)
    session.annotate(noise.id, "odd")
    session.change(noise.id, kind=Kind.STEP)
    session.change(noise.id, stop=noise.stop + 2)
    hand.nudge(session, noise.id, start=1)
    hand.nudge(session, noise.id, stop=1)
    hand.split(session, step.id, 300)
    hand.cut(session, "T10", 10, 20)
    hand.rename(session, {"STRN": "STERNUM"})
    session.remove([peak.id])
    return session.history


def test_every_step_is_told_in_the_language_of_the_app(damaged, brackets):
    for label in steps(*damaged):
        assert told(label).startswith("⟦"), label


def test_reasons_are_told_in_the_language_of_the_app(damaged, brackets):
    found = detect(damaged[0])
    assert len({a.kind for a in found}) >= 3
    for artifact in found:
        assert "⟦" in told(artifact.why), artifact.why


def test_values_keep_their_places():
    assert told("Accept gap on LFHD") == "Accept gap on LFHD"
    assert told("Call slow on C7 noise") == "Call slow drift on C7 noise"
    why = "sticks out by 9 mm for 1 frame (9 ms), its neighbours by 2 mm; 8 times its usual scatter"
    assert told(why) == why
    assert told("something nobody wrote") == "something nobody wrote"


@pytest.mark.parametrize(
    "name", ["Left shank and foot", "Trunk 2", "P0: Right thigh", "LFHD +3", "Head", "Arm thing"]
)
def test_groups_keep_their_names_in_english(name):
    assert told_group(name) == name


def test_groups_are_named_in_the_language_of_the_app(brackets):
    assert told_group("P0: Left shank and foot 2") == "P0: ⟦Left ⟦⟦shank⟧ and ⟦foot⟧⟧⟧ 2"
    assert told_group("LFHD +3") == "LFHD +3"
    assert told_group("head") == "head"
    assert set(_FROM_THE_TOP) == set(_PARTS), "every part that a group can be named after"


def test_a_search_is_told_in_plain_words():
    assert told("Detect (sudden)") == "Find gaps, peaks, noise and steps"


@pytest.mark.parametrize("kind", list(Kind))
def test_reasons_of_the_published_detector_are_told_too(kind, brackets):
    from markermend.detectors.finding import _explain

    assert told(_explain(kind, 12.0, 5, 100.0)).startswith("⟦")


def test_every_course_of_a_jump_is_told(brackets):
    from markermend.detectors.joint.sudden import Course, Sudden
    from markermend.detectors.joint.verdict import _explain

    for kind, course, beside, alone in product(
        (Kind.STEP, Kind.PEAK, Kind.NOISE), Course, (0.0, 3.0), (False, True)
    ):
        jump = Sudden(0, 10, 30, kind, 12.0, 9.0, beside, course)
        why = _explain([jump], 12.0, 20, 100.0, alone=alone)
        assert told(why).startswith("⟦"), why
        assert "neighbours" not in why or not alone or course is Course.FALLEN


def test_why_there_is_no_repair_is_told(damaged, brackets):
    take, truth = damaged
    gap = truth[0]
    positions = take.positions.copy()
    positions[60:90, 1:6] = np.nan
    few = propose(Take(positions, take.labels, take.rate), gap, method="local_regression")
    curve = propose(take, replace(gap, start=2), method="kalman")
    refusals = (few, curve, *(propose(take, gap, method=m) for m in ("swap", "savgol")))
    for refused in refusals:
        assert not refused.patches
        assert told(refused.reason).startswith("⟦"), refused.reason
    both = f"Worked out from other repairs; look at it closely. Without them: {few.reason}"
    assert told(both).count("⟦") == 2
    assert told(f"Cubic spline is not used: {few.reason}").startswith("⟦⟦Cubic spline⟧ is not")
    assert told("Kalman may be about 7 mm off.") == "⟦⟦Kalman⟧ may be about 7 mm off.⟧"
    assert told(OVERWRITTEN).startswith("⟦")
    assert told(f"{few.reason} {SMOOTHED}").startswith("⟦⟦")
    left = in_words((replace(truth[1], amplitude_mm=7.3), truth[2]))
    assert told(left) == ("⟦The detector still finds damage there: a ⟦peak⟧ of 7.3 mm and 1 more.⟧")


def test_why_a_file_cannot_be_opened_is_told(brackets, tmp_path):
    (tmp_path / "empty.c3d").touch()
    (tmp_path / "text.c3d").write_text("hello world" * 100)
    (tmp_path / "dir.c3d").mkdir()
    for name in ("empty.c3d", "text.c3d", "dir.c3d", "none.c3d"):
        with pytest.raises(mm.MarkermendError) as caught:
            mm.read(tmp_path / name)
        said = told(str(caught.value))
        assert said.startswith("⟦"), said
        assert name in said


def test_why_joints_cannot_be_read_or_written_is_told(brackets, tmp_path):
    root = ":root\norder RX RY RZ\naxis XYZ\nposition 0 0 0\norientation 0 0 0\n"
    bone = "begin\nid 1\nname a\ndirection 0 1 0\nlength 4\naxis 0 0 0 XYZ\ndof rx\nend\n"
    tree = ":hierarchy\nbegin\nroot a\nend\n"
    (tmp_path / "a.asf").write_text(f"{root}:bonedata\n{bone}{tree}")
    text = "1\nroot 0 0 0\na 1\n2\nroot 0 0 0\n3\nroot 0 0 0\na 1\n"
    (tmp_path / "a.amc").write_text(text)
    take = mm.read(tmp_path / "a.amc")
    small = mm.read_pose(tmp_path / "a.amc")
    small = small.with_samples(np.zeros((3, 2, 3)), np.full((3, 2, 4), 0.5), np.ones((3, 2)))
    (tmp_path / "b.amc").write_text(text.replace("2\n", "9" * 99 + "\n", 1))
    attempts = (
        lambda: mm.write(take, tmp_path / "b.amc", frames=(1, 2)),
        lambda: mm.write_pose(replace(small, joints=("a b", "a_b")), tmp_path / "b.bvh"),
        lambda: mm.read_pose(tmp_path / "b.amc", skeleton=tmp_path / "a.asf"),
    )
    for attempt in attempts:
        with pytest.raises(mm.MarkermendError) as caught:
            attempt()
        assert told(str(caught.value)).startswith("⟦"), caught.value


ASF_ROOT = ":root\norder RX RY RZ\naxis XYZ\nposition 0 0 0\norientation 0 0 0\n"
ASF_BONE = "begin\nid 1\nname a\ndirection 0 1 0\nlength 4\naxis 0 0 0 XYZ\ndof rx\nend\n"
ASF = f"{ASF_ROOT}:bonedata\n{ASF_BONE}:hierarchy\nbegin\nroot a\nend\n"
BVH = """HIERARCHY
ROOT a
{
OFFSET 0 0 0
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT b
{
OFFSET 0 30 0
CHANNELS 3 Zrotation Xrotation Yrotation
End Site
{
OFFSET 0 9 0
}
}
}
MOTION
Frames: 1
Frame Time: 0.01
0 0 0 0 0 0
"""
ROWS = "frame,joint,x,y,z,qx,qy,qz,qw,confidence,parent\n"
ROW = "1,a,0,0,0,0,0,0,1,1,\n"


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.asf", ASF.replace(":bonedata", ":bones")),
        ("a.asf", ASF.replace(ASF_BONE, ASF_BONE * 2)),
        ("a.asf", ASF.replace("direction 0 1 0", "direction 0 0 0")),
        ("a.asf", ASF.replace("direction 0 1 0", "direction 0 one 0")),
        ("a.asf", ASF.replace("length 4", "length four")),
        ("a.asf", ASF.replace("root a", "root b")),
        ("a.asf", ASF.replace("root a", "")),
        ("a.asf", ASF[: ASF.index("dof")]),
        ("a.asf", f":units\nlength 0\n{ASF}"),
        ("a.asf", f":units\nlength 1e99\n{ASF}"),
        ("a.amc", ""),
        ("a.amc", "1\nb 1\n"),
        ("a.amc", "1\nroot 0 0 0\na x\n2\nroot 0 0 0\n"),
        ("a.amc", "1\nroot 0 0 0\na 1\na 1\n"),
        ("a.amc", "1\nroot 0 0 0\n2 3 4\na 1\n"),
        ("a.csv", ROWS),
        ("a.csv", ROWS.replace("qw,", "") + ROW),
        ("a.csv", ROWS + ROW.replace("a", "")),
        ("a.csv", ROWS + ROW.replace("1,\n", "1,b\n")),
        ("a.csv", ROWS.replace(",parent", "") + ROW.replace("1,\n", "1\n")),
        ("a.csv", ROWS + ROW + "9999999" + ROW),
        ("a.bvh", "HIERARCHY\n"),
        ("a.bvh", BVH.replace("HIERARCHY", "")),
        ("a.bvh", BVH.replace("JOINT b", "JOINT a")),
        ("a.bvh", BVH + "0 0 0 0 0 0\n"),
        ("a.bvh", BVH.replace("0 0 0 0 0 0", "0 0 0 0 0 nan")),
        ("a.txt", "nothing"),
    ],
)
def test_what_is_wrong_with_a_file_of_joints_is_told(brackets, tmp_path, name, text):
    (tmp_path / "a.asf").write_text(ASF)
    (tmp_path / name).write_text(text)
    with pytest.raises(mm.MarkermendError) as caught:
        mm.read_pose(tmp_path / name)
    assert told(str(caught.value)).startswith("⟦"), caught.value
    assert name in told(str(caught.value))


def test_what_is_odd_about_files_of_joints_is_told(brackets, tmp_path):
    (tmp_path / "a.asf").write_text(ASF)
    (tmp_path / "a.amc").write_text("1\nroot 0 0 0\nb 1\n")
    (tmp_path / "a.bvh").write_text(BVH)
    odd = [*mm.read_pose(tmp_path / "a.amc").warnings, *mm.read_pose(tmp_path / "a.bvh").warnings]
    assert {"left", "without", "unit"} <= set(" ".join(odd).replace(";", "").split())
    for sentence in odd:
        assert told(sentence).startswith("⟦"), sentence
    assert "; ⟦centimetres⟧ were" in told(odd[-1])


def test_why_joints_cannot_be_exported_is_told(brackets, tmp_path):
    (tmp_path / "a.bvh").write_text(BVH)
    pose = mm.read_pose(tmp_path / "a.bvh")
    lost = np.array(pose.positions), np.array(pose.rotations), np.array(pose.confidence)
    lost[0][:, 1], lost[1][:, 1], lost[2][:, 1] = np.nan, np.nan, 0.0
    placed = np.array(pose.positions), np.full(pose.rotations.shape, np.nan), lost[2]
    attempts = {
        "b.amc": pose,
        "b.txt": pose,
        "1.bvh": pose.with_samples(*lost),
        "2.bvh": pose.with_samples(placed[0], placed[1], np.array(pose.confidence)),
        "3.bvh": replace(pose, parents=(-1, -1, 1)),
    }
    for name, what in attempts.items():
        with pytest.raises(mm.MarkermendError) as caught:
            mm.write_pose(what, tmp_path / name)
        assert told(str(caught.value)).startswith("⟦"), caught.value


def test_what_cannot_be_done_by_hand_is_told(damaged, brackets):
    session = Session(damaged[0])
    session.add_detected(damaged[1], "sudden")
    gap, peak, *_ = session.artifacts
    attempts = (
        lambda: hand.cut(session, "CLAV", 65, 70),
        lambda: hand.move(session, "CLAV", "T10", 65, 70),
        lambda: hand.move(session, "STRN", "T10", 65, 70),
        lambda: hand.move(session, "T10", "T10", 65, 70),
        lambda: hand.split(session, gap.id, gap.start),
        lambda: hand.join(session, [gap.id, peak.id]),
    )
    for attempt in attempts:
        with pytest.raises(mm.MarkermendError) as caught:
            attempt()
        assert told(str(caught.value)).startswith("⟦"), caught.value


def test_why_joints_are_not_restored_is_told(damaged, brackets, tmp_path):
    (tmp_path / "a.bvh").write_text(BVH)
    longer = BVH.replace("Frames: 1", "Frames: 5") + "0 0 0 0 0 0\n" * 4
    (tmp_path / "b.bvh").write_text(longer)
    take, long = mm.read(tmp_path / "a.bvh"), mm.read(tmp_path / "b.bvh")
    joint = Artifact("b", "xyz", 0, 1, Kind.PEAK)
    refused = (
        propose(damaged[0], damaged[1][0], method="skeleton"),
        propose(take, joint, method="skeleton"),
        propose(long, replace(joint, stop=5), method="skeleton"),
        propose(long, replace(joint, marker=long.labels[2], stop=5), method="skeleton"),
    )
    for repair in refused:
        assert not repair.patches
        assert told(repair.reason).startswith("⟦"), repair.reason
    assert "never seen elsewhere" in refused[-1].reason


def test_what_is_odd_about_a_file_keeps_its_values(brackets, tmp_path):
    path = tmp_path / "odd.csv"
    path.write_text("time,A_X,A_Y,A_Z\n0.00,1,2,3\n0.01,0,0,0\n0.02,x,2,3\n")
    sentences = mm.read(path).warnings
    assert sentences
    for sentence in sentences:
        said = told(sentence)
        assert said.startswith("⟦"), sentence
        assert re.findall(r"\d+", said) == re.findall(r"\d+", sentence)


def test_why_joints_are_left_out_is_told(damaged, brackets):
    take = simulate_clean(duration_s=12.0, rate=50.0, seed=0)
    joints = joint_centres(take).joints
    reasons = {joint.left_out for joint in joints if joint.left_out}
    told_by = {joint.along for joint in joints if joint.along} | {"movement"}
    assert len(reasons) > 1
    assert len(told_by) > 1
    for said in reasons | told_by:
        assert told(said).startswith("⟦"), said
    few = Take(take.positions[:, :1], take.labels[:1], take.rate)
    with pytest.raises(DataError) as alone:
        joint_centres(few)
    assert told(str(alone.value)).startswith("⟦No joint centre")
    # A subject's colon is no part of the sentence, and the reason is told, too.
    why = "P1:Trunk/Head: the markers of Head lie along one line"
    said = told(f"{alone.value} {why}.")
    assert "P1:Trunk/Head: ⟦the markers of Head lie along one line⟧." in said


def test_the_engine_tells_in_the_forms_that_are_translated():
    told_there = set()
    for path in Path(mm.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            parts = node.values if isinstance(node, ast.JoinedStr) else [node]
            words = [getattr(part, "value", None) for part in parts]
            if sum(len(w) for w in words if isinstance(w, str)) > 20:
                told_there.add("".join(re.escape(w) if isinstance(w, str) else ".*" for w in words))
    # Compiled once: there are more of them than re remembers.
    written = [re.compile(words) for words in told_there]
    sentences = (form for form in _JOINTS if len(form) > 20)
    for form in (*file_words.ODDITIES, *sentences):
        assert any(words.fullmatch(form) for words in written), form


def test_what_the_engine_is_doing_is_told(damaged, brackets, tmp_path, shared_data):
    doing: set[str] = set()

    def progress(share, what):
        doing.add(what)

    take, truth = damaged
    detect(take, progress=progress)
    mm.repair(take, truth, progress=progress)
    mm.write(take, tmp_path / "take.c3d", progress=progress)
    mm.read(tmp_path / "take.c3d", progress=progress)
    pose = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_03.amc"))
    noisy = corrupt_pose(pose, Noise(burst=30), seed=1)
    mm.denoise(noisy, progress=progress)
    assert {"Reading frames", "Writing frames", "jumps, peaks and heavy noise"} <= doing
    assert any(what.startswith("Repairing ") for what in doing)
    for what in doing - {"done"}:
        assert told(what).startswith("⟦"), what
