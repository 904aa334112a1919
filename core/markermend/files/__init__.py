"""Read and write takes; what a file is, its content tells, not only its name."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isfinite
from os import PathLike
from pathlib import Path
from typing import IO

import numpy as np

from markermend.arrays import IntArray
from markermend.errors import ExportError, FileFormatError
from markermend.files.opening import SNIFFED, named, not_opened
from markermend.progress import Progress, quiet
from markermend.take import Origin, Take

__all__ = ["TOLD_MM", "Export", "read", "stale_outputs", "write"]

TOLD_MM = 0.5
"""A joint no further off than this is where it should be."""


@dataclass(frozen=True)
class Export:
    """What an export did.

    Attributes
    ----------
    path : the file written
    samples : samples (marker and frame) that are not the source's: filled or edited ones, all of a
        take that was read from no file
    backup : where the file that was there before is kept, or None
    outputs : points that a model computed from markers that were changed: angles, moments,
        powers… in the same file, which no longer match
    off : joints of an AMC that are at least :data:`TOLD_MM` from where the take has them, since its
        bones are rigid, and how far at most in mm; the farthest first
    lost : joints that an AMC lacks in frames in which the take has them, since what they hang on is
        missing there
    dropped : columns of the table of joints that was read which the file has no more, since it
        could not be written over that
    """

    path: Path
    samples: int
    backup: Path | None = None
    outputs: tuple[str, ...] = ()
    off: tuple[tuple[str, float], ...] = ()
    lost: tuple[str, ...] = ()
    dropped: tuple[str, ...] = ()

    @property
    def off_mm(self) -> float:
        """How far the farthest joint is from where the take has it; 0 where none is told."""
        return self.off[0][1] if self.off else 0.0


def read(path: str | PathLike[str], *, progress: Progress | None = None) -> Take:
    """Read a recording.

    Parameters
    ----------
    path : a C3D or TRC file, a table of comma-separated values, or a skeleton recording, whose
        joints become markers (:func:`read_pose` reads it as what it is)
    progress : told the share of frames read; may raise to stop

    Returns
    -------
    Take

    Raises
    ------
    FileFormatError
        when the file cannot be opened, is damaged beyond reading, or of an unknown kind
    """
    where = named(path)
    try:
        return _reader(where)(where, progress=progress)
    except OSError as error:
        raise not_opened(where, error) from error


def _reader(path: Path) -> Callable[..., Take]:
    """Choose a reader by a file's first bytes, and by its name where they say nothing."""
    from markermend.files.c3d import read_c3d
    from markermend.files.csv import read_csv
    from markermend.files.text import refuse_utf_16
    from markermend.files.trc import SIGNATURE, read_trc
    from markermend.plugins.formats import SKELETONS, formats

    if path.exists() and not path.is_file() and not path.is_dir():
        raise FileFormatError(f"{path} is a pipe or device; takes are read from files only.")
    with path.open("rb") as file:
        head = file.read(SNIFFED)
    suffix = path.suffix.lower()
    if head.startswith(SIGNATURE):
        return read_trc
    binary = b"\0" in head
    if suffix == ".c3d" or (binary and head[1:2] == b"P"):
        return read_c3d
    if not head:
        raise FileFormatError(f"{path.name} is empty; look for another copy of it.")
    if suffix == ".trc":
        return read_trc
    if suffix in SKELETONS:
        return _read_skeleton
    if suffix != ".csv" and suffix in formats():
        return formats()[suffix].run
    refuse_utf_16(head, path.name)
    if not binary and _names_joints(head):
        return _read_skeleton
    if binary:
        raise FileFormatError(
            f"{path.name} is of an unknown kind; C3D, TRC, CSV, AMC, ASF and BVH can be read."
        )
    return read_csv


def _names_joints(head: bytes) -> bool:
    """Whether a table is of joints rather than of markers."""
    from markermend.files.pose_rows import names_joints

    return names_joints(head)


def _read_skeleton(path: Path, *, progress: Progress | None = None) -> Take:
    """Read a skeleton recording as a take of joints."""
    from markermend.files.pose import read_pose
    from markermend.poses.take import as_take

    return as_take(read_pose(path, progress=progress), path)


def write(
    take: Take,
    path: str | PathLike[str],
    *,
    overwrite: bool = False,
    as_float: bool = False,
    record: Sequence[str] = (),
    mark_outputs: bool = False,
    frames: tuple[int, int] | None = None,
    progress: Progress | None = None,
) -> Export:
    """Write a recording, whole or not at all.

    A take read from a C3D file is written as that file with only the changed samples replaced;
    without changes the result is the source, byte for byte. Where labels, frames or points are
    not the source's, its parameters are kept and only those rewritten that must change. Any other
    take becomes a new file.

    Parameters
    ----------
    take : the recording
    path : where to, ending in ``.c3d``, ``.trc`` or ``.csv``, for joints in ``.amc`` or ``.bvh``
        too; a file that is there is replaced
    overwrite : replace the take's own source too, which is kept beside, as ``name.bak``
    as_float : write a C3D file of floats even where the source has 16-bit integers
    record : what was done, a line each, written into the C3D file's MARKERMEND group
    mark_outputs : name in that group the model outputs that no longer match
    frames : keep these only, a half-open interval of 0-based frames; they keep their numbers where
        the format has them, and events their times, those outside too
    progress : told the share of frames written; may raise to stop, then nothing is left behind

    Returns
    -------
    Export

    Raises
    ------
    ExportError
        when the target is the source and ``overwrite`` is not set, the source has changed since it
        was read, the take has no frame, a value or a name does not fit the format, or the disk does
        not take the file
    DataError
        when the frames to keep are none, or not all in the take
    """
    from markermend.files.atomic import write_whole
    from markermend.files.restructure import crop
    from markermend.plugins.formats import SKELETONS_WRITTEN

    target = Path(path)
    onto_source = _is_source(take, target)
    if onto_source and not overwrite:
        raise ExportError(
            f"{target.name} is the file the take was read from; choose another name, or ask for it"
            " to be overwritten."
        )
    if onto_source and take.read_only:
        raise ExportError(f"{target.name} is damaged and was opened only to look at it.")
    if not take.frames:
        # No reader, ours neither, makes anything of such a file.
        raise ExportError(f"The take has no frame, so there is nothing to write to {target.name}.")
    report = progress or quiet
    # Also the check that all of the frames are there.
    part = take if frames is None else crop(take, *frames)
    off, dropped = dict[str, float](), list[str]()
    if take.skeleton and target.suffix.lower() in SKELETONS_WRITTEN:
        fill, off = _skeleton_writer(take, target, report, frames or (0, take.frames), dropped)
    else:
        before = frames[0] if frames else 0
        fill = _writer(part, target, report, as_float, record, mark_outputs, before)
    written: list[IntArray] = []
    try:
        backup = write_whole(target, lambda file: written.append(fill(file)), backup=onto_source)
    except FileFormatError as error:
        raise ExportError(str(error)) from error
    changed = tuple(s for s, n in zip(take.labels, written[0], strict=True) if n)
    patched = take.source is not None and take.source.format == "c3d"
    outputs = stale_outputs(part, changed) if patched and target.suffix.lower() == ".c3d" else ()
    lost = tuple(joint for joint, mm in off.items() if not isfinite(mm))
    told = [(joint, mm) for joint, mm in off.items() if mm >= TOLD_MM and joint not in lost]
    far = tuple(sorted(told, key=lambda pair: -pair[1]))
    return Export(target, int(written[0].sum()), backup, outputs, far, lost, tuple(dropped))


def stale_outputs(take: Take, changed: Sequence[str] | None = None) -> tuple[str, ...]:
    """Name the model outputs of a take that its repairs have made wrong.

    Parameters
    ----------
    take : the recording
    changed : markers that were changed; None takes those with filled or edited samples

    Returns
    -------
    labels of the angles, moments, powers and the like that belong to the same subjects as the
    changed markers. Which marker enters which output a file does not tell, so all are named.
    """
    if take.points is None:
        return ()
    if changed is None:
        touched = np.flatnonzero((take.origin >= Origin.FILLED).any(axis=0))
        changed = [take.labels[i] for i in touched]
    if not changed:
        return ()
    subjects = {take.subject(label) for label in changed}
    return tuple(
        label
        for label in take.points.labels
        if "" in subjects or take.subject(label) in subjects | {""}
    )


def _writer(
    take: Take,
    target: Path,
    report: Progress,
    as_float: bool,
    record: Sequence[str],
    mark_outputs: bool,
    before: int,
) -> Callable[[IO[bytes]], IntArray]:
    """Choose how a take is written; the function returns the samples written of each marker.

    Of a part of a take ``before`` are the frames that come before it: time goes on there.
    """
    from markermend.files.c3d_new import write_new
    from markermend.files.c3d_patch import copy_patched, patchable
    from markermend.files.c3d_restructure import copy_restructured, structure_of, to_be_floats
    from markermend.files.csv import write_csv
    from markermend.files.trc import write_trc
    from markermend.plugins.formats import contents, formats, writable_in_words

    others = {name: f for name, f in formats().items() if f.write is not None}
    own = take.present if take.source is None else take.origin >= Origin.FILLED

    def new(file: IO[bytes]) -> IntArray:
        match target.suffix.lower():
            case ".trc":
                write_trc(take, file, report, name=target.name, before=before)
            case ".csv":
                write_csv(take, file, report, before=before)
            case suffix if suffix in others:
                file.write(contents(others[suffix], take))
            case _:
                write_new(take, file, report, notes=_notes(take, record, mark_outputs))
        return np.asarray(np.count_nonzero(own, axis=0), dtype=np.int64)

    if target.suffix.lower() in (".trc", ".csv", *others):
        return new
    if target.suffix.lower() != ".c3d":
        raise ExportError(
            f"{target.name} should end in {writable_in_words(skeleton=take.skeleton)},"
            " to tell what to write."
        )
    notes = _notes(take, record, mark_outputs)
    if patchable(take) and not notes and not (as_float and to_be_floats(take)):
        return lambda file: copy_patched(take, file, report)
    structure = structure_of(take)
    if structure is None:
        return new
    return lambda file: copy_restructured(
        take, structure, file, report, as_float=as_float, notes=notes
    )


def _skeleton_writer(
    take: Take, target: Path, report: Progress, frames: tuple[int, int], dropped: list[str]
) -> tuple[Callable[[IO[bytes]], IntArray], dict[str, float]]:
    """How some frames of a take of joints are written, and how far off joints are there, mm.

    Once they are, columns that are lost of the table that was read are added to ``dropped``.
    """
    from markermend.files.pose import crop_pose, pose_writer
    from markermend.poses.take import as_pose, changed_joints

    # How joints are turned is worked out of the whole recording.
    pose = as_pose(take, progress=report)
    whole = frames == (0, take.frames)
    part = pose if whole else crop_pose(pose, *frames)
    fill, off = pose_writer(part, target, report, whole=None if whole else pose)

    def write_joints(file: IO[bytes]) -> IntArray:
        dropped.extend(fill(file) or ())
        changed = changed_joints(take)[slice(*frames)]
        return np.asarray(np.count_nonzero(changed, axis=0), dtype=np.int64)

    return write_joints, off


def _notes(take: Take, record: Sequence[str], mark_outputs: bool) -> dict[str, list[str]]:
    """Texts for the MARKERMEND group, by parameter."""
    from markermend import __version__

    notes: dict[str, list[str]] = {}
    if record:
        notes["CHANGES"] = list(record)
    stale = stale_outputs(take) if mark_outputs else ()
    if stale:
        notes["STALE_OUTPUTS"] = list(stale)
    return notes | ({"VERSION": [__version__]} if notes else {})


def _is_source(take: Take, target: Path) -> bool:
    """Whether a path is the file a take was read from, by whatever name."""
    try:
        return take.source is not None and os.path.samefile(take.source.path, target)
    except OSError:
        return False
