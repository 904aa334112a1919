"""File formats that other packages bring."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from markermend.errors import FileFormatError
from markermend.plugins.discover import FORMATS, loaded
from markermend.plugins.worker import Worker
from markermend.take import Source, Take

OURS = ("c3d", "trc", "csv")
SKELETONS = (".amc", ".bvh", ".asf")
"""Endings of skeleton recordings, which CSV may be too."""
SKELETONS_WRITTEN = (".csv", ".amc", ".bvh")


@dataclass(frozen=True)
class Format:
    """A file format.

    Attributes
    ----------
    name : the ending of its files without the dot, in small letters: ``"tsv"``
    label : name for people
    run : ``(path) -> Take``, reads a file
    write : ``(take) -> bytes``, the contents of a file, or None where it can only be read
    """

    name: str
    label: str
    run: Callable[[Path], Take]
    write: Callable[[Take], bytes] | None = None
    plugin: str = ""


@lru_cache(maxsize=1)
def formats() -> Mapping[str, Format]:
    """Formats that plugins bring, by ending with the dot."""
    return {f".{f.name}": f for f in loaded(FORMATS, Format, OURS, _guard)}


def contents(chosen: Format, take: Take) -> bytes:
    """What a file of a take holds, made by a plugin in another process."""
    return bytes(_worker(chosen.name).call(take, member="write"))


@cache
def _worker(name: str) -> Worker:
    """The process of a plugin, one for all that is read and written."""
    return Worker(FORMATS, name)


def _guard(chosen: Format) -> Callable[[Path], Take]:
    """Read in another process; takes know the file they came from, as those of our formats do."""
    worker = _worker(chosen.name)

    def read(path: Path, *, progress: Any = None) -> Take:
        status = path.stat()
        take = worker.call(path)
        if not isinstance(take, Take):
            raise FileFormatError(f"The plugin for .{chosen.name} files did not return a take.")
        if take.source is not None:
            return take
        source = Source(path.absolute(), chosen.name, status.st_size, status.st_mtime_ns)
        return replace(take, source=source)

    return read


def writable(*, skeleton: bool = False) -> tuple[str, ...]:
    """Endings of the files that can be written, with the dot; a skeleton recording's first."""
    usual = (*(f".{o}" for o in OURS), *(e for e, f in formats().items() if f.write is not None))
    return tuple(dict.fromkeys((*SKELETONS_WRITTEN, *usual))) if skeleton else usual


def writable_in_words(*, skeleton: bool = False) -> str:
    """Endings of the files that can be written, as a list for people."""
    *first, last = writable(skeleton=skeleton)
    return f"{', '.join(first)} or {last}"
