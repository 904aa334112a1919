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
# The filter is too sure of itself where the movement changes: its deviation is counted so much.
DOUBT = 1.5


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
    """Forward estimates for every ratio: before and after seeing each frame, and their fit."""

    predicted: FloatArray
    predicted_cov: FloatArray
    filtered: FloatArray
    filtered_cov: FloatArray
    best: int
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
    mean, deviation = _across(evidence, artifact, first, known)
    return make_repair(METHOD, evidence, artifact, mean, params, deviation)


def own_course(evidence: Evidence, artifact: Artifact) -> tuple[FloatArray, FloatArray] | None:
    """Where the marker's own movement alone would take it through an interval.

    Parameters
    ----------
    evidence : what may be believed
    artifact : the interval

    Returns
    -------
    mean, deviation : (stop - start, 3) mm; None where too little is seen on a side
    """
    first, known = _around(evidence, artifact, OWN_CONTEXT_S)
    start, stop = artifact.start - first, artifact.stop - first
    if min(known[:start].sum(), known[stop:].sum()) < LEAST_SIDE:
        return None
    return _across(evidence, artifact, first, known)


def _around(evidence: Evidence, artifact: Artifact, context_s: float) -> tuple[int, BoolArray]:
    """First frame looked at, and which frames from there on are known."""
    take = evidence.take
    reach = max(LEAST_SIDE, round(context_s * take.rate))
    first = max(0, artifact.start - reach)
    last = min(take.frames, artifact.stop + reach)
    known: BoolArray = np.all(evidence.trusted[first:last, take.index(artifact.marker)], axis=1)
    known[artifact.start - first : artifact.stop - first] = False
    return first, known


def _across(
    evidence: Evidence, artifact: Artifact, first: int, known: BoolArray
) -> tuple[FloatArray, FloatArray]:
    """Mean and deviation in an interval of which nothing is known."""
    take = evidence.take
    track = take.positions[first : first + len(known), take.index(artifact.marker)]
    mean, variance = smooth(track, known, artifact.start - first, artifact.stop - first)
    return mean, DOUBT * np.sqrt(variance)


def smooth(
    track: FloatArray, known: BoolArray, start: int, stop: int
) -> tuple[FloatArray, FloatArray]:
    """Smoothed positions in an interval.

    Parameters
    ----------
    track : (frames, 3) mm; anything, NaN too, where not known
    known : (frames,) bool, with four true at least
    start, stop : the interval that is wanted

    Returns
    -------
    mean, variance : (stop - start, 3) in mm and mm²
    """
    origin = track[known].mean(axis=0)
    forward = _filter(track - origin, known)
    best = forward.best
    mean = forward.filtered[-1, best]
    cov = forward.filtered_cov[-1, best]
    means = np.empty((stop - start, 3))
    variances = np.empty(stop - start)
    for t in range(len(track) - 2, start - 1, -1):
        ahead, ahead_cov = forward.predicted[t + 1, best], forward.predicted_cov[t + 1, best]
        here = forward.filtered_cov[t, best]
        gain = np.linalg.solve(ahead_cov, STEP @ here).T
        mean = forward.filtered[t, best] + gain @ (mean - ahead)
        cov = here + gain @ (cov - ahead_cov) @ gain.T
        if t < stop:
            means[t - start], variances[t - start] = mean[0], cov[0, 0]
    return means + origin, np.maximum(variances, 0.0)[:, None] * forward.scale


def _filter(track: FloatArray, known: BoolArray) -> _Pass:
    """Run all ratios forward at once; states are (ratios, 3 orders, 3 axes)."""
    frames, ratios = len(track), len(RATIOS)
    noise = RATIOS[:, None, None] * JERK
    predicted = np.zeros((frames, ratios, 3, 3))
    predicted_cov = np.zeros((frames, ratios, 3, 3))
    filtered, filtered_cov = np.zeros_like(predicted), np.zeros_like(predicted)
    mean = np.zeros((ratios, 3, 3))
    cov = np.tile(UNKNOWN * np.eye(3), (ratios, 1, 1))
    logs, squares = np.zeros(ratios), np.zeros((ratios, 3))
    count = 0
    for t in range(frames):
        if t > 0:
            mean, cov = STEP @ mean, STEP @ cov @ STEP.T + noise
        predicted[t], predicted_cov[t] = mean, cov
        if known[t]:
            total = cov[:, 0, 0] + 1.0
            miss = track[t] - mean[:, 0]
            gain = cov[:, :, 0] / total[:, None]
            mean = mean + gain[:, :, None] * miss[:, None, :]
            if count < UNSETTLED:
                # Joseph's form: the short one turns negative where a lone sample precedes a gap.
                keep = np.tile(np.eye(3), (ratios, 1, 1))
                keep[:, :, 0] -= gain
                cov = keep @ cov @ keep.transpose(0, 2, 1) + gain[:, :, None] * gain[:, None, :]
            else:
                cov = cov - gain[:, :, None] * cov[:, 0, None, :]
            count += 1
            if count > SETTLING:
                logs += np.log(total)
                squares += miss**2 / total[:, None]
        filtered[t], filtered_cov[t] = mean, cov
    counted = count - SETTLING
    scales = np.maximum(squares / counted, LEAST_VARIANCE_MM2)
    cost = counted * np.log(scales).sum(axis=1) + 3 * logs
    best = int(np.argmin(cost))
    return _Pass(predicted, predicted_cov, filtered, filtered_cov, best, scales[best])
