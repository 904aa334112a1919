"""Tables of joints as some programs leave them: read as what is meant, or refused in a sentence."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.cli import main
from markermend.errors import FileFormatError
from markermend.files.pose import crop_pose

FRAMES = 30
COLUMNS = "frame,time,joint,parent,x,y,z,qx,qy,qz,qw"


def cells(n, joint):
    """A row of a shank that hangs on a thigh."""
    parent, y = ("", 900) if joint == "thigh" else ("thigh", 500)
    return [str(n), f"{n / 30:.4f}", joint, parent, f"{n}.5", str(y), "30", "0.6", "0", "0", "0.8"]


def table(folder, change=lambda n, joint, row: row, *, head=COLUMNS):
    """Rows that each are ``change``d."""
    rows = [change(n, j, cells(n, j)) for n in range(FRAMES) for j in ("thigh", "shank")]
    path = folder / "k.csv"
    path.write_text("\n".join([head, *(",".join(row) for row in rows if row)]) + "\n")
    return path


@pytest.mark.parametrize("word", ["#N/A", "nan", "-nan(ind)", "NaN", "NA", "", "#NUM!", "1.#QNAN"])
def test_what_programs_write_for_no_number_is_a_gap(tmp_path, word):
    def change(n, joint, row):
        return [*row[:4], *[word] * 7] if joint == "shank" and 5 <= n < 9 else row

    pose = mm.read_pose(table(tmp_path, change))
    assert np.flatnonzero(~pose.seen[:, 1]).tolist() == [5, 6, 7, 8]
    with pytest.raises(FileFormatError, match="line 12 says “12O” where y should be a number"):
        mm.read_pose(
            table(
                tmp_path,
                lambda n, j, row: [*row[:5], "12O", *row[6:]] if (n, j) == (5, "thigh") else row,
            )
        )


@pytest.mark.parametrize("word", ["None", "-1", "null", "nan"])
def test_the_parent_of_a_root_may_be_a_word_for_none(tmp_path, word):
    path = table(tmp_path, lambda n, j, row: [*row[:3], row[3] or word, *row[4:]])
    assert mm.read_pose(path).parents == (-1, 0)


def test_a_joint_may_be_called_as_what_means_none(tmp_path):
    path = table(tmp_path)
    path.write_text(path.read_text().replace("thigh", "-1"))
    pose = mm.read_pose(path)
    assert (pose.joints, pose.parents) == (("-1", "shank"), (-1, 0))


@pytest.mark.parametrize("head", ["x,y,z,w,x,y,z", "x,y,z,x,y,z,w", "x (m),y (m),z (m),x,y,z,w"])
def test_two_columns_of_one_name_are_not_chosen_from(tmp_path, head):
    path = table(tmp_path, head=f"frame,time,joint,parent,{head}")
    with pytest.raises(FileFormatError) as told:
        mm.read_pose(path)
    assert str(told.value) == (
        "k.csv has two columns “x”, of which one may tell how joints are turned; call that qx."
    )


@pytest.mark.parametrize("column", ["body", "User ID", "tracking_id", "id", "PersonIndex"])
def test_several_bodies_are_called_so(tmp_path, column):
    path = table(tmp_path, lambda n, j, row: [*row, "1"], head=f"{COLUMNS},{column}")
    assert mm.read_pose(path).frames == FRAMES
    other = [line.replace(",30,", ",930,")[:-1] + "2" for line in path.read_text().splitlines()[1:]]
    path.write_text(path.read_text() + "\n".join(other) + "\n")
    with pytest.raises(FileFormatError) as told:
        mm.read_pose(path)
    assert str(told.value) == (
        f"k.csv tells of several bodies (column “{column}”); write one of them into a file."
    )
    path.write_text(path.read_text().replace(column, "battery"))
    with pytest.raises(FileFormatError, match="lines 2 and 62 both tell of “thigh” in one frame"):
        mm.read_pose(path)


@pytest.mark.parametrize("do", ["info", "convert", "denoise"])
@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda text: text.encode("utf-16"), "is text in UTF-16, as PowerShell"),
        (lambda text: text.replace("frame,", "count,").encode(), "it lacks the column “frame”; it"),
    ],
)
def test_commands_say_what_a_file_is(tmp_path, capsys, do, spoil, said):
    path = table(tmp_path)
    path.write_bytes(spoil(path.read_text()))
    target = [] if do == "info" else ["-o", str(tmp_path / "out.csv")]
    assert main([do, str(path), *target]) == 1
    assert said in capsys.readouterr().err


LEVELS = {
    "kinect": (["0", "1", "2"], [0.0, 0.5, 1.0]),
    "azure": (["0", "1", "2", "3"], [0.0, 0.5, 1.0, 1.0]),
    "percent": (["0", "25", "87.5", "100"], [0.0, 0.25, 0.875, 1.0]),
    "shares": (["0", "0.25", "1"], [0.0, 0.25, 1.0]),
    "beyond": (["0", "0.5", "1.25"], [0.0, 0.5, 1.0]),
    "far beyond": (["0", "0.5", "0.75", "5.5"], [0.0, 0.5, 0.75, 1.0]),
}


def sure(folder, levels):
    """Each level in turn."""
    head = f"{COLUMNS},confidence"
    return table(folder, lambda n, j, row: [*row, levels[n % len(levels)]], head=head)


@pytest.mark.parametrize("kind", LEVELS)
def test_levels_of_sensors_are_shares_of_being_sure(tmp_path, kind):
    levels, shares = LEVELS[kind]
    path = sure(tmp_path, levels)
    pose = mm.read_pose(path)
    expected = [shares[n % len(shares)] for n in range(FRAMES)]
    np.testing.assert_allclose(pose.confidence[:, 0], expected)
    mm.write_pose(pose, tmp_path / "same.csv")
    assert (tmp_path / "same.csv").read_bytes() == path.read_bytes()


@pytest.mark.parametrize("stray", ["2", "17", "100"])
@pytest.mark.parametrize("share", ["1", "0.75"])
def test_one_stray_number_makes_no_levels_of_shares(tmp_path, share, stray):
    head = f"{COLUMNS},confidence"
    odd = table(
        tmp_path, lambda n, j, row: [*row, stray if (n, j) == (9, "shank") else share], head=head
    )
    pose = mm.read_pose(odd)
    expected = np.full(pose.confidence.shape, float(share))
    expected[9, 1] = 1.0
    np.testing.assert_array_equal(pose.confidence, expected)
    mm.write_pose(pose, tmp_path / "same.csv")
    assert (tmp_path / "same.csv").read_bytes() == odd.read_bytes()


def test_what_is_filled_has_a_level_of_the_file(tmp_path):
    pose = mm.read_pose(sure(tmp_path, ["2", "2", "2", "0"]))
    confidence = np.where(pose.seen, pose.confidence, 0.5)
    places = np.where(pose.seen[..., None], pose.positions, [[[9.0, 900.0, 30.0]] * 2])
    turns = np.where(pose.seen[..., None], pose.rotations, [0.6, 0.0, 0.0, 0.8])
    filled = pose.with_samples(places, turns, confidence)
    mm.write_pose(filled, tmp_path / "filled.csv")
    rows = (tmp_path / "filled.csv").read_text().splitlines()[1:]
    assert {row.rpartition(",")[2] for row in rows} == {"1", "2"}
    np.testing.assert_allclose(mm.read_pose(tmp_path / "filled.csv").confidence, confidence)


def test_levels_of_a_part_that_has_no_sure_joint_stay_what_they_mean(tmp_path):
    pose = mm.read_pose(sure(tmp_path, ["1"] * 10 + ["2"] * 20))
    mm.write_pose(crop_pose(pose, 0, 10), tmp_path / "part.csv")
    assert (mm.read_pose(tmp_path / "part.csv").confidence == 0.5).all()
