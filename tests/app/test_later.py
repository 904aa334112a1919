"""Work that waits for a turn of its own."""

from __future__ import annotations

import time
from functools import partial

from PySide6.QtCore import QObject, QTimer
from shiboken6 import delete

from markermend_app.later import Later, OneByOne


def test_what_is_asked_for_often_in_one_turn_is_done_once(qtbot):
    done, parent = [], QObject()
    later = Later(lambda: done.append(1), parent)
    for _ in range(3):
        later.ask()
    assert not done
    qtbot.waitUntil(lambda: bool(done))
    qtbot.wait(20)
    assert done == [1]


def test_things_that_wait_are_done_in_order_and_each_once(qtbot):
    done, parent = [], QObject()
    turns = OneByOne(parent)
    first, second = (partial(done.append, i) for i in (1, 2))
    for do in (first, second, first):
        turns.ask(do)
    qtbot.waitUntil(lambda: done == [1, 2])
    turns.ask(first)
    qtbot.wait(20)
    assert done == [1, 2, 1]


def test_what_asks_again_goes_behind_what_waits(qtbot):
    done, parent = [], QObject()
    turns = OneByOne(parent)

    def first():
        done.append("first")
        if done.count("first") < 3:
            turns.ask(first)

    turns.ask(first)
    turns.ask(lambda: done.append("second"))
    qtbot.waitUntil(lambda: len(done) == 4)
    assert done == ["first", "second", "first", "first"]


def test_whatever_waits_each_gets_a_turn_of_its_own_in_order(qtbot):
    done, parent = [], QObject()
    first, second = (Later(partial(done.append, i), parent) for i in (1, 2))
    beat = QTimer(parent, interval=0)
    beat.timeout.connect(lambda: done.append("beat"))
    second.ask()
    first.ask()
    beat.start()
    qtbot.waitUntil(lambda: 1 in done)
    beat.stop()
    assert [d for d in done if d != "beat"] == [2, 1]
    assert "beat" in done[done.index(2) : done.index(1)]


def test_what_is_done_at_once_is_not_done_later_too(qtbot):
    done, parent = [], QObject()
    later = Later(lambda: done.append(1), parent)
    later.ask()
    later.do()
    qtbot.wait(20)
    assert done == [1]
    assert not later.waiting


def test_what_ends_while_it_waits_is_not_done_and_holds_nobody_up(qtbot):
    done, parent, gone = [], QObject(), QObject()
    Later(lambda: done.append("gone"), gone).ask()
    Later(lambda: done.append("here"), parent).ask()
    delete(gone)
    qtbot.waitUntil(lambda: bool(done))
    assert done == ["here"]


def test_it_is_no_part_of_a_long_turn_that_asked_for_it(qtbot):
    done, parent = [], QObject()
    later = Later(lambda: done.append("later"), parent)

    def long():
        later.ask()
        QTimer.singleShot(5, lambda: done.append("what came meanwhile"))
        time.sleep(0.03)

    QTimer.singleShot(0, long)
    qtbot.waitUntil(lambda: "later" in done)
    assert done == ["what came meanwhile", "later"]
