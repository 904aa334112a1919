"""Joints of a skeleton recording, worked out from its bones, other joints, time and a prior."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from markermend.artifact import Artifact, axis_columns
from markermend.errors import DataError
from markermend.patch import Patch
from markermend.poses.take import moved_far, pose_of, restored, restored_without
from markermend.progress import Progress
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import MEAN_OVER_RMS, as_mapping, axes_of, refuse
from markermend.take import Take

NAME = "skeleton"


@dataclass(frozen=True)
class SkeletonParams:
    """There is nothing to set: noise, bones and what others tell are measured."""


@register(
    NAME,
    label="Restore skeleton",
    summary="Works a joint out from the others, from time, from its bones and from how bodies move;"
    " only for skeleton recordings, where it mostly is the best.",
    params=SkeletonParams,
)
def repair_skeleton(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Give joints where restoring the recording has them, as ``denoise`` does.

    The recording is restored as it was read: what is wrong in it by itself, the interval of the
    artifact, and what is flagged, cut or repaired of other joints at the same time count as not
    seen. A swap with a counterpart mends both joints.
    """
    take = evidence.take
    if not take.skeleton:
        return refuse(NAME, "Only skeleton recordings have joints and bones.", params)
    rows, axes = slice(artifact.start, artifact.stop), axes_of(artifact)
    joints = [take.index(marker) for marker in artifact.markers]
    try:
        doubted = ~evidence.seen | moved_far(take)
        # Where a repair is to follow chosen joints alone, the others are believed all the same.
        doubted &= evidence.seen.any(axis=0)
        # What stands beside an interval of the joint itself is how restoring begins and ends it.
        doubted[:, joints] = False
        told = restored_without(pose_of(take), joints, rows, evidence.progress, doubted=doubted)
    except DataError as problem:
        return refuse(NAME, str(problem), params)
    values = told.pose.positions[rows]
    if np.isnan(values[:, joints]).any():
        return refuse(NAME, "The joint is never seen elsewhere, so that nothing tells.", params)
    band = told.error_mm[rows, joints[0]].copy()
    patches = tuple(
        Patch(
            marker,
            axes,
            artifact.start,
            artifact.stop,
            values[:, joint][:, axis_columns(axes)].copy(),
        )
        for marker, joint in zip(artifact.markers, joints, strict=True)
    )
    if np.isnan(band).any():
        return Repair(NAME, patches, params=as_mapping(params))
    error = float(MEAN_OVER_RMS * band.mean())
    return Repair(NAME, patches, error_mm=error, band_mm=band, params=as_mapping(params))


def get_ready(take: Take, progress: Progress | None = None) -> None:
    """Restore a skeleton recording, on which all of its repairs rest, unless that was done.

    Parameters
    ----------
    take : a skeleton recording
    progress : told the share done; may raise to stop
    """
    with suppress(DataError):
        restored(pose_of(take), progress)
