"""Which skeleton (ASF) an Acclaim movement (AMC) belongs to: what it is called, or says itself."""

from __future__ import annotations

import re
from pathlib import Path

from markermend.errors import NoSkeletonError
from markermend.files.amc_patch import starts_pose
from markermend.files.asf import words_of
from markermend.poses.skeleton import Skeleton

# As Vicon's programs write it, with the path on the machine that the movement was recorded on.
_SAYS = re.compile(rb"^#!OML:ASF[ \t]+([^\r\n]*)", re.IGNORECASE | re.MULTILINE)
_HEADER_BYTES = 1024
_SAY = "say which it is (denoise --skeleton)."


def find_skeleton(path: Path) -> tuple[Path, bool]:
    """Skeleton of a movement, among those in its folder, and whether it is only the only one there.

    The one that the movement's first comment names, or of the same name, or of its subject (``01``
    of ``01_05``), or the only one.

    Raises
    ------
    NoSkeletonError
        when none of them is surely its own
    """
    there = _skeletons(path.parent)
    found = _said_in(path, there) or _called_as(path, there)
    if found is not None:
        return found, False
    if len(there) == 1:
        return there[0], True
    first = path.stem.partition("_")[0]
    if there:
        raise NoSkeletonError(
            f"{path.name} needs its skeleton: none of the ASF files beside it is named {path.stem}"
            f".asf. Name the right one so (what stands before the first _ will do, as in 02.asf for"
            f" 02_01.amc), or {_SAY}"
        )
    raise NoSkeletonError(
        f"{path.name} needs its skeleton: put the ASF file beside it, named {first}.asf, or {_SAY}"
    )


def check_guess(path: Path, skeleton: Skeleton, file: Path) -> None:
    """Refuse a skeleton that lies beside a movement by chance.

    Parameters
    ----------
    path : the movement
    skeleton : with which it would be read
    file : of the skeleton

    Raises
    ------
    NoSkeletonError
        when the first pose has segments that the skeleton lacks, or other numbers for them
    """
    dofs = {segment.name: len(segment.dofs) for segment in skeleton.segments}
    poses = 0
    for _, (name, *cells) in words_of(path):
        poses += starts_pose(name, dofs)
        if poses > 1:
            return
        if poses and not starts_pose(name, dofs) and dofs.get(name) != len(cells):
            raise NoSkeletonError(
                f"{path.name} needs its skeleton: {file.name}, the only ASF file beside it, does"
                f" not have {name} as it is there. Put the right one beside it, named"
                f" {path.stem}.asf, or {_SAY}"
            )


def saying(content: bytes, target: Path, skeleton: Path | None) -> bytes:
    """A movement that is found to belong to its skeleton wherever its name does not tell.

    Parameters
    ----------
    content : the movement's file
    target : where it is written to
    skeleton : its file, if it was read from one

    Returns
    -------
    the same, whose first comment names the skeleton if that lies in the target's folder among
    others and the target is not called as it
    """
    there = _skeletons(target.parent)
    if skeleton is None or len(there) < 2 or skeleton.parent.resolve() != target.parent.resolve():
        return content
    own = next((p for p in there if p.name == skeleton.name), None)
    if own is None or own == _called_as(target, there):
        return content
    line = b"#!OML:ASF " + skeleton.name.encode()
    head, body = content[:_HEADER_BYTES], content[_HEADER_BYTES:]
    if _SAYS.search(head):
        return _SAYS.sub(lambda _: line, head, count=1) + body
    return line + b"\n" + content


def _said_in(path: Path, there: list[Path]) -> Path | None:
    """The skeleton that a movement's own comment names, if it lies beside it."""
    if not path.is_file():
        return None
    with path.open("rb") as file:
        found = _SAYS.search(file.read(_HEADER_BYTES))
    name = "" if found is None else re.split(r"[\\/]", found[1].decode("utf-8", "replace"))[-1]
    return next((p for p in there if p.name.lower() == name.strip().lower()), None)


def _called_as(path: Path, there: list[Path]) -> Path | None:
    """The skeleton that a movement's name leads to."""
    by_name = {p.stem.lower(): p for p in there}
    stem = path.stem.lower()
    names = (stem, stem.rpartition("_")[0], stem.partition("_")[0])
    return next((by_name[name] for name in names if name in by_name), None)


def _skeletons(folder: Path) -> list[Path]:
    """Skeletons in a folder, by name."""
    return [p for p in sorted(folder.iterdir()) if p.suffix.lower() == ".asf"]
