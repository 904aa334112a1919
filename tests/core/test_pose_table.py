"""Tables of joints: what they may say, and what is said of those that cannot be right."""

from __future__ import annotations

import io

import numpy as np
import pytest
from command_line import run

import markermend as mm
from markermend.errors import ExportError, FileFormatError
from markermend.files.pose_stream import follow
from markermend.poses import Pose
from markermend.poses.nuitrack import to_nuitrack

HEAD = "frame,time,joint,parent,x,y,z,qx,qy,qz,qw,confidence"
ROWS = [
    row
    for n in range(4)
    for row in (
        f"{n},{n / 30:.6f},a,,{n}.5,10,1000,0,0,0,1,1",
        f"{n},{n / 30:.6f},b,a,{n}.5,12,1300,0,0,0,1,1",
    )
]


def table(tmp_path, *, head=HEAD, rows=ROWS, changed=None):
    lines = [head, *rows]
    for number, line in (changed or {}).items():
        lines[number - 1] = line
    path = tmp_path / "table.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture(scope="module")
def kinect(shared_data):
    """A recording whose ends have no rotation, as the second Kinect writes them."""
    body = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))
    rotations = np.array(body.rotations[::4])
    rotations[:, [body.index("head"), body.index("left_wrist")]] = np.nan
    return Pose(body.positions[::4], rotations, body.joints, body.parents, 30.0)


@pytest.mark.parametrize(
    ("number", "line", "said"),
    [
        (4, '1,0.03,"a,,1,2,3,0,0,0,1,1', "line 4 opens a quote"),
        (5, "1,0.03,b,a,12O.5,2,3,0,0,0,1,1", "line 5 says “12O.5” where x should be a number"),
        (5, "1,0.03,b,a,1,2,3,0,0,0,1,sure", "line 5 says “sure” where confidence should"),
        (5, "1,0.03,b,a,1,2,3,0,0,0,1,1,7", "line 5 has 13 cells, the header 12"),
        (5, "1,0.03,b,a,1,2,3", "line 5 has 7 cells, the header 12"),
        (5, "x,0.03,b,a,1,2,3,0,0,0,1,1", "“x” in line 5 is no frame number"),
        (5, "1.5,0.03,b,a,1,2,3,0,0,0,1,1", "“1.5” in line 5 is no frame number"),
        (5, "1,0.03,,a,1,2,3,0,0,0,1,1", "line 5 names no joint"),
        (5, "1,0.03,a,,1,2,3,0,0,0,1,1", "lines 4 and 5 both tell of “a” in one frame"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(tmp_path, number, line, said):
    path = table(tmp_path, changed={number: line})
    with pytest.raises(FileFormatError, match=said):
        mm.read_pose(path)


def test_lines_are_counted_as_an_editor_does(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("# made by hand\n\n" + "\n".join([HEAD, "\n# more", ROWS[0], "0,0,b,a,?"]))
    path.write_text(path.read_text() + ",1,1,0,0,0,1,1\n" + ROWS[2] + "\n")
    with pytest.raises(FileFormatError, match="line 7 says “\\?”"):
        mm.read_pose(path)


def test_cells_that_are_empty_at_the_end_say_nothing(tmp_path):
    pose = mm.read_pose(table(tmp_path, rows=[row + ",," for row in ROWS]))
    assert pose.frames == 4
    assert pose.warnings == ()


def test_a_last_row_that_is_cut_short_is_left_out(tmp_path):
    for end in ("3,0.1,b,a,1", '3,0.1,"b'):
        pose = mm.read_pose(table(tmp_path, rows=[*ROWS[:-1], end]))
        assert pose.warnings == ("The file is cut short; its last row was left out.",)
        assert pose.seen.tolist()[-1] == [True, False]


def test_rows_that_stand_twice_are_read_once(tmp_path):
    pose = mm.read_pose(table(tmp_path, rows=[*ROWS, *ROWS[-2:]]))
    assert pose.frames == 4
    assert pose.warnings == ("2 rows stand twice, line 10 for one; they were read once.",)


def test_decimal_commas_are_read(tmp_path):
    plain = mm.read_pose(table(tmp_path))
    rows = [row.replace(",", ";").replace(".", ",") for row in ROWS]
    pose = mm.read_pose(table(tmp_path, head=HEAD.replace(",", ";"), rows=rows))
    np.testing.assert_array_equal(pose.positions, plain.positions)
    assert pose.rate == plain.rate


def test_words_of_a_kinect_are_confidence(tmp_path):
    words = ["Tracked", "Inferred", "NotTracked", "tracked"]
    rows = [row[:-1] + words[n % 4] for n, row in enumerate(ROWS)]
    pose = mm.read_pose(table(tmp_path, rows=rows))
    np.testing.assert_array_equal(pose.confidence.ravel(), [1, 0.5, 0, 1] * 2)


def test_what_has_no_place_is_not_written_as_seen(tmp_path):
    path = table(tmp_path, changed={4: "1,0.033333,a,,nan,10,1000,0,0,0,1,1"})
    pose = mm.read_pose(path)
    assert not pose.seen[1, 0]
    mm.write_pose(pose, tmp_path / "out.csv")
    line = (tmp_path / "out.csv").read_text().splitlines()[3]
    assert line == "1,0.033333,a,,0.000,0.000,0.000,0.000000,0.000000,0.000000,1.000000,0"
    assert not mm.read_pose(tmp_path / "out.csv").seen[1, 0]


@pytest.mark.parametrize("wild", ["1e308", "inf", "2e7", "-1e200"])
def test_what_is_no_measurement_counts_as_not_seen(tmp_path, wild):
    for cells in (f"{wild},12,1300,0,0,0,1,1", f"1.5,12,1300,0,0,{wild},1,1"):
        pose = mm.read_pose(table(tmp_path, changed={5: f"1,0.03,b,a,{cells}"}))
        assert not pose.seen[1, 1]
        assert pose.seen.sum() == 7
        assert len(pose.warnings) == 1
        assert "1 samples whose coordinates are no numbers, or farther" in pose.warnings[0]


def test_times_in_milliseconds_are_known(tmp_path):
    rows = []
    for row in ROWS:
        frame, _, rest = row.split(",", 2)
        rows.append(f"{frame},{int(frame) * 25},{rest}")
    pose = mm.read_pose(table(tmp_path, rows=rows))
    assert pose.rate == 40.0
    assert "milliseconds were assumed" in pose.warnings[0]


def test_a_joint_without_rotation_stays_without(tmp_path, kinect):
    mm.write_pose(kinect, tmp_path / "k.csv")
    back = mm.read_pose(tmp_path / "k.csv")
    np.testing.assert_array_equal(np.isnan(back.rotations), np.isnan(kinect.rotations))
    rows = [",".join(line.split(",")[:7]) for line in [HEAD, *ROWS]]
    only = mm.read_pose(table(tmp_path, head=rows[0], rows=rows[1:]))
    assert np.isnan(only.rotations).all()
    mm.write_pose(only, tmp_path / "only.csv")
    assert np.isnan(mm.read_pose(tmp_path / "only.csv").rotations).all()


def test_ends_without_rotation_are_turned_as_their_parents_in_a_hierarchy(tmp_path, kinect):
    mm.write_pose(kinect, tmp_path / "k.bvh")
    back = mm.read_pose(tmp_path / "k.bvh")
    by_name = [back.index(joint) for joint in kinect.joints]
    np.testing.assert_allclose(back.positions[:, by_name], kinect.positions, atol=1e-2)
    assert kinect.joints[3:5] == ("neck", "head")
    same = np.abs(np.sum(back.rotations[:, back.index("head")] * kinect.rotations[:, 3], axis=1))
    np.testing.assert_allclose(same, 1.0, atol=1e-6)


def test_a_hierarchy_says_what_it_lacks(tmp_path, kinect):
    never = np.ones(kinect.seen.shape)
    never[:, 4] = 0.0
    unseen = kinect.with_samples(kinect.positions, kinect.rotations, never)
    with pytest.raises(ExportError, match="head was never seen"):
        mm.write_pose(unseen, tmp_path / "k.bvh")
    unturned = kinect.with_samples(kinect.positions, kinect.rotations * np.nan)
    with pytest.raises(ExportError, match="holds rotations, which this recording has none of"):
        mm.write_pose(unturned, tmp_path / "k.bvh")


def streamed(text, **options):
    out, said = [], []
    options = {"rate": 30.0, "prior": None, **options}
    follow(io.StringIO(text), out.append, warn=said.append, **options)
    return "".join(out), said


def test_a_stream_without_rotations_is_filled(tmp_path, kinect):
    hidden = np.array(kinect.confidence)
    hidden[20:30, kinect.index("left_elbow")] = 0
    hidden[20:30, kinect.index("left_wrist")] = 0
    mm.write_pose(
        kinect.with_samples(kinect.positions, kinect.rotations, hidden), tmp_path / "k.csv"
    )
    for columns in (12, 7):
        lines = (tmp_path / "k.csv").read_text().splitlines()
        keep = [0, 1, 2, 3, 4, 5, 6, 11] if columns == 7 else range(12)
        text = "\n".join(",".join(line.split(",")[i] for i in keep) for line in lines)
        out, said = streamed(text)
        assert said == []
        (tmp_path / "out.csv").write_text(out)
        back = mm.read_pose(tmp_path / "out.csv")
        assert (back.confidence[20:30, [6, 7]] == 0.5).all()
        assert np.linalg.norm(back.positions - kinect.positions, axis=2).max() < 250
        gone = np.isnan(kinect.rotations) if columns == 12 else np.ones((*hidden.shape, 4), bool)
        np.testing.assert_array_equal(np.isnan(back.rotations), gone)


def test_streams_may_look_as_files_do():
    plain, _ = streamed("\n".join([HEAD, *ROWS]))
    for delimiter in ";\t":
        text = "\n".join(["# a comment", "", *[r.replace(",", delimiter) for r in [HEAD, *ROWS]]])
        assert streamed(text)[0] == plain
    assert streamed("\r\n".join([HEAD, *ROWS]))[0] == plain


def test_what_a_stream_leaves_out_is_said():
    more = [*ROWS[:2], *ROWS[2:4], "1,0.03,c,b,1,2,1500,0,0,0,1,1", *ROWS[4:]]
    _, said = streamed("\n".join([HEAD, *more]))
    assert said == ["The stream's first pose has no joint “c”; its rows are left out."]
    with pytest.raises(FileFormatError, match="line 2 hangs “b” on “a”, which its first pose"):
        streamed("\n".join([HEAD, ROWS[1]]))
    unseen = [row[:-1] + "0" if ",b," in row else row for row in ROWS]
    _, said = streamed("\n".join([HEAD, *unseen]))
    assert said == [
        "Never seen, and left so: b.",
        "Nothing was filled: no pose of the stream showed the root joint and a bone.",
    ]


def test_a_stream_that_is_closed_is_refused(monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", None)
    assert run("denoise", "-", "-o", "-") == 1
    assert "standard input and output that are open" in capsys.readouterr().err


def test_a_closed_output_ends_nothing(monkeypatch, tmp_path):
    # Once it is imported, a command hides Python's own “open” where commands are run.
    import markermend.cli.open  # noqa: F401

    path = table(tmp_path)
    monkeypatch.setattr("sys.stdin", io.StringIO(path.read_text()))
    monkeypatch.setattr("sys.stdout", None)
    assert run("convert", path, "-o", tmp_path / "out.csv") == 0
    assert (tmp_path / "out.csv").exists()
    assert run("info", path, "--json", "-") == 1
    assert run("denoise", "-", "-o", "-") == 1


def test_a_prior_that_does_not_fit_is_said(tmp_path, shared_data, capsys):
    poses = shared_data / "poses"
    assert run("train", "prior", poses / "02_01.amc", "-o", tmp_path / "p.npz") == 0
    path = table(tmp_path)
    words = ("--prior", tmp_path / "p.npz")
    capsys.readouterr()
    assert run("denoise", path, *words, "-o", tmp_path / "out.csv") == 0
    assert "p.npz does not fit this recording" in capsys.readouterr().err
    mm.write_pose(to_nuitrack(mm.read_pose(poses / "02_01.amc")), tmp_path / "body.csv")
    assert run("denoise", tmp_path / "body.csv", *words, "-o", tmp_path / "two.csv") == 0
    assert "does not fit" not in capsys.readouterr().err


def test_a_prior_learns_from_sensors_that_do_not_turn_the_ends_of_limbs(tmp_path, kinect, capsys):
    assert np.isnan(kinect.rotations[:, kinect.joints.index("head")]).all()
    mm.write_pose(kinect, tmp_path / "k.csv")
    assert run("train", "prior", tmp_path / "k.csv", "-o", tmp_path / "p.npz") == 0
    words = ("--prior", tmp_path / "p.npz", "-o", tmp_path / "out.csv")
    assert run("denoise", tmp_path / "k.csv", *words) == 0
    assert "does not fit" not in capsys.readouterr().err


def test_why_nothing_is_learnt_from_a_recording_is_true(tmp_path, kinect, capsys):
    turns = kinect.rotations.copy()
    turns[:, [kinect.joints.index("left_elbow"), kinect.joints.index("left_knee")]] = np.nan
    limp = kinect.with_samples(kinect.positions, turns, kinect.confidence)
    mm.write_pose(limp, tmp_path / "k.csv")
    assert run("train", "prior", tmp_path / "k.csv", "-o", tmp_path / "p.npz") == 1
    assert "k never tells the rotation of left_elbow, left_knee" in capsys.readouterr().err
    (tmp_path / "other").mkdir()
    mm.write_pose(kinect, tmp_path / "other" / "k.csv")
    two = (tmp_path / "k.csv", tmp_path / "other" / "k.csv")
    for words in (["train", "prior", *two, "-o", tmp_path / "p.npz"], ["bench", "pose", *two]):
        assert run(*words) == 1
        assert "have one name" in capsys.readouterr().err


@pytest.mark.parametrize("rate", ["1e300", "1e-300", "1e6", "0.01", "nan"])
def test_rates_that_nothing_records_at_are_refused(tmp_path, capsys, rate):
    path = table(tmp_path)
    for words in ([path, "-o", tmp_path / "out.csv"], ["-", "-o", "-"]):
        assert run("denoise", *words, "--rate", rate) == 2
        assert "Hz" in capsys.readouterr().err or rate == "nan"
    assert not (tmp_path / "out.csv").exists()


def test_a_rate_that_is_given_goes_before_times(tmp_path):
    path = table(tmp_path)
    assert mm.read_pose(path, rate=25.0).rate == 25.0
    assert mm.read_pose(path).rate == pytest.approx(30.0, rel=1e-4)
    rows = [f"{n},{n * 1e-7:.9f},a,,1,2,3,0,0,0,1,1" for n in range(4)]
    with pytest.raises(FileFormatError, match=r"table\.csv would have 1e\+07 poses a second"):
        mm.read_pose(table(tmp_path, rows=rows))


def test_names_that_are_none_are_said(tmp_path, capsys):
    path = table(tmp_path)
    for words, said in (
        ([tmp_path, "-o", tmp_path / "b.csv"], f"“{tmp_path}” is a folder; name a file in it."),
        (["", "-o", tmp_path / "b.csv"], "“” is no name of a recording"),
        ([path, "-o", ""], "“” is no name of a file to write"),
    ):
        for command in ("denoise", "convert"):
            assert run(command, *words) == 1
            assert said in capsys.readouterr().err


def test_what_an_amc_cannot_hold_is_said_first(tmp_path, shared_data, capsys):
    source, target = shared_data / "poses" / "02_03.amc", tmp_path / "x.amc"
    for words, said in (
        ([source, "--cmu"], "--cmu makes 31 segments that the skeleton"),
        ([source, "--network", "none.npz", "all-both"], "--network makes 17 joints that the skel"),
        ([table(tmp_path)], "needs a skeleton (ASF), which only a recording read from an AMC"),
    ):
        assert run("denoise", *words, "-o", target) == 1
        assert said in capsys.readouterr().err
        assert not target.exists()


def test_how_far_an_amc_is_from_what_was_restored_is_said(tmp_path, shared_data, capsys):
    (tmp_path / "02.asf").write_bytes((shared_data / "poses" / "02.asf").read_bytes())
    lines = (shared_data / "poses" / "02_03.amc").read_text().splitlines()
    starts = [n for n, line in enumerate(lines) if line.strip().isdigit()]
    for n in range(starts[40], starts[60]):
        lines[n] = "" if lines[n].startswith(("lhumerus", "lradius")) else lines[n]
    (tmp_path / "02_9.amc").write_text("\n".join(line for line in lines if line))
    assert run("denoise", tmp_path / "02_9.amc", "-o", tmp_path / "02_8.amc") == 0
    out = capsys.readouterr().out
    assert "Its bones are rigid: a joint is up to" in out
    assert run("denoise", tmp_path / "02_9.amc", "-o", tmp_path / "02_8.csv") == 0
    assert "bones are rigid" not in capsys.readouterr().out
