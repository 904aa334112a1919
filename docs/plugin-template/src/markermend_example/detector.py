"""A detection method: markers that do not move at all while the others do."""

from dataclasses import dataclass, field

import numpy as np

from markermend.arrays import runs
from markermend.artifact import Artifact, Kind
from markermend.detectors.registry import Detector


@dataclass(frozen=True)
class StillParams:
    """Parameters of :data:`still`."""

    least_s: float = field(
        default=0.2, metadata={"unit": "s", "min": 0.0, "help": "Shortest standstill"}
    )


def detect_still(take, params, mesh, progress):
    """Find stretches in which a marker repeats its position to the last digit."""
    found = []
    for column, label in enumerate(take.labels):
        progress(column / take.markers, f"Looking at {label}")
        moved = np.abs(np.diff(take.positions[:, column], axis=0)).sum(axis=1)
        for start, stop in runs(moved == 0):
            if stop - start >= params.least_s * take.rate:
                why = f"does not move at all for {(stop - start) / take.rate:.1f} s"
                found.append(
                    Artifact(label, "xyz", int(start) + 1, int(stop) + 1, Kind.SLOW, 0.9, why=why)
                )
    return found


still = Detector(
    name="still",
    label="Standstill",
    summary="Finds markers that repeat their position to the last digit.",
    params=StillParams,
    run=detect_still,
)
