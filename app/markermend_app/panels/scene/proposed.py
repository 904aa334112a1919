"""The body as it would stand once the repairs that are proposed were made."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Status, axis_columns, within
from markermend_app.document import Document

AUTO = "auto"


def proposed_body(document: Document, now: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Joints where repairs that are known would put them, and which these are.

    A limb that is missing altogether has an artifact for each of its joints; what was worked out
    ahead for those that are open in this frame stands beside the repairs under review.

    Parameters
    ----------
    document : with the frame that is looked at
    now : (markers, 3) mm in this frame

    Returns
    -------
    (markers, 3) mm, NaN where a joint is said to be wrong and nothing better is known yet, and
    (markers,) bool; nothing is proposed for takes of markers, whose segments are no bones
    """
    placed, proposed = now.copy(), np.zeros(len(now), dtype=bool)
    session, current, frame = document.session, document.current, document.frame
    if session is None or current is None or not session.original.skeleton:
        return placed, proposed
    if not current.start <= frame < current.stop:
        return placed, proposed
    index = session.original.index
    wrong = within(session.listed_with(Status.PENDING, Status.ACCEPTED), (frame, frame + 1))
    for artifact in wrong:
        for marker in artifact.markers:
            placed[index(marker), axis_columns(artifact.axes)] = np.nan
    at_once = {a.id: a for a in document.at_once(session)}
    repairs = [document.proposals.get(a, AUTO) for a in wrong if a.id not in at_once]
    # What is under review, which comes first there, is put down last.
    for artifact in reversed(at_once.values()):
        if artifact.status is not Status.REPAIRED:
            repairs.append(document.preview.get(artifact))
    for repair in repairs:
        for patch in repair.patches if repair is not None else ():
            at = frame - patch.start
            if 0 <= at < len(patch.values):
                column = index(patch.marker)
                placed[column, axis_columns(patch.axes)] = patch.values[at]
                proposed[column] = True
    return placed, proposed
