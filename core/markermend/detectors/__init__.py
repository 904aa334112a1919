"""Detectors: what is wrong in a take, where, of which kind, and how sure that is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from threadpoolctl import threadpool_limits

from markermend.artifact import Artifact, in_order
from markermend.detectors.gaps import detect_gaps
from markermend.detectors.params import PaperParams
from markermend.detectors.registry import DETECTORS, Detector, find_detector
from markermend.mesh import Mesh
from markermend.parameters import read_params
from markermend.progress import Progress, quiet
from markermend.take import Take

__all__ = ["DETECTORS", "Detector", "PaperParams", "detect", "detect_gaps", "find_detector"]

DEFAULT = "joint"


def detect(
    take: Take,
    *,
    method: str | None = None,
    params: Mapping[str, Any] | object | None = None,
    mesh: Mesh | None = None,
    progress: Progress | None = None,
    **settings: Any,
) -> tuple[Artifact, ...]:
    """Find damaged intervals and name their class.

    A take made of a skeleton recording has a detector of its own, whatever method is named.

    Parameters
    ----------
    take : the recording; points that are not markers are never looked at
    method : name in :data:`DETECTORS`; when None the one ``params`` belong to, or ``"joint"``
    params : the method's parameters as a mapping or its dataclass; None for the defaults
    mesh : the body's structure; inferred from the take when None and needed
    progress : told the share done; may raise :class:`markermend.errors.Cancelled`
    settings : single parameters by name, ``sensitivity=0.7``

    Returns
    -------
    Gaps and artifacts, sorted by start, then marker.

    Raises
    ------
    MethodError
        when the method is unknown, or ``params`` are another method's or out of range
    """
    detector = find_detector(method or _method_of(params))
    chosen = read_params(detector, params, settings)
    if take.frames == 0:
        return ()
    report = progress or quiet
    if take.skeleton:
        from markermend.detectors.skeleton import detect_joints

        with threadpool_limits(1):
            return in_order(detect_joints(take, report))
    report(0.0, "gaps")
    with threadpool_limits(1):
        found = in_order([*detect_gaps(take), *detector.run(take, chosen, mesh, report)])
    report(1.0, "done")
    return found


def _method_of(params: Any) -> str:
    """Name of the method that parameters belong to; of the default one where they tell nothing."""
    return next((d.name for d in DETECTORS.values() if d.params is type(params)), DEFAULT)
