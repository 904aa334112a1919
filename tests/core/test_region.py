"""The region of interest: what is asked about, counted, repaired and written."""

from __future__ import annotations

import numpy as np
import pytest
from command_line import run, strict, write_swing

import markermend as mm
from markermend.artifact import Artifact, Kind, Status
from markermend.errors import DataError
from markermend.poses.skeleton import Movement
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
    assert ids(session.with_status(Status.PENDING)) == ids([EDGE, INSIDE])
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


@pytest.mark.parametrize("region", [(5, 5), (-1, 4), (90, 101), (8, 3)])
def test_frames_that_are_none_or_not_there_are_refused(session, region):
    with pytest.raises(DataError, match="region of interest"):
        session.set_region(region)
    assert session.region is None


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
    assert "Only frames 31–70 were reviewed" in page
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


def test_a_part_of_a_movement_is_no_files_any_more():
    whole = Movement(None, {"root": np.arange(12.0).reshape(6, 2)}, 6, file="there.amc")
    part = whole.part(2, 5)
    assert (part.frames, part.file) == (3, None)
    np.testing.assert_array_equal(part.channels["root"], [[4, 5], [6, 7], [8, 9]])


# The command line


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    path = tmp_path_factory.mktemp("take") / "swing.c3d"
    write_swing(path)
    return path


def test_detect_lists_what_reaches_into_the_frames(recording, capsys):
    assert run("detect", recording, "--no-slow", "--json", "-", "--frames", 141, 155) == 0
    found = {(a["marker"], a["kind"]) for a in strict(capsys.readouterr().out)["artifacts"]}
    assert found == {("TOP1", "gap")}


def test_clean_and_fill_leave_the_rest(recording, tmp_path, capsys):
    before = mm.read(recording)
    out = tmp_path / "c.c3d"
    assert run("clean", recording, "-o", out, "--no-slow", "--frames", 250, 350) == 0
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
    assert not (tmp_path / "no.c3d").exists()
