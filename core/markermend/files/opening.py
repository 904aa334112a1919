"""Why a file could not be opened, as a sentence."""

from __future__ import annotations

from pathlib import Path

from markermend.errors import FileFormatError


def not_opened(path: Path, error: OSError) -> FileFormatError:
    """The error to raise for one of the operating system, with what to do about it.

    Parameters
    ----------
    path : of the file that was to be read
    error : what the system said
    """
    match error:
        case FileNotFoundError() | NotADirectoryError():
            return FileFormatError(f"There is no file “{path}”; check its name and folder.")
        case IsADirectoryError():
            return FileFormatError(f"“{path}” is a folder; name a file in it.")
        case PermissionError():
            return FileFormatError(f"“{path}” may not be read; check its permissions.")
    reason = (error.strerror or str(error)).lower()
    return FileFormatError(f"“{path}” cannot be opened: {reason}.")
