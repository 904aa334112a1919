"""Gaps made for tests of repairs."""

from __future__ import annotations

import numpy as np

from markermend.artifact import Artifact, Kind
from markermend.take import Take


def hide(take: Take, label: str, start: int, stop: int) -> Take:
    """Lose a marker for a while."""
    positions = take.positions.copy()
    positions[start:stop, take.index(label)] = np.nan
    return Take(positions, take.labels, take.rate)


def gap(label: str, start: int, stop: int) -> Artifact:
    """Say that it was lost."""
    return Artifact(label, "xyz", start, stop, Kind.GAP)
