"""A batch under review: what the list tells, and the next take that opens at once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt

import markermend as mm
from markermend.artifact import Status
from markermend.batch import Recipe, find_takes, run_batch
from markermend.review.file import open_session
from markermend_app import settings
from markermend_app.dialogs import export as export_dialog

WAIT = 60_000


@pytest.fixture
def shoot(tmp_path, damaged):
    """Record three damaged takes, one of them in a folder below."""
    folder = tmp_path / "day1"
    (folder / "more").mkdir(parents=True)
    take = damaged[0]
    for i, name in enumerate(("a", "b", "more/c")):
        # Takes that are the same to the byte share their review.
        mm.write(take.with_positions(take.positions + i, take.origin), folder / f"{name}.c3d")
    return folder


@pytest.fixture
def window(qtbot):
    from markermend_app.window import MainWindow

    def let_close(window):
        window.document.open(None, None)

    made = MainWindow()
    qtbot.addWidget(made, before_close_func=let_close)
    made.show()
    made.activateWindow()
    qtbot.waitExposed(made)
    return made


def settled(window, qtbot):
    """Wait until a take is open, searched and everything ahead is done."""
    batch, document = window.batch, window.document

    def at_rest():
        idle = not window.lane.busy and not batch._ahead.busy
        seen = all(i.path in batch.glances or i.path in batch.problems for i in batch.items)
        return idle and seen and document.session is not None and document.mesh is not None

    qtbot.waitUntil(at_rest, timeout=WAIT)


def arrive(window, qtbot, name):
    """Wait until a take is open with an artifact under review."""
    document = window.document
    qtbot.waitUntil(
        lambda: document.path.name == name and document.current is not None, timeout=WAIT
    )


def test_the_next_take_is_ready_and_opens_with_its_first_repair(window, shoot, qtbot):
    batch, document = window.batch, window.document
    batch.start([shoot])
    settled(window, qtbot)
    assert [item.name for item in batch.items] == ["a", "b", "more/c"]
    assert document.path.name == "a.c3d"
    assert window.docks["takes"].isVisible()
    ahead = batch.next_item
    assert ahead.name == "b"
    assert batch.ready(ahead)
    # Nothing is held or written for a take that is only made ready.
    assert not list(shoot.glob("b.*.markermend.*"))
    first = document.current.id
    qtbot.keyClick(window, Qt.Key.Key_R)
    opened = []
    document.opened.connect(lambda: opened.append(document.mesh is not None))
    qtbot.keyClick(window, Qt.Key.Key_N, Qt.KeyboardModifier.ShiftModifier)
    arrive(window, qtbot, "b.c3d")
    assert opened == [True]
    assert document.session.history == ("Detect (sudden)",)
    assert document.proposal is not None
    assert document.current.id == window.queue.model.rows[0].id
    assert window.docks["takes"].widget().view.currentIndex().row() == 1, "it is the one chosen"
    # The first one's review was kept, without a question.
    kept = open_session(mm.read(shoot / "a.c3d"))
    assert kept.session.artifact(first).status is Status.REJECTED
    kept.close()


def test_the_list_tells_how_each_take_stands(window, shoot, qtbot):
    batch, model = window.batch, window.docks["takes"].widget().model
    batch.start([shoot])
    settled(window, qtbot)
    total = len(window.document.session.artifacts)
    qtbot.keyClick(window, Qt.Key.Key_R)
    qtbot.waitUntil(lambda: batch.glances[shoot / "a.c3d"].decided == 1, timeout=WAIT)
    told = [row.facts() for row in model.rows]
    assert [model.index(i).data() for i in range(3)] == ["a", "b", "more/c"]
    missing = 1 - mm.read(shoot / "a.c3d").present.mean()
    assert told[0] == f"1/{total} · {100 * missing:.1f} % missing"
    assert told[1] == f"0/{total} · {100 * missing:.1f} % missing"
    assert told[2] == f"not searched · {100 * missing:.1f} % missing"
    assert [row.share for row in model.rows] == [1 / total, 0.0, None]
    glance = model.rows[0].glance
    for worst, words in ((0.01, "< 0.05 mm"), (3.21, "± 3.2 mm")):
        standing = replace(glance.standing, worst_mm=worst)
        row = replace(model.rows[0], glance=replace(glance, standing=standing))
        assert row.facts().endswith(words)
    row = replace(model.rows[0], glance=replace(glance, exported=True))
    assert row.facts().startswith(f"1/{total} · exported · "), "some are still open"


def test_what_is_exported_is_marked_also_when_it_is_listed_again(window, shoot, qtbot, tmp_path):
    batch, document = window.batch, window.document
    model = window.docks["takes"].widget().model
    batch.start([shoot])
    settled(window, qtbot)
    document.decisions.reject([a.id for a in document.session.artifacts])
    choice = export_dialog.ExportChoice(record=True, mark_outputs=False)
    assert window.commands._exporter.export_to(tmp_path / "out.c3d", choice, wait=True)
    qtbot.waitUntil(lambda: model.rows[0].facts().startswith("exported"), timeout=WAIT)
    document.open(None, None)
    batch.start([shoot])
    settled(window, qtbot)
    assert [row.facts().startswith("exported") for row in model.rows] == [True, False, False]
    qtbot.waitUntil(lambda: model.rows[0].glance.exported)


def test_what_is_done_is_passed_over_and_the_key_is_told(window, shoot, qtbot):
    batch, document = window.batch, window.document
    done = open_session(mm.read(shoot / "b.c3d"))
    done.session.add_detected((), "sudden")
    done.save()
    done.close()
    batch.start([shoot])
    settled(window, qtbot)
    assert batch.next_item.name == "more/c"
    document.decisions.reject([a.id for a in document.session.artifacts])
    assert "Shift+N goes on with more/c" in window.status._said.whole
    batch.next_take()
    arrive(window, qtbot, "c.c3d")
    document.decisions.reject([a.id for a in document.session.artifacts])
    qtbot.waitUntil(lambda: batch.next_item is None, timeout=WAIT)
    batch.next_take()
    assert "done" in window.status._said.whole
    assert document.path.name == "c.c3d"


def test_a_take_that_cannot_be_read_does_not_stop_the_batch(window, shoot, qtbot):
    (shoot / "b.c3d").write_bytes(b"no take")
    window.batch.start([shoot])
    settled(window, qtbot)
    assert "b.c3d" in window.batch.problems[shoot / "b.c3d"]
    assert window.batch.next_item.name == "more/c"
    model = window.docks["takes"].widget().model
    assert model.rows[1].facts() == "cannot be opened"


def test_a_file_that_changed_after_it_was_made_ready_is_read_anew(window, shoot, qtbot, damaged):
    window.batch.start([shoot])
    settled(window, qtbot)
    assert window.batch.ready(window.batch.next_item)
    take = damaged[0]
    positions = take.positions.copy()
    positions[300:320, 5] = np.nan
    origin = take.origin.copy()
    origin[300:320, 5] = 0
    mm.write(take.with_positions(positions, origin), shoot / "b.c3d", overwrite=True)
    window.batch.next_take()
    document = window.document
    arrive(window, qtbot, "b.c3d")
    assert np.isnan(document.session.positions[310, 5]).all()
    assert any(a.start == 300 for a in document.session.artifacts)


def test_what_a_batch_left_is_reviewed_from_where_it_ended(window, shoot, qtbot, tmp_path):
    out = tmp_path / "out"
    run_batch(find_takes([shoot / "a.c3d"]), out, Recipe(min_confidence=1.0), jobs=1)
    settings.remember("detect_on_open", False)
    window.open_paths([out / "review.json"])
    settled(window, qtbot)
    session = window.document.session
    assert window.document.path == shoot / "a.c3d"
    clean = mm.read(out / "takes" / "a_clean.c3d")
    assert np.array_equal(session.positions, clean.positions, equal_nan=True)
    assert session.with_status(Status.PENDING)
    assert window.document.current.status is Status.PENDING


def test_the_next_start_has_no_empty_list_of_takes(window, shoot, qtbot):
    window.batch.start([shoot])
    settled(window, qtbot)
    assert not window.docks["takes"].isHidden()
    window.close()
    fresh = type(window)()
    qtbot.addWidget(fresh)
    assert fresh.docks["takes"].isHidden()
    assert not fresh.docks["history"].isHidden()
