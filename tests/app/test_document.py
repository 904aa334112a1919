"""The document: signals tell what changed, decisions move on, proposals stay true."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.artifact import Kind, Status
from markermend.mesh import infer_mesh
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app.document import Document
from markermend_app.rows import Rows

WAIT = 20_000


@pytest.fixture
def document(qapp, damaged, tmp_path):
    take, truth = damaged
    made = Document()
    made.open(open_session(take, folder=tmp_path), infer_mesh(take))
    made.decisions.add_detected(truth, "truth")
    made.set_queue(Rows([[a.id] for a in made.session.artifacts]))
    yield made
    made.open(None, None)
    made.proposals.close()


def of(document, kind):
    return next(a for a in document.session.artifacts if a.kind is kind)


def test_removing_moves_on_and_the_last_leaves_nothing(document):
    first, second, *others = (a.id for a in document.session.artifacts)
    document.select(first)
    document.decisions.remove([first])
    assert document.current.id == second
    document.decisions.remove(others)
    assert document.current.id == second
    document.decisions.remove([second])
    assert document.current is None
    document.undo()
    assert second in {a.id for a in document.session.artifacts}


def test_deciding_moves_to_the_next_undecided_and_wraps(document):
    gap, peak, noise, step = document.session.artifacts
    document.decisions.reject([peak.id])
    document.select(gap.id)
    document.decisions.accept_current()
    assert document.current.id == noise.id
    document.select(step.id)
    document.decisions.reject_current()
    assert document.current.id == noise.id
    document.decisions.accept_current()
    assert document.current.id == noise.id
    assert not document.session.with_status(Status.PENDING)


def test_selecting_shows_the_marker_and_asks_for_its_frames(document, qtbot):
    peak = of(document, Kind.PEAK)
    with qtbot.waitSignal(document.frame_requested) as asked:
        document.select(peak.id)
    assert asked.args == [peak.start, peak.stop]
    assert document.shown == (peak.marker,)
    assert peak.start <= document.frame < peak.stop


def test_where_nothing_is_listed_a_marker_that_is_seen_is_shown(document, damaged, tmp_path):
    take = damaged[0]
    positions = take.positions.copy()
    positions[:, :2] = np.nan
    unseen = Take(positions, take.labels, take.rate)
    document.open(open_session(unseen, folder=tmp_path), None)
    document.set_queue(Rows())
    document.step(1)
    assert document.shown == take.labels[2:3]


def test_the_marker_under_review_is_foremost_among_those_shown(document):
    gap, peak, *_ = document.session.artifacts
    document.show(["T10", gap.marker, peak.marker])
    document.select(peak.id)
    assert document.shown == (peak.marker, "T10", gap.marker)
    document.select(gap.id)
    assert document.shown == (gap.marker, peak.marker, "T10")


def test_repair_tells_what_changed(document, qtbot):
    gap = of(document, Kind.GAP)
    document.select(gap.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    with qtbot.waitSignal(document.data_changed) as changed:
        document.decisions.repair_current()
    change = changed.args[0]
    assert change.markers == (gap.marker,)
    assert (change.start, change.stop) == (gap.start, gap.stop)


def test_a_change_of_its_marker_makes_a_proposal_anew(document, qtbot):
    noise, gap = of(document, Kind.NOISE), of(document, Kind.GAP)
    document.select(noise.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    kept = document.proposal
    document.select(gap.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    document.decisions.repair_current()
    document.select(noise.id)
    assert document.proposal is kept
    document.decisions.repair_current()
    document.undo()
    document.select(noise.id)
    assert document.proposal is not kept


def test_the_next_proposal_is_made_ahead(document, qtbot):
    first, second = document.queue[:2]
    document.select(first)
    ahead = document.session.artifact(second)
    qtbot.waitUntil(lambda: document.proposals.get(ahead, "auto") is not None, timeout=WAIT)


def test_a_method_without_an_answer_is_said_and_changes_nothing(document, qtbot):
    peak = of(document, Kind.PEAK)
    document.select(peak.id)
    document.choose_method("swap")
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    with qtbot.waitSignal(document.failed) as failed:
        document.decisions.repair_current()
    assert "cannot be repaired" in str(failed.args[0])
    assert document.session.artifact(peak.id).status is Status.PENDING


def test_deciding_several_moves_past_all_of_them(document):
    first, second, third, _ = document.queue
    document.select(first)
    document.decisions.accept([first, second])
    assert document.current.id == third


def test_repairing_several_moves_past_all_of_them(document, qtbot):
    gap, noise = of(document, Kind.GAP), of(document, Kind.NOISE)
    repairs = []
    for artifact in (noise, gap):
        document.select(artifact.id)
        qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
        repairs.append((artifact.id, document.proposal))
    document.decisions.repair_many(repairs, "Repair 2 artifacts")
    assert document.current.status is Status.PENDING


def test_travelling_through_history(document):
    first, second, *_ = document.queue
    document.decisions.accept([first])
    document.decisions.reject([second])
    document.travel(1)
    assert len(document.session.with_status(Status.PENDING)) == 4
    document.travel(3)
    assert document.session.artifact(second).status is Status.REJECTED


def test_reading_only_refuses_every_decision(document, qtbot):
    document.file.read_only = True
    with qtbot.waitSignal(document.failed):
        document.decisions.accept([document.queue[0]])
    assert len(document.session.with_status(Status.PENDING)) == 4
    document.file.read_only = False


def test_accepting_leaves_repaired_samples_repaired(document, qtbot):
    step, peak = of(document, Kind.STEP), of(document, Kind.PEAK)
    document.select(peak.id)
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
    document.decisions.repair_current()
    mended = document.session.positions.copy()
    document.decisions.accept([step.id, peak.id])
    assert document.session.artifact(peak.id).status is Status.REPAIRED
    assert document.session.artifact(step.id).status is Status.ACCEPTED
    with qtbot.waitSignal(document.failed) as told:
        document.decisions.accept([peak.id])
    assert "repaired already" in str(told.args[0])
    assert document.session.positions.tobytes() == mended.tobytes()


def test_undo_and_redo_go_to_the_artifact_they_are_about(document, qtbot):
    gap, peak, noise, _ = document.session.artifacts
    document.decisions.accept([gap.id])
    document.decisions.reject([peak.id])
    document.select(noise.id)
    document.undo()
    assert (document.current.id, document.shown) == (peak.id, (peak.marker,))
    with qtbot.waitSignal(document.reveal_requested) as asked:
        document.undo()
    assert asked.args == [gap.start, gap.stop]
    assert document.current.id == gap.id
    document.redo()
    document.redo()
    assert document.current.id == peak.id
    document.travel(2)
    assert document.current.id == gap.id


def test_undoing_a_step_on_samples_alone_shows_them(document):
    from markermend.review import hand

    peak = of(document, Kind.PEAK)
    document.select(peak.id)
    values = document.session.positions[20:30, 3:4].copy()
    origin = document.session.origin[20:30, 3:4].copy()
    document.do(lambda s: hand.replace_samples(s, "Smooth", ["T10"], 20, values, origin))
    document.undo()
    assert document.shown == ("T10",)
    assert document.frame == 25
    assert document.current.id == peak.id
