"""How far segments that were added to 17 joints are from where they were, on people never seen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from markermend.poses.networks.learning_sets import subject_of
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.segments import CARRIERS, learn_segments, to_cmu


@dataclass(frozen=True)
class Added:
    """One added segment.

    Attributes
    ----------
    name : of the segment
    place_mm : mean distance of its end from the truth; 0 where a joint tells it
    turned_deg : mean angle between its rotation and the true one; 0 where a joint tells it
    """

    name: str
    place_mm: float
    turned_deg: float


def try_segments(clips: Mapping[str, Pose]) -> list[Added]:
    """Reduce recordings to 17 joints and add the segments by what others' recordings taught.

    Parameters
    ----------
    clips : name, which begins with the subject, to recording of the CMU skeleton

    Returns
    -------
    list
        one for each of :data:`~markermend.poses.segments.CARRIERS`, poses of all subjects pooled;
        none where there is one subject only
    """
    subjects = sorted({subject_of(name) for name in clips})
    if len(subjects) < 2:
        return []
    away, angle = [], []
    for subject in subjects:
        others = {name: p for name, p in clips.items() if subject_of(name) != subject}
        learnt = learn_segments(list(others.values()), names=list(others))
        for name, pose in clips.items():
            if subject_of(name) == subject:
                back = to_cmu(to_nuitrack(pose), learnt)
                ours = [back.index(segment) for segment in CARRIERS]
                true = [pose.index(segment) for segment in CARRIERS]
                off = back.positions[:, ours] - pose.positions[:, true]
                away.append(np.sqrt(np.sum(off**2, axis=2)))
                alike = np.sum(back.rotations[:, ours] * pose.rotations[:, true], axis=2)
                angle.append(np.degrees(2.0 * np.arccos(np.minimum(np.abs(alike), 1.0))))
    # Of poses in which something was not seen nothing is known.
    place, turned = (np.nanmean(np.concatenate(part), axis=0) for part in (away, angle))
    return [Added(*row) for row in zip(CARRIERS, place.tolist(), turned.tolist(), strict=True)]
