"""A stored review done again, step by step."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from markermend.review.left_at import left_at_from_dict
from markermend.review.session import Session
from markermend.review.steps_json import step_from_dict


def replay_document(session: Session, document: Mapping[str, Any]) -> None:
    """Do again every step of a session file, then take back what stood undone.

    Parameters
    ----------
    session : a new review of the take
    document : what the file holds

    Raises
    ------
    KeyError, TypeError, ValueError, AttributeError, DataError
        when a part of it is missing or is not what it should be
    """
    undone = [step_from_dict(d) for d in document["undone"]]
    for entry in document["done"]:
        session.perform(*step_from_dict(entry))
    for step in reversed(undone):
        session.perform(*step)
    for _ in undone:
        session.undo()
    session.left_at = left_at_from_dict(document.get("at"))
    if document.get("exported") is not None:
        session.mark_exported(int(document["exported"]))


def replay_journal(session: Session, text: bytes, generation: int, digest: str) -> int:
    """Do again what a journal holds; stops at the first line that a crash cut short.

    Parameters
    ----------
    session : the review as it is saved
    text : the journal
    generation, digest : of the session file and the take that it must continue

    Returns
    -------
    Steps that were done again
    """
    lines = text.split(b"\n")
    head = _parse(lines[0])
    if head is None or head.get("generation") != generation or head.get("sha256") != digest:
        return 0
    count = 0
    for line in lines[1:]:
        entry = _parse(line)
        if entry is None:
            break
        if "at" in entry:
            session.left_at = left_at_from_dict(entry["at"])
            continue
        if "do" in entry:
            session.perform(*step_from_dict(entry["do"]))
        elif "undo" in entry:
            session.undo()
        else:
            session.redo()
        count += 1
    return count


def starts_journal(path: Path, digest: str) -> bool:
    """Whether a file is a journal of a take of which no session file was written."""
    try:
        with path.open("rb") as file:
            head = _parse(file.readline())
    except OSError:
        return False
    return head is not None and (head.get("generation"), head.get("sha256")) == (0, digest)


def holds_steps(journal: bytes) -> bool:
    """Whether a journal holds more than its head and where the operator stood."""
    _, *lines = journal.split(b"\n")
    return any(line and not line.startswith(b'{"at"') for line in lines)


def _parse(line: bytes) -> dict[str, Any] | None:
    """One journal line, or None when it is empty or cut short."""
    try:
        entry = json.loads(line)
    except ValueError:
        return None
    return entry if isinstance(entry, dict) else None
