"""Takes with a known truth: a synthetic performer, contamination, damage and gaps, all seeded."""

from __future__ import annotations

from markermend.simulation.contamination import contaminate
from markermend.simulation.gap_placement import place_gaps

__all__ = ["contaminate", "place_gaps"]
