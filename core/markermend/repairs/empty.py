"""Making a gap of an interval that is not worth keeping."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from markermend.artifact import Artifact
from markermend.patch import Patch
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import as_mapping, refuse
from markermend.take import AXES


@dataclass(frozen=True)
class EmptyParams:
    """Leaving an interval empty has nothing to set."""


@register(
    "leave_empty",
    label="Leave empty",
    summary="Removes the wrong samples and leaves a gap, where no honest repair exists.",
    params=EmptyParams,
    key=9,
)
def leave_empty(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Make the interval missing; needs an artifact on all three axes."""
    column = evidence.take.index(artifact.marker)
    if not evidence.take.present[artifact.start : artifact.stop, column].any():
        return refuse("leave_empty", "The interval is empty already.", params)
    if artifact.axes != AXES:
        return refuse(
            "leave_empty",
            f"Only axis “{artifact.axes}” is flagged and a sample cannot be half missing; "
            "flag all three axes first.",
            params,
        )
    values = np.full((artifact.length, 3), np.nan)
    patch = Patch(artifact.marker, AXES, artifact.start, artifact.stop, values)
    return Repair("leave_empty", (patch,), params=as_mapping(params))
