"""Tables of joints written over their own file: what was not repaired stays as it stands there."""

from __future__ import annotations

import numpy as np
import pytest
from command_line import run

import markermend as mm
from markermend.files.pose import crop_pose
from markermend.files.pose_stream import follow
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.segments import to_cmu

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


def rows_of(frames=6, joints=("a,", "b,a", "c,b"), first=1000, begin=55.5):
    return [
        f'{first + n},{begin + n / 25:.4f},{joint},{n}.5,{5 * k}.25,0,0,0,0,1,1,7,"hi, there"'
        for n in range(frames)
        for k, joint in enumerate(joints)
    ]


WIDE = HEAD + ',tracking_id,"note"'


@pytest.mark.parametrize(
    ("gone", "place"),
    [
        ([7], 8),  # a joint within a frame
        ([6], 7),  # the first of a frame
        ([6, 7, 8], 8),  # a whole frame
        ([17], 18),  # the last row
    ],
)
def test_a_row_that_the_file_lacks_comes_where_it_belongs(tmp_path, gone, place):
    rows = rows_of()
    kept = [row for n, row in enumerate(rows) if n not in gone]
    path = table(tmp_path, kept, head=WIDE, before="# lab 3\n")
    frame, joint = divmod(place - 1, 3)
    lines = filled(path, tmp_path / "out.csv", frame, "abc"[joint], [1.0, 2.0, 3.0])
    cells = rows[place - 1].split(",")[:4]
    new = [line for line in lines if line not in kept]
    assert new[:2] == ["# lab 3", WIDE]
    values = "1.000,2.000,3.000,0.000000,0.000000,0.000000,1.000000,0.5,,"
    assert new[2:] == [",".join([*cells, values])]
    at = lines.index(new[2]) - 2
    assert lines[2 : 2 + at] + lines[3 + at :] == kept
    assert at == place - 1 - sum(n < place - 1 for n in gone)
    back = mm.read_pose(tmp_path / "out.csv")
    assert back.joints == ("a", "b", "c")
    assert back.seen.sum() == len(kept) + 1


def test_a_file_that_ends_without_an_end_of_line_takes_a_row_more(tmp_path):
    rows = rows_of()
    path = table(tmp_path, rows[:-1], head=WIDE)
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n").removesuffix(b"\r\n"))
    filled(path, tmp_path / "out.csv", 5, "c", [1.0, 2.0, 3.0])
    raw = (tmp_path / "out.csv").read_bytes()
    assert raw.startswith(path.read_bytes() + b"\r\n1005,55.7000,c,b,1.000,")
    assert raw.count(b"\n") == raw.count(b"\r\n") == len(rows) + 1


@pytest.mark.parametrize("before", ["\ufeff# lab 3\n", "\ufeff"])
def test_a_byte_order_mark_costs_nothing(tmp_path, before):
    rows = rows_of()
    path = table(tmp_path, rows, head=WIDE, before=before)
    lines = filled(path, tmp_path / "out.csv", 2, "b", [1.0, 2.0, 3.0])
    assert "\n".join(lines).startswith(f"{before}{WIDE}\n")
    assert sum(line not in rows for line in lines) == 1 + before.count("\n") + 1
    assert lines[-11].endswith(',0.5,7,"hi, there"')


def test_frames_keep_their_numbers_and_times(tmp_path):
    path = table(tmp_path, rows_of(), head=WIDE)
    take = mm.read(path)
    assert take.first_frame == 1000
    # A part of it holds the rows of these frames, as they stand there.
    mm.write(take, tmp_path / "part.csv", frames=(2, 4))
    assert (tmp_path / "part.csv").read_text().splitlines() == [WIDE, *rows_of()[6:12]]
    # So does what is written anew, which has no further columns.
    pose = mm.read_pose(path)
    path.unlink()
    mm.write_pose(pose, tmp_path / "anew.csv")
    lines = (tmp_path / "anew.csv").read_text().splitlines()
    assert lines[4].startswith("1001,55.540000,a,,1.500,")
    assert mm.read_pose(tmp_path / "anew.csv").first_frame == 1000


@pytest.mark.parametrize("lacks", ["", "confidence"])
def test_a_part_of_a_table_has_all_of_its_frames_and_joints(tmp_path, lacks):
    # No row at all tells of “b” in frames 2 to 4, and none of any joint in frame 2.
    gone = {6, 7, 8, 10, 13}
    rows = [row for n, row in enumerate(rows_of()) if n not in gone]
    keep = [n for n, column in enumerate(WIDE.split(",")) if column != lacks]
    rows = [",".join(row.split(",")[n] for n in keep) + ' there"' for row in rows]
    path = table(tmp_path, rows, head=",".join(WIDE.split(",")[n] for n in keep))
    take = mm.read(path)
    mm.write(take, tmp_path / "part.csv", frames=(2, 5))
    part = mm.read_pose(tmp_path / "part.csv")
    assert (part.joints, part.frames, part.first_frame) == (take.labels, 3, 1002)
    np.testing.assert_array_equal(part.seen, take.present[2:5])


def test_frames_of_a_movement_keep_their_numbers_in_a_table(tmp_path, shared_data):
    take = mm.read(shared_data / "poses" / "02_01.amc")
    mm.write(take, tmp_path / "part.csv", frames=(49, 60))
    assert (tmp_path / "part.csv").read_text().splitlines()[1].startswith("50,0.408333,root,")
    assert mm.read(tmp_path / "part.csv").first_frame == 50


def test_frames_keep_their_numbers_as_other_joints(shared_data):
    pose = crop_pose(mm.read_pose(shared_data / "poses" / "02_01.amc"), 49, 60)
    for body in (to_nuitrack(pose), to_cmu(to_nuitrack(pose))):
        assert (body.first_frame, body.first_time) == (50, 49 / 120)


def test_frames_are_named_by_the_numbers_of_the_file(tmp_path, capsys):
    path = table(tmp_path, rows_of(), head=WIDE)
    assert run("detect", path, "--frames", "1001", "1004") == 0
    assert run("detect", path, "--frames", "1", "4") == 1
    assert "has frames 1000 to 1005" in capsys.readouterr().err


def test_decimal_commas_stay_commas(tmp_path):
    rows = [row.partition(',7,"')[0].replace(",", ";").replace(".", ",") for row in rows_of()]
    path = table(tmp_path, rows, head=HEAD.replace(",", ";"))
    lines = filled(path, tmp_path / "out.csv", 2, "b", [1.5, 2.0, 3.0])
    numbers = "1,500;2,000;3,000;0;0;0;1;0,5"
    assert lines[8] == f"1002;55,5800;b;a;{numbers}"
    assert lines[:8] + lines[9:] == [HEAD.replace(",", ";"), *rows[:7], *rows[8:]]


@pytest.mark.parametrize(
    ("unit", "mm_of", "said"),
    [("m", 1000.0, "0.001500,0.002000,0.003000"), ("cm", 10.0, "0.1500,0.2000,0.3000")],
)
def test_units_of_the_columns_are_honoured(tmp_path, unit, mm_of, said):
    head = HEAD.replace("x,y,z", f"x ({unit}),y [{unit}],z ({unit})")
    rows = [row.partition(',7,"')[0] for row in rows_of()]
    path = table(tmp_path, rows, head=head)
    pose = mm.read_pose(path)
    np.testing.assert_allclose(pose.positions[2, 1], [2.5 * mm_of, 5.25 * mm_of, 0.0])
    lines = filled(path, tmp_path / "out.csv", 2, "b", [1.5, 2.0, 3.0])
    assert lines[8].startswith(f"1002,55.5800,b,a,{said},")
    assert lines[:8] + lines[9:] == [head, *rows[:7], *rows[8:]]
    out = []
    follow([head, *rows], out.append, rate=30.0, prior=None)
    assert f",b,a,{2.5 * mm_of:.3f},{5.25 * mm_of:.3f},0.000," in "".join(out)


def test_a_unit_that_is_none_is_said(tmp_path):
    head = HEAD.replace("x,y,z", "x (px),y (px),z (px)")
    rows = [row.partition(',7,"')[0] for row in rows_of()]
    said = "The columns tell no unit of length that is known; millimetres were assumed."
    assert said in mm.read_pose(table(tmp_path, rows, head=head)).warnings
    told = []
    follow([head, *rows], lambda text: None, rate=30.0, prior=None, warn=told.append)
    assert said in told


def test_a_table_without_times_parents_or_rotations_is_written_over_too(tmp_path):
    keep = [0, 2, 4, 5, 6, 11, 12]
    joints = ("waist,", "torso,waist", "neck,torso")
    rows = [",".join(row.split(",")[i] for i in keep) for row in rows_of(joints=joints)]
    head = ",".join(WIDE.split(",")[i] for i in keep)
    path = table(tmp_path, rows, head=head)
    pose = mm.read_pose(path)
    places, sure = np.array(pose.positions), np.array(pose.confidence)
    places[2, 1], sure[2, 1] = [1.0, 2.0, 3.0], 0.5
    mm.write_pose(pose.with_samples(places, pose.rotations, sure), tmp_path / "out.csv")
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert lines[8] == "1002,torso,1.000,2.000,3.000,0.5,7"
    assert lines[:8] + lines[9:] == [head, *rows[:7], *rows[8:]]
    # What it has no column for is written where there is one.
    turned = np.array(pose.rotations)
    turned[2, 1] = [0.0, 0.6, 0.0, 0.8]
    mm.write_pose(pose.with_samples(places, turned, sure), tmp_path / "out.csv")
    assert ",0.600000,0.000000,0.800000,0.5\n" in (tmp_path / "out.csv").read_text()


def test_rows_of_nothing_but_blank_cells_say_nothing(tmp_path):
    rows = rows_of()
    path = table(tmp_path, [*rows, ",,,,"], head=WIDE)
    pose = mm.read_pose(path)
    assert (pose.frames, pose.warnings) == (6, ())
    lines = filled(path, tmp_path / "out.csv", 2, "b", [1.0, 2.0, 3.0])
    assert lines[9:] == [*rows[8:], ",,,,"]


def test_what_is_cut_short_or_has_no_place_costs_no_other_row(tmp_path):
    rows = rows_of()
    rows[4] = '1001,55.5400,b,a,,,,0,0,0,1,0,7,"hi, there"'
    path = table(tmp_path, [*rows, "1006,55.7,a"], head=WIDE, before="# lab 3\n")
    lines = filled(path, tmp_path / "out.csv", 2, "b", [1.0, 2.0, 3.0])
    assert lines[:9] == ["# lab 3", WIDE, *rows[:7]]
    assert lines[10:] == rows[8:]


@pytest.mark.parametrize("name", ["k.tsv", "k.txt", "k.dat"])
def test_joints_are_known_by_what_a_file_says_not_by_its_name(tmp_path, name):
    rows = [row.partition(',7,"')[0].replace(",", "\t") for row in rows_of()]
    comment = f"# {'recorded in the lab ' * 50}\n"
    path = table(tmp_path, rows, head=HEAD.replace(",", "\t"), before=comment, name=name)
    take = mm.read(path)
    assert take.skeleton
    assert take.labels == mm.read_pose(path).joints == ("a", "b", "c")
    (tmp_path / "m.txt").write_text("frame,time,A.x,A.y,A.z\n1,0,1,2,3\n2,0.01,1,2,3\n")
    assert not mm.read(tmp_path / "m.txt").skeleton


def test_a_stream_goes_on_in_time_where_a_row_tells_none():
    rows = [row.partition(',7,"')[0] for row in rows_of()]
    blank = [row.replace("55.5400", "") for row in rows]
    out = []
    follow([HEAD, *blank, ",,,,,"], out.append, rate=25.0, prior=None)
    times = [line.split(",")[1] for line in "".join(out).splitlines()[1:]]
    assert times[::3] == [f"{55.5 + n / 25:.6f}" for n in range(6)]


def test_a_rate_that_is_given_is_written_into_the_times(tmp_path):
    rows = rows_of()
    path = table(tmp_path, rows, head=WIDE, before="# lab 3\n")
    mm.write_pose(mm.read_pose(path, rate=50.0), tmp_path / "out.csv")
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert lines[:2] == ["# lab 3", WIDE]
    times = [f"{n / 50:.6f}" for n in range(6) for _ in range(3)]
    for line, row, time in zip(lines[2:], rows, times, strict=True):
        number, _, rest = row.split(",", 2)
        assert line == f"{number},{time},{rest}"
    assert mm.read_pose(tmp_path / "out.csv").rate == 50.0
    mm.write_pose(mm.read_pose(path, rate=25.0), tmp_path / "same.csv")
    assert (tmp_path / "same.csv").read_bytes() == path.read_bytes()
    # Without a column of times it is written anew, which has one.
    keep = [n for n in range(14) if n != 1]
    untimed = [",".join(row.split(",")[n] for n in keep) for row in rows]
    head = ",".join(WIDE.split(",")[n] for n in keep)
    path = table(tmp_path, [row + ' there"' for row in untimed], head=head)
    mm.write_pose(mm.read_pose(path, rate=50.0), tmp_path / "out.csv")
    assert mm.read_pose(tmp_path / "out.csv").rate == 50.0


def test_what_is_lost_where_a_table_is_written_anew_is_said(tmp_path, capsys):
    keep = [n for n in range(14) if n != 11]
    rows = [",".join([*row.split(",")[:11], "7", "well"]) for row in rows_of(frames=30)]
    rows[31] = "1010,55.9000,b,a,0,0,0,0,0,0,1,7,well"
    head = ",".join(WIDE.split(",")[n] for n in keep)
    take = mm.read(table(tmp_path, rows, head=head))
    assert mm.write(take, tmp_path / "same.csv").dropped == ()
    clean = mm.repair(take, mm.detect(take))
    assert mm.write(clean, tmp_path / "out.csv").dropped == ("tracking_id", "note")
    assert run("clean", tmp_path / "table.csv", "-o", tmp_path / "two.csv") == 0
    said = "Written anew, so without further columns of its source: tracking_id, note."
    assert said in capsys.readouterr().out
