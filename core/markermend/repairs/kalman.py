"""Kalman smoothing of the marker's own trajectory under constant acceleration.

State: position, velocity and acceleration, which changes by white jerk. Forward filter and
backward pass of Rauch, Tung and Striebel (1965); the ratio of jerk to measurement noise is the
likeliest of a grid, their common scale follows in closed form, one for each axis.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact
from markermend.progress import heed
from markermend.repairs.interpolation import too_few
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import make_repair, refuse

METHOD = "kalman"
LEAST_SIDE = 4
# One step of a frame, and the covariance that white jerk of density 1 adds in it.
STEP = np.array([[1.0, 1.0, 0.5], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]])
JERK = np.array([[1 / 20, 1 / 8, 1 / 6], [1 / 8, 1 / 3, 1 / 2], [1 / 6, 1 / 2, 1.0]])
# Densities of jerk tried, for a measurement noise of variance 1.
RATIOS = np.geomspace(1e-8, 1e4, 37)
# The first state is as good as unknown; the observations that settle it say nothing of the noise.
UNKNOWN, SETTLING = 1e9, 3
# So many observations are worked in with more care for rounding.
UNSETTLED = 8
LEAST_VARIANCE_MM2 = 1e-8
# Beside the body less of the trajectory tells as much.
OWN_CONTEXT_S = 0.5
# The filter is too sure of itself where the movement changes: its deviation is counted so much,
# with the noise of what would have been measured beside it, and without.
DOUBT, DOUBT_ALONE = 1.25, 1.5


@dataclass(frozen=True)
class KalmanParams:
    """How far the smoother looks at its own trajectory."""

    context_s: float = field(
        default=1.0,
        metadata={
            "unit": "s",
            "min": 0.1,
            "max": 60.0,
            "help": "Time on either side that is smoothed along",
        },
    )


@dataclass(frozen=True, eq=False)
class _Pass:
    """Forward estimates before and after seeing each frame, for the likeliest ratio.

    Attributes
    ----------
    before, after : (frames, 3, 6) covariance of position, velocity and acceleration, and beside it
        their means along three axes: both step from frame to frame, and learn, alike
    scale : (3,) variance of the measurement noise along each axis, mm²; covariances are for 1
    """

    before: FloatArray
    after: FloatArray
    scale: FloatArray


@register(
    METHOD,
    label="Kalman smoother",
    summary="Moves on under constant acceleration from both sides; for short intervals, with band.",
    params=KalmanParams,
    source="Rauch, Tung and Striebel 1965",
    crosses_blackout=True,
)
def repair_kalman(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Smooth the trusted samples around the interval and read the interval off.

    Refuses where either side has fewer than four trusted samples, so also at the take's ends.
    """
    first, known = _around(evidence, artifact, params.context_s)
    start, stop = artifact.start - first, artifact.stop - first
    sides = int(known[:start].sum()), int(known[stop:].sum())
    if min(sides) < LEAST_SIDE:
        return refuse(METHOD, too_few(artifact.marker, *sides, LEAST_SIDE), params)
    mean, variance, noise = _across(evidence, artifact, first, known)
    deviation = np.sqrt(DOUBT**2 * variance + noise)
    return make_repair(METHOD, evidence, artifact, mean, params, deviation)


def own_course(evidence: Evidence, artifact: Artifact) -> tuple[FloatArray, FloatArray] | None:
    """Where the marker's own movement alone would take it through an interval.

    Parameters
    ----------
    evidence : what may be believed
    artifact : the interval

    Returns
    -------
    mean, deviation : (stop - start, 3) mm, without the noise of measurement; None where too little
        is seen on a side
    """
    first, known = _around(evidence, artifact, OWN_CONTEXT_S)
    start, stop = artifact.start - first, artifact.stop - first
    if min(known[:start].sum(), known[stop:].sum()) < LEAST_SIDE:
        return None
    mean, variance, _ = _across(evidence, artifact, first, known)
    return mean, DOUBT_ALONE * np.sqrt(variance)


def _around(evidence: Evidence, artifact: Artifact, context_s: float) -> tuple[int, BoolArray]:
    """First frame looked at, and which frames from there on are known."""
    take = evidence.take
    reach = max(LEAST_SIDE, round(context_s * take.rate))
    first = max(0, artifact.start - reach)
    last = min(take.frames, artifact.stop + reach)
    known = evidence.seen[first:last, take.index(artifact.marker)].copy()
    known[artifact.start - first : artifact.stop - first] = False
    return first, known


def _across(
    evidence: Evidence, artifact: Artifact, first: int, known: BoolArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Smoothed positions in an interval of which nothing is known, as :func:`smooth` gives them."""
    take = evidence.take
    track = take.positions[first : first + len(known), take.index(artifact.marker)]
    return smooth(track, known, artifact.start - first, artifact.stop - first)


def smooth(
    track: FloatArray, known: BoolArray, start: int, stop: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Smoothed positions in an interval.

    Parameters
    ----------
    track : (frames, 3) mm; anything, NaN too, where not known
    known : (frames,) bool, with four true at least
    start, stop : the interval that is wanted

    Returns
    -------
    mean, variance : (stop - start, 3) in mm and mm²
    noise : (3,) variance of the measurement along each axis, mm²
    """
    heed()
    origin = track[known].mean(axis=0)
    forward = _filter(track - origin, known)
    here, ahead = forward.after[start:-1], forward.before[start + 1 :]
    gains = np.linalg.solve(ahead[:, :, :3], STEP @ here[:, :, :3])
    back = _for_both(np.asarray(gains.swapaxes(1, 2)))
    here, ahead = here.reshape(-1, 18), ahead.reshape(-1, 18)
    state = forward.after[-1].ravel()
    states = np.empty_like(here)
    for t in range(len(here) - 1, -1, -1):
        state = states[t] = here[t] + back[t] @ (state - ahead[t])
    wanted = states[: stop - start].reshape(-1, 3, 6)
    variance = np.maximum(wanted[:, 0, 0], 0.0)[:, None] * forward.scale
    return wanted[:, 0, 3:] + origin, variance, forward.scale


def _for_both(turns: FloatArray) -> FloatArray:
    """(n, 18, 18) what (n, 3, 3) do to covariance, on both its sides, and means, flattened."""
    wide = np.tile(np.eye(6), (len(turns), 1, 1))
    wide[:, :3, :3] = turns
    return np.asarray(np.einsum("nac,nxy->naxcy", turns, wide).reshape(-1, 18, 18))


def _filter(track: FloatArray, known: BoolArray) -> _Pass:
    """Run all ratios forward at once."""
    frames, ratios = len(track), len(RATIOS)
    ahead = _for_both(STEP[None])[0]
    noise = np.pad(JERK, ((0, 0), (0, 3))).reshape(18, 1) * RATIOS
    # What is seen of covariance and mean: nothing, and the place.
    seen = np.zeros((frames, 6, 1))
    seen[:, 3:, 0] = track
    before, after = (np.zeros((frames, 18, ratios)) for _ in range(2))
    before[0, [0, 7, 14]] = UNKNOWN
    count = 0
    for t in range(frames):
        if t > 0:
            np.matmul(ahead, after[t - 1], out=before[t])
            before[t] += noise
        if not known[t]:
            after[t] = before[t]
            continue
        old, new = before[t].reshape(3, 6, -1), after[t].reshape(3, 6, -1)
        gain = old[:, 0] / (old[0, 0] + 1.0)
        np.subtract(old, gain[:, None] * (old[0] - seen[t]), out=new)
        if count < UNSETTLED:
            # Joseph's form: the short one turns negative where a lone sample precedes a gap.
            new[:, :3] -= (new[:, 0] - gain)[:, None] * gain
        count += 1
    settled = before.reshape(frames, 3, 6, ratios)[np.flatnonzero(known)[SETTLING:], 0]
    total = settled[:, 0] + 1.0
    squares = (track[known][SETTLING:, :, None] - settled[:, 3:]) ** 2 / total[:, None]
    counted = count - SETTLING
    scales = np.maximum(squares.sum(axis=0) / counted, LEAST_VARIANCE_MM2)
    cost = counted * np.log(scales).sum(axis=0) + 3 * np.log(total).sum(axis=0)
    best = int(np.argmin(cost))
    old, new = (a[:, :, best].reshape(frames, 3, 6) for a in (before, after))
    return _Pass(old, new, scales[:, best])
