"""Gaps at random places, for benchmarks of filling: one marker or several at once."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray
from markermend.artifact import Artifact
from markermend.errors import DataError, MethodError
from markermend.simulation.truth import Damage, apply_damage, hidden
from markermend.take import Take, is_unlabelled

_TRIES = 500


def place_gaps(
    take: Take,
    *,
    count: int = 2,
    mean_length: float = 50.0,
    concomitant: int = 1,
    fixed_length: bool = False,
    margin: int = 1,
    seed: int,
) -> tuple[Take, tuple[Artifact, ...]]:
    """Hide samples that are known, to see how well they can be filled.

    Parameters
    ----------
    take : the recording; NaN = missing, such samples are never part of a new gap
    count : number of gap intervals
    mean_length : mean of the Poisson distribution of lengths, in frames
    concomitant : markers hidden together in each interval, drawn anew for each
    fixed_length : every gap has exactly ``round(mean_length)`` frames
    margin : frames that must be seen on either side of a gap
    seed : same seed, same gaps

    Returns
    -------
    the take with the gaps, and one artifact of class gap for each marker and interval

    Raises
    ------
    MethodError
        when a number is out of range
    DataError
        when the take has no room for the gaps asked for

    Notes
    -----
    Poisson lengths as in skurowski2021; concomitant gaps as in tits2018.
    """
    if count < 1 or concomitant < 1 or mean_length < 1 or margin < 0:
        raise MethodError("Count, length and concomitant markers must be at least 1.")
    rng = np.random.default_rng(seed)
    columns = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    free = take.present.copy()
    damages: list[Damage] = []
    for _ in range(count):
        length = round(mean_length) if fixed_length else max(1, int(rng.poisson(mean_length)))
        start, chosen = _room(free, columns, length, concomitant, margin, rng)
        for column in chosen:
            free[max(0, start - margin) : start + length + margin, column] = False
            damages.append(hidden(take.labels[column], start, start + length, "simulated gap"))
    return apply_damage(take, damages)


def _room(
    free: BoolArray,
    columns: list[int],
    length: int,
    together: int,
    margin: int,
    rng: np.random.Generator,
) -> tuple[int, list[int]]:
    """Start of an interval with room for a gap, and the markers to hide in it."""
    last = free.shape[0] - length - margin
    if last >= margin:
        for _ in range(_TRIES):
            start = int(rng.integers(margin, last + 1))
            around = free[start - margin : start + length + margin]
            open_columns = [c for c in columns if around[:, c].all()]
            if len(open_columns) >= together:
                picked = rng.choice(open_columns, size=together, replace=False)
                return start, sorted(int(c) for c in picked)
    raise DataError(
        f"The take has no room for {together} gaps of {length} frames at once; ask for fewer."
    )
