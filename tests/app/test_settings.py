"""Preferences are known at once, and on the disk soon."""

from __future__ import annotations

import threading

import pytest
from PySide6.QtCore import QByteArray

from markermend_app import settings


@pytest.fixture
def slow_disk(monkeypatch):
    """Settings that are written only once this is set."""
    free = threading.Event()
    write = settings._write

    def wait_and_write(name, value):
        assert free.wait(10)
        write(name, value)

    monkeypatch.setattr(settings, "_write", wait_and_write)
    yield free
    free.set()
    settings.settle()


def test_what_is_remembered_holds_before_it_is_written(slow_disk):
    settings.remember("theme", "dark")
    assert settings.text("theme", "system") == "dark"
    assert settings.store().value("theme") is None
    slow_disk.set()
    settings.settle()
    assert settings.store().value("theme") == "dark"


def test_the_last_of_several_values_stays():
    for width in range(20):
        settings.remember("width", width)
    settings.settle()
    settings._known.clear()
    assert settings.number("width", -1) == 19


@pytest.mark.parametrize("value", [True, False])
def test_a_flag_is_read_as_it_was_written(value):
    settings.remember("seen", value)
    assert settings.flag("seen", not value) is value
    settings.settle()
    settings._known.clear()
    assert settings.flag("seen", not value) is value


def test_numbers_words_and_layouts_are_read_as_they_were_written(tmp_path):
    take = tmp_path / "take.c3d"
    take.touch()
    settings.add_recent(take)
    settings.remember("minutes", 2.5)
    settings.remember("state", QByteArray(b"laid out"))
    settings.settle()
    settings._known.clear()
    assert settings.recent() == [take]
    assert settings.number("minutes", 1.0) == 2.5
    assert settings.layout("state") == QByteArray(b"laid out")
    assert settings.layout("geometry") is None


def test_what_is_forgotten_is_as_delivered_again():
    settings.remember("unit", "m")
    settings.remember("unit", None)
    assert settings.text("unit", "mm") == "mm"
    settings.settle()
    assert not settings.store().contains("unit")


def test_a_number_that_is_none_is_as_delivered():
    settings.remember("minutes", "many")
    assert settings.number("minutes", 5.0) == 5.0


def test_takes_that_another_window_opened_are_kept(tmp_path):
    takes = [tmp_path / f"{name}.c3d" for name in "ABC"]
    for take in takes:
        take.touch()
    settings.add_recent(takes[0])
    settings.settle()
    other = settings.store()
    other.setValue("recent", [str(takes[1]), str(takes[0])])
    other.sync()
    settings.add_recent(takes[2])
    assert settings.recent()[0] == takes[2]
    settings.settle()
    settings._known.clear()
    assert settings.recent() == [takes[2], takes[1], takes[0]]
