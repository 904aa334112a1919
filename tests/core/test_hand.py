"""Work by hand: what it does to samples, artifacts and names, and what an export holds of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reviews import artifact, die, make_take, proposal, state_of

import markermend as mm
from markermend.artifact import Kind, Status
from markermend.errors import DataError
from markermend.files import read, write
from markermend.patch import Patch
from markermend.repairs.registry import Repair
from markermend.review import hand
from markermend.review.file import open_session
from markermend.review.session import Session
from markermend.review.step import stretch
from markermend.take import Origin, Take


def of(session, marker):
    return [(a.start, a.stop, a.kind, a.status) for a in session.artifacts if a.marker == marker]


def unlabelled_take() -> Take:
    """C is missing for a while, in which an unlabelled trajectory is seen where it should be."""
    rng = np.random.default_rng(7)
    positions = rng.normal(0, 100, (50, 3, 3)).astype(np.float32).astype(np.float64)
    positions[:15, 2] = positions[25:, 2] = np.nan
    positions[15:25, 1] = np.nan
    return Take(positions, ("A", "C", "*3"), 100.0)


def test_cutting_opens_a_gap_that_joins_the_one_beside_it():
    session = Session(make_take())
    gap = artifact("B", start=10, stop=20, kind=Kind.GAP)
    inside = artifact("B", start=21, stop=24)
    session.add_detected([gap, inside], "paper")
    before = state_of(session)
    hand.cut(session, "B", 20, 28)
    assert np.isnan(session.positions[20:28, 1]).all()
    assert (session.origin[20:28, 1] == Origin.MISSING).all()
    assert of(session, "B") == [(10, 28, Kind.GAP, Status.PENDING)]
    assert session.history[-1] == "Cut B in frames 25–32"
    session.undo()
    assert state_of(session) == before
    with pytest.raises(DataError, match="nothing to cut"):
        hand.cut(session, "B", 12, 15)


def test_what_a_repair_returns_to_is_hand_work_where_there_is_some_and_else_what_was_read():
    session = Session(make_take())
    read, frames = session.original.positions, session.original.frames
    rng, column = np.random.default_rng(4), session.original.index("B")
    wanted = [read[:, column].copy()]
    for start in rng.integers(0, frames - 8, 20).tolist():
        stop = start + 8
        if np.isnan(wanted[-1][start:stop, 0]).all():
            continue
        hand.cut(session, "B", start, stop)
        wanted.append(wanted[-1].copy())
        wanted[-1][start:stop] = np.nan
    assert len(wanted) > 5
    base = session.state.base
    while True:
        np.testing.assert_array_equal(base.read(column, 0, frames)[0], wanted.pop())
        low, high = sorted(rng.integers(0, frames, 2).tolist())
        whole = base.read(column, 0, frames)
        for part, every in zip(base.read(column, low, high), whole, strict=True):
            np.testing.assert_array_equal(part, every[low:high])
        if not wanted:
            break
        session.undo()
    np.testing.assert_array_equal(whole[0], read[:, column])
    np.testing.assert_array_equal(whole[1], session.original.origin[:, column])
    for i in set(range(session.original.markers)) - {column}:
        np.testing.assert_array_equal(base.read(i, 0, frames)[0], read[:, i])


def test_a_filled_cut_that_is_reopened_is_cut_again():
    session = Session(make_take())
    hand.cut(session, "A", 30, 40)
    (gap,) = session.artifacts
    session.repair([(gap.id, proposal(gap))])
    assert (session.origin[30:40, 0] == Origin.FILLED).all()
    session.set_status([gap.id], Status.PENDING)
    assert np.isnan(session.positions[30:40, 0]).all()
    assert (session.origin[30:40, 0] == Origin.MISSING).all()


def test_merging_an_unlabelled_trajectory_closes_the_gap_and_the_export_is_without_it(tmp_path):
    take = unlabelled_take()
    write(take, tmp_path / "in.c3d")
    source = read(tmp_path / "in.c3d")
    session = Session(source)
    session.add_detected([artifact("C", start=15, stop=25, kind=Kind.GAP)], "paper")
    hand.merge(session, "*3", "C")
    assert session.history[-1] == "Merge *3 into C"
    assert session.artifacts == ()
    assert (session.origin[15:25, 1] == Origin.EDITED).all()
    write(hand.without_emptied(session.take, session.original), tmp_path / "out.c3d")
    result = mm.read(tmp_path / "out.c3d")
    assert result.labels == ("A", "C")
    assert np.array_equal(result.positions[15:25, 1], source.positions[15:25, 2])
    assert np.array_equal(result.positions[:, 0], source.positions[:, 0])
    session.undo()
    assert np.array_equal(session.positions, source.positions, equal_nan=True)


def test_what_is_moved_leaves_a_gap_and_never_overwrites():
    session = Session(make_take())
    hand.move(session, "A", "B", 10, 20)
    assert np.array_equal(session.positions[10:20, 1], session.original.positions[10:20, 0])
    assert of(session, "A") == [(10, 20, Kind.GAP, Status.PENDING)]
    with pytest.raises(DataError, match="own in 5 of these frames"):
        hand.move(session, "C", "B", 15, 20)
    with pytest.raises(DataError, match="nothing to take over"):
        hand.move(session, "A", "C", 12, 18)
    with pytest.raises(DataError, match="another name"):
        hand.move(session, "A", "A", 0, 5)


def test_renaming_takes_artifacts_along_and_comes_out_in_the_export(tmp_path):
    write(unlabelled_take(), tmp_path / "in.c3d")
    source = read(tmp_path / "in.c3d")
    session = Session(source)
    session.add_detected([artifact("C", start=15, stop=25, kind=Kind.GAP)], "paper")
    before = state_of(session)
    hand.rename(session, {"C": "LKNE", "*3": "RKNE"})
    assert session.original.labels == session.take.labels == ("A", "LKNE", "RKNE")
    assert session.artifacts[0].marker == "LKNE"
    hand.cut(session, "LKNE", 0, 3)
    write(session.take, tmp_path / "out.c3d", record=session.repairs_in_words())
    result = mm.read(tmp_path / "out.c3d")
    assert result.labels == ("A", "LKNE", "RKNE")
    assert np.isnan(result.positions[:3, 1]).all()
    assert np.array_equal(result.positions[3:], source.positions[3:], equal_nan=True)
    assert session.repairs_in_words() == (
        "Rename C to LKNE, *3 to RKNE",
        "Cut LKNE in frames 1–3",
    )
    session.undo()
    session.undo()
    assert state_of(session) == before


@pytest.mark.parametrize("names", [{"A": "B"}, {"A": " "}, {"Z": "Y"}])
def test_a_name_that_is_taken_empty_or_unknown_is_refused(names):
    session = Session(make_take())
    before = state_of(session)
    with pytest.raises(DataError):
        hand.rename(session, names)
    assert state_of(session) == before


def test_two_markers_may_change_names():
    session = Session(make_take())
    hand.rename(session, {"A": "B", "B": "A"})
    assert session.take.labels == ("B", "A", "C")
    assert session.take.index("A") == 1


def test_splitting_and_joining():
    session = Session(make_take())
    a = artifact()
    session.add_detected([a], "paper")
    session.repair([(a.id, proposal(a))])
    hand.split(session, a.id, 34)
    assert of(session, "A") == [
        (30, 34, Kind.NOISE, Status.PENDING),
        (34, 40, Kind.NOISE, Status.PENDING),
    ]
    assert session.positions.tobytes() == session.original.positions.tobytes()
    with pytest.raises(DataError, match="inside"):
        hand.split(session, a.id, 34)
    hand.join(session, [x.id for x in session.artifacts])
    assert of(session, "A") == [(30, 40, Kind.NOISE, Status.PENDING)]
    with pytest.raises(DataError, match="two or more"):
        hand.join(session, [session.artifacts[0].id])


def test_hand_work_names_and_notes_survive_a_crash(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    session = kept.session
    hand.cut(session, "A", 5, 9)
    hand.rename(session, {"A": "HIP"})
    session.annotate(session.artifacts[0].id, "  look again ")
    hand.move(session, "B", "HIP", 5, 9)
    expected = state_of(session)
    die(kept)
    again = open_session(make_take(), folder=tmp_path)
    assert again.recovered == 4
    assert state_of(again.session) == expected
    again.session.undo()
    assert again.session.artifacts[0].note == "look again"
    again.close()


def test_a_take_changed_on_disk_keeps_renamed_markers_that_are_the_same(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    hand.rename(kept.session, {"A": "HIP", "C": "KNEE"})
    hand.rename(kept.session, {"HIP": "TOE"})
    kept.session.mark(artifact("TOE"))
    kept.save()
    kept.close()
    take = make_take()
    positions = take.positions.copy()
    positions[0, 2, 0] += 1.0
    again = open_session(take.with_positions(positions, take.origin), folder=tmp_path)
    # Both names were given in one step, and one of the two markers is another one now.
    assert again.session.original.labels == ("A", "B", "C")
    assert again.session.artifacts == ()
    again.close()


def test_nudges_go_on_in_one_step_until_something_else_is_done():
    session = Session(make_take())
    noise = artifact(start=20, stop=30)
    session.mark(noise)
    for _ in range(3):
        hand.nudge(session, noise.id, start=-1)
    assert session.history[1:] == (f"Nudge the beginning of {noise.kind} on {noise.marker}",)
    hand.nudge(session, noise.id, stop=2)
    hand.nudge(session, noise.id, start=1)
    assert len(session.history) == 4, "the other edge came between"
    session.mark_exported()
    hand.nudge(session, noise.id, start=1)
    assert session.exported_at == 4, "what was exported stays in the history"
    frames = [(20, 30), (17, 30), (17, 32), (18, 32), (19, 32)]
    assert [stretch(s) for s in session.steps[0]] == frames
    hand.nudge(session, noise.id, start=-1)
    assert len(session.history) == 4, "a nudge taken back by the opposite one leaves no step"
    hand.nudge(session, noise.id, start=100)
    assert len(session.history) == 4, "an artifact keeps one frame"
    session.travel(1)
    assert session.artifact(noise.id) == noise


def test_a_repaired_artifact_that_is_nudged_gets_its_samples_back_and_again_by_one_undo():
    session = Session(make_take())
    noise = artifact(start=20, stop=30)
    session.mark(noise)
    measured = session.positions.copy()
    session.repair([(noise.id, proposal(noise))])
    repaired = session.positions.copy()
    assert not np.array_equal(repaired, measured, equal_nan=True)
    for _ in range(2):
        hand.nudge(session, noise.id, stop=1)
    assert session.artifact(noise.id).status is Status.PENDING
    assert np.array_equal(session.positions, measured, equal_nan=True)
    session.undo()
    assert session.artifact(noise.id).status is Status.REPAIRED
    assert np.array_equal(session.positions, repaired, equal_nan=True)


def repaired_review() -> tuple[Session, str, str]:
    """Two repaired artifacts with bands, the second one out of the way."""
    session = Session(make_take())
    a, far = artifact(start=20, stop=30), artifact(start=40, stop=50)
    session.add_detected([a, far], "paper")
    banded = [replace(proposal(x), band_mm=np.full(x.length, 2.0)) for x in (a, far)]
    session.repair([(a.id, banded[0]), (far.id, banded[1])])
    return session, a.id, far.id


def swap_by_hand(session: Session) -> None:
    swapped = artifact(start=28, stop=34, kind=Kind.STEP, counterpart="C")
    values = session.positions[28:34, :1]
    patch = Patch("A", "xyz", 28, 34, values[:, 0].copy())
    hand.repair(session, swapped, Repair("swap", (patch,), error_mm=0.0))


@pytest.mark.parametrize("work", [lambda s: hand.cut(s, "A", 28, 34), swap_by_hand])
def test_what_is_written_over_a_repair_takes_its_error_and_band_away(work):
    session, under, far = repaired_review()
    before = dict(session.notes)
    work(session)
    note = session.notes[under]
    assert (note.method, note.error_mm, note.band_mm) == (before[under].method, None, None)
    assert note.leaves.startswith("Edited by hand since")
    assert session.notes[far] == before[far]
    session.undo()
    assert dict(session.notes) == before


def test_smoothing_a_repair_is_noted_once_and_its_error_still_told():
    session, under, far = repaired_review()
    before = session.notes[under]
    for _ in range(2):
        values, origin = session.positions[18:32, :1].copy(), session.origin[18:32, :1].copy()
        hand.replace_samples(session, "Smooth", ["A"], 18, values, origin)
    note = session.notes[under]
    assert (note.error_mm, note.band_mm) == (before.error_mm, before.band_mm)
    assert note.leaves == "Smoothed since; the expected error is that of the repair."
    assert session.notes[far].leaves == ""


def test_repairing_a_range_answers_what_was_found_inside():
    take = make_take()
    positions = take.positions.copy()
    positions[20:28, take.index("A")] = np.nan
    session = Session(Take(positions, take.labels, take.rate))
    gap = artifact(start=20, stop=28, kind=Kind.GAP)
    beside, rejected = artifact(start=29, stop=31), artifact(start=22, stop=24)
    other = artifact("B", start=20, stop=28)
    session.add_detected([gap, beside, rejected, other], "joint")
    session.set_status([rejected.id], Status.REJECTED)
    swept = artifact(start=18, stop=30, kind=Kind.NOISE)
    hand.repair(session, swept, proposal(swept))
    left = {(a.marker, a.start, a.stop, a.status) for a in session.artifacts}
    assert left == {
        ("A", 18, 30, Status.REPAIRED),
        ("A", 29, 31, Status.PENDING),
        ("A", 22, 24, Status.REJECTED),
        ("B", 20, 28, Status.PENDING),
    }
    session.undo()
    assert session.artifact(gap.id).status is Status.PENDING


def test_of_a_gap_that_is_filled_in_part_the_rest_stays():
    take = make_take()
    positions = take.positions.copy()
    positions[20:28, take.index("A")] = np.nan
    session = Session(Take(positions, take.labels, take.rate))
    session.add_detected([artifact(start=20, stop=28, kind=Kind.GAP)], "joint")
    swept = artifact(start=24, stop=31, kind=Kind.NOISE)
    hand.repair(session, swept, proposal(swept))
    open_ = [(a.start, a.stop) for a in session.artifacts if a.status is Status.PENDING]
    assert open_ == [(20, 24)]
    assert np.isnan(session.positions[20:24, take.index("A"), 0]).all()
    assert np.isfinite(session.positions[24:31, take.index("A"), 0]).all()


def test_a_swap_answers_steps_and_leaves_what_else_is_wrong():
    session = Session(make_take())
    step, noise = artifact(start=29, stop=33, kind=Kind.STEP), artifact(start=30, stop=32)
    assert noise.kind is not Kind.STEP
    session.add_detected([step, noise], "joint")
    swap_by_hand(session)
    assert session.find(step.id) is None
    assert session.artifact(noise.id).status is Status.PENDING
