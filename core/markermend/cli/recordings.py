"""Skeleton recordings that commands learn from or try, and what they are restored by."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import markermend as mm
from markermend.cli.console import warn
from markermend.errors import DataError, MethodError
from markermend.take import Take

if TYPE_CHECKING:
    from markermend.poses import Pose
    from markermend.poses.prior import Prior


def read_by_name(paths: Iterable[str]) -> dict[str, Pose]:
    """Recordings by the names of their files without ending, which tell who they show.

    Raises
    ------
    DataError
        when two files have one name, so that one would go unnoticed
    """
    by_name: dict[str, str] = {}
    for path in paths:
        other = by_name.setdefault(Path(path).stem, path)
        if other != path:
            raise DataError(f"“{other}” and “{path}” have one name; give each recording its own.")
    return {name: mm.read_pose(path) for name, path in by_name.items()}


def heed_prior(take: Take, path: str | None) -> None:
    """Let a take of joints be restored by a prior of the user's own, and say where it is not.

    Parameters
    ----------
    take : as it was read
    path : the prior's file; None for Markermend's own

    Raises
    ------
    MarkermendError
        when the file holds no prior, or the take has markers
    """
    if take.skeleton:
        from markermend.poses.take import pose_of, restore_by

        pose = pose_of(take)
        restore_by(pose, prior_asked_for(pose, path))
    elif path is not None:
        raise MethodError("--prior is for skeleton recordings, and this take has markers.")


def prior_asked_for(pose: Pose, path: str | None) -> Prior:
    """The prior in a file where it fits a recording, else Markermend's own, saying why.

    Parameters
    ----------
    pose : the recording
    path : the prior's file; None for Markermend's own

    Raises
    ------
    FileFormatError
        when the file holds no prior
    """
    from markermend.poses.own_prior import prior_for

    prior, why = prior_for(pose, None if path is None else Path(path))
    if why:
        warn(why)
    return prior
