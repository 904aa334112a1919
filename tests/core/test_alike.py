"""Like with like, what rejections teach, and the operator's time."""

from __future__ import annotations

import pytest
from reviews import artifact, die, make_take

from markermend.artifact import Kind, Status
from markermend.review.alike import alike, doubts, lower
from markermend.review.file import open_session
from markermend.review.pace import Stopwatch
from markermend.review.session import Session


def several(session, count, marker="A", kind=Kind.PEAK):
    found = [artifact(marker, start=3 * i, stop=3 * i + 1, kind=kind) for i in range(count)]
    session.add_detected([*session.artifacts, *found], "paper")
    return [a.id for a in found]


def test_alike_is_the_open_ones_of_a_class_on_these_markers_that_are_sure_enough():
    session = Session(make_take())
    ids = several(session, 3)
    several(session, 2, "B")
    several(session, 1, "A", Kind.STEP)
    session.set_status(ids[:1], Status.REJECTED)
    found = alike(session.artifacts, Kind.PEAK)
    assert [a.marker for a in found] == ["B", "A", "B", "A"]
    assert {a.id for a in alike(session.artifacts, Kind.PEAK, markers={"A"})} == set(ids[1:])
    assert alike(session.artifacts, Kind.PEAK, min_confidence=0.95) == ()


def test_several_rejections_put_the_rest_in_doubt_and_lowering_them_is_one_step():
    session = Session(make_take())
    ids = several(session, 7)
    session.set_status(ids[:2], Status.REJECTED)
    session.set_status(ids[2:3], Status.ACCEPTED)
    assert doubts(session.artifacts) == ()
    session.set_status(ids[3:4], Status.REJECTED)
    (doubt,) = doubts(session.artifacts)
    assert (doubt.rejected, doubt.upheld, len(doubt.rest)) == (3, 1, 3)
    lower(session, doubt)
    # Laplace: one of four was real, so that the next is with probability 2/6.
    assert [session.artifact(i).confidence for i in ids[4:]] == pytest.approx([0.9 / 3] * 3)
    assert session.artifact(ids[0]).confidence == 0.9
    session.undo()
    assert {a.confidence for a in session.artifacts} == {0.9}


def test_gaps_and_what_was_mostly_right_are_not_in_doubt():
    session = Session(make_take())
    gaps = several(session, 6, "A", Kind.GAP)
    session.set_status(gaps[:4], Status.REJECTED)
    peaks = several(session, 8, "B")
    session.set_status(peaks[:4], Status.ACCEPTED)
    session.set_status(peaks[4:7], Status.REJECTED)
    assert doubts(session.artifacts) == ()


def test_pauses_are_not_counted():
    now = [0.0]
    watch = Stopwatch(lambda: now[0], idle_after_s=30.0)
    for seconds in (5.0, 4.0, 100.0, 6.0):
        now[0] += seconds
        watch.touch()
    # The first touch begins, and the hundred seconds were a pause.
    assert watch.spent_s == 10.0


def test_time_is_kept_with_the_review(tmp_path):
    now = [0.0]
    kept = open_session(make_take(), folder=tmp_path)
    kept.session.stopwatch = Stopwatch(lambda: now[0])
    ids = several(kept.session, 4)
    for i in ids[:2]:
        now[0] += 3.0
        kept.session.set_status([i], Status.REJECTED)
    assert kept.session.pace.seconds_each == 3.0
    kept.save()
    now[0] += 4.0
    kept.session.set_status(ids[2:3], Status.ACCEPTED)
    kept.session.undo()
    # The process dies here.
    die(kept)
    again = open_session(make_take(), folder=tmp_path)
    pace = again.session.pace
    assert (pace.decided, pace.total, pace.spent_s) == (2, 4, 10.0)
    assert pace.minutes == pytest.approx(1 / 6)
    again.close()
