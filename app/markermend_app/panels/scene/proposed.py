"""The body as it would stand once the repairs that are proposed were made."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact, Status, axis_columns
from markermend_app.document import Document

AUTO = "auto"


def proposed_body(document: Document, now: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Joints where repairs that are known would put them, and which these are.

    A limb that is missing altogether has an artifact for each of its joints; what was worked out
    ahead for those that are open in this frame stands beside the repair under review.

    Parameters
    ----------
    document : with the frame that is looked at
    now : (markers, 3) mm in this frame

    Returns
    -------
    (markers, 3) mm, and (markers,) bool; nothing is proposed for takes of markers, whose segments
    are no bones
    """
    placed, proposed = now.copy(), np.zeros(len(now), dtype=bool)
    session, current = document.session, document.current
    if session is None or current is None or not session.original.skeleton:
        return placed, proposed
    if not current.start <= document.frame < current.stop:
        return placed, proposed
    open_ones = session.listed_with(Status.PENDING, Status.ACCEPTED)
    others = (a for a in open_ones if a.id != current.id and _covers(a, document.frame))
    repairs = [(a, document.proposals.get(a, AUTO)) for a in others]
    # What is under review is put down last.
    for artifact, repair in (*repairs, (current, document.proposal)):
        for patch in repair.patches if repair is not None else ():
            at = document.frame - patch.start
            if 0 <= at < len(patch.values) and artifact.status is not Status.REPAIRED:
                column = session.original.index(patch.marker)
                placed[column, axis_columns(patch.axes)] = patch.values[at]
                proposed[column] = True
    return placed, proposed


def _covers(artifact: Artifact, frame: int) -> bool:
    """Whether a frame lies in an artifact."""
    return artifact.start <= frame < artifact.stop
