"""A review and its disk: killed processes, full and slow disks, steps that take long to write."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from reviews import artifact, die, make_take, state_of

from markermend.errors import MarkermendError
from markermend.review.file import open_session
from markermend.review.hand import replace_samples
from markermend.review.steps_json import step_to_dict

KILLED = """
    import sys
    from pathlib import Path
    from tests_session_take import make_take
    from markermend.artifact import Artifact, Kind
    from markermend.review.file import open_session

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


def comes_back(kept, folder):
    """Close a review and see that it is the same when it is opened again."""
    expected = state_of(kept.session)
    kept.close()
    again = open_session(make_take(), folder=folder)
    assert state_of(again.session) == expected
    again.close()


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
    comes_back(kept, tmp_path)


def test_nobody_waits_for_a_slow_disk_and_all_gets_there(tmp_path, monkeypatch):
    kept = open_session(make_take(), folder=tmp_path)
    brought, journal, go_on = [], Path(kept._journal.name), threading.Event()

    def lines():
        return journal.read_bytes().count(b"\n")

    def slow(handle):
        assert go_on.wait(10)
        brought.append(lines())

    kept._on_disk.wait()
    monkeypatch.setattr("markermend.review.on_disk.os.fsync", slow)
    for start in range(5):
        kept.session.mark(artifact("C", start=start, stop=9))
        assert lines() == start + 2, "a killed process loses nothing"
    assert not brought
    go_on.set()
    kept._on_disk.wait()
    assert brought[-1] == 6
    assert len(brought) <= 2
    kept.close()


def smooth_all(kept):
    """A step of as many samples as are written beside what goes on."""
    take = kept.session.original
    replace_samples(kept.session, "Smooth", take.labels, 0, 1.5 * take.positions, take.origin)


def test_a_long_step_is_written_beside_what_goes_on_and_before_what_follows(tmp_path, monkeypatch):
    kept = open_session(make_take(), folder=tmp_path)
    go_on, made = threading.Event(), step_to_dict

    def slow(step):
        if threading.current_thread() is not threading.main_thread():
            assert go_on.wait(10)
        return made(step)

    kept._on_disk.wait()
    monkeypatch.setattr("markermend.review.file.LONG", 100)
    monkeypatch.setattr("markermend.review.file.step_to_dict", slow)
    smooth_all(kept)
    kept.session.mark(artifact("C", start=5, stop=9))
    kept.session.undo()
    assert Path(kept._journal.name).read_bytes().count(b"\n") == 1
    go_on.set()
    comes_back(kept, tmp_path)


def test_a_long_step_that_could_not_be_written_is_saved_when_closing(tmp_path, monkeypatch):
    kept = open_session(make_take(), folder=tmp_path)
    monkeypatch.setattr("markermend.review.file.LONG", 100)
    full_disk(kept)
    smooth_all(kept)
    comes_back(kept, tmp_path)


def test_a_snapshot_is_taken_over_unless_the_review_went_on_or_was_saved(tmp_path):
    kept = open_session(make_take(), folder=tmp_path)
    kept.session.mark(artifact())
    taken = kept.snapshot()
    taken.write()
    kept.session.mark(artifact("C"))
    assert not kept.take_over(taken), "the second mark would be lost"
    taken = kept.snapshot()
    taken.write()
    kept.save()
    assert not kept.take_over(taken), "the journal would not continue it"
    taken = kept.snapshot()
    taken.write()
    assert kept.take_over(taken)
    kept.session.mark(artifact("C", start=5, stop=9))
    expected = state_of(kept.session)
    die(kept)
    again = open_session(make_take(), folder=tmp_path)
    assert state_of(again.session) == expected
    assert again.recovered == 1
    late = again.snapshot()
    late.write()
    again.close()
    assert not again.take_over(late)
    assert not list(tmp_path.glob("*.part"))


def test_a_snapshot_that_cannot_be_written_leaves_nothing(tmp_path, monkeypatch):
    kept = open_session(make_take(), folder=tmp_path)
    kept.session.mark(artifact())
    taken = kept.snapshot()

    def fails(handle):
        raise OSError(28, "No space left on device")

    kept._on_disk.wait()
    with monkeypatch.context() as full:
        full.setattr("markermend.review.saving.os.fsync", fails)
        with pytest.raises(MarkermendError, match="No space left"):
            taken.write()
    assert not list(tmp_path.glob("*.part"))
    comes_back(kept, tmp_path)


def test_a_disk_that_fails_later_is_told_and_the_next_step_makes_it_good(tmp_path, monkeypatch):
    kept = open_session(make_take(), folder=tmp_path)

    def fails(handle):
        raise OSError(5, "Input/output error")

    kept._on_disk.wait()
    with monkeypatch.context() as broken:
        broken.setattr("markermend.review.on_disk.os.fsync", fails)
        kept.session.mark(artifact())
        while kept._on_disk._working:
            time.sleep(0.001)
    with pytest.raises(MarkermendError, match="Input/output error"):
        kept.session.mark(artifact("C"))
    kept.session.mark(artifact("C", start=5, stop=9))
    comes_back(kept, tmp_path)


def test_after_a_long_step_that_failed_nothing_follows_in_the_journal(tmp_path, monkeypatch):
    kept = open_session(make_take(), folder=tmp_path)

    def fails(step):
        raise ValueError("out of range")

    kept._on_disk.wait()
    with monkeypatch.context() as broken:
        broken.setattr("markermend.review.file.LONG", 100)
        broken.setattr("markermend.review.file.step_to_dict", fails)
        smooth_all(kept)
        while kept._on_disk._working:
            time.sleep(0.001)
    lines = Path(kept._journal.name).read_bytes()
    with pytest.raises(ValueError, match="out of range"):
        kept.session.mark(artifact("C"))
    assert Path(kept._journal.name).read_bytes() == lines, "the step before it is missing"
    kept.session.mark(artifact("C", start=5, stop=9))
    comes_back(kept, tmp_path)
