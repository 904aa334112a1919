"""Work off the GUI thread: results arrive in it, progress is seen, cancel stops."""

from __future__ import annotations

import threading

import pytest

from markermend.errors import DataError
from markermend_app.background.jobs import Lane


@pytest.fixture
def lane(qapp):
    made = Lane("test")
    yield made
    made.close()


def never_mind(result):
    """Pass a result over."""


def never(error):
    pytest.fail(f"unexpected: {error}")


def test_result_arrives_in_the_gui_thread(lane, qtbot):
    seen = []
    lane.submit(
        "work",
        lambda progress: threading.current_thread(),
        lambda worker: seen.append((worker, threading.current_thread())),
        never,
    )
    qtbot.waitUntil(lambda: bool(seen))
    worker, here = seen[0]
    assert here is threading.main_thread()
    assert worker is not here


def test_progress_is_told_and_ends(lane, qtbot):
    told = []
    lane.progressed.connect(lambda share, doing: told.append((share, doing)))

    def work(progress):
        progress(0.25, "one")
        progress(1.0, "two")

    with qtbot.waitSignal(lane.finished):
        lane.submit("work", work, lambda _: None, never)
    assert told == [(0.25, "one"), (1.0, "two")]
    assert not lane.busy


def test_an_error_reaches_the_caller(lane, qtbot):
    errors = []

    def work(progress):
        raise DataError("no such marker")

    lane.submit("work", work, lambda _: pytest.fail("not done"), errors.append)
    qtbot.waitUntil(lambda: bool(errors))
    assert str(errors[0]) == "no such marker"


def test_cancel_stops_running_and_waiting_jobs(lane, qtbot):
    started, ended = threading.Event(), threading.Event()

    def endless(progress):
        started.set()
        try:
            while True:
                progress(0.5, "on and on")
        finally:
            ended.set()

    ran = []
    lane.submit("endless", endless, ran.append, never)
    lane.submit("waiting", lambda progress: ran.append("waiting"), ran.append, never)
    qtbot.waitUntil(started.is_set)
    lane.cancel()
    assert ended.wait(5)
    qtbot.waitUntil(lambda: not lane.busy)
    assert ran == []


def test_a_job_begins_after_the_turn_that_asked_for_it(lane, qtbot):
    started = threading.Event()
    lane.submit("work", lambda progress: started.set(), never_mind, never)
    assert lane.busy
    assert not started.wait(0.1)
    qtbot.waitUntil(started.is_set)


def test_jobs_run_in_order(lane, qtbot):
    order = []
    for i in range(5):
        lane.submit("work", lambda progress, i=i: i, order.append, never)
    qtbot.waitUntil(lambda: len(order) == 5)
    assert order == [0, 1, 2, 3, 4]


def test_what_a_cancelled_job_came_to_is_handed_back(lane, qtbot):
    finishing, go_on = threading.Event(), threading.Event()

    def deaf(progress):
        finishing.set()
        assert go_on.wait(5)
        return "a lock"

    let_go = []
    lane.submit("deaf", deaf, lambda _: pytest.fail("not done"), never, let_go.append)
    qtbot.waitUntil(finishing.is_set)
    lane.cancel()
    go_on.set()
    qtbot.waitUntil(lambda: not lane.busy)
    assert let_go == ["a lock"]
