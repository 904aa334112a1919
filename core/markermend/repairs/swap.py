"""Exchange of markers whose names were mixed up for a while."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from markermend.artifact import Artifact, axis_columns
from markermend.patch import Patch
from markermend.poses.faults.exchanging_angles import angles_changed_back
from markermend.poses.take import pose_of
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import as_mapping, refuse
from markermend.take import AXES, Origin

_ANGLES = "Angles were exchanged here, not places; restoring the skeleton gives them back."


@dataclass(frozen=True)
class SwapParams:
    """A swap has nothing to set: the counterparts are the artifact's."""


@register(
    "swap",
    label="Swap markers",
    summary="Gives the marker and its counterparts their own samples back; nothing is invented.",
    params=SwapParams,
    key=6,
)
def repair_swap(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Give each marker of a swap the samples of the next, and the last those of the first.

    Where any of them is missing all three axes are exchanged, since a sample cannot be half
    there; the gap then changes sides too. Joints whose angles changed places stand at their own
    side, so that there is nothing to exchange.
    """
    take, names = evidence.take, artifact.markers
    if len(names) < 2:
        return refuse("swap", "No counterpart is known that carries the opposite step.", params)
    if len(set(names)) < len(names) or not all(name in take for name in names):
        others = " and ".join(names[1:])
        return refuse("swap", f"{others} cannot be the counterpart.", params)
    rows = slice(artifact.start, artifact.stop)
    columns = [take.index(name) for name in names]
    if take.skeleton and angles_changed_back(pose_of(take))[1][rows, columns].any():
        return refuse("swap", _ANGLES, params)
    axes = artifact.axes if take.present[rows, columns].all() else AXES
    patches = []
    for label, donor in zip(names, [*columns[1:], columns[0]], strict=True):
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
