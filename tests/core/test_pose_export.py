"""What a repaired skeleton recording is written as: its file, but for what was repaired."""

from __future__ import annotations

import json

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.cli import main
from markermend.poses.faults.finding import SWAPPED
from markermend.poses.faults.guessing import INFERRED
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.simulated.breaking import break_pose
from markermend.poses.take import changed_joints, pose_of, restored

pytestmark = pytest.mark.usefixtures("restored_once")

ASF = "02.asf"


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))


@pytest.fixture
def broken(walk, tmp_path):
    path = tmp_path / "sensor.csv"
    mm.write_pose(break_pose(walk, each=1, seed=4)[0], path)
    return path


def repaired(path):
    take = mm.read(path)
    return mm.repair(take, mm.detect(take))


def touched(take):
    """Joints that were changed, and their parents, which turn with them."""
    changed = changed_joints(take)
    for joint, parent in enumerate(pose_of(take).parents):
        if parent >= 0:
            changed[:, parent] |= changed_joints(take)[:, joint]
    return changed


def test_confidence_tells_what_was_worked_out_from_what_was_measured(broken, tmp_path):
    clean = repaired(broken)
    mm.write(clean, tmp_path / "out.csv")
    found = restored(pose_of(clean)).faults
    confidence = mm.read_pose(tmp_path / "out.csv").confidence
    kinds = {fault.kind for fault in found}
    assert SWAPPED in kinds
    assert len(kinds) > 1
    changed = changed_joints(clean)
    for fault in found:
        rows = np.flatnonzero(changed[:, fault.joint])
        rows = rows[(rows >= fault.start) & (rows < fault.stop)]
        assert rows.size
        assert set(confidence[rows, fault.joint]) == {1.0 if fault.kind == SWAPPED else INFERRED}


def test_what_is_exchanged_in_a_noisy_recording_was_measured(walk, tmp_path):
    places = walk.positions + np.random.default_rng(0).normal(0.0, 8.0, walk.positions.shape)
    sides = [walk.joints.index(name) for name in ("left_wrist", "right_wrist")]
    places[100:130, sides] = places[100:130, sides[::-1]]
    mm.write_pose(walk.with_samples(places, walk.rotations), tmp_path / "noisy.csv")
    take = mm.read(tmp_path / "noisy.csv")
    swap = Artifact("left_wrist", "xyz", 100, 130, Kind.STEP, counterpart="right_wrist")
    clean = mm.repair(take, [swap], method="swap")
    assert changed_joints(clean)[100:130, sides].all()
    mm.write(clean, tmp_path / "out.csv")
    assert (mm.read_pose(tmp_path / "out.csv").confidence[100:130, sides] == 1.0).all()


def test_rows_of_a_table_that_nothing_touched_keep_their_bytes(broken, tmp_path):
    text = broken.read_text().replace("\n", "\r\n")
    head, *rows = text.splitlines(keepends=True)
    # As other programs write it: a comment, a column more, blanks, and digits that say nothing.
    rows = [row.replace("\r\n", ", 7.50\r\n") for row in rows]
    source = tmp_path / "other.csv"
    whole = [head.replace("\r\n", ",battery\r\n"), *rows]
    source.write_bytes(("# sensor 3\r\n" + "".join(whole)).encode())
    clean = repaired(source)
    target = tmp_path / "out.csv"
    mm.write(clean, target)
    before, after = (p.read_bytes().splitlines(keepends=True) for p in (source, target))
    assert len(before) == len(after)
    assert before[:2] == after[:2]
    joints = clean.labels
    differs = np.array([a != b for a, b in zip(before[2:], after[2:], strict=True)])
    differs = differs.reshape(-1, len(joints))
    assert differs.any()
    assert not (differs & ~touched(clean)).any()
    assert all(line.endswith(b", 7.50\r\n") for line in after[2:])


def test_what_was_not_repaired_is_the_file_itself(broken, tmp_path):
    text = broken.read_text().replace("0.000000,", "0.0,")
    broken.write_text(text)
    mm.write(mm.read(broken), tmp_path / "same.csv")
    assert (tmp_path / "same.csv").read_text() == text


def test_a_table_that_is_another_now_is_written_anew(broken, tmp_path):
    clean, pose = repaired(broken), mm.read_pose(broken)
    lines = broken.read_text().splitlines()
    broken.write_text("\n".join([*lines[:-1], lines[-1].replace(",1", ",0.25")]) + "\n")
    mm.write(clean, tmp_path / "out.csv")
    back = mm.read_pose(tmp_path / "out.csv")
    assert back.confidence[-1, -1] == pose.confidence[-1, -1]
    broken.unlink()
    mm.write(clean, tmp_path / "again.csv")
    assert (tmp_path / "again.csv").read_bytes() == (tmp_path / "out.csv").read_bytes()


def test_a_movement_with_segments_left_out_is_written_over_its_file(shared_data, tmp_path):
    (tmp_path / ASF).write_bytes((shared_data / "poses" / ASF).read_bytes())
    whole = (shared_data / "poses" / "02_01.amc").read_bytes()
    lines = whole.replace(b"\r\n", b"\n").splitlines()
    pose, kept = 0, []
    for line in lines:
        pose = int(line) if line.isdigit() else pose
        if not (100 <= pose < 110 and line.startswith((b"lradius ", b"lwrist ", b"lfingers "))):
            kept.append(line)
    source, target = tmp_path / "02_01.amc", tmp_path / "out.amc"
    source.write_bytes(b"\r\n".join(kept) + b"\r\n")
    clean = repaired(source)
    mm.write(clean, target)
    before, after = source.read_bytes().split(b"\r\n"), target.read_bytes().split(b"\r\n")
    at = [block.index(b"100") for block in (before, after)]
    assert before[: at[0]] == after[: at[1]]
    assert before[before.index(b"110") :] == after[after.index(b"110") :]
    names = [
        [line.split()[0] for line in block[start : block.index(stop)]]
        for block, start, stop in ((lines, lines.index(b"100"), b"110"), (after, at[1], b"110"))
    ]
    assert names[0] == names[1]
    assert mm.read(target).present.all()


def test_what_hangs_on_what_is_missing_is_said_not_to_be_in_the_file(shared_data, tmp_path, capsys):
    (tmp_path / ASF).write_bytes((shared_data / "poses" / ASF).read_bytes())
    lines, pose = [], 0
    for line in (shared_data / "poses" / "02_03.amc").read_text().splitlines():
        pose = int(line) if line.isdigit() else pose
        if not (40 <= pose < 60 and line.startswith("lhumerus ")):
            lines.append(line)
    (tmp_path / "02_03.amc").write_text("\n".join(lines) + "\n")
    take = mm.read(tmp_path / "02_03.amc")
    found = mm.detect(take)
    hand = [a for a in found if a.marker == "lhand"]
    export = mm.write(mm.repair(take, hand), tmp_path / "hand.amc")
    assert export.lost == ("lhand",)
    assert export.off_mm < 1.0
    assert not mm.read(tmp_path / "hand.amc").present[:, take.index("lhand")].all()
    assert mm.write(mm.repair(take, hand), tmp_path / "hand.csv").lost == ()
    whole = mm.write(mm.repair(take, found), tmp_path / "whole.amc")
    assert whole.lost == ()
    assert mm.read(tmp_path / "whole.amc").present.all()
    listed, again = tmp_path / "found.json", tmp_path / "again.amc"
    assert main(["detect", str(tmp_path / "02_03.amc"), "--json", str(listed)]) == 0
    document = json.loads(listed.read_text())
    document["artifacts"] = [a for a in document["artifacts"] if a["marker"] == "lhand"]
    listed.write_text(json.dumps(document))
    words = ["clean", tmp_path / "02_03.amc", "--artifacts", listed, "-o", again]
    assert main([str(word) for word in words]) == 0
    assert (
        "Not in the file wherever what they hang on is missing: lhand." in capsys.readouterr().out
    )
