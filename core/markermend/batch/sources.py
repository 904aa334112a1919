"""Which takes a batch is about: files, folders and patterns, each with a name of its own."""

from __future__ import annotations

import glob
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from markermend.errors import MarkermendError
from markermend.plugins.formats import formats

# In a folder, beside those of plugins; a CSV there may be any table, so it is taken only when named
# or matched.
_SUFFIXES = (".c3d", ".trc", ".amc", ".bvh")
# What exports are named by themselves.
_EXPORTED = "_clean"


@dataclass(frozen=True)
class Source:
    """A take to be cleaned.

    Attributes
    ----------
    path : absolute
    name : file name without ending, under the folders below the one that was named
    """

    path: Path
    name: str


def find_takes(
    given: Iterable[str | Path], *, leave_out: str | Path | None = None
) -> tuple[Source, ...]:
    """Find takes and name them.

    Parameters
    ----------
    given : files; folders, searched with all below for ``.c3d``, ``.trc``, ``.amc``, ``.bvh``
        and what plugins read, without the exports ``NAME_clean`` beside their source; and
        patterns such as ``day1/**/walk*.c3d``
    leave_out : a folder whose files are passed over, such as the one that is written to

    Returns
    -------
    Each file once, sorted by name. Files that differ only in their ending keep it in their name.

    Raises
    ------
    MarkermendError
        when something given is not there, everything is left out, or two takes in different
        folders have one name
    """
    outside = None if leave_out is None else Path(leave_out).resolve()
    if outside is not None and outside.is_file():
        # That nothing can be written into it is for the batch to say.
        outside = None
    found: dict[Path, PurePosixPath] = {}
    for item in given:
        matched = list(_expand(str(item)))
        if not matched and Path(item).is_dir():
            raise MarkermendError(
                f"“{item}” holds no take ending in {', '.join(_searched())}; name others, or"
                " match them as by “*.csv”."
            )
        if not matched:
            raise MarkermendError(f"There is no take at “{item}”; check its name and folder.")
        for path, below in matched:
            whole = path.resolve()
            if outside is None or not whole.is_relative_to(outside):
                found.setdefault(whole, PurePosixPath(below.as_posix()))
    if not found:
        raise MarkermendError(
            f"All takes lie in “{leave_out}”; name another folder for what is written."
            if outside is not None
            else "There is no take to be cleaned."
        )
    same = Counter(_key(relative.with_suffix("")) for relative in found.values())
    named = defaultdict(list)
    for path, relative in found.items():
        name: PurePosixPath = relative.with_suffix("")
        if same[_key(name)] > 1:
            name = relative.with_name(relative.name.replace(".", "_"))
        named[_key(name)].append(Source(path, str(name)))
    for twins in named.values():
        if len(twins) > 1:
            together = twins[0].path.parent == twins[1].path.parent
            what_to_do = "rename one" if together else "name the folder that holds both"
            raise MarkermendError(
                f"“{twins[0].path}” and “{twins[1].path}” have the same name; {what_to_do}, or"
                " clean them apart."
            )
    return tuple(sorted((s for (s,) in named.values()), key=lambda s: s.name))


def _expand(item: str) -> Iterator[tuple[Path, Path]]:
    """Files of one thing given, each with its path below the folder that was named."""
    path = Path(item)
    if path.is_dir():
        suffixes = _searched()
        for below in sorted(path.rglob("*")):
            inside = below.relative_to(path)
            hidden = any(step.startswith(".") for step in inside.parts)
            if below.suffix.lower() not in suffixes or hidden or _is_export(below, suffixes):
                continue
            if below.is_file():
                yield below, inside
    elif path.is_file():
        yield path, Path(path.name)
    elif glob.has_magic(item):
        steps = path.parts
        fixed = next(i for i, step in enumerate(steps) if glob.has_magic(step))
        root = Path(*steps[:fixed])
        for match in sorted(glob.glob(item, recursive=True)):
            if Path(match).is_file():
                yield Path(match), Path(match).relative_to(root)


def _searched() -> tuple[str, ...]:
    """Endings of files that are taken from a folder."""
    return *_SUFFIXES, *formats()


def _is_export(path: Path, suffixes: tuple[str, ...]) -> bool:
    """Whether a file is named as the repaired copy of one beside it."""
    source = path.stem.removesuffix(_EXPORTED)
    endings = (e for s in suffixes for e in (s, s.upper()))
    return source != path.stem and any(path.with_name(source + e).exists() for e in endings)


def _key(name: PurePosixPath) -> str:
    """What two names must not share, since some file systems do not tell case apart."""
    return str(name).casefold()
