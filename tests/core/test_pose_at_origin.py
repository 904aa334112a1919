"""Joints at exactly 0, 0, 0: some were not seen, and some are there."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.poses import Pose
from markermend.poses.faults.finding import VANISHED
from markermend.poses.restore import restore

FRAMES = 60
# A hip joint that only gives the leg an axis more, as in BVH files of the CMU database.
BVH = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT LHipJoint
  {
    OFFSET 0 0 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    JOINT LeftLeg
    {
      OFFSET 0 -42 0
      CHANNELS 3 Zrotation Xrotation Yrotation
      End Site
      {
        OFFSET 0 -40 0
      }
    }
  }
}
MOTION
"""


def in_place(path):
    """A body that moves its leg, and its root not at all."""
    rows = [f"0 0 0 0 0 0 {n / 3} {n} 0 0 {n / 2} 0" for n in range(FRAMES)]
    text = BVH + f"Frames: {FRAMES}\nFrame Time: 0.033333\n" + "\n".join(rows)
    path.write_text(text + "\n")
    return mm.read_pose(path)


def test_a_body_in_place_keeps_its_joints_at_the_origin(tmp_path):
    pose = in_place(tmp_path / "k.bvh")
    assert (pose.positions[:, :2] == 0).all()
    mm.write_pose(pose, tmp_path / "k.csv")
    assert "Hips,,0.000,0.000,0.000" in (tmp_path / "k.csv").read_text()
    back = mm.read_pose(tmp_path / "k.csv")
    assert back.seen.all()
    np.testing.assert_allclose(back.positions, pose.positions, atol=1e-3)
    np.testing.assert_allclose(back.rotations[:, 1], pose.rotations[:, 1], atol=1e-6)
    for recording in (pose, back):
        restored = restore(recording, prior=None)
        assert VANISHED not in {fault.kind for fault in restored.faults}
        assert restored.pose.seen.all()
        assert not restored.filled.any()


def arm(places, sure):
    """A wrist that is ``sure`` at ``places``, on an elbow and a shoulder."""
    positions = np.zeros((FRAMES, 3, 3))
    positions[:, 0] = [0.0, 300.0, 0.0]
    positions[:, 1] = [250.0, 200.0, 0.0]
    positions[:, 2] = places
    confidence = np.stack([np.ones(FRAMES), np.ones(FRAMES), sure], axis=1)
    turns = np.tile([0.6, 0.0, 0.0, 0.8], (FRAMES, 3, 1))
    return Pose(positions, turns, ("shoulder", "elbow", "wrist"), (-1, 0, 1), 30.0, confidence)


def test_what_passes_through_the_origin_is_seen_there(tmp_path):
    places = np.stack([np.arange(FRAMES) - 20.0, np.zeros(FRAMES), np.zeros(FRAMES)], axis=1)
    places[21] = [0.0002, -0.0004, 0.0]
    sure = np.where(np.arange(FRAMES) >= 50, 0.0, 1.0)
    pose = arm(places, sure)
    mm.write_pose(pose, tmp_path / "k.csv")
    back = mm.read_pose(tmp_path / "k.csv")
    np.testing.assert_array_equal(back.confidence, pose.confidence)
    np.testing.assert_allclose(back.positions, pose.positions, atol=6e-4)
    assert np.abs(back.positions[20, 2]).max() < 2e-6
    rows = [line for line in (tmp_path / "k.csv").read_text().splitlines() if "wrist" in line]
    assert rows[55].split(",")[4:] == [
        "0.000",
        "0.000",
        "0.000",
        "0.000000",
        "0.000000",
        "0.000000",
        "1.000000",
        "0",
    ]


@pytest.mark.parametrize("column", [True, False])
def test_zeros_of_a_program_that_lost_a_joint_are_gaps(tmp_path, column):
    places = np.tile([400.0, 150.0, 30.0], (FRAMES, 1)) + np.arange(FRAMES)[:, None]
    mm.write_pose(arm(places, np.ones(FRAMES)), tmp_path / "k.csv")
    lines = (tmp_path / "k.csv").read_text().splitlines()
    # A wrist, and then with it the elbow.
    for row in [3 * n + 3 for n in range(10, 30)] + [3 * n + 2 for n in range(20, 30)]:
        cells = lines[row].split(",")
        lines[row] = ",".join([*cells[:4], *["0"] * 3, *["0"] * 3, "1", "1"])
    if not column:
        lines = [line.rpartition(",")[0] for line in lines]
    (tmp_path / "lost.csv").write_text("\n".join(lines) + "\n")
    pose = mm.read_pose(tmp_path / "lost.csv")
    assert np.flatnonzero(~pose.seen[:, 2]).tolist() == list(range(10, 30))
    assert np.flatnonzero(~pose.seen[:, 1]).tolist() == list(range(20, 30))
    # So it is where they stand at the place of a root that is there itself.
    rows = [line.replace("shoulder,,0.000,300.000", "shoulder,,0,0") for line in lines]
    (tmp_path / "centred.csv").write_text("\n".join(rows) + "\n")
    assert (mm.read_pose(tmp_path / "centred.csv").seen == pose.seen).all()
