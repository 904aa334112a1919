"""What commands share: text on the terminal, a progress bar, files written whole or not at all."""

from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
import time
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from markermend.encoding import printable
from markermend.errors import DataError, ExportError, MarkermendError

if TYPE_CHECKING:
    from markermend.artifact import Artifact
    from markermend.files import Export
    from markermend.take import Take

STDOUT = "-"
_BAR_WIDTH = 24
_REDRAW_S = 0.1


def output_is_closed() -> bool:
    """Whether there is no standard output, whose place :func:`markermend.cli.main` fills."""
    return str(getattr(sys.stdout, "name", "")) == os.devnull


def say(text: str = "") -> None:
    """Write a line to standard output."""
    sys.stdout.write(printable(text) + "\n")


def warn(text: str) -> None:
    """Write a line to standard error."""
    sys.stderr.write(printable(text) + "\n")


class Bar:
    """Progress bar on a terminal, nothing in a pipe; call it as any progress function."""

    def __init__(self) -> None:
        self._shown = sys.stderr.isatty()
        self._drawn = 0.0

    def __enter__(self) -> Bar:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._drawn:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()

    def __call__(self, share: float, doing: str) -> None:
        """Show the share done in [0, 1] and what is being done."""
        now = time.monotonic()
        if not self._shown or now - self._drawn < _REDRAW_S:
            return
        self._drawn = now
        full = round(_BAR_WIDTH * min(max(share, 0.0), 1.0))
        bar = "█" * full + "░" * (_BAR_WIDTH - full)
        room = shutil.get_terminal_size().columns - _BAR_WIDTH - 8
        sys.stderr.write(f"\r\033[K{bar} {share:4.0%} {doing[: max(room, 0)]}")
        sys.stderr.flush()


def table(head: Sequence[str], rows: Iterable[Sequence[str]], right: str = "") -> list[str]:
    """Align columns.

    Parameters
    ----------
    head : column titles
    rows : cells as text
    right : one letter a column, ``r`` for aligned to the right, anything else to the left

    Returns
    -------
    Lines without trailing blanks, cut to the terminal's width when there is one.
    """
    cells = [list(head), *(list(row) for row in rows)]
    widths = [max(len(row[i]) for row in cells) for i in range(len(head))]
    right = right.ljust(len(head))
    lines = [
        "  ".join(
            cell.rjust(width) if side == "r" else cell.ljust(width)
            for cell, width, side in zip(row, widths, right, strict=True)
        ).rstrip()
        for row in cells
    ]
    if not sys.stdout.isatty():
        return lines
    room = shutil.get_terminal_size().columns
    return [line if len(line) <= room else line[: room - 1] + "…" for line in lines]


def count(number: int, noun: str) -> str:
    """Write a number with its noun: ``1 gap``, ``2 gaps``."""
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def check_outputs(
    paths: Sequence[str | None], *, source: str | Iterable[str | None] | None, force: bool
) -> None:
    """Refuse, before any work is done, what could not or should not be written.

    Parameters
    ----------
    paths : files to be written; None and ``"-"`` are passed over
    source : the take that is read, or all files that are
    force : existing files may be overwritten

    Raises
    ------
    ExportError
        when a path is one that is read, a review, exists, is a folder or a device, is named twice,
        or lies in no folder or one that takes no files; and when two want standard output
    """
    if sum(path == STDOUT for path in paths) > 1:
        raise ExportError("Only one result can go to standard output.")
    if "" in paths:
        raise ExportError("“” is no name of a file to write; give it one.")
    seen: set[Path] = set()
    for path in (Path(p) for p in paths if p is not None and p != STDOUT):
        where = path.resolve()
        if not where.parent.is_dir():
            raise ExportError(
                f"There is no folder “{path.parent}” to write “{path.name}” into; make it first."
            )
        if where.is_dir():
            raise ExportError(f"“{path}” is a folder; name a file to write.")
        # /dev/stdout may be a file that a shell writes to, which would be replaced under it.
        device = path.absolute().parent in (Path("/dev"), Path("/dev/fd"))
        if device or (path.exists() and not path.is_file()):
            raise ExportError(f"“{path}” is a device; name a file, or “-” for standard output.")
        if not os.access(where.parent, os.W_OK):
            raise ExportError(
                f"“{path}” could not be written: the folder “{where.parent}” takes no files; name"
                " another place."
            )
        if where in seen:
            raise ExportError(f"“{path}” is named for two results; give each its own file.")
        seen.add(where)
        if path.exists():
            _check_replaced(path, source, force=force)


def _check_replaced(path: Path, source: str | Iterable[str | None] | None, *, force: bool) -> None:
    """Refuse to replace what is read, and a review, which is hours of somebody's work."""
    from markermend.review.place import JOURNAL_SUFFIX, SUFFIX

    alone = isinstance(source, str)
    for other in [source] if isinstance(source, str) else source or ():
        if other is not None and Path(other).exists() and path.samefile(other):
            what = "the take itself" if alone else "read itself"
            raise ExportError(f"“{path}” is {what}; name another file to write.")
    if path.resolve().name.endswith((SUFFIX, JOURNAL_SUFFIX)):
        raise ExportError(f"“{path}” is a review; name another file to write.")
    if not force:
        raise ExportError(f"“{path}” exists already; add --force to overwrite it.")


def check_figures(folder: str | None, names: Iterable[str], *, force: bool) -> None:
    """Refuse, before any work is done, a folder that figures cannot or should not go into.

    Parameters
    ----------
    folder : made by :func:`write_figures` where it is not there; nothing is asked of None
    names : of the files
    force : existing files may be overwritten

    Raises
    ------
    ExportError
        when it or what it would lie in is a file, or holds one of the files already
    """
    if folder is None:
        return
    place = Path(folder).absolute()
    nearest = next(path for path in (place, *place.parents) if path.exists())
    if not nearest.is_dir():
        raise ExportError(f"“{nearest}” is a file; name a folder for the figures.")
    if nearest == place:
        check_outputs([str(place / name) for name in names], source=None, force=force)


def write_figures(folder: str, figures: Mapping[str, str]) -> None:
    """Write figures by name into a folder, which is made where it is not there."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    for name, text in figures.items():
        write_text(str(Path(folder) / name), text)


def check_take_output(path: str, *, source: str = "") -> None:
    """Refuse, before any work is done, a take's name that does not tell its format.

    What a skeleton recording can be written as too, its source's ending tells; a table may be one.
    """
    from markermend.plugins.formats import writable, writable_in_words

    skeleton = Path(source).suffix.lower() not in ("", ".c3d", ".trc")
    if Path(path).suffix.lower() not in writable(skeleton=skeleton):
        endings = writable_in_words(skeleton=skeleton)
        raise ExportError(f"“{path}” should end in {endings}, to tell what to write.")


def written(export: Export) -> list[str]:
    """Say where a take went, how much of it changed, and what no longer fits it."""
    how_much = count(export.samples, "new sample") if export.samples else "no sample changed"
    lines = [f"Written: {export.path}, {how_much}."]
    if export.outputs:
        names = ", ".join(export.outputs[:3]) + ("…" if len(export.outputs) > 3 else "")
        lines.append(
            f"{count(len(export.outputs), 'model output')} in the file ({names}) may no longer "
            "match the repaired markers; compute them anew."
        )
    if export.lost:
        lines.append(
            f"Not in the file wherever what they hang on is missing: {', '.join(export.lost)}."
            " Repair that too, or write a CSV."
        )
    if export.dropped:
        lines.append(
            f"Written anew, so without further columns of its source: {', '.join(export.dropped)}."
        )
    return [*lines, *off_by_rigid_bones(export.off_mm)]


def off_by_rigid_bones(off_mm: float) -> list[str]:
    """Say how far off a joint is in an AMC; nothing where none is."""
    from markermend.files import TOLD_MM

    if off_mm < TOLD_MM:
        return []
    return [f"Its bones are rigid: a joint is up to {off_mm:.1f} mm from where the repair has it."]


def chosen_frames(take: Take, options: argparse.Namespace) -> tuple[int, int] | None:
    """The frames that ``--frames`` names, as a half-open interval of indices; None for all.

    Raises
    ------
    DataError
        when they are not in the take
    """
    if options.frames is None:
        return None
    first, last = options.frames
    start, stop = first - take.first_frame, last - take.first_frame + 1
    if not 0 <= start < stop <= take.frames:
        raise DataError(
            f"Frames {first} to {last} are not all there; “{options.take}” has frames "
            f"{take.first_frame} to {take.frame_number(take.frames - 1)}."
        )
    return start, stop


def write_text(path: str, text: str) -> None:
    """Write a text file whole or not at all; ``"-"`` is standard output."""
    if path == STDOUT:
        if output_is_closed():
            raise ExportError("Standard output is closed, so “-” writes nothing; name a file.")
        if hasattr(sys.stdout, "reconfigure"):
            sys.stdout.reconfigure(encoding="utf-8")
        sys.stdout.write(printable(text))
        return
    from markermend.files.atomic import write_text as write_whole_text

    write_whole_text(Path(path), text)


def write_json(path: str, document: dict[str, Any]) -> None:
    """Write a JSON document; numbers that JSON does not know are a mistake, never ``NaN``."""
    write_text(path, json.dumps(document, ensure_ascii=False, indent=1, allow_nan=False) + "\n")


def read_take(path: str) -> Take:
    """Read a take, and say on standard error what is odd about its file."""
    from markermend.files import read

    with Bar() as bar:
        take = read(path, progress=bar)
    for oddity in take.warnings:
        warn(f"{Path(path).name}: {oddity}")
    return take


def read_json(path: str) -> dict[str, Any]:
    """Read a JSON document.

    Raises
    ------
    MarkermendError
        when the file cannot be opened or is no JSON object
    """
    from markermend.files.opening import not_opened

    try:
        document = json.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise not_opened(Path(path), error) from error
    except UnicodeDecodeError as error:
        raise MarkermendError(f"“{path}” is not JSON; name another file.") from error
    except ValueError as error:
        raise MarkermendError(f"“{path}” is not JSON: {error}.") from error
    if not isinstance(document, dict):
        raise MarkermendError(f"“{path}” is not a JSON object.")
    return document


def read_artifacts(path: str) -> tuple[tuple[Artifact, ...], dict[str, Any]]:
    """Read the artifacts that a JSON of ``detect`` lists, and all that it says.

    Raises
    ------
    MarkermendError
        when the file is no such list
    """
    from markermend.artifact_json import artifacts_of

    listed = read_json(path)
    try:
        return artifacts_of(listed), listed
    except DataError as error:
        raise DataError(
            f"“{path}” is no list of artifacts as “detect --json” writes it: {error}"
        ) from error
