"""A review: decisions, undo and redo bit for bit, saving, the journal after a crash, the lock."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from markermend import session_file
from markermend.artifact import Artifact, Kind, Status
from markermend.errors import DataError, FileFormatError, MarkermendError
from markermend.patch import Patch
from markermend.repairs.registry import Repair
from markermend.session import Session
from markermend.session_file import open_session
from markermend.take import Origin, Take

FRAMES, LABELS = 60, ("A", "B", "C")


def make_take() -> Take:
    rng = np.random.default_rng(3)
    positions = rng.normal(0, 100, (FRAMES, 3, 3))
    positions[10:20, 1] = np.nan
    return Take(positions, LABELS, 100.0, first_frame=5)


def artifact(marker="A", axes="xyz", start=30, stop=40, kind=Kind.NOISE, **more) -> Artifact:
    return Artifact(marker, axes, start, stop, kind, 0.9, 5.0, "because", **more)


def proposal(a: Artifact, value: float = 1.0, method: str = "spline") -> Repair:
    values = np.full((a.length, len(a.axes)), value)
    return Repair(method, (Patch(a.marker, a.axes, a.start, a.stop, values),), error_mm=0.4)


def state_of(session: Session) -> tuple:
    return (
        session.positions.tobytes(),
        session.origin.tobytes(),
        session.artifacts,
        tuple(sorted((i, n.method) for i, n in session.notes.items())),
    )


def test_repair_replaces_only_interval_and_named_axes():
    session = Session(make_take())
    a = artifact(axes="xz")
    session.add_detected([a], "paper")
    session.repair([(a.id, proposal(a))])
    differs = session.positions != session.original.positions
    differs &= ~np.isnan(session.original.positions)
    expected = np.zeros_like(differs)
    expected[30:40, 0, [0, 2]] = True
    assert (differs == expected).all()
    assert (session.origin[30:40, 0] == Origin.EDITED).all()
    assert session.artifact(a.id).status is Status.REPAIRED
    assert session.notes[a.id].method == "spline"


def test_filling_a_gap_marks_samples_filled():
    session = Session(make_take())
    a = artifact("B", start=10, stop=20, kind=Kind.GAP)
    session.add_detected([a], "paper")
    session.repair([(a.id, proposal(a))])
    assert (session.origin[10:20, 1] == Origin.FILLED).all()
    session.undo()
    assert (session.origin[10:20, 1] == Origin.MISSING).all()
    assert np.isnan(session.positions[10:20, 1]).all()


def test_proposal_outside_its_artifact_is_refused():
    session = Session(make_take())
    a = artifact(axes="x")
    session.add_detected([a], "paper")
    wide = Repair("spline", (Patch("A", "xy", 30, 40, np.zeros((10, 2))),))
    before = state_of(session)
    with pytest.raises(DataError, match="outside the artifact"):
        session.repair([(a.id, wide)])
    assert state_of(session) == before


def test_half_missing_sample_is_refused_and_nothing_changes():
    session = Session(make_take())
    fine = artifact("A")
    gap = artifact("B", axes="x", start=10, stop=20, kind=Kind.GAP)
    session.add_detected([fine, gap], "paper")
    before = state_of(session)
    with pytest.raises(DataError, match="half missing"):
        session.repair([(fine.id, proposal(fine)), (gap.id, proposal(gap))])
    assert state_of(session) == before


def test_rejecting_a_repaired_artifact_restores_its_source():
    session = Session(make_take())
    a = artifact()
    session.add_detected([a], "paper")
    session.repair([(a.id, proposal(a))])
    session.set_status([a.id], Status.REJECTED)
    assert session.positions.tobytes() == session.original.positions.tobytes()
    assert session.origin.tobytes() == session.original.origin.tobytes()
    assert a.id not in session.notes


def test_reopening_leaves_an_overlapping_repair_alone():
    session = Session(make_take())
    a, b = artifact(start=30, stop=40), artifact(start=36, stop=50, kind=Kind.STEP)
    session.add_detected([a, b], "paper")
    session.repair([(a.id, proposal(a, 1.0))])
    session.repair([(b.id, proposal(b, 2.0))])
    session.set_status([a.id], Status.PENDING)
    assert (session.positions[36:50, 0] == 2.0).all()
    assert (session.positions[30:36, 0] == session.original.positions[30:36, 0]).all()


def test_detecting_again_keeps_decisions():
    session = Session(make_take())
    a, b = artifact(), artifact("C")
    session.add_detected([a, b], "paper")
    session.set_status([a.id], Status.REJECTED)
    again = artifact(start=31, stop=41)
    other = artifact("C", start=2, stop=9)
    session.add_detected([again, other], "paper")
    assert [(x.marker, x.start, x.status) for x in session.artifacts] == [
        ("C", 2, Status.PENDING),
        ("A", 30, Status.REJECTED),
    ]


def test_exported_asks_only_when_something_was_decided():
    session = Session(make_take())
    a = artifact()
    session.add_detected([a], "paper")
    assert session.exported
    session.set_status([a.id], Status.ACCEPTED)
    assert not session.exported
    session.mark_exported()
    assert session.exported
    session.undo()
    assert session.exported
    session.redo()
    session.set_status([a.id], Status.REJECTED)
    assert not session.exported


verbs = st.lists(
    st.tuples(
        st.sampled_from(["accept", "reject", "reopen", "repair", "move", "kind", "mark", "remove"]),
        st.integers(0, 30),
        st.integers(1, 12),
        st.floats(-500, 500),
    ),
    min_size=1,
    max_size=25,
)


def drive(session: Session, verb: str, where: int, length: int, value: float) -> None:
    """Do one of the operator's verbs to some artifact."""
    if verb == "mark" or not session.artifacts:
        kind = Kind.GAP if where % 2 else Kind.STEP
        marker = LABELS[where % 3]
        session.mark(Artifact(marker, "xyz", where, where + length, kind))
        return
    a = session.artifacts[where % len(session.artifacts)]
    if verb == "repair":
        session.repair([(a.id, proposal(a, value))])
    elif verb == "move":
        session.change(a.id, start=where, stop=where + length)
    elif verb == "kind":
        session.change(a.id, kind=Kind.PEAK)
    elif verb == "remove":
        session.remove([a.id])
    else:
        status = {
            "accept": Status.ACCEPTED,
            "reject": Status.REJECTED,
            "reopen": Status.PENDING,
        }[verb]
        session.set_status([a.id], status)


@settings(max_examples=60, deadline=None)
@given(verbs)
def test_undo_and_redo_restore_every_state_bit_for_bit(script):
    session = Session(make_take())
    states = [state_of(session)]
    for step in script:
        before = len(session.history)
        drive(session, *step)
        if len(session.history) > before:
            states.append(state_of(session))
    for state in reversed(states[:-1]):
        session.undo()
        assert state_of(session) == state
    for state in states[1:]:
        session.redo()
        assert state_of(session) == state
    session.travel(0)
    assert state_of(session) == states[0]
    session.travel(len(states) - 1)
    assert state_of(session) == states[-1]


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
    kept._journal.close()
    again = open_session(make_take(), folder=folder)
    assert (state_of(again.session), again.session.history, again.session.undone) == expected
    again.close()


def test_a_line_cut_short_loses_only_that_step(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    for a in (artifact(), artifact("C")):
        kept.session.mark(a)
    journal = Path(kept._journal.name)
    kept._journal.close()
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


def test_second_opening_is_read_only(tmp_path):
    first = open_session(make_take(), folder=tmp_path)
    first.session.mark(artifact())
    second = open_session(make_take(), folder=tmp_path)
    assert second.read_only
    assert not first.read_only
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
    again._journal.close()
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


KILLED = """
    import sys
    from pathlib import Path
    from tests_session_take import make_take
    from markermend.artifact import Artifact, Kind
    from markermend.session_file import open_session

    kept = open_session(make_take(), folder=Path(sys.argv[1]))
    i = len(kept.session.history)
    while True:
        kept.session.mark(Artifact("A", "xyz", i % 50, i % 50 + 1 + i % 7, Kind.PEAK))
        i += 1
        print(i, flush=True)
        if i % 40 == 0:
            kept.save()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="kills with a POSIX signal")
def test_kill_at_random_moments_loses_at_most_the_step_in_flight(tmp_path):
    rounds = int(os.environ.get("MARKERMEND_KILLS", "6"))
    script = tmp_path / "killed.py"
    script.write_text(textwrap.dedent(KILLED))
    (tmp_path / "tests_session_take.py").write_text(
        "import numpy as np\nfrom markermend.take import Take\n"
        "def make_take():\n"
        "    p = np.random.default_rng(3).normal(0, 100, (60, 3, 3))\n"
        "    return Take(p, ('A', 'B', 'C'), 100.0)\n"
    )
    folder = tmp_path / "reviews"
    folder.mkdir()
    rng = np.random.default_rng(0)
    sys.path.insert(0, str(tmp_path))
    try:
        from tests_session_take import make_take as same_take
    finally:
        sys.path.remove(str(tmp_path))
    root = Path(__file__).resolve().parents[2]
    environment = dict(
        os.environ,
        PYTHONPATH=os.pathsep.join([str(tmp_path), str(root / "core")]),
        XDG_DATA_HOME=str(tmp_path),
    )
    for _ in range(rounds):
        child = subprocess.Popen(
            [sys.executable, str(script), str(folder)],
            stdout=subprocess.PIPE,
            text=True,
            env=environment,
        )
        first = child.stdout.readline()
        assert first
        time.sleep(float(rng.uniform(0.0, 0.15)))
        child.send_signal(signal.SIGKILL)
        rest = child.stdout.read().split()
        child.wait()
        told = int(rest[-1]) if rest else int(first)
        again = open_session(same_take(), folder=folder)
        assert told <= len(again.session.history) <= told + 1
        again.close()


def stored_take() -> Take:
    """The take that the stored sessions of every version belong to."""
    positions = np.arange(40 * 2 * 3, dtype=np.float64).reshape(40, 2, 3)
    positions[5:9, 1] = np.nan
    return Take(positions, ("LHEE", "RHEE"), 50.0)


@pytest.mark.parametrize("version", [1])
def test_reviews_of_every_version_keep_opening(tmp_path, version):
    text = (Path(__file__).parent / "sessions" / f"v{version}.json").read_text(encoding="utf-8")
    (tmp_path / "take.markermend.json").write_text(text, encoding="utf-8")
    kept = open_session(stored_take(), folder=tmp_path)
    assert kept.warning == ""
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


def full_disk(kept):
    """Let the journal of an open review take half a line and then no more."""
    real = kept._journal

    class Full:
        name, fileno, close = real.name, real.fileno, real.close
        seek, read = real.seek, real.read
        left = 40

        def write(self, line):
            if not self.left:
                raise OSError(28, "No space left on device")
            taken, self.left = real.write(line[: self.left]), 0
            return taken

        def truncate(self, size):
            self.left = 1 << 20
            return real.truncate(size)

    kept._journal = Full()


def test_a_full_disk_is_one_sentence_and_the_next_step_makes_it_good(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    kept.session.mark(artifact())
    full_disk(kept)
    with pytest.raises(MarkermendError, match="free some space"):
        kept.session.mark(artifact("C"))
    kept.session.mark(artifact("C", start=5, stop=9))
    expected = state_of(kept.session)
    kept.close()
    again = open_session(make_take(), folder=tmp_path)
    assert state_of(again.session) == expected
    again.close()


def test_a_review_in_a_folder_that_became_read_only_goes_on_in_the_users_own(tmp_path, monkeypatch):
    monkeypatch.setattr("platformdirs.user_data_path", lambda *_, **__: tmp_path / "own")
    (tmp_path / "own").mkdir()
    shared = tmp_path / "shared"
    shared.mkdir()
    first = open_session(make_take(), folder=shared)
    first.session.mark(artifact())
    first.save()
    first.close()
    really = session_file._open_locked

    def locked(path):
        if path.parent == shared:
            raise PermissionError(13, "Permission denied")
        return really(path)

    monkeypatch.setattr(session_file, "_open_locked", locked)
    again = open_session(make_take(), folder=shared)
    assert not again.read_only
    assert len(again.session.artifacts) == 1
    assert again.path.parent == tmp_path / "own" / "sessions"
    again.close()


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


def test_detecting_again_keeps_what_was_marked_by_hand_or_given_other_edges():
    session = Session(make_take())
    found = [artifact("A"), artifact("C")]
    session.add_detected(found, "paper")
    session.mark(artifact("B", start=45, stop=50))
    session.change(found[0].id, stop=44)
    session.add_detected([artifact("C", start=2, stop=6)], "paper")
    assert [(a.marker, a.start, a.stop) for a in session.artifacts] == [
        ("C", 2, 6),
        ("A", 30, 44),
        ("B", 45, 50),
    ]


def test_repairing_repaired_ones_anew_starts_from_the_source():
    session = Session(make_take())
    a, b = artifact(start=30, stop=40), artifact(start=35, stop=45)
    session.add_detected([a, b], "paper")
    session.repair([(a.id, proposal(a)), (b.id, proposal(b))])
    session.repair([(a.id, proposal(a, 2.0)), (b.id, proposal(b, 3.0))])
    assert (session.positions[30:35, 0] == 2.0).all()
    assert (session.positions[35:45, 0] == 3.0).all()
    session.set_status([a.id, b.id], Status.PENDING)
    assert session.positions.tobytes() == session.original.positions.tobytes()


def test_looking_at_the_working_samples_checks_nothing_again(monkeypatch):
    session = Session(make_take())
    session.mark(artifact())
    monkeypatch.setattr(Take, "__post_init__", lambda self: pytest.fail("checked again"))
    assert session.take.positions.shape == (FRAMES, 3, 3)
