"""Where a review is kept: a JSON file beside the take, and a journal that survives a crash.

The session file holds the source's hash, the artifacts and every step. Between saves each step
is appended to the journal and flushed to disk before the next one can happen, so that a killed
process loses at most the step in flight. The journal starts with the generation of the session
file it continues; one that belongs to an older file is not replayed.

The journal's operating system lock marks the review as open: it dies with its process. A second
opening gets a read-only review.
"""

from __future__ import annotations

import base64
import hashlib
import json
import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np

from markermend.artifact_json import from_dict, to_dict
from markermend.edits import Edit, Group, RepairNote, SetArtifacts, SetNotes, SetSamples
from markermend.errors import FileFormatError, MarkermendError
from markermend.patch import Patch
from markermend.session import Session, Step
from markermend.take import Take

VERSION = 1
SUFFIX = ".markermend.json"
JOURNAL_SUFFIX = ".markermend.journal"


def source_hash(take: Take) -> str:
    """SHA-256 of the take's source file, or of its samples when it has none."""
    digest = hashlib.sha256()
    if take.source is None:
        digest.update(json.dumps([take.labels, take.rate, take.first_frame]).encode())
        digest.update(take.positions.tobytes())
        return digest.hexdigest()
    with take.source.path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@dataclass
class SessionFile:
    """An open review on disk.

    Attributes
    ----------
    session : the review, with every step that was saved or journalled
    path : the session file beside the take (or in the user's data folder where that is
        read-only)
    read_only : another window has this take open; nothing is written
    recovered : steps that came from the journal of a crashed or killed process
    warning : one sentence when the stored review could not be used as it is, or empty
    """

    session: Session
    path: Path
    hash: str
    read_only: bool = False
    recovered: int = 0
    warning: str = ""
    generation: int = 0
    _journal: IO[bytes] | None = None

    def save(self) -> None:
        """Write the whole review to the session file and start the journal afresh."""
        if self.read_only:
            return
        done, undone = self.session.steps
        document = {
            "format": "markermend session",
            "version": VERSION,
            "generation": self.generation + 1,
            "source": {"sha256": self.hash},
            "artifacts": [to_dict(a) for a in self.session.artifacts],
            "done": [_step_to_dict(s) for s in done],
            "undone": [_step_to_dict(s) for s in undone],
        }
        part = self.path.with_name(self.path.name + ".part")
        try:
            with part.open("w", encoding="utf-8") as file:
                json.dump(document, file, allow_nan=False)
                file.flush()
                os.fsync(file.fileno())
            os.replace(part, self.path)
        except OSError as error:
            part.unlink(missing_ok=True)
            raise MarkermendError(
                f"The review could not be saved to “{self.path}” ({error.strerror})."
            ) from error
        self.generation += 1
        self._start_journal()

    def close(self) -> None:
        """Let go of the lock; an empty journal is removed."""
        if self._journal is None:
            return
        journal, self._journal = self._journal, None
        self.session.on_step = None
        empty = _lines(journal) <= 1
        name = Path(journal.name)
        journal.close()
        if empty:
            name.unlink(missing_ok=True)

    def discard(self) -> None:
        """Forget the review: session file and journal are deleted."""
        if self.read_only:
            return
        if self._journal is not None:
            self._start_journal()
        self.close()
        self.path.unlink(missing_ok=True)

    def _start_journal(self) -> None:
        """Empty the journal and head it with the generation it continues."""
        if self._journal is None:
            return
        self._journal.seek(0)
        self._journal.truncate()
        self._append({"generation": self.generation, "version": VERSION, "sha256": self.hash})

    def _append(self, entry: Mapping[str, Any]) -> None:
        """Add one line and do not return before it is on disk."""
        if self._journal is None:
            return
        self._journal.seek(0, os.SEEK_END)
        self._journal.write(json.dumps(entry, allow_nan=False).encode() + b"\n")
        self._journal.flush()
        os.fsync(self._journal.fileno())

    def _on_step(self, what: str, step: Step) -> None:
        """Journal one step of the session."""
        self._append({"do": _step_to_dict(step)} if what == "do" else {what: True})


def open_session(take: Take, *, folder: Path | None = None) -> SessionFile:
    """Open the review of a take: the stored one, what its journal adds, or a new one.

    Parameters
    ----------
    take : the recording
    folder : where the session file lies; beside the take by default, or in the user's data
        folder when that cannot be written to

    Raises
    ------
    FileFormatError
        when the session file is not one, or of a newer version
    """
    digest = source_hash(take)
    path = _session_path(take, digest, folder)
    session = Session(take)
    result = SessionFile(session, path, digest)
    journal = path.with_name(path.name[: -len(SUFFIX)] + JOURNAL_SUFFIX)
    handle = _open_locked(journal)
    result.read_only = handle is None
    stored = _load(path)
    if stored is not None and stored["source"]["sha256"] != digest:
        result.warning = (
            "The take has changed since it was reviewed; "
            f"the old review stays in “{path.name}.old”."
        )
        if handle is not None:
            os.replace(path, path.with_name(path.name + ".old"))
            handle.truncate(0)
        stored = None
    if stored is not None:
        result.generation = int(stored["generation"])
        _replay_document(session, stored)
    if handle is not None:
        handle.seek(0)
        result.recovered = _replay_journal(session, handle.read(), result.generation, digest)
        result._journal = handle
        if result.recovered:
            result.save()
        else:
            result._start_journal()
        session.on_step = result._on_step
    return result


def _session_path(take: Take, digest: str, folder: Path | None) -> Path:
    """Beside the take when that folder can be written to, else in the user's data folder."""
    if take.source is not None:
        name = take.source.path.name + SUFFIX
        home = folder or take.source.path.parent
        if (home / name).exists() or os.access(home, os.W_OK):
            return home / name
    else:
        name = "take" + SUFFIX
        if folder is not None:
            return folder / name
    from platformdirs import user_data_path

    home = user_data_path("markermend", appauthor=False, ensure_exists=True) / "sessions"
    home.mkdir(exist_ok=True)
    return home / f"{digest[:16]}-{name}"


def _open_locked(path: Path) -> IO[bytes] | None:
    """Open the journal under the operating system's lock, or None when another holds it."""
    handle = open(path, "a+b")  # noqa: SIM115 - held open for the life of the review
    try:
        if sys.platform == "win32":
            import msvcrt

            # Far behind the content, so that other programs can still read the journal.
            handle.seek(1 << 30)
            msvcrt.locking(handle.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        handle.close()
        return None
    return handle


def _load(path: Path) -> dict[str, Any] | None:
    """Read a session file, or None when there is none."""
    try:
        with path.open(encoding="utf-8") as file:
            document = json.load(file)
        version = int(document["version"])
        if document["format"] != "markermend session":
            raise KeyError
    except FileNotFoundError:
        return None
    except (ValueError, KeyError, TypeError, OSError) as error:
        raise FileFormatError(
            f"“{path}” is not a readable Markermend review; move it away to start a new one."
        ) from error
    if version > VERSION:
        raise FileFormatError(
            f"“{path}” was written by a newer Markermend; update, or move it away to start anew."
        )
    return document  # type: ignore[no-any-return]


def _replay_document(session: Session, document: Mapping[str, Any]) -> None:
    """Do again every step of a session file, then take back what stood undone."""
    undone = [_step_from_dict(d) for d in document["undone"]]
    for entry in document["done"]:
        session.perform(*_step_from_dict(entry))
    for label, edit in reversed(undone):
        session.perform(label, edit)
    for _ in undone:
        session.undo()


def _replay_journal(session: Session, text: bytes, generation: int, digest: str) -> int:
    """Do again what a journal holds; stops at the first line that a crash cut short."""
    lines = text.split(b"\n")
    head = _parse(lines[0])
    if head is None or head.get("generation") != generation or head.get("sha256") != digest:
        return 0
    count = 0
    for line in lines[1:]:
        entry = _parse(line)
        if entry is None:
            break
        if "do" in entry:
            session.perform(*_step_from_dict(entry["do"]))
        elif "undo" in entry:
            session.undo()
        else:
            session.redo()
        count += 1
    return count


def _parse(line: bytes) -> dict[str, Any] | None:
    """One journal line, or None when it is empty or cut short."""
    try:
        entry = json.loads(line)
    except ValueError:
        return None
    return entry if isinstance(entry, dict) else None


def _lines(journal: IO[bytes]) -> int:
    """Count the lines of an open journal."""
    journal.seek(0)
    return journal.read().count(b"\n")


def _step_to_dict(step: Step) -> dict[str, Any]:
    return {"label": step.label, "edit": _edit_to_dict(step.edit)}


def _step_from_dict(entry: Mapping[str, Any]) -> tuple[str, Edit]:
    return entry["label"], _edit_from_dict(entry["edit"])


def _edit_to_dict(edit: Edit) -> dict[str, Any]:
    """Write an edit as JSON; samples as base64 of little-endian doubles, to keep every bit."""
    if isinstance(edit, Group):
        return {"group": [_edit_to_dict(e) for e in edit.edits]}
    if isinstance(edit, SetSamples):
        return {"samples": [_patch_to_dict(p) for p in edit.patches]}
    if isinstance(edit, SetArtifacts):
        return {
            "artifacts": {i: None if a is None else to_dict(a) for i, a in edit.changes.items()}
        }
    return {
        "notes": {
            i: None if n is None else {"method": n.method, "error_mm": n.error_mm}
            for i, n in edit.changes.items()
        }
    }


def _edit_from_dict(entry: Mapping[str, Any]) -> Edit:
    if "group" in entry:
        return Group(tuple(_edit_from_dict(e) for e in entry["group"]))
    if "samples" in entry:
        return SetSamples(tuple(_patch_from_dict(p) for p in entry["samples"]))
    if "artifacts" in entry:
        return SetArtifacts(
            {i: None if a is None else from_dict(a) for i, a in entry["artifacts"].items()}
        )
    return SetNotes(
        {
            i: None if n is None else RepairNote(n["method"], n["error_mm"])
            for i, n in entry["notes"].items()
        }
    )


def _patch_to_dict(patch: Patch) -> dict[str, Any]:
    return {
        "marker": patch.marker,
        "axes": patch.axes,
        "start": patch.start,
        "stop": patch.stop,
        "values": base64.b64encode(patch.values.astype("<f8").tobytes()).decode(),
        "origin": None
        if patch.origin is None
        else base64.b64encode(patch.origin.tobytes()).decode(),
    }


def _patch_from_dict(entry: Mapping[str, Any]) -> Patch:
    shape = (entry["stop"] - entry["start"], len(entry["axes"]))
    values = np.frombuffer(base64.b64decode(entry["values"]), dtype="<f8").reshape(shape)
    origin = entry["origin"]
    return Patch(
        marker=entry["marker"],
        axes=entry["axes"],
        start=entry["start"],
        stop=entry["stop"],
        values=values.astype(np.float64),
        origin=None if origin is None else np.frombuffer(base64.b64decode(origin), dtype=np.uint8),
    )
