"""Where a review is kept: a JSON file beside the take, and a journal that survives a crash.

The session file holds the source's hash, the artifacts and every step. Between saves each step
is appended to the journal, so that a killed process loses nothing, and is brought to the disk
beside what goes on, so that a machine that fails loses at most the last moment. A step of very many
samples, as when a whole take is smoothed, is written beside what goes on, too. The journal starts
with the generation of the session file it continues; one that belongs to an older file is not
replayed.

The journal's operating system lock marks the review as open: it dies with its process. A second
opening gets a read-only review.

Where the operator stood is journalled as well, for the review to go on there; it is no step.
"""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any

from markermend.errors import DataError, MarkermendError
from markermend.review.carry import carry_over, go_on, marker_hashes
from markermend.review.edits import samples_in
from markermend.review.left_at import left_at_to_dict
from markermend.review.lock import open_locked
from markermend.review.on_disk import OnDisk
from markermend.review.place import (
    SUFFIX,
    index_entry,
    journal_path,
    own_path,
    session_path,
    source_hash,
)
from markermend.review.replay import holds_steps, replay_document, replay_journal
from markermend.review.saving import Snapshot
from markermend.review.session import Session
from markermend.review.step import Step
from markermend.review.steps_json import step_to_dict
from markermend.review.stored import VERSION, load, moved, unreadable
from markermend.take import Take

LONG = 50_000
"""Samples in a step that take some 10 ms to be written."""


@dataclass
class SessionFile:
    """An open review on disk.

    Attributes
    ----------
    session : the review, with every step that was saved or journalled
    path : the session file beside the take (or in the user's data folder where that is
        read-only)
    hash : SHA-256 of the take's file, by which a review is found again
    read_only : another window has this take open; nothing is written
    recovered : steps that came from the journal of a crashed or killed process
    warning : one sentence when the stored review could not be used as it is, or empty
    generation : how often the session file was written; a journal continues one generation
    wrote : hash of what was exported over the take's file, by which it is known again; or empty
    taken_over : journal of a take that was renamed, which goes once this review is saved, or None
    """

    session: Session
    path: Path
    hash: str
    read_only: bool = False
    recovered: int = 0
    warning: str = ""
    generation: int = 0
    wrote: str = ""
    taken_over: Path | None = None
    _journal: IO[bytes] | None = None
    _torn: bool = False
    _on_disk: OnDisk = field(default_factory=OnDisk)
    _markers: Mapping[str, str] = field(default_factory=dict)

    @property
    def is_open(self) -> bool:
        """Whether it has not been closed; what is open to be looked at only never is."""
        return self._journal is not None

    def save(self) -> None:
        """Write the whole review to the session file and start the journal afresh."""
        if self.read_only:
            return
        taken = self.snapshot(".part")
        taken.write()
        self.take_over(taken)

    def snapshot(self, ending: str = ".beside.part") -> Snapshot:
        """The review as it stands, to be written beside what goes on and then taken over.

        Parameters
        ----------
        ending : of the name that what is written has until then
        """
        done, undone = self.session.steps
        source = {
            "sha256": self.hash,
            "path": _source_path(self.session.original),
            "markers": dict(self._markers),
            "wrote": self.wrote,
        }
        return Snapshot(
            path=self.path,
            part=self.path.with_name(self.path.name + ending),
            revision=self.session.revision,
            generation=self.generation + 1,
            head={"format": "markermend session", "version": VERSION, "source": source},
            artifacts=self.session.artifacts,
            done=done,
            undone=undone,
            exported=self.session.exported_at,
            left_at=self.session.left_at,
        )

    def take_over(self, taken: Snapshot) -> bool:
        """Let a snapshot that was written be the session file, unless the review went on meanwhile.

        Gives whether it is: what only the journal holds would be lost otherwise.
        """
        now = self.session.revision, self.generation + 1
        if not self.is_open or (taken.revision, taken.generation) != now:
            taken.discard()
            return False
        taken.put_in_place()
        self.generation += 1
        self._start_journal()
        # Without it a moved take would only lose the way to its old review.
        with contextlib.suppress(OSError):
            index_entry(self.hash).write_bytes(os.fsencode(self.path))
        return True

    def keep_left_at(self) -> None:
        """Journal where the operator stands, unless that cannot be written now."""
        at = left_at_to_dict(self.session.left_at)
        if not self._torn:
            with contextlib.suppress(MarkermendError):
                self._append(lambda: {"at": at})

    def close(self) -> None:
        """Let go of the lock; an empty journal is removed."""
        if self._journal is None:
            return
        try:
            self._on_disk.wait()
        except Exception:
            self._torn = True
        if self._torn:
            with contextlib.suppress(MarkermendError):
                self.save()
        self._on_disk.close()
        journal, self._journal = self._journal, None
        self.session.on_step = None
        journal.seek(0)
        empty = not holds_steps(journal.read())
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

    def drop_taken_over(self) -> None:
        """Delete the journal that was taken over, unless another window has it open."""
        journal, self.taken_over = self.taken_over, None
        if journal is not None:
            with contextlib.suppress(OSError):
                handle = open_locked(journal)
                if handle is not None:
                    handle.close()
                    journal.unlink()

    def _start_journal(self) -> None:
        """Empty the journal and head it with the generation it continues."""
        if self._journal is None:
            return
        # What it held, on the disk or not, is in the session file.
        self._on_disk.settle()
        self._journal.truncate(0)
        self._torn = False
        head = {"generation": self.generation, "version": VERSION, "sha256": self.hash}
        self._append(lambda: head)

    def _append(self, entry: Callable[[], Mapping[str, Any]], long: bool = False) -> None:
        """Add one line; nobody waits until it is on the disk.

        Parameters
        ----------
        entry : makes what the line holds
        long : whether that takes long
        """
        journal = self._journal
        if journal is None:
            return

        def write() -> None:
            line = json.dumps(entry(), allow_nan=False).encode() + b"\n"
            while line:
                line = line[journal.write(line) :]

        try:
            self._on_disk.keep(journal.fileno(), write, long)
        except Exception as error:
            # Whatever went wrong, a step is missing there.
            self._torn = True
            if not isinstance(error, OSError):
                raise
            raise MarkermendError(
                f"The step is made, but could not be kept in “{journal.name}” "
                f"({error.strerror}); free some space, or export now."
            ) from error

    def _on_step(self, what: str, step: Step) -> None:
        """Journal one step of the session."""
        if self._torn:
            # A step is missing there, so that only the whole review can make it good.
            self.save()
        elif what == "do":
            self._append(lambda: {"do": step_to_dict(step)}, samples_in(step.edit) > LONG)
        else:
            self._append(lambda: {what: True})


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
    path = session_path(take, digest, folder)
    try:
        handle = open_locked(journal_path(path))
        beside = path
    except OSError:
        # The folder can be looked at only, whatever it said of itself.
        beside, path = path, own_path(take, digest)
        handle = open_locked(journal_path(path))
    session = Session(take)
    # Fingerprints are made here, since opening is done off the window's thread and saving is not.
    result = SessionFile(session, path, digest, _markers=marker_hashes(take))
    result.read_only = handle is None
    try:
        changed = _restore(result, beside)
        if changed and handle is not None:
            os.replace(path, path.with_name(path.name + ".old"))
            handle.truncate(0)
        if handle is not None:
            handle.seek(0)
            result.recovered += replay_journal(session, handle.read(), result.generation, digest)
            result._journal = handle
            if result.recovered or result.warning:
                # What came from elsewhere is nowhere at this place yet.
                result.save()
                result.drop_taken_over()
            else:
                result._start_journal()
            session.on_step = result._on_step
        elif not changed:
            _replay_living(result)
    except BaseException:
        if handle is not None:
            handle.close()
        raise
    return result


def read_review(take: Take, *, folder: Path | None = None) -> Session:
    """Read the review of a take as it is saved and journalled; nothing is locked or written.

    Parameters
    ----------
    take : the recording
    folder : where the session file lies; see :func:`open_session`

    Returns
    -------
    A session of its own; an empty one when the take was never reviewed

    Raises
    ------
    FileFormatError
        when the session file is not one, or of a newer version
    """
    digest = source_hash(take)
    beside = session_path(take, digest, folder)
    own = own_path(take, digest)
    kept = any(p.exists() for p in (beside, journal_path(beside)))
    path = beside if kept or not own.exists() else own
    result = SessionFile(Session(take), path, digest, read_only=True)
    if not _restore(result, beside):
        _replay_living(result)
    return result.session


def _replay_living(result: SessionFile) -> None:
    """Do again what a journal adds, which another window may be writing on."""
    with contextlib.suppress(OSError):
        text = journal_path(result.path).read_bytes()
        replay_journal(result.session, text, result.generation, result.hash)


def _restore(result: SessionFile, beside: Path) -> bool:
    """Do again what is saved of a review; whether it is of another version of the take."""
    session, path = result.session, result.path
    stored, where = load(path), path
    if stored is None:
        stored, where = moved(result.hash, path, beside)
        if stored is not None:
            place = stored["source"]["path"]
            result.warning = f"The review made of this take at “{place}” goes on here."
    try:
        if stored is not None and stored["source"]["sha256"] != result.hash:
            ours = stored["source"].get("wrote") == result.hash
            result.warning = (go_on if ours else carry_over)(session, stored, path)
            return True
        if stored is not None:
            result.generation = int(stored["generation"])
            replay_document(session, stored)
    except (KeyError, TypeError, ValueError, AttributeError, DataError) as error:
        raise unreadable(path) from error
    if where != path:
        _replay_elsewhere(result, where)
        result.taken_over = None if stored is not None else journal_path(where)
    return False


def _replay_elsewhere(result: SessionFile, where: Path) -> None:
    """Do again what the journal of a review at another place adds to it."""
    journal = journal_path(where)
    with contextlib.suppress(OSError):
        text = journal.read_bytes()
        result.recovered = replay_journal(result.session, text, result.generation, result.hash)
    if result.recovered and not result.warning:
        place = where.with_name(where.name.removesuffix(SUFFIX))
        result.warning = f"The review made of this take at “{place}” goes on here."


def _source_path(take: Take) -> str:
    """Where the take lay, or empty."""
    return str(take.source.path) if take.source else ""
