"""Read and write takes; what a file is, its content tells, not only its name."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from markermend.errors import FileFormatError
from markermend.progress import Progress
from markermend.take import Take

__all__ = ["read"]


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
