"""Tables of joints written over their own file: what was not repaired stays as it stands there."""

from __future__ import annotations

import numpy as np

import markermend as mm

HEAD = "frame,time,joint,parent,x,y,z,qx,qy,qz,qw,confidence"


def table(folder, rows, *, head=HEAD, before="", name="table.csv"):
    path = folder / name
    path.write_text(before + "\n".join([head, *rows]) + "\n", encoding="utf-8")
    return path


def filled(path, target, frame, joint, place):
    """Write a recording in which a joint has come to a place; its rows there."""
    pose = mm.read_pose(path)
    at = pose.index(joint)
    places, turns, sure = (np.array(a) for a in (pose.positions, pose.rotations, pose.confidence))
    places[frame, at], turns[frame, at], sure[frame, at] = place, [0.0, 0.0, 0.0, 1.0], 0.5
    mm.write_pose(pose.with_samples(places, turns, sure), target)
    return target.read_text(encoding="utf-8").splitlines()


def test_a_row_that_is_filled_keeps_nothing_that_an_unseen_joint_was_said_to_be(tmp_path):
    rows = [
        f"{n},{n / 30:.4f},{joint},0,5,0,0,0,0,1,1" for n in range(4) for joint in ("a,", "b,a")
    ]
    rows[5] = "2,0.0667,b,a,777,888,99,.5,.5,.5,.5,0"
    lines = filled(table(tmp_path, rows), tmp_path / "out.csv", 2, "b", [0.0, 4.0, 0.0])
    assert lines[6] == "2,0.0667,b,a,0.000,4.000,0.000,0.000000,0.000000,0.000000,1.000000,0.5"
    assert lines[:6] + lines[7:] == [HEAD, *rows[:5], *rows[6:]]
