"""Tables of joints as sensors' programs lay them out: units, clocks, words for confidence."""

from __future__ import annotations

import io
from itertools import pairwise

import numpy as np
import pytest

import markermend as mm
from markermend.errors import FileFormatError
from markermend.files.pose_stream import follow

FRAMES = 120
# A thigh and a shank that swing, in mm.
SWING = 0.3 * np.sin(np.arange(FRAMES) / 9.0)
KNEE = np.stack([400 * np.sin(SWING), 500 - 400 * np.cos(SWING), 0 * SWING], axis=1)
HIP = np.tile([0.0, 500.0, 0.0], (FRAMES, 1))
PLACES = {"hip": HIP, "knee": KNEE, "ankle": 2.0 * KNEE - HIP}
PARENT = {"hip": "", "knee": "hip", "ankle": "knee"}


def table(folder, *, head="x,y,z", mm=1.0, times=None, time="time", more=None, name="k.csv"):
    """Write the swing; ``times`` makes a cell of a frame, ``more`` (name, cell of frame, joint)."""
    extra, cell = more or ("", None)
    lines = [f"frame,{time},joint,parent,{head}" + (f",{extra}" if extra else "")]
    for n in range(FRAMES):
        told = f"{n / 30:.4f}" if times is None else times(n)
        for joint, places in PLACES.items():
            where = ",".join(f"{value / mm:.6f}" for value in places[n])
            last = f",{cell(n, joint)}" if cell else ""
            lines.append(f"{n},{told},{joint},{PARENT[joint]},{where}{last}")
    path = folder / name
    path.write_text("\n".join(lines) + "\n")
    return path


def places_of(pose):
    return [pose.positions[:, pose.index(joint)] for joint in PLACES]


@pytest.mark.parametrize(
    ("head", "mm_each", "guessed"),
    [
        ("x,y,z", 1000.0, True),
        ("x (m),y (m),z (m)", 1000.0, False),
        ("x_m,y_m,z_m", 1000.0, False),
        ("position_x_cm,position_y_cm,position_z_cm", 10.0, False),
        ("x,y,z", 1.0, False),
        ("x (mm),y (mm),z (mm)", 1000.0, None),
    ],
)
def test_a_unit_of_length_stands_behind_names_or_is_told_by_the_size(
    tmp_path, head, mm_each, guessed
):
    pose = mm.read_pose(table(tmp_path, head=head, mm=mm_each))
    scale = 1.0 if guessed is not None else 1e-3
    for there, places in zip(places_of(pose), PLACES.values(), strict=True):
        np.testing.assert_allclose(there, places * scale, atol=1e-3)
    told = "The file tells no unit of length; by the size of things metres were assumed."
    assert pose.warnings == ((told,) if guessed else ())


def test_what_is_filled_in_metres_is_as_fine_as_in_millimetres(tmp_path):
    unseen = "confidence", lambda n, joint: int(joint != "ankle" or not 40 <= n < 50)
    clean = {}
    for scale in (1.0, 1000.0):
        path = table(tmp_path, mm=scale, more=unseen, name=f"{scale}.csv")
        pose = mm.read_pose(path)
        target = tmp_path / f"clean{scale}.csv"
        mm.write_pose(mm.denoise(pose), target)
        lines = path.read_text().splitlines(), target.read_text().splitlines()
        assert sum(a != b for a, b in zip(*lines, strict=True)) == 10
        clean[scale] = mm.read_pose(target).positions
    np.testing.assert_allclose(clean[1.0], clean[1000.0], atol=0.01)


def test_a_small_body_comes_back_as_small_as_it_was(tmp_path):
    pose = mm.read_pose(table(tmp_path))
    small = pose.with_samples(pose.positions / 1000.0, pose.rotations)
    mm.write_pose(small, tmp_path / "small.csv")
    back = mm.read_pose(tmp_path / "small.csv")
    np.testing.assert_allclose(back.positions, small.positions, atol=1e-6)
    assert not back.warnings


def test_a_stream_of_metres_keeps_its_digits(tmp_path):
    text, out = table(tmp_path, mm=1000.0).read_text(), []
    follow(io.StringIO(text), out.append, rate=30.0, prior=None)
    knee = next(line for line in "".join(out).splitlines() if line.startswith("5,0.1667,knee"[:2]))
    assert knee.split(",")[4:7] == ["0.000000", "0.500000", "0.000000"]


@pytest.mark.parametrize(
    ("name", "unit_s", "rate"),
    [
        ("time (ms)", 1e-3, 1000.0),
        ("time [s]", 1.0, 0.5),
        ("timestamp_ms", 1e-3, 30.0),
        ("timestamp_usec", 1e-6, 30.0),
        ("timestamp (µs)", 1e-6, 30.0),
        ("Time (seconds)", 1.0, 30.0),
        ("timestamp_ns", 1e-9, 30.0),
    ],
)
def test_a_unit_of_time_is_not_guessed_where_it_is_told(tmp_path, name, unit_s, rate):
    begins = 50.0
    pose = mm.read_pose(
        table(tmp_path, time=name, times=lambda n: f"{(begins + n / rate) / unit_s:.3f}")
    )
    assert pose.rate == pytest.approx(rate, abs=1e-3)
    assert pose.first_time == pytest.approx(begins, abs=1e-3)
    assert not pose.warnings


@pytest.mark.parametrize(
    ("unit_s", "name"), [(1e-3, "milliseconds"), (1e-6, "microseconds"), (1e-9, "nanoseconds")]
)
def test_times_too_quick_for_seconds_are_of_the_unit_in_which_they_are_not(tmp_path, unit_s, name):
    pose = mm.read_pose(table(tmp_path, times=lambda n: f"{(1.7e9 + n / 30) / unit_s:.0f}"))
    assert pose.rate == pytest.approx(30.0, abs=0.01)
    assert pose.first_time == pytest.approx(1.7e9, abs=0.1)
    assert f"{name} were assumed" in pose.warnings[0]


def test_other_times_are_written_in_the_unit_of_the_file(tmp_path):
    path = table(tmp_path, time="time (ms)", times=lambda n: f"{1000 * n / 30:.2f}")
    mm.write_pose(mm.read_pose(path, rate=60.0), tmp_path / "quick.csv")
    assert "\n6,100.000000,hip" in (tmp_path / "quick.csv").read_text()
    assert mm.read_pose(tmp_path / "quick.csv").rate == pytest.approx(60.0, abs=1e-3)


@pytest.mark.parametrize("seconds", [60.0, -2.0])
def test_a_clock_that_jumps_does_not_tell_another_rate(tmp_path, seconds):
    late = mm.read_pose(
        table(tmp_path, times=lambda n: f"{n / 30 + (seconds if n > 40 else 0):.4f}")
    )
    assert late.rate == pytest.approx(30.0, abs=0.02)
    (said,) = late.warnings
    assert said.startswith("Times in the file jump or stand still (after frame 40, for one);")
    random = np.random.default_rng(0).uniform(0.0, 0.03, FRAMES)
    trembling = mm.read_pose(table(tmp_path, times=lambda n: f"{n / 30 + random[n]:.3f}"))
    assert trembling.rate == pytest.approx(30.0, abs=0.2)
    assert not trembling.warnings


def test_a_stream_tells_times_in_seconds(tmp_path):
    text = table(tmp_path, time="time_ms", times=lambda n: f"{1000 * n / 30:.2f}").read_text()
    out = []
    follow(io.StringIO(text), out.append, rate=30.0, prior=None)
    assert "\n6,0.200000,hip" in "".join(out)


def test_words_of_an_azure_kinect_are_confidence(tmp_path):
    level = ("NONE", "LOW", "MEDIUM", "HIGH")
    more = "confidence_level", lambda n, joint: f"K4ABT_JOINT_CONFIDENCE_{level[n % 4]}"
    pose = mm.read_pose(table(tmp_path, more=more))
    np.testing.assert_array_equal(pose.confidence[:, 0], np.tile([0.0, 0.5, 1.0, 1.0], FRAMES // 4))


def test_a_column_of_the_usual_name_goes_before_one_of_another(tmp_path):
    more = "confidence,tracking_state", lambda n, joint: "1,NotTracked"
    assert mm.read_pose(table(tmp_path, more=more)).seen.all()
    more = "tracking_state", lambda n, joint: "NotTracked" if n == 3 and joint == "knee" else 2
    assert np.argwhere(~mm.read_pose(table(tmp_path, more=more)).seen).tolist() == [[3, 1]]


def test_angles_are_no_quaternion_and_stay_as_they_are(tmp_path):
    more = "rotationx,rotationy,rotationz", lambda n, joint: "10.5,20.5,30.5"
    path = table(tmp_path, more=more)
    pose = mm.read_pose(path)
    assert np.isnan(pose.rotations).all()
    places = pose.positions + np.array([1.0, 0.0, 0.0])
    mm.write_pose(pose.with_samples(places, pose.rotations), tmp_path / "moved.csv")
    assert (tmp_path / "moved.csv").read_text().count(",10.5,20.5,30.5\n") == 3 * FRAMES


KINECTS = {
    "second": (
        "SpineBase SpineMid Neck Head ShoulderLeft ElbowLeft WristLeft HandLeft HipLeft KneeLeft"
        " AnkleLeft FootLeft SpineShoulder HandTipLeft ThumbLeft",
        "ThumbLeft HandLeft WristLeft ElbowLeft ShoulderLeft SpineShoulder SpineMid SpineBase",
    ),
    "first": (
        "HipCenter Spine ShoulderCenter Head ShoulderRight ElbowRight WristRight HandRight",
        "HandRight WristRight ElbowRight ShoulderRight ShoulderCenter Spine HipCenter",
    ),
    "Azure": (
        "PELVIS SPINE_NAVEL SPINE_CHEST NECK CLAVICLE_LEFT SHOULDER_LEFT HEAD NOSE EYE_LEFT",
        "SHOULDER_LEFT CLAVICLE_LEFT SPINE_CHEST SPINE_NAVEL PELVIS",
    ),
    "Nuitrack": (
        "JOINT_HEAD JOINT_NECK JOINT_TORSO JOINT_WAIST JOINT_LEFT_COLLAR JOINT_LEFT_SHOULDER",
        "JOINT_LEFT_SHOULDER JOINT_LEFT_COLLAR JOINT_TORSO JOINT_WAIST",
    ),
    "few": ("waist neck left_shoulder", "left_shoulder waist"),
}


@pytest.mark.parametrize("kind", KINECTS)
def test_joints_that_sensors_name_hang_on_the_next_one_that_is_there(tmp_path, kind):
    joints, chain = (names.split() for names in KINECTS[kind])
    rows = [f"{n},{joint},{n},{i},900" for n in range(3) for i, joint in enumerate(joints)]
    path = tmp_path / "k.csv"
    path.write_text("\n".join(["frame,joint,x,y,z", *rows]) + "\n")
    pose = mm.read_pose(path)
    for joint, parent in pairwise(chain):
        assert pose.joints[pose.parents[pose.index(joint)]] == parent
    assert [j for j, p in zip(pose.joints, pose.parents, strict=True) if p < 0] == [chain[-1]]


def test_a_stream_that_was_stopped_within_a_row_ends_with_the_pose_before(tmp_path):
    lines = table(tmp_path).read_text().splitlines(keepends=True)
    out, said = [], []
    text = "".join(lines[:31]) + lines[31][:12]
    count = follow(io.StringIO(text), out.append, rate=30.0, prior=None, warn=said.append)
    assert count == 10
    assert said == ["The stream is cut short; its last row was left out."]
    text = "".join(lines[:31]) + lines[31][:12] + "\n" + "".join(lines[32:40])
    with pytest.raises(FileFormatError, match=r"line 32, “10,0\.3333,hi”, lacks cells"):
        follow(io.StringIO(text), out.append, rate=30.0, prior=None)


def test_what_a_spreadsheet_is_told_about_cells_is_no_row(tmp_path):
    path = table(tmp_path)
    text = path.read_text().replace(",", ";").replace(".", ",")
    path.write_text("sep=;\n" + text)
    pose = mm.read_pose(path)
    np.testing.assert_allclose(pose.positions[:, 1], KNEE, atol=1e-3)
    mm.write_pose(pose, tmp_path / "again.csv")
    assert (tmp_path / "again.csv").read_bytes() == path.read_bytes()


@pytest.mark.parametrize("ending", ["csv", "bvh"])
def test_two_bytes_a_letter_are_named(tmp_path, ending):
    path = tmp_path / f"k.{ending}"
    path.write_bytes(table(tmp_path).read_text().encode("utf-16"))
    with pytest.raises(FileFormatError, match="is text in UTF-16, as PowerShell and Excel"):
        mm.read_pose(path)


@pytest.mark.parametrize("names", ["rx,ry,rz,rw", "qx,qy,qz,qw", "Rot X,Rot Y,Rot Z,Rot W"])
def test_rotations_are_read_under_the_names_that_papers_and_programs_give_them(tmp_path, names):
    path = table(tmp_path, head="tx,ty,tz", more=(names, lambda n, joint: "0.6,0,0,0.8"))
    pose = mm.read_pose(path)
    np.testing.assert_allclose(places_of(pose)[1], KNEE, atol=1e-3)
    np.testing.assert_allclose(pose.rotations[5], np.tile([0.6, 0.0, 0.0, 0.8], (3, 1)))
    assert not pose.warnings


def test_rotations_that_are_not_read_are_told(tmp_path):
    angles = "pitch,yaw,roll", lambda n, joint: "10,20,30"
    pose = mm.read_pose(table(tmp_path, more=angles))
    assert "No column tells how joints are turned" in pose.warnings[0]
    assert np.isnan(pose.rotations).all()
    assert not mm.read_pose(table(tmp_path)).warnings
