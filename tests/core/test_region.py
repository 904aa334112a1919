"""The region of interest: what is asked about, counted, repaired and written."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from command_line import run, strict, write_swing

import markermend as mm
from markermend.artifact import Artifact, Kind, Status
from markermend.errors import DataError, ExportError
from markermend.report import review_report, reviewed
from markermend.review.file import open_session
from markermend.review.session import Session
from markermend.review.standing import standings
from markermend.take import Take

EARLY, EDGE, INSIDE, LATE = (
    Artifact("A", "x", 2, 6, Kind.PEAK, 0.9),
    Artifact("A", "x", 18, 21, Kind.NOISE, 0.9),
    Artifact("B", "y", 30, 40, Kind.STEP, 0.9),
    Artifact("A", "x", 60, 70, Kind.STEP, 0.9),
)


@pytest.fixture
def take():
    positions = np.random.default_rng(2).normal(0, 100, (100, 2, 3))
    positions[10:30, 0] = np.nan
    return Take(positions, ("A", "B"), 100.0, first_frame=11)


@pytest.fixture
def session(take):
    made = Session(take)
    made.add_detected((EARLY, EDGE, INSIDE, LATE), "test")
    return made


def ids(artifacts):
    return [a.id for a in artifacts]


def test_only_what_reaches_into_it_is_asked_about(session):
    session.set_region((20, 60))
    assert session.history[-1] == "Review frames 31–70 only"
    assert ids(session.listed) == ids([EDGE, INSIDE])
    assert ids(session.listed_with(Status.PENDING)) == ids([EDGE, INSIDE])
    assert session.pace.total == 2
    assert len(session.artifacts) == 4
    session.undo()
    assert session.region is None
    assert session.listed == session.artifacts
    session.redo()
    session.set_region((0, 100))
    assert session.region is None
    assert session.history[-1] == "Review the whole take"


def test_choosing_it_is_no_work_that_waits_to_be_exported(session):
    session.set_region((20, 60))
    assert session.exported
    session.set_status([INSIDE.id], Status.REJECTED)
    assert not session.exported


@pytest.mark.parametrize(
    "region", [(5, 5), (-1, 4), (90, 101), (8, 3), (1.5, 20), (1, 2, 3), ("a", "b"), (1,)]
)
def test_frames_that_are_none_or_not_there_are_refused(session, region):
    with pytest.raises(DataError, match=r"region of interest"):
        session.set_region(region)
    assert session.region is None


def test_numbers_of_numpy_are_kept_as_plain_ones(tmp_path, take):
    kept = open_session(take, folder=tmp_path)
    kept.session.set_region((np.int64(20), np.int32(60)))
    kept.save()
    kept.close()
    again = open_session(take, folder=tmp_path)
    assert again.session.region == (20, 60)
    again.close()


def test_the_same_region_is_no_step(session):
    session.set_region((20, 60))
    steps = len(session.history)
    session.set_region((20, 60))
    assert len(session.history) == steps


def test_shares_are_counted_in_it(session):
    session.set_region((20, 60))
    whole, a, _ = standings(
        session.original, session.take, session.listed, session.notes, session.region
    )
    assert a.gap_before == pytest.approx(10 / 40)
    assert whole.gap_now == pytest.approx(10 / 80)
    assert sum(whole.open.values()) == 2


def test_the_report_tells_it_and_leaves_out_the_rest(session):
    session.set_region((20, 60))
    page = review_report(reviewed(session), name="t.c3d")
    assert "This is about frames 31–70 only" in page
    assert '"region": [20, 60]' in page or '"region":[20,60]' in page
    assert "12.5" in page
    assert len(reviewed(session).done) == 2


def test_the_record_of_an_export_is_of_what_is_exported(session):
    for a in (EARLY, INSIDE):
        session.set_status([a.id], Status.REPAIRED)
    assert len(session.repairs_in_words()) == 2
    (only,) = session.repairs_in_words((20, 60))
    assert only.startswith("step B")


def test_a_take_that_changed_keeps_it_where_a_trajectory_is_the_same(tmp_path, take):
    path = tmp_path / "t.c3d"
    mm.write(take, path)
    kept = open_session(mm.read(path))
    kept.session.set_region((20, 60))
    kept.save()
    kept.close()
    other = np.array(take.positions)
    other[50, 1] += 1.0
    mm.write(Take(other, take.labels, take.rate, take.first_frame), path)
    again = open_session(mm.read(path))
    assert "has changed" in again.warning
    assert again.session.region == (20, 60)
    again.close()


# Writing a part


def test_frames_of_a_c3d_are_written_as_they_were(tmp_path, shared_data):
    path = next(p for p in sorted(shared_data.rglob("*.c3d")) if mm.read(p).analog is not None)
    whole = mm.read(path)
    mm.write(whole, tmp_path / "part.c3d", frames=(10, 40))
    part = mm.read(tmp_path / "part.c3d")
    assert (part.frames, part.first_frame) == (30, whole.first_frame + 10)
    np.testing.assert_array_equal(part.positions, whole.positions[10:40])
    each = len(whole.analog.values) // whole.frames
    np.testing.assert_array_equal(part.analog.values, whole.analog.values[10 * each : 40 * each])
    assert part.events == whole.events


def test_samples_that_differ_are_counted_in_what_is_written(tmp_path, take):
    mm.write(take, tmp_path / "t.c3d")
    read = mm.read(tmp_path / "t.c3d")
    gap = Artifact("A", "xyz", 10, 30, Kind.GAP, 1.0)
    filled = mm.repair(read, (gap,), method="linear")
    assert mm.write(filled, tmp_path / "all.c3d").samples == 20
    assert mm.write(filled, tmp_path / "part.c3d", frames=(20, 60)).samples == 10
    with pytest.raises(DataError, match="not a part"):
        mm.write(filled, tmp_path / "no.c3d", frames=(20, 101))
    assert not (tmp_path / "no.c3d").exists()


@pytest.mark.parametrize("ending", [".csv", ".bvh", ".amc"])
def test_poses_of_a_recording_are_written_as_they_were(tmp_path, shared_data, ending):
    source = shared_data / "poses" / "02_01.amc"
    skeleton = source.with_name("02.asf") if ending == ".amc" else None
    for name, frames in (("all", None), ("part", (20, 50))):
        mm.write(mm.read(source), tmp_path / f"{name}{ending}", frames=frames)
    whole, part = (
        mm.read_pose(tmp_path / f"{name}{ending}", skeleton=skeleton) for name in ("all", "part")
    )
    assert (part.frames, part.joints) == (30, whole.joints)
    np.testing.assert_allclose(part.positions, whole.positions[20:50], atol=2e-3)
    np.testing.assert_allclose(part.rotations, whole.rotations[20:50], atol=2e-5)


def test_a_table_of_joints_keeps_its_numbers(tmp_path):
    lines = ["frame,joint,x,y,z"]
    lines += [f"{f},{j},{f + 0.123456789},2,3" for f in range(6) for j in ("waist", "torso")]
    (tmp_path / "t.csv").write_text("\n".join(lines) + "\n")
    mm.write(mm.read(tmp_path / "t.csv"), tmp_path / "p.csv", frames=(2, 4))
    rows = (tmp_path / "p.csv").read_text().splitlines()
    assert len(rows) == 1 + 4
    assert "2.123456789" in rows[1]
    assert "3.123456789" in rows[-1]


def test_a_part_in_which_nothing_was_seen_does_not_show_what_was_left_in_the_file(
    tmp_path, shared_data
):
    whole = mm.read(shared_data / "formats" / "ADemo1_rewrite_c3d_pc_float.c3d")
    unseen = int(np.flatnonzero(~whole.present.any(axis=1))[0])
    mm.write(whole, tmp_path / "p.c3d", frames=(unseen, unseen + 1))
    assert not mm.read(tmp_path / "p.c3d").present.any()


def test_rotations_are_not_lost_unasked(tmp_path, shared_data):
    whole = mm.read(shared_data / "gait" / "C3DRotationExample.c3d")
    with pytest.raises(ExportError, match="rotations"):
        mm.write(whole, tmp_path / "p.c3d", frames=(0, 100))
    assert not (tmp_path / "p.c3d").exists()
    mm.write(whole, tmp_path / "w.c3d", frames=(0, whole.frames))
    assert (tmp_path / "w.c3d").read_bytes() == whole.source.path.read_bytes()


def test_wrong_counts_of_a_header_are_put_right_in_a_part(tmp_path, shared_data):
    whole = mm.read(shared_data / "formats" / "MotionMonitorC3D.c3d")
    mm.write(whole, tmp_path / "p.c3d", frames=(3, 4))
    part = mm.read(tmp_path / "p.c3d")
    assert part.analog.rate == whole.analog.rate
    each = round(whole.analog.rate / whole.rate)
    np.testing.assert_array_equal(part.analog.values, whole.analog.values[3 * each : 4 * each])


def test_frame_numbers_that_a_header_has_no_room_for_are_told_in_parameters(tmp_path):
    positions = np.zeros((70_000, 1, 3))
    positions[:, 0, 0] = np.arange(1, 70_001)
    mm.write(Take(positions, ("A",), 100.0), tmp_path / "long.c3d")
    raw = (tmp_path / "long.c3d").read_bytes()
    # A file without the group, as some systems write them.
    (tmp_path / "bare.c3d").write_bytes(raw.replace(b"TRIAL", b"TRIEL"))
    mm.write(mm.read(tmp_path / "bare.c3d"), tmp_path / "p.c3d", frames=(66_000, 66_010))
    part = mm.read(tmp_path / "p.c3d")
    assert part.first_frame == 66_001
    np.testing.assert_array_equal(part.positions[:, 0, 0], positions[66_000:66_010, 0, 0])


def test_a_pose_alone_hangs_together_as_the_whole(tmp_path, shared_data):
    take = mm.read(shared_data / "poses" / "02_03.amc")
    for name, frames in (("all", None), ("one", (20, 21))):
        mm.write(take, tmp_path / f"{name}.bvh", frames=frames)
    texts = [(tmp_path / f"{name}.bvh").read_text() for name in ("all", "one")]
    assert texts[0].split("MOTION")[0] == texts[1].split("MOTION")[0]
    whole, one = (mm.read_pose(tmp_path / f"{name}.bvh") for name in ("all", "one"))
    np.testing.assert_allclose(one.positions[0], whole.positions[20], atol=2e-3)


def test_a_part_of_a_recording_with_gaps_is_written_where_it_has_none(tmp_path, shared_data):
    pose = mm.read_pose(shared_data / "poses" / "02_03.amc")
    confidence = np.array(pose.confidence)
    confidence[50, 3] = 0.0
    mm.write_pose(pose.with_samples(pose.positions, pose.rotations, confidence), tmp_path / "t.csv")
    mm.write(mm.read(tmp_path / "t.csv"), tmp_path / "p.bvh", frames=(0, 40))
    assert mm.read_pose(tmp_path / "p.bvh").frames == 40


@pytest.mark.parametrize("ending", [".trc", ".csv"])
def test_time_goes_on_in_tables(tmp_path, take, ending):
    mm.write(take, tmp_path / f"p{ending}", frames=(20, 23))
    rows = (tmp_path / f"p{ending}").read_text().splitlines()[-3:]
    cells = [row.replace("\t", ",").split(",")[:2] for row in rows]
    assert [(int(f), float(t)) for f, t in cells] == [(31, 0.2), (32, 0.21), (33, 0.22)]
    part = mm.read(tmp_path / f"p{ending}")
    assert (part.rate, part.first_frame, part.frames) == (100.0, 31, 3)


def test_a_row_alone_tells_no_rate(tmp_path, take):
    mm.write(take, tmp_path / "p.csv", frames=(30, 31))
    (said,) = mm.read(tmp_path / "p.csv").warnings
    assert "one row" in said


def test_frames_below_zero_are_no_c3d(tmp_path, take):
    with pytest.raises(ExportError, match="begins with frame -3"):
        mm.write(replace(take, first_frame=-3), tmp_path / "n.c3d")
    mm.write(replace(take, first_frame=-3), tmp_path / "n.csv")


# The command line


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    path = tmp_path_factory.mktemp("take") / "swing.c3d"
    write_swing(path)
    return path


def test_detect_lists_what_reaches_into_the_frames(recording, capsys):
    assert run("detect", recording, "--no-slow", "--json", "-", "--frames", 141, 155) == 0
    told = strict(capsys.readouterr().out)
    assert {(a["marker"], a["kind"]) for a in told["artifacts"]} == {("TOP1", "gap")}
    assert told["region"] == [140, 155]
    assert run("detect", recording, "--no-slow", "--frames", 10, 12) == 0
    assert "Nothing is damaged in these frames" in capsys.readouterr().out


def test_clean_and_fill_leave_the_rest(recording, tmp_path, capsys):
    before = mm.read(recording)
    out = tmp_path / "c.c3d"
    page, listed = tmp_path / "c.html", tmp_path / "c.json"
    words = ("clean", recording, "-o", out, "--no-slow", "--frames", 250, 350)
    assert run(*words, "--report", page, "--json", listed) == 0
    assert "This is about frames 250–350 only" in page.read_text(encoding="utf-8")
    assert strict(listed.read_text(encoding="utf-8"))["region"] == [249, 350]
    after = mm.read(out)
    assert not after.present[150:160, after.index("TOP1")].any()
    assert after.positions[300, 2, 2] != before.positions[300, 2, 2]
    assert run("fill", recording, "-o", tmp_path / "f.c3d", "--frames", 1, 150) == 0
    assert not mm.read(tmp_path / "f.c3d").present[150:160, 1].any()
    assert run("fill", recording, "-o", tmp_path / "g.c3d", "--frames", 1, 151) == 0
    assert mm.read(tmp_path / "g.c3d").present[150:160, 1].all()
    capsys.readouterr()


def test_convert_writes_a_part(recording, tmp_path, capsys):
    out = tmp_path / "p.c3d"
    assert run("convert", recording, "-o", out, "--frames", 101, 200) == 0
    assert "100 frames" in capsys.readouterr().out
    part = mm.read(out)
    assert (part.frames, part.first_frame) == (100, 101)
    assert run("convert", recording, "-o", tmp_path / "no.c3d", "--frames", 300, 500) == 1
    assert "has frames 1 to 400" in capsys.readouterr().err
    assert run("convert", recording, "-o", tmp_path / "no.c3d", "--frames", 200, 100) == 2
    assert "200 comes after 100" in capsys.readouterr().err
    assert not (tmp_path / "no.c3d").exists()
