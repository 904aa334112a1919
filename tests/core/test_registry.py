"""A room's list of methods is whole for whoever asks, whoever began to fill it."""

from __future__ import annotations

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
