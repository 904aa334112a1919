"""Write a file so that it is there whole, or not at all."""

from __future__ import annotations

import contextlib
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import IO

from markermend.encoding import utf8
from markermend.errors import ExportError


def write_whole(target: Path, fill: Callable[[IO[bytes]], object], *, backup: bool) -> Path | None:
    """Fill a temporary file beside the target, flush it to the disk, and rename it.

    Parameters
    ----------
    target : where the file shall be; what is there is replaced in one step
    fill : writes the contents into the file it is given; whatever it raises stops the export
    backup : keep what was at the target under another name

    Returns
    -------
    the backup's path, or None

    Raises
    ------
    ExportError
        when the folder, the disk or another program does not let us; nothing is left behind
    """
    target = Path(os.path.realpath(target))
    temporary = target.with_name(f".markermend-{os.urandom(4).hex()}.part")
    kept: Path | None = None
    done = False
    try:
        if target.exists() and not target.is_file():
            raise OSError("what is there is no file")
        with open(temporary, "xb") as file:
            fill(file)
            file.flush()
            os.fsync(file.fileno())
        if target.exists():
            shutil.copymode(target, temporary)
            if backup:
                kept = _keep(target)
        os.replace(temporary, target)
        done = True
        _sync_folder(target.parent)
    except OSError as error:
        raise ExportError(
            f"{target.name} could not be written: {(error.strerror or str(error)).lower()};"
            " nothing was changed, choose another place or free some space."
        ) from error
    finally:
        if not done:
            for path in (temporary, kept):
                if path is not None:
                    with contextlib.suppress(OSError):
                        path.unlink()
    return kept


def write_contents(target: Path, contents: bytes) -> None:
    """Write contents that are all there already, as :func:`write_whole` does."""

    def fill(file: IO[bytes]) -> None:
        file.write(contents)

    write_whole(target, fill, backup=False)


def write_text(target: Path, text: str) -> None:
    """Write a text in UTF-8, as :func:`write_whole` does, whatever file names are in it."""
    write_contents(target, utf8(text))


def _keep(target: Path) -> Path:
    """Keep a file under a name that is still free (``.bak``, ``.bak2``…) and return it."""
    number = 1
    while True:
        name = target.with_name(f"{target.name}.bak{number if number > 1 else ''}")
        try:
            os.link(target, name)
        except FileExistsError:
            number += 1
        except OSError:
            # No hard links here; a copy serves, unless somebody took the name meanwhile.
            if not name.exists():
                shutil.copy2(target, name)
                return name
            number += 1
        else:
            return name


def _sync_folder(folder: Path) -> None:
    """Make the rename itself survive a power cut, where the system lets us."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
