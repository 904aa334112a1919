"""Exchange of two markers whose names were mixed up for a while."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from markermend.artifact import Artifact, axis_columns
from markermend.patch import Patch
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import as_mapping, refuse
from markermend.take import AXES, Origin


@dataclass(frozen=True)
class SwapParams:
    """A swap has nothing to set: the counterpart is the artifact's."""


@register(
    "swap",
    label="Swap markers",
    summary="Exchanges the marker with its counterpart over the interval; nothing is invented.",
    params=SwapParams,
    key=6,
)
def repair_swap(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Exchange the samples of marker and counterpart on the artifact's axes.

    Where either is missing all three axes are exchanged, since a sample cannot be half there;
    the gap then changes sides too.
    """
    take = evidence.take
    if artifact.counterpart is None:
        return refuse("swap", "No counterpart is known that carries the opposite step.", params)
    if artifact.counterpart not in take or artifact.counterpart == artifact.marker:
        return refuse("swap", f"{artifact.counterpart} cannot be the counterpart.", params)
    rows = slice(artifact.start, artifact.stop)
    one, other = take.index(artifact.marker), take.index(artifact.counterpart)
    complete = take.present[rows, one].all() and take.present[rows, other].all()
    axes = artifact.axes if complete else AXES
    patches = []
    for label, donor in ((artifact.marker, other), (artifact.counterpart, one)):
        values = take.positions[rows, donor][:, axis_columns(axes)].copy()
        missing = np.isnan(values).any(axis=1)
        origin = np.where(missing, Origin.MISSING, Origin.EDITED).astype(np.uint8)
        patches.append(Patch(label, axes, artifact.start, artifact.stop, values, origin))
    return Repair(
        "swap",
        tuple(patches),
        error_mm=0.0,
        band_mm=np.zeros(artifact.length),
        params=as_mapping(params),
    )
