"""Gaps of a review: frames that are not seen stay listed, and each gap says what it holds."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from reviews import proposal, state_of

from markermend.artifact import AXES, Artifact, Kind, Status
from markermend.review import hand
from markermend.review.session import Session
from markermend.review.step import stretch
from markermend.take import Take

FRAMES = 80


def hidden(*gaps: tuple[int, int]) -> Session:
    """A review of two markers, one of which is missing in some frames, as a detector lists them."""
    positions = np.random.default_rng(2).normal(0, 100, (FRAMES, 2, 3))
    for start, stop in gaps:
        positions[start:stop, 0] = np.nan
    session = Session(Take(positions, ("A", "B"), 100.0))
    session.add_detected(found(*gaps), "joint")
    return session


def found(*gaps: tuple[int, int]) -> list[Artifact]:
    return [Artifact("A", AXES, start, stop, Kind.GAP) for start, stop in gaps]


def listed(session: Session) -> list[tuple[int, int]]:
    return [(a.start, a.stop) for a in session.artifacts]


def test_what_a_gap_leaves_out_and_is_not_seen_becomes_a_gap_of_its_own():
    session = hidden((20, 50))
    (gap,) = session.artifacts
    before = state_of(session)
    session.change(gap.id, stop=40)
    kept, left = session.artifacts
    assert (kept.id, kept.start, kept.stop) == (gap.id, 20, 40)
    assert (left.start, left.stop, left.status) == (40, 50, Status.PENDING)
    assert left.why == "not seen for 10 frames (100 ms)"
    assert stretch(session.steps[0][-1]) == (20, 40), "what was moved, not what it left"
    session.change(gap.id, stop=30)
    assert listed(session) == [(20, 30), (30, 50)], "what is left lies beside it in one piece"
    session.change(gap.id, start=25, stop=45)
    assert listed(session) == [(20, 25), (25, 45), (45, 50)]
    session.change(gap.id, start=20, stop=50)
    assert listed(session) == [(20, 50)], "a gap that grows takes them back"
    session.travel(1)
    assert state_of(session) == before


def test_nudges_of_a_gap_stay_one_step_and_what_they_leave_one_gap():
    session = hidden((20, 50))
    (gap,) = session.artifacts
    for _ in range(3):
        hand.nudge(session, gap.id, stop=-2)
    assert listed(session) == [(20, 44), (44, 50)]
    assert len(session.history) == 2
    session.undo()
    assert listed(session) == [(20, 50)]


def test_a_gap_takes_nothing_from_gaps_that_were_decided():
    session = hidden((20, 30), (40, 50))
    first, second = session.artifacts
    session.set_status([second.id], Status.REJECTED)
    session.change(first.id, stop=45)
    assert listed(session) == [(20, 45), (40, 50)]
    session.change(first.id, stop=25)
    assert listed(session) == [(20, 25), (25, 30), (40, 50)]


def test_a_gap_that_was_widened_says_how_many_of_its_frames_are_not_seen():
    session = hidden((20, 50))
    (gap,) = session.artifacts
    session.change(gap.id, start=18)
    assert session.artifacts[0].why == "not seen for 30 of the 32 frames that were chosen by hand"
    session.change(gap.id, start=20)
    assert session.artifacts[0].why == "not seen for 30 frames (300 ms)"
    hand.cut(session, "A", 50, 55)
    (cut,) = session.artifacts
    assert cut.why == "not seen for 35 frames, since samples were cut or moved by hand"
    session.change(cut.id, stop=56)
    assert session.artifacts[0].why == "not seen for 35 of the 36 frames that were chosen by hand"


def test_looking_again_lists_what_of_a_gap_is_in_none_that_was_decided():
    session = hidden((20, 50))
    (gap,) = session.artifacts
    session.change(gap.id, stop=44)
    session.remove([session.artifacts[1].id])
    session.set_status([gap.id], Status.REJECTED)
    assert listed(session) == [(20, 44)]
    session.add_detected(found((20, 50)), "joint")
    kept, left = session.artifacts
    assert (kept.id, kept.status) == (gap.id, Status.REJECTED)
    assert (left.start, left.stop, left.status) == (44, 50, Status.PENDING)
    assert left.why == "not seen for 6 frames (60 ms)"
    session.add_detected(found((20, 50)), "joint")
    assert listed(session) == [(20, 44), (44, 50)], "looked again, the same"


def test_a_gap_moved_off_all_it_held_leaves_its_name_to_no_other():
    session = hidden((20, 50))
    (gap,) = session.artifacts
    session.change(gap.id, start=60, stop=70)
    assert listed(session) == [(20, 50), (60, 70)]
    assert session.artifacts[1].id == gap.id
    session.add_detected(found((20, 50)), "joint")
    assert listed(session) == [(20, 50), (60, 70)]
    assert len({a.id for a in session.artifacts}) == 2


EDGES = st.tuples(st.integers(0, FRAMES - 1), st.integers(1, FRAMES)).filter(lambda e: e[0] < e[1])


@given(
    moves=st.lists(
        st.tuples(st.integers(0, 9), EDGES, st.sampled_from([None, *Status])), max_size=8
    )
)
def test_whatever_edges_are_moved_no_frame_that_is_not_seen_goes_unlisted(moves):
    session = hidden((5, 20), (30, 31), (40, 70))
    missing = np.isnan(session.original.positions[:, 0, 0])
    first = state_of(session)
    for which, (start, stop), status in moves:
        gap = session.artifacts[which % len(session.artifacts)]
        session.change(gap.id, start=start, stop=stop)
        if status is not None and status is not Status.REPAIRED:
            session.set_status([gap.id], status)
        covered = np.zeros(FRAMES, dtype=bool)
        for a in session.artifacts:
            covered[a.start : a.stop] = True
        assert covered[missing].all()
    session.travel(1)
    assert state_of(session) == first


def test_gaps_beside_keep_what_was_noted_and_frames_that_were_chosen():
    session = hidden((20, 50))
    (gap,) = session.artifacts
    noted = session.placed(Artifact("A", AXES, 50, 60, Kind.GAP, note="ask the actor", why="seen"))
    session.mark(noted)
    hand.nudge(session, gap.id, stop=-1)
    assert listed(session) == [(20, 49), (49, 50), (50, 60)]
    assert session.artifact(noted.id) == noted
    session.change(gap.id, stop=55)
    trimmed = session.artifact(noted.id)
    assert (trimmed.start, trimmed.stop, trimmed.note, trimmed.why) == (55, 60, noted.note, "seen")
    session.change(gap.id, stop=70)
    assert session.artifact(noted.id) == trimmed, "a note is not thrown away"


def test_what_another_class_leaves_out_of_a_gap_becomes_a_gap_too():
    session = hidden((20, 50))
    (gap,) = session.artifacts
    session.change(gap.id, kind=Kind.NOISE, stop=40)
    assert [(a.kind, a.start, a.stop) for a in session.artifacts] == [
        (Kind.NOISE, 20, 40),
        (Kind.GAP, 40, 50),
    ]
    assert stretch(session.steps[0][-1]) == (20, 40)


def test_a_gap_found_takes_no_name_of_a_marker_that_was_renamed():
    positions = np.random.default_rng(2).normal(0, 100, (FRAMES, 2, 3))
    positions[20:50] = np.nan
    session = Session(Take(positions, ("A", "B"), 100.0))
    session.add_detected(found((20, 50)), "joint")
    (gap,) = session.artifacts
    session.set_status([gap.id], Status.ACCEPTED)
    hand.rename(session, {"A": "C"})
    hand.rename(session, {"B": "A"})
    both = [Artifact(name, AXES, 20, 50, Kind.GAP) for name in ("A", "C")]
    session.add_detected(both, "joint")
    assert [(a.marker, a.status) for a in session.artifacts] == [
        ("A", Status.PENDING),
        ("C", Status.ACCEPTED),
    ]


def test_what_is_joined_has_the_reason_of_what_it_became():
    session = hidden((20, 25))
    (gap,) = session.artifacts
    noise = session.placed(Artifact("A", AXES, 15, 22, Kind.NOISE, 0.7, why="jitters"))
    session.mark(noise)
    hand.join(session, [noise.id, gap.id])
    (joined,) = session.artifacts
    assert (joined.kind, joined.start, joined.stop) == (Kind.GAP, 15, 25)
    assert joined.why == "not seen for 5 of the 10 frames that were chosen by hand"
    peak = session.placed(Artifact("A", AXES, 60, 62, Kind.PEAK, 0.5, why="sticks out"))
    jitter = session.placed(Artifact("A", AXES, 62, 70, Kind.NOISE, 0.9, why="jitters"))
    session.mark(peak)
    session.mark(jitter)
    hand.join(session, [peak.id, jitter.id])
    assert session.artifacts[-1].why == "its frames were set by hand"


def test_the_history_says_which_frames_a_repaired_gap_has_now():
    session = hidden((20, 50))
    (gap,) = session.artifacts
    session.repair([(gap.id, proposal(gap))])
    session.change(gap.id, stop=40)
    assert listed(session) == [(20, 40), (40, 50)]
    assert stretch(session.steps[0][-1]) == (20, 50), "what was filled beyond it is missing again"
