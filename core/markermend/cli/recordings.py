"""Skeleton recordings that commands learn from or try, by name."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import markermend as mm
from markermend.errors import DataError
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
