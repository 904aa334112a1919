"""Work off the GUI thread: results arrive in it, progress is seen, cancel stops."""

from __future__ import annotations

import os
import subprocess
import sys
import threading

import pytest

from markermend.errors import DataError
from markermend.progress import heed
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


@pytest.mark.skipif(sys.platform != "linux", reason="threads are nice by themselves on Linux only")
def test_workers_and_their_processes_come_after_the_window(lane, qtbot):
    def niceness(progress):
        own = os.getpriority(os.PRIO_PROCESS, threading.get_native_id())
        return own, int(subprocess.check_output(["nice"]))

    seen = []
    lane.submit("work", niceness, seen.append, never)
    qtbot.waitUntil(lambda: bool(seen))
    window = os.getpriority(os.PRIO_PROCESS, threading.get_native_id())
    assert all(nice > window for nice in seen[0])


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


def test_the_same_is_told_once(lane, qtbot):
    told = []
    lane.progressed.connect(lambda share, doing: told.append((share, doing)))

    def work(progress):
        heed()
        for share in (0.25, 0.25, 0.5):
            progress(share, "one")
            heed()

    with qtbot.waitSignal(lane.finished):
        lane.submit("work", work, lambda _: None, never)
    assert told == [(0.25, "one"), (0.5, "one")]


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


def test_a_lane_behind_another_begins_nothing_while_that_one_has_jobs(lane, qtbot):
    behind = Lane("behind", behind=lane)
    order, go_on = [], threading.Event()

    def first(progress):
        go_on.wait(10)
        order.append("first")

    def follow(_):
        # More for the lane that goes first, asked for in the turn in which it became free.
        lane.submit("second", lambda _: order.append("second"), never_mind, never)

    lane.submit("first", first, follow, never)
    for name in ("third", "fourth"):
        behind.submit(name, lambda _, name=name: order.append(name), never_mind, never)
    qtbot.wait(50)
    assert order == []
    go_on.set()
    qtbot.waitUntil(lambda: not behind.busy)
    assert order == ["first", "second", "third", "fourth"]
    behind.submit("alone", lambda _: order.append("alone"), never_mind, never)
    qtbot.waitUntil(lambda: not behind.busy)
    assert order[-1] == "alone"
    behind.close()


def test_what_is_held_back_can_be_cancelled(lane, qtbot):
    behind = Lane("behind", behind=lane)
    go_on, ran = threading.Event(), []
    lane.submit("first", lambda _: go_on.wait(10), never_mind, never)
    behind.submit("held", lambda _: ran.append(1), never_mind, never)
    qtbot.wait(20)
    behind.cancel()
    go_on.set()
    qtbot.waitUntil(lambda: not behind.busy)
    assert ran == []
    behind.close()


def test_a_job_behind_another_lane_rests_where_it_reports(lane, qtbot):
    behind = Lane("behind", behind=lane)
    order, began, meanwhile = [], threading.Event(), threading.Event()

    def patient(progress):
        began.set()
        meanwhile.wait(10)
        progress(0.5, "half")
        order.append("patient")

    behind.submit("patient", patient, never_mind, never)
    qtbot.waitUntil(began.is_set)

    def urgent(_):
        meanwhile.set()
        # Time enough for the other to overtake, did it not rest.
        threading.Event().wait(0.1)
        order.append("urgent")

    lane.submit("urgent", urgent, never_mind, never)
    qtbot.waitUntil(lambda: not behind.busy)
    assert order == ["urgent", "patient"]
    behind.submit("patient", patient, never_mind, never)
    lane.submit("urgent", lambda _: threading.Event().wait(0.2), never_mind, never)
    behind.close()
