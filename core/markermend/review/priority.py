"""In which order artifacts are worth looking at: the worst first."""

from __future__ import annotations

import math

from markermend.artifact import Artifact

GAP_MM_PER_S = 100.0
"""What a second without a marker weighs against a deviation in mm."""


def badness(artifact: Artifact, rate: float, frames: int) -> float:
    """How much an artifact is worth looking at: its size in mm times how sure we are.

    Where a take begins or ends without a marker it was mostly not in view yet or any more, and
    little can be done: such gaps come last.

    Parameters
    ----------
    artifact : an amplitude of NaN, as gaps have, is worked out from its length
    rate : frames per second
    frames : length of the take
    """
    size = artifact.amplitude_mm
    if not math.isfinite(size):
        at_edge = artifact.start == 0 or artifact.stop == frames
        size = 0.0 if at_edge else GAP_MM_PER_S * artifact.length / rate
    return artifact.confidence * size
