"""A marker that slides to another place of the body and stays there."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind
from markermend.errors import DataError
from markermend.predictors.local import align, rank_references
from markermend.take import AXES, Take

MATES = 4


def slide_off(
    take: Take, marker: str, *, start: int, frames: int, away_mm: FloatArray
) -> tuple[Take, Artifact]:
    """Let a marker slide on its body part, steadily, and stay off to the end of the take.

    Parameters
    ----------
    take : the recording; NaN = missing, such samples stay missing
    marker : label
    start, frames : when it sets out, and how long that takes
    away_mm : (3,) mm, where to, in the frame of the four markers whose distance to it varies
        least

    Returns
    -------
    the take with it, and the truth

    Raises
    ------
    DataError
        when no three other markers are seen with it
    """
    column = take.index(marker)
    usable = take.present
    mates = rank_references(take.positions, column, usable, usable[:, column], 0, take.frames)[
        :MATES
    ]
    if len(mates) < 3:
        raise DataError(f"“{marker}” has no three other markers to slide among.")
    turn = align(take.positions[:, mates]).turn
    course = np.clip((np.arange(take.frames) - start) / max(1, frames), 0.0, 1.0)
    positions = take.positions.copy()
    positions[:, column] += course[:, None] * (away_mm @ turn)
    size = float(np.linalg.norm(away_mm))
    why = "slides off and does not come back"
    truth = Artifact(marker, AXES, start, take.frames, Kind.SLOW, amplitude_mm=size, why=why)
    return take.with_positions(positions, take.origin), truth
