"""Why a file could not be opened, as a sentence."""

from __future__ import annotations

import os
from os import PathLike
from pathlib import Path

from markermend.errors import FileFormatError

SNIFFED = 4096
"""Bytes that tell what a file is: a table of joints may begin with comments and long names."""


def named(path: str | PathLike[str]) -> Path:
    """The path of a recording.

    Raises
    ------
    FileFormatError
        when it is no name at all, or one that no file can have
    """
    if not os.fspath(path):
        raise FileFormatError("“” is no name of a recording; name a file.")
    if "\0" in os.fspath(path):
        raise FileFormatError("A name with a zero byte in it is no file's.")
    return Path(path)


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
