"""What every method does alike: read its parameters, refuse with a reason, make its patch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind, axis_columns
from markermend.patch import Patch
from markermend.repairs.registry import Evidence, Repair
from markermend.take import AXES

# Mean length of a three-dimensional Gaussian vector over its root mean square.
MEAN_OVER_RMS = 0.921
# Where these end is known to a frame or two only: a damaged sample just outside the interval would
# drag the repair with it, so that the edges are not believed either. They are not replaced.
WIDE, EDGE_S = (Kind.NOISE, Kind.STEP, Kind.SLOW), 0.025


def refuse(method: str, reason: str, params: Any = None) -> Repair:
    """A repair without patches, saying why."""
    return Repair(method, reason=reason, params=as_mapping(params))


def as_mapping(params: Any) -> Mapping[str, Any]:
    """Parameters as a read-only mapping, for files and reports."""
    return MappingProxyType({} if params is None else asdict(params))


def axes_of(artifact: Artifact) -> str:
    """Axes a repair may replace: all three in a gap, else those the artifact names."""
    return AXES if artifact.kind is Kind.GAP else artifact.axes


def without_own(evidence: Evidence, artifact: Artifact) -> Evidence:
    """Evidence that does not believe the artifact's own samples and, by kind, those beside it."""
    edge = round(EDGE_S * evidence.take.rate) if artifact.kind in WIDE else 0
    rows = slice(max(0, artifact.start - edge), artifact.stop + edge)
    marker, axes = evidence.take.index(artifact.marker), axis_columns(axes_of(artifact))
    if not evidence.trusted[rows, marker][:, axes].any():
        return evidence
    trusted = evidence.trusted.copy()
    trusted[rows, marker, axes] = False
    seen = evidence.seen.copy()
    seen[rows, marker] = False
    return replace(evidence, trusted=trusted).with_seen(seen)


def make_repair(
    method: str,
    evidence: Evidence,
    artifact: Artifact,
    values: FloatArray,
    params: Any,
    deviation: FloatArray | None = None,
    *,
    weights: int = 0,
) -> Repair:
    """Turn values for the interval into a repair of the artifact's axes.

    Where only some axes are named, samples that are missing stay missing: half a sample cannot
    be put back.

    Parameters
    ----------
    method : name in the registry
    evidence, artifact : what was repaired
    values : (stop - start, 3) float64, mm; axes that are not replaced may hold anything
    params : the method's parameters
    deviation : (stop - start, 3) expected standard deviation of each coordinate in mm, or None
    weights : how many numbers were learnt for it
    """
    axes = axes_of(artifact)
    columns = axis_columns(axes)
    wanted = values[:, columns].copy()
    if axes != AXES:
        marker = evidence.take.index(artifact.marker)
        wanted[~evidence.take.present[artifact.start : artifact.stop, marker]] = np.nan
    band, error = None, None
    if deviation is not None:
        band = np.sqrt(np.sum(deviation[:, columns] ** 2, axis=1))
        error = float(MEAN_OVER_RMS * band.mean())
    return Repair(
        method,
        (Patch(artifact.marker, axes, artifact.start, artifact.stop, wanted),),
        error_mm=error,
        band_mm=band,
        params=as_mapping(params),
        weights=weights,
    )
