"""Where the marker must have been, from the body around it and from its own way in and out.

The marker is seen from a frame that moves with its nearest references. There its position is one
Gaussian process of pose and time: a ridge regression on the references' coordinates and on
products of their main components, plus a deviation that is smooth in time on three scales. The
process is conditioned on all frames near the interval and on an even sample of the rest of the
take; one factorisation gives the mean and, per frame, how far off it may be.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Artifact
from markermend.repairs.body_frame import (
    align,
    describe_pose,
    pick_references,
    rank_references,
    to_frame,
    to_lab,
)
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import make_repair, refuse

METHOD = "local_regression"
# Fewer frames than this cannot tell how the marker follows its body.
LEAST_FRAMES = 20
# Standard deviations of the prior in mm: of the linear part, the products, the place itself,
# and of the deviation in time on each scale; and of the measurement.
LINEAR_MM, PRODUCTS_MM, PLACE_MM, MEASURED_MM = 12.0, 1.0, 25.0, 0.2
TIME_MM = (2.0, 2.0, 2.0)
TIME_S = (0.067, 0.5, 8.0)


@dataclass(frozen=True)
class LocalRegressionParams:
    """How much of body and take the regression looks at."""

    references: int = field(
        default=12, metadata={"min": 3, "max": 60, "help": "Markers whose pose is the input"}
    )
    frame: int = field(
        default=4, metadata={"min": 3, "max": 20, "help": "Nearest of them that make the frame"}
    )
    near_s: float = field(
        default=0.5,
        metadata={
            "unit": "s",
            "min": 0.05,
            "max": 10.0,
            "help": "Time on either side of which every frame is used",
        },
    )
    samples: int = field(
        default=300,
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
    seen: BoolArray = np.all(evidence.trusted, axis=2)
    seen[interval, marker] = False
    ranked = rank_references(take, seen, marker, interval)
    references = pick_references(ranked, seen, marker, params.references)
    if len(references) < 3:
        return refuse(METHOD, _too_few_references(artifact, len(references)), params)
    together: BoolArray = np.all(seen[:, references], axis=1)
    known = _learn_from(together & seen[:, marker], artifact, take.rate, params)
    if len(known) < LEAST_FRAMES:
        return refuse(
            METHOD,
            f"{artifact.marker} is seen together with its references in only {len(known)} frames; "
            f"{LEAST_FRAMES} are needed.",
            params,
        )
    wanted = np.arange(artifact.start, artifact.stop)
    frames = np.concatenate([known, wanted])
    cloud = take.positions[frames][:, references]
    rotation, centre = align(cloud[:, : params.frame])
    linear, products = describe_pose(to_frame(cloud, rotation, centre))
    target = to_frame(
        take.positions[known, marker][:, None], rotation[: len(known)], centre[: len(known)]
    )[:, 0]
    mean, deviation = _condition(frames / take.rate, linear, products, target)
    inside = slice(len(known), None)
    values = to_lab(mean, rotation[inside], centre[inside])
    spread = np.repeat(deviation[:, None], 3, axis=1)
    return make_repair(METHOD, evidence, artifact, values, params, spread)


def _too_few_references(artifact: Artifact, count: int) -> str:
    """Why the body cannot tell where the marker was."""
    return (
        f"Only {count} other markers of the body are seen all through the interval of "
        f"{artifact.marker}; 3 are needed."
    )


def _learn_from(
    usable: BoolArray, artifact: Artifact, rate: float, params: LocalRegressionParams
) -> IntArray:
    """Frames to learn from: all near the interval, an even sample of the others."""
    frames = np.flatnonzero(usable)
    margin = params.near_s * rate
    near = (frames >= artifact.start - margin) & (frames < artifact.stop + margin)
    rest = frames[~near]
    step = max(1, len(rest) // params.samples)
    return np.sort(np.concatenate([frames[near], rest[step // 2 :: step]]))


def _kernel(
    a: slice, b: slice, times: FloatArray, linear: FloatArray, products: FloatArray
) -> FloatArray:
    """Prior covariance in mm² between two sets of frames."""
    total = PLACE_MM**2 + (3 * LINEAR_MM**2 / linear.shape[1]) * (linear[a] @ linear[b].T)
    total += (PRODUCTS_MM**2 / products.shape[1]) * (products[a] @ products[b].T)
    apart = np.abs(times[a][:, None] - times[b][None])
    for size, scale, matern in zip(TIME_MM, TIME_S, (_matern52, _matern32, _matern32), strict=True):
        total += size**2 * matern(apart / scale)
    return np.asarray(total)


def _matern32(distance: FloatArray) -> FloatArray:
    scaled = np.sqrt(3.0) * distance
    return np.asarray((1.0 + scaled) * np.exp(-scaled))


def _matern52(distance: FloatArray) -> FloatArray:
    scaled = np.sqrt(5.0) * distance
    return np.asarray((1.0 + scaled + scaled**2 / 3.0) * np.exp(-scaled))


def _condition(
    times: FloatArray, linear: FloatArray, products: FloatArray, target: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mean (wanted, 3) and deviation (wanted,) of the process given the first frames' target.

    The deviation is scaled by how well the prior's size fits the known frames (maximum
    likelihood).
    """
    from scipy.linalg import cho_factor, cho_solve, solve_triangular

    known, wanted = slice(len(target)), slice(len(target), None)
    middle = np.median(target, axis=0)
    covariance = _kernel(known, known, times, linear, products)
    covariance[np.diag_indices_from(covariance)] += MEASURED_MM**2
    factor = cho_factor(covariance, lower=True, overwrite_a=True)
    across = _kernel(wanted, known, times, linear, products)
    weights = cho_solve(factor, target - middle)
    mean = middle + across @ weights
    explained = solve_triangular(factor[0], across.T, lower=True)
    prior = _variances(linear[wanted], products[wanted])
    variance = np.maximum(prior - np.sum(explained**2, axis=0), 0.0)
    size = np.mean((target - middle) * weights)
    return mean, np.sqrt(variance * size)


def _variances(linear: FloatArray, products: FloatArray) -> FloatArray:
    """Prior variance of single frames: the diagonal of the kernel."""
    return np.asarray(
        PLACE_MM**2
        + (3 * LINEAR_MM**2 / linear.shape[1]) * np.sum(linear**2, axis=1)
        + (PRODUCTS_MM**2 / products.shape[1]) * np.sum(products**2, axis=1)
        + sum(size**2 for size in TIME_MM)
    )
