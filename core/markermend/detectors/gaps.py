"""Simple gaps: where a marker was not seen."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, runs
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import how_long
from markermend.take import Take, is_unlabelled

# A marker seen in fewer frames than this share belongs to a calibration or to a labelling slip;
# there is no trajectory to complete.
LEAST_PRESENCE = 0.05
# With fewer markers of its body in view nothing says where a marker should be.
LEAST_BODY = 3


def detect_gaps(take: Take) -> tuple[Artifact, ...]:
    """Name every run of frames in which a labelled marker was not seen.

    Parameters
    ----------
    take : the recording

    Returns
    -------
    One artifact a run: kind gap, all axes, confidence 1, no amplitude; by marker, then start.

    Notes
    -----
    Trajectories without a name end where they end: their absence is no gap. Neither is that of
    a marker never seen, or seen in less than 5 % of the frames. Absence at the start or the end
    of a take is a gap only while at least three other markers of the same body are in view:
    before a person walks in and after they have left nobody is missing.
    """
    present = take.present
    found: list[Artifact] = []
    for subject in take.subjects:
        members = [
            i
            for i, label in enumerate(take.labels)
            if not is_unlabelled(label) and take.subject(label) == subject
        ]
        body = present[:, members].sum(axis=1) >= LEAST_BODY
        for marker in members:
            if present[:, marker].mean() >= LEAST_PRESENCE:
                found += _gaps_of(take, marker, present[:, marker], body)
    return tuple(found)


def _gaps_of(take: Take, marker: int, seen: BoolArray, body: BoolArray) -> list[Artifact]:
    """Gaps of one marker that is seen at some time."""
    at = np.flatnonzero(seen)
    inside = np.zeros(len(seen), dtype=bool)
    inside[at[0] : at[-1]] = True
    return [
        Artifact(
            marker=take.labels[marker],
            axes="xyz",
            start=int(start),
            stop=int(stop),
            kind=Kind.GAP,
            why=f"not seen for {how_long(int(stop - start), take.rate)}",
        )
        for start, stop in runs(~seen & (inside | body))
    ]
