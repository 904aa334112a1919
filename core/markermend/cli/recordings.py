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
    if not take.skeleton:
        if path is not None:
            raise MethodError("--prior is for skeleton recordings, and this take has markers.")
        return
    from markermend.poses.own_prior import choose_prior, why_not_used
    from markermend.poses.prior import load_prior
    from markermend.poses.take import pose_of

    choose_prior(None if path is None else Path(path))
    if path is not None:
        load_prior(Path(path))
        why = why_not_used(pose_of(take))
        if why:
            warn(why)
