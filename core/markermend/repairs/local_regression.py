"""Where the marker must have been, from the body around it and from its own way in and out.

The marker is seen from eight frames that move with its nearest references: one held by those that
are rigid to it, the others by some of the nearest alike. In each its place is a Gaussian process of
the references' pose and of time, conditioned on the frames near the interval, on half an even
sample of the rest of the take and, over intervals of about a second, half of those in which the
body is as it is there; the eight are averaged, the surer ones the more. Over short intervals the
marker's own movement, by the Kalman smoother, is averaged in.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, samples_of
from markermend.artifact import Artifact
from markermend.progress import heed
from markermend.repairs.body_frame import (
    align_each,
    alike,
    holding,
    pick_references,
    rank_references,
    to_frames,
)
from markermend.repairs.calming import calmed, jitter
from markermend.repairs.kalman import own_course
from markermend.repairs.kriging import Part, View, condition
from markermend.repairs.pose import FORCE_S, describe_poses
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import make_repair, refuse
from markermend.repairs.training_frames import choose_frames, near_interval
from markermend.take import Take
from markermend.vertical import up_axis

METHOD = "local_regression"
# Fewer frames than this cannot tell how the marker follows its body.
LEAST_FRAMES = 20
# References that hold the frames from which the marker is seen, beside the one that those rigid to
# it hold, by rank. What moves one of them alone is in some of the frames only, and averages out.
HOLDERS = ((0, 2, 4), range(4), range(3), (1, 2, 3), range(12), (0, 1, 4), (0, 3, 6))
# Where so many known frames lie away from the interval, half of the views learn from every second
# of them and half from the others, if there are enough views: what is learnt from different frames
# averages better, and takes less time.
MANY, LEAST_VIEWS = 100, 4
# Intervals of these lengths are likened to the rest of the take: a fourth of its even sample gives
# way to twice as many frames in which the body is as it is in the interval, and distant references
# count more in telling so. Shorter ones are told by the frames beside them, longer ones hold so
# much of the movement that an even sample is as good.
ALIKE_S, EVEN, ALIKE = (0.25, 1.25), 0.75, 0.5
# How far around the interval the noise is estimated, and its limits.
NOISE_S = 2.0
# Up to here the marker's own movement has a say beside the body. Both err alike in part, so that
# their average is not as sure as if they did not.
OWN_COURSE_S, IN_COMMON, LEAST_MM2 = 0.5, 1.2, 1e-12
# Beyond, the deviation is counted so much: the frames that were hidden to measure it had others
# near them to learn from more often than those of a long interval have. Beyond two seconds it
# grows with this power of the length: what the body does meanwhile is less and less like the rest.
LONG_DOUBT, LONG_S, LONG_POWER = 1.1, 2.0, 0.2
# Stretches that are hidden to measure the deviation are as long as the interval, and at most this
# share of what is seen: with all of it hidden, only the prior would be measured.
MOST_HIDDEN = 0.5
# Nothing holds the far end of an interval that has one side only, as where a take begins or ends.
# It is missed as far as expected in the middle, but far more in some: its band is so much wider.
ONE_SIDED_BAND = 1.3
LEAST_NOISE_MM, MOST_NOISE_MM = 0.03, 1.0


@dataclass(frozen=True)
class LocalRegressionParams:
    """How much of body and take the regression looks at."""

    references: int = field(
        default=18, metadata={"min": 3, "max": 60, "help": "Markers whose pose is the input"}
    )
    near_s: float = field(
        default=0.5,
        metadata={
            "unit": "s",
            "min": 0.05,
            "max": 10.0,
            "help": "Time on either side from which more frames are used",
        },
    )
    samples: int = field(
        default=200,
        metadata={"min": 50, "max": 5000, "help": "Frames used from the rest of the take"},
    )


@register(
    METHOD,
    label="Local regression",
    summary="Follows the body around it and joins its own way in and out; the usual choice.",
    params=LocalRegressionParams,
    key=1,
)
def repair_local_regression(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Predict the interval from the markers around and the trusted samples on its sides.

    Works with one side only, at the take's beginning and end. Needs three references that are
    seen all through the interval.
    """
    take = evidence.take
    marker, interval = take.index(artifact.marker), slice(artifact.start, artifact.stop)
    seen = evidence.seen.copy()
    seen[interval, marker] = False
    ranked, spread = rank_references(take, seen, marker, interval)
    heed()
    places = pick_references(ranked, seen, marker, params.references)
    if len(places) < 3:
        return refuse(METHOD, _too_few_references(artifact, len(places)), params)
    references, spread = ranked[places], spread[places]
    together: BoolArray = np.all(seen[:, references], axis=1)
    usable = together & seen[:, marker]
    heed()
    likened = _likened(artifact, take)
    beside = near_interval(take.frames, artifact, params.near_s * take.rate)
    known = choose_frames(
        usable,
        beside,
        artifact,
        take.rate,
        take.positions,
        references,
        even=round(params.samples * (EVEN if likened else 1.0)),
        alike=round(params.samples * ALIKE) if likened else 0,
    )
    if len(known) < LEAST_FRAMES:
        return refuse(
            METHOD,
            f"{artifact.marker} is seen together with its references in only {len(known)} frames; "
            f"{LEAST_FRAMES} are needed.",
            params,
        )
    frames = np.concatenate([known, np.arange(artifact.start, artifact.stop)])
    cloud = samples_of(take.positions, frames, references)
    reach = max(1, round(FORCE_S * take.rate))
    earlier, later = (
        samples_of(take.positions, np.clip(frames + step, 0, take.frames - 1), references)
        for step in (-reach, reach)
    )
    # Where a reference is not seen a moment earlier or later, no force is as good as any.
    force = np.nan_to_num(earlier - 2.0 * cloud + later)
    own, up = take.positions[known, marker], up_axis(take)
    parts = _parts(cloud, force, own, spread, up, likened, beside[known])
    heed()
    noise = _noise(take.positions[:, marker], seen[:, marker], artifact, take.rate)
    hidden = min(artifact.length, int(MOST_HIDDEN * np.count_nonzero(usable)))
    values, deviation, learnt = condition(frames, take.rate, parts, noise, hidden, beside[known])
    if artifact.length <= OWN_COURSE_S * take.rate:
        values, deviation = _with_own_course(evidence, artifact, values, deviation)
        # Both say how sure the place is; what a camera would have seen there trembles, too, and
        # where a body hardly moves that is most of it.
        deviation = np.hypot(deviation, noise)
    else:
        longer = max(1.0, artifact.length / take.rate / LONG_S)
        deviation = LONG_DOUBT * longer**LONG_POWER * deviation
    reach = round(NOISE_S * take.rate)
    values = calmed(
        values, take.positions[:, marker], seen[:, marker], artifact.start, noise, reach
    )
    coordinates = np.repeat(deviation[:, None], 3, axis=1)
    repair = make_repair(METHOD, evidence, artifact, values, params, coordinates, weights=learnt)
    if repair.band_mm is not None and not known[0] < artifact.start < artifact.stop <= known[-1]:
        repair = replace(repair, band_mm=ONE_SIDED_BAND * repair.band_mm)
    return repair


def _parts(
    cloud: FloatArray,
    force: FloatArray,
    own: FloatArray,
    spread: FloatArray,
    up: int,
    likened: bool,
    beside: BoolArray,
) -> list[Part]:
    """All views of references and marker, by the known frames from which they learn."""
    known, count = len(own), len(spread)
    weights = np.array([holding(spread), *(alike(spread, h) for h in HOLDERS if h[-1] < count)])
    halves = _halves(beside) if len(weights) >= LEAST_VIEWS else [np.arange(known)]
    parts = []
    for i, learnt in enumerate(halves):
        rows = np.concatenate([learnt, np.arange(known, len(cloud))])
        held = weights[i :: len(halves)]
        views = _views(cloud[rows], force[rows], own[learnt], spread, held, up, likened)
        parts.append(Part(learnt, views))
    return parts


def _halves(beside: BoolArray) -> list[IntArray]:
    """Places of known frames in two parts: all beside the interval in both, every second else."""
    near, far = np.flatnonzero(beside), np.flatnonzero(~beside)
    if len(far) < MANY:
        return [np.arange(len(beside))]
    return [np.sort(np.concatenate([near, far[k::2]])) for k in range(2)]


def _likened(artifact: Artifact, take: Take) -> bool:
    """Whether an interval is likened to the rest of the take; with one side only it is not."""
    inside = artifact.start > 0 and artifact.stop < take.frames
    return inside and ALIKE_S[0] <= artifact.length / take.rate <= ALIKE_S[1]


def _with_own_course(
    evidence: Evidence, artifact: Artifact, values: FloatArray, deviation: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Average with what the marker's own movement says, each by its inverse variance."""
    own = own_course(evidence, artifact)
    if own is None:
        return values, deviation
    course, alone = own
    alone, body = np.mean(alone**2, axis=1) + LEAST_MM2, deviation**2 + LEAST_MM2
    share = (body / (alone + body))[:, None]
    return share * course + (1.0 - share) * values, (
        IN_COMMON * np.sqrt(alone * body / (alone + body))
    )


def _views(
    cloud: FloatArray,
    force: FloatArray,
    own: FloatArray,
    spread: FloatArray,
    weights: FloatArray,
    up: int,
    likened: bool,
) -> tuple[View, ...]:
    """Look at references and marker from frames that are held by (views, points) weights."""
    learnt = len(own)
    points = np.ascontiguousarray(cloud.transpose(1, 2, 0))
    rotation, centre = align_each(points, weights)
    share = weights / weights.sum(axis=1, keepdims=True)
    pushed = np.einsum("vp,fpi->vif", share, force)
    linear, curved = describe_poses(
        to_frames(points, rotation, centre),
        spread,
        rotation[:, up],
        np.einsum("vif,vijf->vjf", pushed, rotation),
        distant=likened,
    )
    target = to_frames(own.T[None], rotation[..., :learnt], centre[..., :learnt])
    return tuple(
        View(linear[v].T, curved[v].T, target[v, 0].T, rotation[v].transpose(2, 0, 1), centre[v].T)
        for v in range(len(weights))
    )


def _too_few_references(artifact: Artifact, count: int) -> str:
    """Why the body cannot tell where the marker was."""
    seen = ("No other marker", "Only one other marker")[count] if count < 2 else "Only two others"
    verb = "are" if count == 2 else "is"
    return (
        f"{seen} of the body {verb} seen all through the interval of {artifact.marker}; "
        "three are needed."
    )


def _noise(own: FloatArray, seen: BoolArray, artifact: Artifact, rate: float) -> float:
    """Noise of the measurement in mm, from fourth differences of the trajectory around."""
    reach = round(NOISE_S * rate)
    around = slice(max(0, artifact.start - reach), artifact.stop + reach)
    track = np.where(seen[around, None], own[around], np.nan)
    noise = jitter(track)
    return MOST_NOISE_MM if np.isnan(noise) else min(max(noise, LEAST_NOISE_MM), MOST_NOISE_MM)
