"""Reviews that were stored: reading a session file, and finding that of a take that was moved."""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from markermend.errors import FileFormatError
from markermend.review.place import JOURNAL_SUFFIX, index_entry, journal_path, session_of
from markermend.review.replay import holds_steps, starts_journal

VERSION = 3


def load(path: Path) -> dict[str, Any] | None:
    """Read a session file, or None when there is none."""
    try:
        with path.open(encoding="utf-8") as file:
            document = json.load(file)
        version = int(document["version"])
        if document["format"] != "markermend session":
            raise KeyError
        if version <= VERSION and not _has_its_parts(document):
            raise TypeError
    except FileNotFoundError:
        return None
    except (ValueError, KeyError, TypeError, OSError) as error:
        raise unreadable(path) from error
    if version > VERSION:
        raise FileFormatError(
            f"“{path}” was written by a newer Markermend; update, or move it away to start anew."
        )
    return document  # type: ignore[no-any-return]


def _has_its_parts(document: Mapping[str, Any]) -> bool:
    """Whether a session file holds a source and lists of steps."""
    lists = isinstance(document["done"], list) and isinstance(document["undone"], list)
    return lists and isinstance(document["source"]["sha256"], str)


def unreadable(path: Path) -> FileFormatError:
    """Say that a session file is not one."""
    return FileFormatError(
        f"“{path}” is not a readable Markermend review; move it away to start a new one."
    )


def moved(digest: str, path: Path, beside: Path) -> tuple[dict[str, Any] | None, Path]:
    """The review of the same take at another place, beside it before anywhere else, and where.

    Without a session file of one it may be that there is a journal; else the place is ``path``.
    """
    own = journal_path(path)
    if starts_journal(own, digest) and holds_steps(own.read_bytes()):
        # What a crash left before anything was saved is not to give way to the review of a copy.
        return None, path
    places = [beside]
    with contextlib.suppress(OSError):
        places.append(Path(os.fsdecode(index_entry(digest).read_bytes())))
    for where in places:
        if where != path:
            with contextlib.suppress(FileFormatError):
                stored = load(where)
                if stored is not None and stored["source"]["sha256"] == digest:
                    return stored, where
    if not own.exists() or own.stat().st_size == 0:
        for journal in sorted(beside.parent.glob(f"*{JOURNAL_SUFFIX}")):
            # What is still there, or open in another window, has a review of its own.
            take = journal.with_name(journal.name.removesuffix(JOURNAL_SUFFIX))
            if journal != own and not take.exists() and starts_journal(journal, digest):
                return None, session_of(journal)
    return None, path
