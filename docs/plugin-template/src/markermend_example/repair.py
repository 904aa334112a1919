"""A repair method: hold the last position that was seen."""

from dataclasses import dataclass, field

import numpy as np

from markermend.artifact import axis_columns
from markermend.patch import Patch
from markermend.repairs.registry import Method, Repair


@dataclass(frozen=True)
class HoldParams:
    """Parameters of :data:`hold`."""

    longest: int = field(
        default=50, metadata={"unit": "frames", "min": 1, "help": "Leave longer intervals alone"}
    )


def repair_hold(evidence, artifact, params):
    """Repeat the last trusted position over the whole interval."""
    if artifact.length > params.longest:
        return Repair("hold", reason=f"it is longer than {params.longest} frames")
    if artifact.start == 0:
        return Repair("hold", reason="nothing was seen before it")
    column, axes = evidence.take.index(artifact.marker), axis_columns(artifact.axes)
    last = evidence.take.positions[artifact.start - 1, column, axes]
    if np.isnan(last).any():
        return Repair("hold", reason="nothing was seen before it")
    values = np.tile(last, (artifact.length, 1))
    patch = Patch(artifact.marker, artifact.axes, artifact.start, artifact.stop, values)
    return Repair("hold", (patch,))


hold = Method(
    name="hold",
    label="Hold",
    summary="Repeats the last position; right for a marker that stands still.",
    params=HoldParams,
    run=repair_hold,
)
