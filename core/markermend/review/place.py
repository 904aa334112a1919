"""Where the review of a take lies on disk, and by what it is found again."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path

from markermend.take import Take

SUFFIX = ".markermend.json"
JOURNAL_SUFFIX = ".markermend.journal"


def source_hash(take: Take) -> str:
    """SHA-256 of the take's source file, or of its samples when it has none."""
    digest = hashlib.sha256()
    if take.source is None:
        digest.update(json.dumps([take.labels, take.rate, take.first_frame]).encode())
        digest.update(take.positions.tobytes())
        return digest.hexdigest()
    return file_hash(take.source.path)


def file_hash(path: Path) -> str:
    """SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def session_path(take: Take, digest: str, folder: Path | None) -> Path:
    """Session file of a take: beside it when that folder can be written to, else the user's own.

    Parameters
    ----------
    take : the recording
    digest : hash of its source
    folder : where the file is to lie, instead of beside the take
    """
    if take.source is not None:
        name = take.source.path.name + SUFFIX
        home = folder or take.source.path.parent
        if (home / name).exists() or os.access(home, os.W_OK):
            return home / name
    elif folder is not None:
        return folder / ("take" + SUFFIX)
    return own_path(take, digest)


def own_path(take: Take, digest: str) -> Path:
    """Session file of a take in the user's data folder, which is made when it is not there."""
    from platformdirs import user_data_path

    name = take.source.path.name if take.source else "take"
    home = user_data_path("markermend", appauthor=False, ensure_exists=True) / "sessions"
    home.mkdir(exist_ok=True)
    return home / f"{digest[:16]}-{name}{SUFFIX}"


def journal_path(path: Path) -> Path:
    """The journal that belongs to a session file."""
    return path.with_name(path.name[: -len(SUFFIX)] + JOURNAL_SUFFIX)


def session_of(journal: Path) -> Path:
    """The session file that a journal belongs to."""
    return journal.with_name(journal.name[: -len(JOURNAL_SUFFIX)] + SUFFIX)


def index_entry(digest: str) -> Path:
    """Small file in the user's data folder that says where the review of a take is."""
    from platformdirs import user_data_path

    folder = user_data_path("markermend", appauthor=False, ensure_exists=True) / "reviews"
    folder.mkdir(exist_ok=True)
    return folder / digest[:32]
