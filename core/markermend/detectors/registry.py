"""The detection methods by name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from markermend.artifact import Artifact
from markermend.detectors.joint import JointParams, detect_joint
from markermend.detectors.paper import detect_paper
from markermend.detectors.params import PaperParams
from markermend.mesh import Mesh
from markermend.plugins.discover import DETECTORS as PLUGINS
from markermend.plugins.guards import guard_detector
from markermend.progress import Progress
from markermend.registry import Registry
from markermend.take import Take

DetectorFunction = Callable[[Take, Any, Mesh | None, Progress], list[Artifact]]


@dataclass(frozen=True)
class Detector:
    """A detection method.

    Attributes
    ----------
    name : short name for command line and files
    label : name for people
    summary : one sentence on what it does
    params : frozen dataclass; each field's metadata gives ``unit``, ``min``, ``max``, ``help``
    run : ``(take, params, mesh or None, progress) -> artifacts`` of all kinds but gaps
    source : paper and section, or empty
    plugin : the package that brings it, empty for ours
    """

    name: str
    label: str
    summary: str
    params: type
    run: DetectorFunction
    source: str = ""
    plugin: str = ""


DETECTORS = Registry("detection method", Detector, PLUGINS, guard_detector)
"""Every detection method by name."""

DETECTORS.add(
    Detector(
        name="paper",
        label="As published",
        summary="Four stages on each coordinate, from single peaks to slow changes.",
        params=PaperParams,
        run=detect_paper,
        source="skurowski2022, section 3.4",
    )
)
DETECTORS.add(
    Detector(
        name="joint",
        label="Joint",
        summary="Jumps and jitter that neither smooth motion nor the neighbours explain, "
        "with calibrated confidence.",
        params=JointParams,
        run=detect_joint,
    )
)


def find_detector(name: str) -> Detector:
    """Look a method up.

    Raises
    ------
    MethodError
        when there is none of that name; the message lists those there are
    """
    return DETECTORS.find(name)
