"""A room's list of methods is whole for whoever asks, whoever began to fill it."""

from __future__ import annotations

import contextlib
import threading
from dataclasses import dataclass

from markermend import registry
from markermend.registry import Registry


@dataclass(frozen=True)
class Method:
    """A method of a room."""

    name: str
    plugin: str = ""


def test_who_asks_while_plugins_are_loaded_waits_for_them(monkeypatch):
    begun, go_on = threading.Event(), threading.Event()
    inside: list[list[str]] = []

    def loaded(*_):
        begun.set()
        # A plugin that is imported may ask for the room it belongs to.
        inside.append(list(room))
        assert go_on.wait(10)
        return [Method("theirs", "package")]

    monkeypatch.setattr(registry, "loaded", loaded)
    room = Registry("method", Method, "group", lambda m: lambda: None)
    room.add(Method("ours"))
    seen: list[list[str]] = []
    first = threading.Thread(target=lambda: seen.append(list(room)))
    first.start()
    assert begun.wait(10)
    second = threading.Thread(target=lambda: seen.append(list(room)))
    second.start()
    second.join(0.1)
    assert not seen
    go_on.set()
    first.join()
    second.join()
    assert seen == [["ours", "theirs"]] * 2
    assert inside == [["ours"]]


def test_plugins_that_ask_for_other_rooms_hold_nobody_up(monkeypatch):
    """A package that serves two rooms is imported once, by whoever comes first."""
    package, barrier = threading.RLock(), threading.Barrier(2)
    rooms: dict[str, Registry] = {}

    def loaded(group, *_):
        with contextlib.suppress(threading.BrokenBarrierError):
            barrier.wait(0.2)
        with package:
            list(rooms["repairs" if group == "smoothers" else "smoothers"])
        return [Method("theirs", "package")]

    monkeypatch.setattr(registry, "loaded", loaded)
    for group in ("repairs", "smoothers"):
        rooms[group] = Registry("method", Method, group, lambda m: lambda: None)
    threads = [threading.Thread(target=list, args=(room,), daemon=True) for room in rooms.values()]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(10)
    assert not any(thread.is_alive() for thread in threads)
    assert [list(room) for room in rooms.values()] == [["theirs"]] * 2
