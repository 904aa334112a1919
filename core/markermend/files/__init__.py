"""Read and write takes; what a file is, its content tells, not only its name."""

from __future__ import annotations

import os
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import IO

from markermend.errors import ExportError, FileFormatError
from markermend.progress import Progress, quiet
from markermend.take import Take

__all__ = ["Export", "read", "write"]


@dataclass(frozen=True)
class Export:
    """What an export did.

    Attributes
    ----------
    path : the file written
    samples : samples (marker and frame) that differ from the source; all of them in a new file
    backup : where the file that was there before is kept, or None
    """

    path: Path
    samples: int
    backup: Path | None = None


def read(path: str | PathLike[str], *, progress: Progress | None = None) -> Take:
    """Read a recording.

    Parameters
    ----------
    path : a C3D file
    progress : told the share of frames read; may raise to stop

    Returns
    -------
    Take

    Raises
    ------
    FileFormatError
        when the file cannot be opened, is damaged beyond reading, or of an unknown kind
    """
    where = Path(path)
    try:
        from markermend.files.c3d import read_c3d

        return read_c3d(where, progress=progress)
    except OSError as error:
        reason = error.strerror or str(error)
        raise FileFormatError(f"{where.name} cannot be opened: {reason.lower()}.") from error


def write(
    take: Take,
    path: str | PathLike[str],
    *,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> Export:
    """Write a recording, whole or not at all.

    A take read from a C3D file is written as that file with only the changed samples replaced;
    without changes the result is the source, byte for byte. Any other take becomes a new file.

    Parameters
    ----------
    take : the recording
    path : where to; a file that is there is replaced, but the take's own source only on request
    overwrite : replace the source too; it is kept beside, as ``name.bak``
    progress : told the share of frames written; may raise to stop, then nothing is left behind

    Returns
    -------
    Export

    Raises
    ------
    ExportError
        when the target is the source and ``overwrite`` is not set, the source has changed since it
        was read, a value does not fit the file's numbers, or the disk does not take the file
    """
    from markermend.files.atomic import write_whole
    from markermend.files.c3d_new import write_new
    from markermend.files.c3d_patch import copy_patched, patchable

    target, report = Path(path), progress or quiet
    onto_source = _is_source(take, target)
    if onto_source and not overwrite:
        raise ExportError(
            f"{target.name} is the file the take was read from; choose another name, or ask for it"
            " to be overwritten."
        )
    if onto_source and take.read_only:
        raise ExportError(f"{target.name} is damaged and was opened only to look at it.")
    if patchable(take):
        samples = 0

        def fill(file: IO[bytes]) -> None:
            nonlocal samples
            samples = copy_patched(take, file, report)
    else:
        samples = int(take.present.sum())

        def fill(file: IO[bytes]) -> None:
            write_new(take, file, report)

    backup = write_whole(target, fill, backup=onto_source)
    return Export(target, samples, backup)


def _is_source(take: Take, target: Path) -> bool:
    """Whether a path is the file a take was read from, by whatever name."""
    try:
        return take.source is not None and os.path.samefile(take.source.path, target)
    except OSError:
        return False
