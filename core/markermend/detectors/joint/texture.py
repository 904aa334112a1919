"""What small jumps are usual in a take, so that only what stands out of them is believed.

Some takes jump by a millimetre or two at every moment, on all markers, whenever another set of
cameras sees a marker. Each of these jumps is real, but nobody repairs them one by one. They show
by their number and by how it falls with size: the smaller, the more. Damage that is worth a repair
has a size of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from markermend.artifact import Artifact
from markermend.take import Take

USUAL_PER_MINUTE = 25.0
"""Up to so many artifacts per minute and marker a take is calm."""
STEPS_MM = (1.0, 1.4, 2.0)
FALLING = 0.2
"""Counts that fall by size: this many of those above lie in the half octave below."""
STEEPNESS = 4


def texture_mm(artifacts: Sequence[Artifact], take: Take) -> float:
    """Size below which sudden deviations are a take's own texture.

    Parameters
    ----------
    artifacts : what was found
    take : where

    Returns
    -------
    mm, at most 2; 0 for a calm take, and for one whose damage has a size of its own
    """
    sizes = np.array([a.amplitude_mm for a in artifacts], dtype=np.float64)
    if len(sizes) * 60 * take.rate <= USUAL_PER_MINUTE * take.present.sum():
        return 0.0
    level = 0.0
    for step in STEPS_MM:
        below = int(((sizes >= step / np.sqrt(2.0)) & (sizes < step)).sum())
        if below > FALLING * (sizes >= step).sum():
            level = step
    return level


def stand_out(artifacts: Sequence[Artifact], level_mm: float, least: float) -> list[Artifact]:
    """Believe what is no larger than a take's texture less: half of it at the level itself.

    Parameters
    ----------
    artifacts : sudden ones
    level_mm : see :func:`texture_mm`
    least : smallest confidence that is kept

    Returns
    -------
    Those left, with their new confidence
    """
    if not level_mm:
        return list(artifacts)
    weaker = [
        replace(a, confidence=a.confidence / (1.0 + (level_mm / a.amplitude_mm) ** STEEPNESS))
        for a in artifacts
    ]
    return [a for a in weaker if a.confidence >= least]
