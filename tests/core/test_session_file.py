"""A review on disk: saving, the journal after a crash, the lock, a take that changed."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reviews import artifact, die, drive, make_take, proposal, state_of, verbs

from markermend.artifact import Artifact, Kind, Status
from markermend.errors import FileFormatError
from markermend.files import read, write
from markermend.repairs import propose
from markermend.review import file as session_file
from markermend.review.file import open_session, read_review
from markermend.review.left_at import LeftAt
from markermend.simulation import simulate_clean
from markermend.take import Take


@settings(max_examples=25, deadline=None)
@given(verbs, st.integers(0, 5), st.booleans())
def test_a_killed_review_comes_back_whole(tmp_path_factory, script, undos, save_half_way):
    folder = tmp_path_factory.mktemp("review")
    kept = open_session(make_take(), folder=folder)
    for i, step in enumerate(script):
        drive(kept.session, *step)
        if save_half_way and i == len(script) // 2:
            kept.save()
    for _ in range(undos):
        kept.session.undo()
    expected = state_of(kept.session), kept.session.history, kept.session.undone
    # The process dies here: the lock goes, nothing is saved.
    die(kept)
    again = open_session(make_take(), folder=folder)
    assert (state_of(again.session), again.session.history, again.session.undone) == expected
    again.close()


def test_a_line_cut_short_loses_only_that_step(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    for a in (artifact(), artifact("C")):
        kept.session.mark(a)
    journal = Path(kept._journal.name)
    die(kept)
    journal.write_bytes(journal.read_bytes()[:-20])
    again = open_session(make_take(), folder=tmp_path)
    assert [a.marker for a in again.session.artifacts] == ["A"]
    assert again.recovered == 1
    again.close()


def test_saved_review_opens_with_its_history(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    a = artifact()
    kept.session.add_detected([a], "paper")
    kept.session.repair([(a.id, proposal(a))])
    kept.session.undo()
    kept.save()
    kept.close()
    again = open_session(make_take(), folder=tmp_path)
    assert again.recovered == 0
    again.session.redo()
    assert again.session.artifact(a.id).status is Status.REPAIRED
    assert again.session.notes[a.id].error_mm == pytest.approx(0.4)
    again.close()


def test_what_came_by_itself_is_still_no_step_of_the_operators(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    a = artifact()
    assert not kept.session.undoable
    kept.session.add_detected([a], "sudden", by_itself=True)
    die(kept)
    again = open_session(make_take(), folder=tmp_path)
    again.save()
    again.close()
    last = open_session(make_take(), folder=tmp_path)
    assert not last.session.undoable
    last.session.set_status([a.id], Status.ACCEPTED)
    assert last.session.undoable
    last.session.undo()
    last.session.add_detected([a], "all kinds")
    assert last.session.undoable
    last.close()


def test_where_the_operator_stood_is_kept_and_outlives_a_crash_but_makes_no_files(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    kept.session.left_at = LeftAt(None, 3)
    kept.keep_left_at()
    kept.close()
    assert list(tmp_path.iterdir()) == []
    kept = open_session(make_take(), folder=tmp_path)
    a = artifact()
    kept.session.mark(a)
    kept.session.left_at = LeftAt(a.id, 7)
    kept.save()
    kept.session.left_at = LeftAt(a.id, 9)
    kept.keep_left_at()
    die(kept)
    assert read_review(make_take(), folder=tmp_path).left_at == LeftAt(a.id, 9)
    again = open_session(make_take(), folder=tmp_path)
    # To look elsewhere is no work that was interrupted.
    assert again.recovered == 0
    assert again.session.left_at == LeftAt(a.id, 9)
    again.save()
    again.close()
    path = next(tmp_path.glob("*.json"))
    document = json.loads(path.read_text())
    for spoilt, left in ((document["at"], LeftAt(a.id, 9)), ("nowhere", None), ({}, None)):
        path.write_text(json.dumps({**document, "at": spoilt}))
        assert read_review(make_take(), folder=tmp_path).left_at == left
    del document["at"]
    path.write_text(json.dumps(document))
    assert read_review(make_take(), folder=tmp_path).left_at is None


def test_second_opening_is_read_only(tmp_path):
    first = open_session(make_take(), folder=tmp_path)
    first.session.mark(artifact())
    second = open_session(make_take(), folder=tmp_path)
    assert second.read_only
    assert not first.read_only
    assert second.session.artifacts == first.session.artifacts
    second.save()
    assert not second.path.exists()
    first.close()


def test_a_changed_take_keeps_the_old_review_aside(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    kept.session.mark(artifact())
    kept.save()
    kept.close()
    take = make_take()
    positions = take.positions.copy()
    positions[0, 0, 0] += 1.0
    again = open_session(take.with_positions(positions, take.origin), folder=tmp_path)
    assert again.session.artifacts == ()
    assert "changed" in again.warning
    assert Path(str(again.path) + ".old").exists()
    again.close()


def test_a_changed_take_keeps_what_was_decided_on_unchanged_trajectories(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    a, c = artifact("A"), artifact("C")
    kept.session.add_detected([a, c], "paper")
    kept.session.repair([(c.id, proposal(c, 7.0)), (a.id, proposal(a, 7.0))])
    kept.save()
    kept.close()
    take = make_take()
    positions = take.positions.copy()
    positions[0, 0, 0] += 1.0
    again = open_session(take.with_positions(positions, take.origin), folder=tmp_path)
    assert [x.id for x in again.session.with_status(Status.REPAIRED)] == [c.id]
    assert (again.session.positions[30:40, 2] == 7.0).all()
    assert (again.session.positions[:, 0] == positions[:, 0]).all()
    again.close()


def test_a_moved_take_finds_its_review(tmp_path):
    old, new = tmp_path / "old", tmp_path / "new"
    old.mkdir()
    new.mkdir()
    kept = open_session(make_take(), folder=old)
    kept.session.mark(artifact())
    kept.save()
    kept.close()
    again = open_session(make_take(), folder=new)
    assert [a.marker for a in again.session.artifacts] == ["A"]
    assert "goes on here" in again.warning
    # It is written at the new place at once, so that a crash loses nothing of it.
    die(again)
    third = open_session(make_take(), folder=new)
    assert [a.marker for a in third.session.artifacts] == ["A"]
    third.close()


@pytest.mark.parametrize(
    "text", ["", "{}", "[1]", '{"format": "markermend session", "version": 9}']
)
def test_a_strange_session_file_is_refused_in_one_sentence(tmp_path, text):
    kept = open_session(make_take(), folder=tmp_path)
    kept.save()
    path = kept.path
    kept.close()
    path.write_text(text)
    with pytest.raises(FileFormatError, match=r"Markermend"):
        open_session(make_take(), folder=tmp_path)
    # The refused file is untouched and the lock is free again.
    assert path.read_text() == text
    with pytest.raises(FileFormatError):
        open_session(make_take(), folder=tmp_path)


def test_closing_an_unchanged_review_leaves_no_files(tmp_path):
    open_session(make_take(), folder=tmp_path).close()
    assert list(tmp_path.iterdir()) == []


def test_session_json_is_strict_json(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    kept.session.mark(Artifact("A", "xyz", 1, 2, Kind.GAP))
    kept.save()
    json.loads(kept.path.read_text(), parse_constant=lambda c: pytest.fail(f"{c} in the file"))
    kept.close()


def stored_take() -> Take:
    """The take that the stored sessions of every version belong to."""
    positions = np.arange(40 * 2 * 3, dtype=np.float64).reshape(40, 2, 3)
    positions[5:9, 1] = np.nan
    return Take(positions, ("LHEE", "RHEE"), 50.0)


def stored(tmp_path, version):
    """The stored review of a version, opened."""
    text = (Path(__file__).parent / "sessions" / f"v{version}.json").read_text(encoding="utf-8")
    (tmp_path / "take.markermend.json").write_text(text, encoding="utf-8")
    kept = open_session(stored_take(), folder=tmp_path)
    assert kept.warning == ""
    return kept


def test_a_review_of_version_1_keeps_opening(tmp_path):
    kept = stored(tmp_path, 1)
    statuses = [(a.marker, a.kind, a.status) for a in kept.session.artifacts]
    assert statuses == [
        ("RHEE", Kind.GAP, Status.REPAIRED),
        ("LHEE", Kind.STEP, Status.REJECTED),
        ("LHEE", Kind.SLOW, Status.ACCEPTED),
        ("RHEE", Kind.PEAK, Status.PENDING),
    ]
    assert (kept.session.positions[5:9, 1] == 2.5).all()
    assert kept.session.undone == ("Accept peak on RHEE",)
    kept.close()


def test_a_review_of_version_2_keeps_opening(tmp_path):
    kept = stored(tmp_path, 2)
    assert kept.session.take.labels == ("LHEE", "RTOE")
    statuses = [(a.marker, a.kind, a.status, a.note) for a in kept.session.artifacts]
    assert statuses == [
        ("RTOE", Kind.GAP, Status.REPAIRED, ""),
        ("LHEE", Kind.STEP, Status.PENDING, "the heel was bumped"),
        ("LHEE", Kind.GAP, Status.PENDING, ""),
    ]
    assert np.isnan(kept.session.positions[30:34, 0]).all()
    assert (kept.session.positions[5:9, 1] == 2.5).all()
    assert kept.session.undone == ("Reject step on LHEE",)
    kept.close()


def test_a_review_of_version_3_keeps_opening(tmp_path):
    kept = stored(tmp_path, 3)
    assert kept.session.region == (10, 30)
    assert [a.kind for a in kept.session.listed] == [Kind.STEP]
    assert len(kept.session.artifacts) == 2
    assert kept.session.undone == ("Review the whole take",)
    kept.close()


def test_a_review_in_a_folder_that_became_read_only_goes_on_in_the_users_own(tmp_path, monkeypatch):
    monkeypatch.setattr("platformdirs.user_data_path", lambda *_, **__: tmp_path / "own")
    (tmp_path / "own").mkdir()
    shared = tmp_path / "shared"
    shared.mkdir()
    first = open_session(make_take(), folder=shared)
    first.session.mark(artifact())
    first.save()
    first.close()
    really = session_file.open_locked

    def locked(path):
        if path.parent == shared:
            raise PermissionError(13, "Permission denied")
        return really(path)

    monkeypatch.setattr(session_file, "open_locked", locked)
    again = open_session(make_take(), folder=shared)
    assert not again.read_only
    assert len(again.session.artifacts) == 1
    assert again.path.parent == tmp_path / "own" / "sessions"
    again.close()


@pytest.mark.parametrize("spoilt", [None, "x", [1], {}])
@pytest.mark.parametrize("part", ["source", "generation", "done", "undone"])
def test_a_review_with_a_spoilt_part_is_refused_in_one_sentence(tmp_path, part, spoilt):
    kept = open_session(make_take(), folder=tmp_path)
    kept.session.mark(artifact())
    kept.save()
    kept.close()
    document = json.loads(kept.path.read_text()) | {part: spoilt}
    kept.path.write_text(json.dumps(document))
    for reads in (open_session, read_review):
        with pytest.raises(FileFormatError, match="move it away"):
            reads(make_take(), folder=tmp_path)


def test_a_review_with_a_broken_step_is_refused_in_one_sentence(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    kept.session.mark(artifact())
    kept.save()
    kept.close()
    document = json.loads(kept.path.read_text(encoding="utf-8"))
    del document["done"][0]["edit"]
    kept.path.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(FileFormatError, match="move it away"):
        open_session(make_take(), folder=tmp_path)


def test_a_swap_of_three_is_kept_exported_and_taken_back(tmp_path):
    names = ("LWRA", "LWRB", "LFIN")
    clean = simulate_clean(duration_s=3.0, rate=100.0, seed=3, labels=names)
    mixed = clean.positions.copy()
    mixed[100:140] = mixed[100:140][:, [2, 0, 1]]
    write(Take(mixed, clean.labels, clean.rate), tmp_path / "mixed.c3d")
    take = read(tmp_path / "mixed.c3d")
    swap = Artifact(
        "LWRA",
        "xyz",
        100,
        140,
        Kind.STEP,
        counterpart="LWRB",
        further_counterparts=("LFIN",),
    )
    kept = open_session(take, folder=tmp_path)
    kept.session.add_detected([swap], "joint")
    kept.session.repair([(swap.id, propose(take, swap))])
    kept.save()
    kept.close()
    again = open_session(take, folder=tmp_path)
    (found,) = again.session.artifacts
    assert found == swap.with_status(Status.REPAIRED)
    write(again.session.take, tmp_path / "clean.c3d")
    exported = read(tmp_path / "clean.c3d").positions
    assert np.allclose(exported, clean.positions, atol=1e-3)
    again.session.set_status([swap.id], Status.PENDING)
    assert np.array_equal(again.session.positions, take.positions)
    again.close()


def test_what_was_exported_is_known_when_the_review_is_opened_again(tmp_path):
    take = make_take()
    first = open_session(take, folder=tmp_path)
    a = artifact()
    first.session.add_detected([a], "paper")
    first.session.set_status([a.id], Status.REJECTED)
    first.session.mark_exported()
    first.save()
    first.close()
    again = open_session(take, folder=tmp_path)
    assert again.session.exported_at == 2
    again.session.set_status([a.id], Status.ACCEPTED)
    assert not again.session.exported
    again.close()
    later = open_session(take, folder=tmp_path)
    assert not later.session.exported
    later.session.undo()
    assert later.session.exported
    later.close()
