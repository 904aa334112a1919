"""Markermend: find, name and repair damaged intervals in optical motion capture takes.

>>> import markermend as mm
>>> take = mm.read("take.c3d")
>>> found = mm.detect(take)
>>> clean = mm.repair(take, found)
>>> mm.write(clean, "take_clean.c3d")

Names are imported when first used, so that ``import markermend`` costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from markermend.artifact import Artifact, Kind, Status
    from markermend.detectors import detect
    from markermend.errors import (
        Cancelled,
        DataError,
        ExportError,
        FileFormatError,
        MarkermendError,
        MethodError,
    )
    from markermend.files import read, write
    from markermend.files.pose import read_pose, write_pose
    from markermend.mesh import Mesh, infer_mesh
    from markermend.poses import Pose
    from markermend.poses.restore import denoise
    from markermend.repairs import fill, repair
    from markermend.review.session import Session
    from markermend.simulation import simulate
    from markermend.smoothers import smooth
    from markermend.take import Origin, Take

__version__ = "0.1.0"

_HOME = {
    "Artifact": "artifact",
    "Cancelled": "errors",
    "DataError": "errors",
    "ExportError": "errors",
    "FileFormatError": "errors",
    "Kind": "artifact",
    "MarkermendError": "errors",
    "Mesh": "mesh",
    "MethodError": "errors",
    "Origin": "take",
    "Pose": "poses",
    "Session": "review.session",
    "Status": "artifact",
    "Take": "take",
    "denoise": "poses.restore",
    "detect": "detectors",
    "fill": "repairs",
    "infer_mesh": "mesh",
    "read": "files",
    "read_pose": "files.pose",
    "repair": "repairs",
    "simulate": "simulation",
    "smooth": "smoothers",
    "write": "files",
    "write_pose": "files.pose",
}

__all__ = [
    "Artifact",
    "Cancelled",
    "DataError",
    "ExportError",
    "FileFormatError",
    "Kind",
    "MarkermendError",
    "Mesh",
    "MethodError",
    "Origin",
    "Pose",
    "Session",
    "Status",
    "Take",
    "denoise",
    "detect",
    "fill",
    "infer_mesh",
    "read",
    "read_pose",
    "repair",
    "simulate",
    "smooth",
    "write",
    "write_pose",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'markermend' has no attribute {name!r}")
    value = getattr(import_module(f"markermend.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
