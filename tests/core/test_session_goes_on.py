"""A review that goes on: after a crash and a rename, after an export over the original."""

from __future__ import annotations

import shutil

import numpy as np
from reviews import artifact, die, make_take, proposal

from markermend.artifact import Artifact, Kind, Status
from markermend.files import read, write
from markermend.repairs.registry import Repair
from markermend.review import hand
from markermend.review.file import open_session, read_review
from markermend.review.place import file_hash
from markermend.review.session import Session
from markermend.review.step import stretch
from markermend.take import Take


def written(tmp_path, name: str = "a.c3d") -> Take:
    write(make_take(), tmp_path / name)
    return read(tmp_path / name)


def test_a_take_renamed_after_a_crash_finds_its_journal(tmp_path):
    kept = open_session(written(tmp_path))
    kept.session.mark(artifact())
    kept.session.set_status([kept.session.artifacts[0].id], Status.ACCEPTED)
    die(kept)
    (tmp_path / "a.c3d").rename(tmp_path / "b.c3d")
    again = open_session(read(tmp_path / "b.c3d"))
    assert [a.status for a in again.session.artifacts] == [Status.ACCEPTED]
    assert again.recovered == 2
    assert "a.c3d" in again.warning
    # What is forgotten does not come back.
    again.discard()
    third = open_session(read(tmp_path / "b.c3d"))
    assert third.session.artifacts == ()
    third.close()


def test_a_copy_does_not_take_over_what_is_reviewed_beside_it(tmp_path):
    kept = open_session(written(tmp_path))
    kept.session.mark(artifact())
    shutil.copy(tmp_path / "a.c3d", tmp_path / "b.c3d")
    assert not read_review(read(tmp_path / "b.c3d")).begun
    other = open_session(read(tmp_path / "b.c3d"))
    assert other.session.artifacts == ()
    other.close()
    kept.close()


def test_a_moved_take_takes_along_what_only_the_journal_holds(tmp_path):
    kept = open_session(written(tmp_path))
    kept.session.mark(artifact())
    kept.save()
    kept.session.mark(artifact("C"))
    die(kept)
    (tmp_path / "other").mkdir()
    shutil.move(tmp_path / "a.c3d", tmp_path / "other" / "b.c3d")
    again = open_session(read(tmp_path / "other" / "b.c3d"))
    assert {a.marker for a in again.session.artifacts} == {"A", "C"}
    again.close()


def test_what_a_crash_left_of_a_review_stays_where_a_copy_was_reviewed_meanwhile(tmp_path):
    kept = open_session(written(tmp_path))
    kept.session.mark(artifact())
    die(kept)
    (tmp_path / "other").mkdir()
    shutil.copy(tmp_path / "a.c3d", tmp_path / "other" / "a.c3d")
    other = open_session(read(tmp_path / "other" / "a.c3d"))
    other.session.mark(artifact("C"))
    other.save()
    other.close()
    assert [a.marker for a in read_review(read(tmp_path / "a.c3d")).artifacts] == ["A"]
    again = open_session(read(tmp_path / "a.c3d"))
    assert [a.marker for a in again.session.artifacts] == ["A"]
    assert (again.recovered, again.warning) == (1, "")
    again.close()
    assert [a.marker for a in read_review(read(tmp_path / "a.c3d")).artifacts] == ["A"]


def test_an_export_over_the_original_keeps_what_is_open(tmp_path):
    take = written(tmp_path)
    kept = open_session(take)
    session = kept.session
    done, left, other = artifact(), artifact(start=45, stop=55), artifact("C")
    session.add_detected([done, left, other], "paper")
    session.repair([(done.id, proposal(done))])
    session.set_status([other.id], Status.REJECTED)
    session.set_region((10, 58))
    write(session.take, tmp_path / "a.c3d", overwrite=True)
    session.mark_exported()
    kept.wrote = file_hash(tmp_path / "a.c3d")
    kept.save()
    kept.close()
    again = open_session(read(tmp_path / "a.c3d"))
    found = {(a.marker, a.start): a.status for a in again.session.artifacts}
    assert found == {("A", 45): Status.PENDING, ("C", 30): Status.REJECTED}
    assert again.session.region == (10, 58)
    assert "goes on here" in again.warning
    assert again.session.exported
    assert not again.session.undoable
    # The detector's own flags may be found anew; what was decided stays.
    again.session.add_detected([], "paper")
    assert {a.marker for a in again.session.artifacts} == {"C"}
    assert (tmp_path / "a.c3d.markermend.json.old").exists()
    again.close()


def test_an_export_over_the_original_of_which_nothing_is_open_begins_anew(tmp_path):
    kept = open_session(written(tmp_path))
    only = artifact()
    kept.session.add_detected([only], "paper")
    kept.session.repair([(only.id, proposal(only))])
    write(kept.session.take, tmp_path / "a.c3d", overwrite=True)
    kept.wrote = file_hash(tmp_path / "a.c3d")
    kept.save()
    kept.close()
    again = open_session(read(tmp_path / "a.c3d"))
    assert not again.session.begun
    assert again.session.exported
    again.close()


def test_a_mix_up_repaired_on_one_marker_leaves_the_others_open():
    session = Session(make_take())
    swap = Artifact(
        "A", "xyz", 30, 40, Kind.STEP, counterpart="B", further_counterparts=("C",), why="swapped"
    )
    session.add_detected([swap], "joint")
    alone = proposal(replace_partners(swap))
    session.repair([(swap.id, alone)])
    found = {a.marker: (a.status, a.counterpart) for a in session.artifacts}
    assert found == {
        "A": (Status.REPAIRED, "B"),
        "B": (Status.PENDING, None),
        "C": (Status.PENDING, None),
    }
    assert all("mix-up with A" in a.why for a in session.artifacts if a.marker != "A")
    assert stretch(session.steps[0][-1]) == (30, 40)
    session.set_status([swap.id], Status.PENDING)
    assert [a.markers for a in session.artifacts] == [("A", "B", "C")]
    assert session.positions.tobytes() == session.original.positions.tobytes()
    session.undo()
    decided = next(a for a in session.artifacts if a.marker == "B")
    session.set_status([decided.id], Status.ACCEPTED)
    session.repair([(swap.id, alone)])
    assert {a.marker: a.status for a in session.artifacts} == {
        "A": Status.REPAIRED,
        "B": Status.ACCEPTED,
        "C": Status.PENDING,
    }


def test_what_was_marked_on_the_other_marker_of_a_mix_up_stays():
    session = Session(make_take())
    swap = Artifact("A", "xyz", 30, 40, Kind.STEP, counterpart="B")
    own = Artifact("B", "xyz", 30, 40, Kind.STEP, note="mine")
    session.add_detected([swap, own], "joint")
    session.repair([(own.id, proposal(own))])
    session.repair([(swap.id, proposal(replace_partners(swap)))])
    assert [a.status for a in session.artifacts] == [Status.REPAIRED] * 2
    assert session.artifact(own.id).note == "mine"
    session.set_status([own.id], Status.REJECTED)
    assert session.positions[30:40, 1].tolist() == session.original.positions[30:40, 1].tolist()


def replace_partners(swap: Artifact) -> Artifact:
    """The same on its own marker."""
    return Artifact(swap.marker, swap.axes, swap.start, swap.stop, swap.kind)


def test_reasons_stay_true_when_frames_or_class_are_changed_by_hand():
    take = make_take()
    positions = take.positions.copy()
    positions[30:50, 0] = np.nan
    session = Session(Take(positions, take.labels, take.rate))
    gap = Artifact("A", "xyz", 30, 50, Kind.GAP, why="not seen for 20 frames (200 ms)")
    session.add_detected([gap], "joint")
    hand.split(session, gap.id, 38)
    assert [a.why.split(" (")[0] for a in session.artifacts] == [
        "not seen for 8 frames",
        "not seen for 12 frames",
    ]
    hand.nudge(session, gap.id, stop=-2)
    assert session.artifact(gap.id).why.startswith("not seen for 6 frames")
    session.change(gap.id, kind=Kind.SLOW)
    assert session.artifact(gap.id).why == "called slow by hand"


def test_a_gap_that_was_in_the_file_is_not_said_to_be_made_by_hand():
    take = make_take()
    positions = take.positions.copy()
    positions[30:60, 0] = np.nan
    positions[:30, 1] = positions[50:, 1] = np.nan
    session = Session(Take(positions, take.labels, take.rate))
    gap = Artifact("A", "xyz", 30, 60, Kind.GAP, why="not seen for 30 frames")
    session.add_detected([gap], "joint")
    hand.move(session, "B", "A", 30, 50)
    (rest,) = [a for a in session.artifacts if a.marker == "A"]
    assert (rest.start, rest.stop) == (50, 60)
    assert "by hand" not in rest.why
    assert isinstance(proposal(rest), Repair)
