"""Read and write skeleton recordings; the ending tells which format."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import isfinite
from os import PathLike
from pathlib import Path
from typing import IO

from markermend.errors import DataError, ExportError, FileFormatError, MethodError
from markermend.files.amc import read_amc, write_amc
from markermend.files.amc_patch import USUAL_RATE
from markermend.files.amc_skeleton import check_guess, find_skeleton
from markermend.files.asf import read_asf
from markermend.files.atomic import write_whole
from markermend.files.bvh_read import Channels, read_bvh
from markermend.files.bvh_write import write_bvh
from markermend.files.opening import SNIFFED, named, not_opened
from markermend.files.pose_csv import Table, read_pose_csv, write_pose_csv
from markermend.files.pose_rows import names_joints
from markermend.files.units import USUAL, unit_mm
from markermend.poses.inverse import how_far_off, inverse_kinematics
from markermend.poses.pose import Pose
from markermend.poses.skeleton import Movement, forward_kinematics
from markermend.progress import Progress, part, quiet
from markermend.rates import rate_of

__all__ = ["read_pose", "write_pose"]

READABLE = (".csv", ".bvh", ".amc", ".asf")
WRITABLE = (".csv", ".bvh", ".amc")


def read_pose(
    path: str | PathLike[str],
    *,
    skeleton: str | PathLike[str] | None = None,
    rate: float | None = None,
    unit: str | None = None,
    progress: Progress | None = None,
) -> Pose:
    """Read a skeleton recording.

    Parameters
    ----------
    path : Acclaim movement (AMC, whose ASF is looked for beside it) or skeleton (ASF: one pose,
        at rest), Biovision hierarchy (BVH), or a table of joints (CSV, or of another name that
        tells nothing)
    skeleton : the ASF of an AMC, where it is not beside it
    rate : poses per second, instead of what the file tells (where it does not: AMC 120, CSV 30)
    unit : of length, as ``m``, ``cm``, ``mm`` or ``in``, of a BVH, or a CSV whose columns tell none
        (otherwise the size of the body tells it)
    progress : may raise to stop

    Returns
    -------
    Pose

    Raises
    ------
    FileFormatError
        when the file cannot be opened, is damaged, of an unknown kind, or tells another unit
    MethodError
        when there is no such unit
    """
    where = named(path)
    mm = None if unit is None else _unit_mm(unit)
    if rate is not None:
        rate_of(rate, where.name)
    try:
        where.stat()
        if where.is_dir():
            raise IsADirectoryError(str(where))
        match where.suffix.lower():
            case ".amc":
                asf, guessed = (Path(skeleton), False) if skeleton else find_skeleton(where)
                body = read_asf(asf)
                if guessed:
                    check_guess(where, body, asf)
                movement, stated, warnings = read_amc(where, body)
                if guessed:
                    warnings.insert(
                        0, f"Its skeleton is taken to be {asf.name}, the only one here."
                    )
                if stated is None and rate is None:
                    warnings.append("The file tells no rate; 120 Hz was assumed.")
                hertz = rate or stated or USUAL_RATE
                return forward_kinematics(movement, hertz, warnings=tuple(warnings))
            case ".bvh":
                return read_bvh(where, rate=rate, unit_mm=mm)
            case ".asf":
                rest = Movement(read_asf(where), {}, 1)
                return forward_kinematics(rest, rate or USUAL_RATE)
            case ending if ending == ".csv" or _begins_as_joints(where):
                return read_pose_csv(where, rate=rate, unit_mm=mm, progress=progress)
    except OSError as error:
        raise not_opened(Path(error.filename or where), error) from error
    except DataError as error:
        # What poses refuse knows no file.
        reason = str(error)
        raise FileFormatError(
            f"{where.name} is damaged: {reason[:1].lower()}{reason[1:]}"
        ) from error
    raise FileFormatError(
        f"{where.name} is no skeleton recording; its name should end in {', '.join(READABLE)}."
    )


def _unit_mm(name: str) -> float:
    """Millimetres in a unit of length."""
    mm = unit_mm(name)
    if mm is None:
        raise MethodError(f"“{name}” is no unit of length; name {', '.join(USUAL)}.")
    return mm


def _begins_as_joints(path: Path) -> bool:
    """Whether a file begins as a table of joints, whatever its name."""
    with path.open("rb") as file:
        return names_joints(file.read(SNIFFED))


def write_pose(pose: Pose, path: str | PathLike[str], *, progress: Progress | None = None) -> float:
    """Write a skeleton recording, whole or not at all; a file that is there is replaced.

    Parameters
    ----------
    pose : the recording
    path : where to, ending in ``.csv`` or ``.bvh``, or in ``.amc`` for one read from such a file
    progress : told the share of poses written; may raise to stop, then nothing is left behind

    Returns
    -------
    How far off in mm the farthest joint is there: the bones of an AMC are rigid

    Raises
    ------
    ExportError
        when the ending is of no such format, the recording has no skeleton to write an AMC by, or
        the disk does not take the file
    """
    target = Path(path)
    fill, off_mm = pose_writer(pose, target, progress or quiet)
    write_whole(target, fill, backup=False)
    return max(filter(isfinite, off_mm.values()), default=0.0)


def crop_pose(pose: Pose, start: int, stop: int) -> Pose:
    """Keep the poses of an interval.

    Parameters
    ----------
    pose : the recording
    start, stop : half-open interval of 0-based poses

    Returns
    -------
    Pose
        with the part of what was read that belongs to these poses; they keep their numbers, and
        time goes on
    """
    source, rows = pose.source, slice(start, stop)
    if isinstance(source, Movement | Channels):
        source = source.part(start, stop)
    elif isinstance(source, Table):
        source = replace(source, written=source.written[rows], read=source.read[rows])
    return replace(
        pose,
        positions=pose.positions[rows],
        rotations=pose.rotations[rows],
        confidence=pose.confidence[rows],
        source=source,
        first_frame=pose.first_frame + start,
        first_time=pose.first_time + start / pose.rate,
    )


def pose_writer(
    pose: Pose, target: Path, report: Progress, *, whole: Pose | None = None
) -> tuple[Callable[[IO[bytes]], tuple[str, ...] | None], dict[str, float]]:
    """Choose by a name's ending how a recording is written, or a part of the ``whole`` one.

    The other parameters and errors are those of :func:`write_pose`.

    Returns
    -------
    What writes it, which returns the columns of a table that are lost; and how far off in mm joints
    are there at most: the bones of an AMC are rigid, and a joint that hangs on one that is missing
    cannot be told, which is infinitely far
    """
    match target.suffix.lower():
        case ".csv":
            return lambda file: write_pose_csv(pose, file, report), {}
        case ".bvh":
            return lambda file: write_bvh(pose, file, report, whole=whole), {}
        case ".amc":
            if not isinstance(pose.source, Movement):
                raise ExportError(
                    f"{target.name} needs a skeleton (ASF), and these joints have none: only those"
                    " of an AMC have, as they were read; write a CSV."
                )
            turning, writing = part(report, 0.0, 0.7), part(report, 0.7, 1.0)
            movement = inverse_kinematics(pose, pose.source, progress=turning)
            off = dict(zip(pose.joints, how_far_off(movement, pose).tolist(), strict=True))
            return lambda file: write_amc(movement, file, writing, target, rate=pose.rate), off
        case _:
            raise ExportError(
                f"{target.name} should end in {', '.join(WRITABLE)}, to tell what to write."
            )
