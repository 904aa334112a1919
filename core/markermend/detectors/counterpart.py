"""Swaps: a step whose complement another trajectory carries.

When the labels of two markers are exchanged for a while, both trajectories jump at the same two
frames, and exchanging them back makes both continuous. That is looked for here among all
trajectories, named or not. A nameless trajectory may exist only during the swap; then it is
enough that the marker's own trajectory becomes continuous.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import how_long, in_mm, overlap
from markermend.take import Take, is_unlabelled

# What is left of each jump after the exchange, at most.
LARGEST_REST = 0.3
# Both trajectories jump at the same frames; intervals on either this much alike are one swap.
SAME_STEP = 0.5


def name_swaps(take: Take, artifacts: list[Artifact]) -> list[Artifact]:
    """Turn steps that are swaps into one artifact a swap, naming both markers.

    Parameters
    ----------
    take : the recording
    artifacts : of any kinds; only steps are looked at

    Returns
    -------
    The artifacts; a swap names all axes and its counterpart, and what else was read from the same
    two jumps (steps or noise of either marker over the same interval) is gone. The one named first
    in the take is the artifact's marker, a labelled one before a nameless one.
    """
    steps = sorted(
        (a for a in artifacts if a.kind is Kind.STEP),
        key=lambda a: (-a.amplitude_mm, a.marker, a.start),
    )
    named: list[Artifact] = []
    explained: set[str] = set()
    for step in steps:
        if step.id in explained:
            continue
        swap = _swap(take, step)
        if swap is None:
            continue
        pair = {swap.marker, swap.counterpart}
        explained |= {
            a.id
            for a in artifacts
            if a.kind in (Kind.STEP, Kind.NOISE)
            and a.marker in pair
            and overlap((a.start, a.stop), (step.start, step.stop)) >= SAME_STEP
        }
        named.append(swap)
    return [a for a in artifacts if a.id not in explained] + named


def _swap(take: Take, step: Artifact) -> Artifact | None:
    """Describe a step as a swap with the trajectory that explains it best, if one does."""
    if step.start < 2 or step.stop > take.frames - 2:
        return None
    marker = take.index(step.marker)
    around = [take.positions[frame - 2 : frame + 2] for frame in (step.start, step.stop)]
    jump = np.array([_break(p[:, marker], p[:, marker]) for p in around])
    into = np.array(
        [_break(around[0][:, [marker]], around[0]), _break(around[1], around[1][:, [marker]])]
    )
    back = np.array(
        [_break(around[0], around[0][:, [marker]]), _break(around[1][:, [marker]], around[1])]
    )
    with np.errstate(invalid="ignore"):
        fits = (into <= LARGEST_REST * jump[:, None]).all(axis=0)
        # Where the partner is absent outside the interval, only this marker has a say.
        fits &= ((back <= LARGEST_REST * jump[:, None]) | np.isnan(back)).all(axis=0)
    fits[marker] = False
    if not fits.any():
        return None
    rest = np.where(fits, into.mean(axis=0), np.inf)
    partner = int(np.argmin(rest))
    first, second = sorted((marker, partner), key=lambda m: (is_unlabelled(take.labels[m]), m))
    size = float(jump.mean())
    return replace(
        step,
        marker=take.labels[first],
        axes="xyz",
        counterpart=take.labels[second],
        amplitude_mm=size,
        why=(
            f"changes places with {take.labels[second]} for {how_long(step.length, take.rate)}: "
            f"exchanging them leaves {in_mm(float(rest[partner]))} of the {in_mm(size)} mm jump"
        ),
        id="",
    )


def _break(left: FloatArray, right: FloatArray) -> FloatArray:
    """How far the right's third frame is from where the left's second one was going.

    Both (4, ..., 3) mm around a border between second and third; velocity is the mean of both
    sides. Returns (...,) mm, NaN where a sample is missing.
    """
    velocity = (left[1] - left[0] + right[3] - right[2]) / 2
    return np.asarray(np.linalg.norm(right[2] - left[1] - velocity, axis=-1))
