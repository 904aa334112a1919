"""A skeleton recording under review: read as a take, searched, repaired, written back."""

from __future__ import annotations

import numpy as np
import pytest
from recordings import exchange_angles

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.cli import main
from markermend.errors import DataError, ExportError
from markermend.files.restructure import crop, drop
from markermend.poses.faults.guessing import INFERRED
from markermend.poses.nuitrack import JOINTS, to_nuitrack
from markermend.poses.simulated.breaking import break_pose
from markermend.poses.take import at_hand, changed_joints, pose_of
from markermend.repairs import advise, evidence_for, propose

pytestmark = pytest.mark.usefixtures("restored_once")

HIDDEN = slice(200, 230)


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))


@pytest.fixture
def broken(walk, tmp_path):
    """A file of joints of which some are wrong and one is not seen for a while."""
    pose, _ = break_pose(walk, each=1, seed=4)
    confidence = np.array(pose.confidence)
    confidence[HIDDEN, JOINTS.index("head")] = 0.0
    path = tmp_path / "sensor.csv"
    mm.write_pose(pose.with_samples(pose.positions, pose.rotations, confidence), path)
    return path


def apart(a, b):
    return np.sqrt(np.sum((a.positions - b.positions) ** 2, axis=2))


def test_joints_are_markers_and_bones_the_mesh(broken):
    take = mm.read(broken)
    assert take.skeleton
    assert take.labels == JOINTS
    mesh = mm.infer_mesh(take)
    tree = {g.name: g.parent is not None and mesh.groups[g.parent].name for g in mesh.groups}
    assert tree["left_elbow"] == "left_shoulder"
    assert tree["waist"] is False
    assert len(mesh.links) == len(JOINTS) - 1


def test_what_is_wrong_is_found_and_put_right(walk, broken, tmp_path):
    take = mm.read(broken)
    found = mm.detect(take)
    gap = next(a for a in found if a.marker == "head")
    assert (gap.kind, gap.start, gap.stop) == (Kind.GAP, HIDDEN.start, HIDDEN.stop)
    swap = next(a for a in found if a.counterpart)
    assert swap.marker.startswith("left_")
    clean = mm.repair(take, found)
    target = tmp_path / "clean.csv"
    export = mm.write(clean, target)
    back, changed = mm.read_pose(target), changed_joints(clean)
    assert export.samples == changed.sum()
    assert apart(back, walk)[changed].mean() < 0.1 * np.nanmean(apart(pose_of(take), walk)[changed])
    assert (back.confidence[HIDDEN, JOINTS.index("head")] == INFERRED).all()
    before = mm.read_pose(broken)
    turned = changed.copy()
    for joint, parent in enumerate(before.parents):
        turned[:, parent] |= changed[:, joint] & (parent >= 0)
    np.testing.assert_array_equal(back.positions[~changed], before.positions[~changed])
    np.testing.assert_allclose(back.rotations[~turned], before.rotations[~turned], atol=2e-6)


def test_an_interval_marked_by_hand_is_worked_out_anew(walk, tmp_path):
    path = tmp_path / "walk.csv"
    mm.write_pose(walk, path)
    take = mm.read(path)
    assert mm.detect(take) == ()
    marked = Artifact("left_elbow", "xyz", 100, 120, Kind.STEP)
    repair = propose(take, marked)
    assert repair.method == "skeleton"
    off = np.sqrt(np.sum((repair.patches[0].values - take.positions[100:120, 6]) ** 2, axis=1))
    assert 0 < off.mean() < 3 * repair.error_mm
    assert repair.band_mm.shape == (20,)


def test_what_restoring_told_is_at_hand_and_an_interval_marked_by_hand_is_not(broken):
    take = mm.read(broken)
    pose = pose_of(take)
    assert not at_hand(pose).any()
    found = mm.detect(take)
    known = at_hand(pose)
    assert known.shape == (take.frames, take.markers)
    for a in found:
        assert known[a.start : a.stop, [take.index(m) for m in a.markers]].all()
    assert not known.all()


def test_an_amc_is_the_same_where_nothing_was_repaired(shared_data, tmp_path):
    source = shared_data / "poses" / "02_01.amc"
    take = mm.read(source)
    mm.write(take, tmp_path / "same.amc")
    marked = Artifact("rthumb", "xyz", 100, 120, Kind.STEP)
    clean = mm.repair(take, [marked])
    mm.write(clean, tmp_path / "clean.amc")
    asf = shared_data / "poses" / "02.asf"
    before, same, after = (
        mm.read_pose(path, skeleton=asf).source.channels
        for path in (source, tmp_path / "same.amc", tmp_path / "clean.amc")
    )
    rows = np.r_[0:100, 120 : take.frames]
    for name, values in before.items():
        np.testing.assert_array_equal(same[name], values)
        np.testing.assert_array_equal(after[name][rows], values[rows])
    assert (after["rthumb"][100:120] != before["rthumb"][100:120]).any()


def test_every_shared_recording_opens(shared_data):
    for path in sorted((shared_data / "poses").iterdir()):
        if path.suffix == ".asf" or path.stem in ("01_08", "02_03", "03_01"):
            take = mm.read(path)
            assert take.skeleton
            assert take.markers == 31


def test_what_cannot_be_said_is_one_sentence(broken, tmp_path):
    take = mm.read(broken)
    with pytest.raises(ExportError, match="needs a skeleton"):
        mm.write(take, tmp_path / "out.amc")
    with pytest.raises(ExportError, match=r"\.amc"):
        mm.write(take, tmp_path / "out.txt")
    (tmp_path / "cut.csv").write_text("frame,joint,x,y,z\n")
    with pytest.raises(mm.MarkermendError, match="cut short"):
        mm.read(tmp_path / "cut.csv")
    (tmp_path / "lone.amc").write_text("1\nroot 0 0 0 0 0 0\n")
    with pytest.raises(mm.MarkermendError, match="skeleton"):
        mm.read(tmp_path / "lone.amc")


def test_the_command_line_takes_joints_for_markers(broken, tmp_path, capsys):
    assert main(["info", str(broken)]) == 0
    assert "left_elbow" in capsys.readouterr().out
    assert main(["clean", str(broken), "-o", str(tmp_path / "out.csv")]) == 0
    assert mm.read_pose(tmp_path / "out.csv").joints == JOINTS


def test_the_command_line_writes_what_skeletons_are_written_as(
    shared_data, broken, tmp_path, capsys
):
    source = str(shared_data / "poses" / "02_01.amc")
    assert main(["convert", source, "-o", str(tmp_path / "out.bvh")]) == 0
    assert mm.read(tmp_path / "out.bvh").skeleton
    assert main(["fill", source, "-o", str(tmp_path / "out.amc")]) == 0
    assert main(["convert", str(broken), "-o", str(tmp_path / "markers.c3d")]) == 0
    assert not mm.read(tmp_path / "markers.c3d").skeleton
    capsys.readouterr()
    assert main(["convert", str(tmp_path / "markers.c3d"), "-o", str(tmp_path / "no.bvh")]) == 1
    assert "should end in" in capsys.readouterr().err


@pytest.fixture
def crossed(shared_data, tmp_path):
    """A file of angles in which those of the legs are exchanged for a while."""
    folder = shared_data / "poses"
    (tmp_path / "02.asf").write_bytes((folder / "02.asf").read_bytes())
    leg = ("femur", "tibia", "foot", "toes")
    return exchange_angles(folder / "02_01.amc", tmp_path / "02_01.amc", leg, range(100, 140))


def test_joints_whose_angles_were_exchanged_are_not_swapped(crossed, shared_data, capsys):
    take, truth = mm.read(crossed), mm.read_pose(shared_data / "poses" / "02_01.amc")
    found = mm.detect(take)
    assert {a.counterpart for a in found} == {"rfemur", "rtibia", "rfoot", "rtoes"}
    for artifact in found:
        refused = propose(take, artifact, found, method="swap")
        assert refused.patches == ()
        assert refused.reason.startswith("Angles were exchanged here, not places;")
    ranked = advise(evidence_for(take, found), found[0], methods=("skeleton",))
    assert [(a.method, bool(a.repair.patches)) for a in ranked] == [
        ("skeleton", True),
        ("swap", False),
    ]
    clean = mm.repair(take, found)
    np.testing.assert_allclose(clean.positions, truth.positions, atol=0.01)
    target = crossed.parent / "o.amc"
    main(["clean", str(crossed), "--method", "swap", "-o", str(target)])
    assert "Angles were exchanged here" in "".join(capsys.readouterr())


def test_a_part_of_a_recording_is_one_itself(broken, tmp_path):
    take = mm.read(broken)
    part = crop(take, 150, 300)
    assert mm.detect(part)
    assert not changed_joints(part).any()
    mm.write(part, tmp_path / "part.csv")
    mm.write(take, tmp_path / "same.csv", frames=(150, 300))
    assert (tmp_path / "part.csv").read_bytes() == (tmp_path / "same.csv").read_bytes()
    with pytest.raises(DataError, match="other frames or joints than the skeleton recording"):
        mm.write(drop(take, ["head"]), tmp_path / "headless.csv")
