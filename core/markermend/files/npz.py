"""Arrays in one file (NumPy's ``.npz``), as models are kept; nothing in it is executed."""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from markermend.files.atomic import write_contents
from markermend.files.opening import not_opened


def write_arrays(path: Path, arrays: Mapping[str, Any]) -> None:
    """Write named arrays, whole or not at all, under exactly this name.

    Raises
    ------
    ExportError
        when the disk does not take the file
    """
    memory = io.BytesIO()
    np.savez_compressed(memory, **arrays)
    write_contents(path, memory.getvalue())


def read_arrays(path: Path) -> dict[str, NDArray[Any]]:
    """Read what :func:`write_arrays` wrote.

    Raises
    ------
    FileFormatError
        when the file cannot be opened
    ValueError
        when it holds no such arrays
    """
    try:
        with np.load(path, allow_pickle=False) as stored:
            return {name: stored[name] for name in stored.files}
    except OSError as error:
        raise not_opened(path, error) from error
    except (EOFError, TypeError, zipfile.BadZipFile, zlib.error) as error:
        raise ValueError("no arrays") from error
