"""The marker as a fixed point of its rigid body."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact
from markermend.repairs.body_frame import align, to_frame, to_lab
from markermend.repairs.bridge import bridge_within, context_of
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import make_repair, refuse

METHOD = "rigid"
LEAST_REFERENCES = 3


@dataclass(frozen=True)
class RigidParams:
    """What counts as a rigid body."""

    least_width: float = field(
        default=10.0,
        metadata={
            "unit": "mm",
            "min": 0.1,
            "max": 1000.0,
            "help": "Least width across its longest side; on a line, markers cannot show a turn",
        },
    )


@register(
    METHOD,
    label="Rigid body",
    summary="Moves the marker with three or more others of its group; for rigid segments.",
    params=RigidParams,
)
def repair_rigid(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Keep the marker in place within its group's markers, aligned frame by frame (Procrustes).

    Its place in the body's frame, which soft tissue moves a little, is bridged from one side to
    the other. With one side only, at the take's beginning and end, it is held. Refuses where
    fewer than three markers of the group are seen all through the interval, or lie on a line.
    """
    from markermend.mesh import infer_mesh

    take, marker = evidence.take, evidence.take.index(artifact.marker)
    start, stop = artifact.start, artifact.stop
    seen = evidence.seen
    siblings = (evidence.mesh or infer_mesh(take)).siblings(marker)
    group = [m for m in siblings if seen[start:stop, m].all()]
    if len(group) < LEAST_REFERENCES:
        reason = (
            f"Only {len(group)} other markers of the group of {artifact.marker} are seen all "
            f"through the interval; {LEAST_REFERENCES} are needed."
        )
        return refuse(METHOD, reason, params)
    posed: BoolArray = np.all(seen[:, group], axis=1)
    usable = posed & seen[:, marker]
    usable[start:stop] = False
    if len(context_of(usable, start, stop, take.rate)) == 0:
        reason = f"{artifact.marker} is nowhere near the interval seen together with its group."
        return refuse(METHOD, reason, params)
    cloud = take.positions[posed][:, group]
    rotation, centre = np.zeros((take.frames, 3, 3)), np.zeros((take.frames, 3))
    rotation[posed], centre[posed] = align(cloud, np.ones(len(group)))
    width = _width(to_frame(cloud, rotation[posed], centre[posed]).mean(axis=0))
    if width < params.least_width:
        reason = f"The other markers of the group lie on a line, within {width:.0f} mm."
        return refuse(METHOD, reason, params)
    own = take.positions[:, marker][:, None]
    place = to_frame(own, rotation, centre)[:, 0]
    mean, deviation = bridge_within(place, usable, start, stop, take.rate)
    values = to_lab(mean, rotation[start:stop], centre[start:stop])
    # The frame turns, so each lab coordinate gets its share of the whole.
    level = np.sqrt(np.mean(deviation**2, axis=1, keepdims=True))
    return make_repair(METHOD, evidence, artifact, values, params, np.repeat(level, 3, axis=1))


def _width(shape: FloatArray) -> float:
    """How far markers (k, 3) reach across the longest line through them, mm."""
    _, _, axes = np.linalg.svd(shape - shape.mean(axis=0))
    return float(np.ptp((shape - shape.mean(axis=0)) @ axes[1]))
