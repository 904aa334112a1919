"""Garbage of the window is collected in its own thread, and without walking through libraries."""

from __future__ import annotations

import gc
import threading
import weakref

import pytest
from PySide6.QtCore import QObject

from markermend.progress import quiet
from markermend_app import detection
from markermend_app.background.garbage import MANY, PUT_OFF, Collector, keep_what_is_loaded


class Ring(QObject):
    """Holds itself, so that only a collection destroys it."""

    def __init__(self, seen):
        super().__init__()
        self.itself = self
        weakref.finalize(self, lambda: seen.append(threading.current_thread()))


@pytest.fixture
def collector(qapp):
    made = Collector(qapp)
    yield made
    made.stop()
    made.deleteLater()


def allocate():
    """Keep enough objects for Python to collect by itself."""
    kept = [[number] for number in range(200_000)]
    assert kept


def test_what_a_worker_does_destroys_no_objects_of_qt(collector, qtbot):
    seen = []
    Ring(seen)
    worker = threading.Thread(target=allocate)
    worker.start()
    worker.join()
    assert not seen
    qtbot.waitUntil(lambda: bool(seen))
    assert seen == [threading.main_thread()]


def test_the_window_does_not_walk_through_a_table_that_is_being_read(collector, monkeypatch):
    collected = []
    gc.collect()
    monkeypatch.setattr(gc, "collect", collected.append)
    table = [[number] for number in range(2 * MANY)]
    collector._collect()
    assert not collected
    # Who keeps as much for long has it looked through once.
    for _ in range(PUT_OFF):
        collector._collect()
    assert len(collected) == 1
    del table
    collector._collect()
    assert len(collected) == 2


def test_it_is_left_to_python_again_when_stopped(collector):
    assert not gc.isenabled()
    collector.stop()
    assert gc.isenabled()
    gc.disable()


def test_what_is_loaded_is_not_walked_through_at_every_collection(damaged):
    gc.unfreeze()
    keep_what_is_loaded.cache_clear()
    detection.search(damaged[0], None, quiet, slow=False)
    kept = gc.get_freeze_count()
    assert kept > 10_000
    later = [[number] for number in range(1000)]
    detection.search(damaged[0], None, quiet, slow=False)
    assert gc.get_freeze_count() <= kept, len(later)
