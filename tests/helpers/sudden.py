"""Sudden damage for tests of the joint detector."""

from __future__ import annotations

import numpy as np

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.take import Take


def sudden(take: Take, **settings: float) -> list[Artifact]:
    """What the joint detector finds but for gaps and slow changes."""
    found = mm.detect(take, slow=False, **settings)
    return [a for a in found if a.kind is not Kind.GAP]


def hurt(take: Take, marker: str, axis: int, start: int, deviation: np.ndarray) -> Take:
    """Add a deviation in mm, a value a frame, to one axis of a marker."""
    positions = take.positions.copy()
    positions[start : start + len(deviation), take.index(marker), axis] += deviation
    return Take(positions, take.labels, take.rate)
